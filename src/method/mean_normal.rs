//! The mean normal of footprints: what filters are held to where light comes from everywhere.

use std::sync::Arc;

use super::Card;
use super::one_lobe::filtered_share;
use crate::lobe::vector::V3;
use crate::texture::{Footprint, Moments, NormalMap, Pyramid, Texel};

/// w n, which averages as it is.
#[derive(Debug)]
struct Weighted;

impl Moments<3> for Weighted {
    #[inline(always)]
    fn encode(&self, [x, y, z, weight]: Texel) -> [f32; 3] {
        [x * weight, y * weight, z * weight]
    }
}

/// The mean of w n over footprints, looked up as methods look up theirs.
pub struct MeanNormals {
    map: Arc<NormalMap>,
    pyramid: Pyramid<Weighted, 3>,
}

impl MeanNormals {
    /// Of the map that a method has prefiltered. None if the method draws single normals, not all of a
    /// footprint ([`Card::keeps_roughness`]): what its lobes should add up to are those.
    pub fn beside(card: &Card, map: &Arc<NormalMap>) -> Option<Self> {
        card.keeps_roughness
            .then(|| Self { map: Arc::clone(map), pyramid: Pyramid::build(map, Weighted) })
    }

    /// The mean over a footprint, of any length up to the mean weight.
    pub fn at(&self, at: &Footprint) -> V3 {
        let level = at.level(self.map.width(), self.map.height());
        let share = filtered_share(level, at.lookup);
        let wide = self.pyramid.fetch(&self.map, at);
        let [x, y, z, weight] = self.map.normal_at(at.u, at.v);
        let here = [x, y, z].map(|c| weight * c);
        [0, 1, 2].map(|c| share * wide[c] + (1.0 - share) * here[c])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{brute_force, build};
    use crate::texture::Wrap;

    #[test]
    fn at_the_top_it_is_the_mean_of_all() {
        let map = NormalMap::from_fn(8, 4, Wrap::Repeat, |u, v| [u - 0.5, 0.3 * v, 1.0, 1.0 + u]);
        let map = Arc::new(map);
        let means = MeanNormals::beside(&build("lean").unwrap().card(), &map).unwrap();
        let at = Footprint { u: 0.3, v: 0.9, along_y: [0.0, 2.0], ..Footprint::whole() };
        for (c, got) in means.at(&at).into_iter().enumerate() {
            let sum: f32 = map.texels().iter().map(|t| t[c] * t[3]).sum();
            assert!((got - sum / 32.0).abs() < 1e-6);
        }
        assert!(MeanNormals::beside(&brute_force().card(), &map).is_none());
    }
}
