//! What a filter can be held to: brute force over the bumps, without or with masking and self-shadowing.

use std::sync::Arc;

use super::one_lobe::unfiltered_lobe;
use super::{Batch, Lane, Prefiltered, Silent, brute_force};
use crate::lobe::{BaseLobe, EllipticLobe, MultipleSurface, Shading, Spread};
use crate::texture::{Footprint, NormalMap, Relief};

/// What a supersampled reference shows of the bumps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Truth {
    /// Their normals alone, as bump mapping does (Blinn 1978).
    #[default]
    Bumps,
    /// Their normals, dark where the heights hide them from the light or from the eye: what Fournier
    /// approximates (1992 §5).
    Masked,
    /// The heights themselves, as a ray from the eye meets them and a ray to the light leaves them.
    Relief,
}

impl Truth {
    /// Every truth, the default first.
    pub const ALL: [Self; 3] = [Self::Bumps, Self::Masked, Self::Relief];

    /// Its name in specs and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bumps => "bumps",
            Self::Masked => "masked",
            Self::Relief => "relief",
        }
    }

    /// What a reference shows where it is not the bumps alone, to go on a sentence.
    pub fn meaning(self) -> Option<&'static str> {
        match self {
            Self::Bumps => None,
            Self::Masked => Some("the bumps dark where their heights hide them from light or eye"),
            Self::Relief => {
                Some("the heights themselves, as rays from the eye and to the light meet them")
            }
        }
    }
}

/// The map that, with many samples a pixel, converges to a truth. Heights are the map's own, or else
/// integrated from its normals.
pub fn truth(truth: Truth, map: &Arc<NormalMap>, base: &BaseLobe) -> Box<dyn Prefiltered> {
    if truth == Truth::Bumps {
        let unfiltered = brute_force().prefilter(map, base, &Silent);
        return unfiltered.expect("the unfiltered method takes every lobe");
    }
    let relief = Relief::new(map.heights_or_integrated());
    Box::new(ReliefMap { map: Arc::clone(map), base: *base, relief, through: truth })
}

/// A normal map over its heights, shaded one ray at a time.
///
/// Directions in tangent space are directions in texture space, as texels are square; the surface is
/// taken for flat as far as rays go (1992 §5: "we made no attempts to take the object curvature into
/// account").
///
/// - Masked: the normal at the sample, if both light and eye can be seen from the heights there.
/// - Relief: the heights lie on the surface, height 0 in it. The ray of a sample goes on, from the
///   greatest height in, to what it meets first; the normal there shades, if it sees the light. Rays
///   meet leaning surface as often as its size asks for, so weights above 1, which stand for that size
///   where it is looked at from above, count as 1.
struct ReliefMap {
    map: Arc<NormalMap>,
    base: BaseLobe,
    relief: Relief,
    through: Truth,
}

impl ReliefMap {
    /// The lobe that a sample at (u, v) shows an eye in direction `view`, and where it is, in texels.
    fn shown(&self, u: f32, v: f32, view: [f64; 3]) -> (EllipticLobe, [f64; 2]) {
        let size = [self.map.width() as f64, self.map.height() as f64];
        let at = [f64::from(u) * size[0], f64::from(v) * size[1]];
        if self.through == Truth::Masked {
            let here = Footprint { u, v, ..Footprint::default() };
            return (unfiltered_lobe(&self.map, &self.base, &here), at);
        }
        let seen = self.relief.seen_at(at, view);
        let fold = |axis: usize| self.map.wrap().fold(seen[axis] / size[axis]) as f32;
        let [x, y, z, weight] = self.map.sample(fold(0), fold(1));
        (self.base.about([x, y, z], weight.min(1.0)), seen)
    }
}

impl Prefiltered for ReliefMap {
    fn bytes(&self) -> usize {
        0
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn needs_directions(&self) -> bool {
        true
    }

    /// The bumps' own, whatever hides them.
    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let mut surface = MultipleSurface::new();
        surface.add(unfiltered_lobe(&self.map, &self.base, at), 1.0);
        surface
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        for (i, out) in radiance.iter_mut().enumerate().take(batch.len) {
            *out = 0.0;
            if batch.irradiance[i] <= 0.0 {
                continue;
            }
            let [light, view] = [batch.light(i), batch.view(i)];
            let [to_light, to_eye] = [light, view].map(|d| d.map(f64::from));
            let (lobe, at) = self.shown(batch.u[i], batch.v[i], to_eye);
            let sent = batch.irradiance[i] * lobe.radiance(shading, batch.half(i), light, view);
            let sees = |direction| self.relief.sees(at, direction);
            let hidden = self.through == Truth::Masked && !sees(to_eye);
            if sent > 0.0 && !hidden && sees(to_light) {
                *out = sent;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::vector::unit;
    use crate::method::BATCH;
    use crate::texture::{HeightMap, Wrap};

    const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 20.0 };

    /// A batch over the whole map, light and eye as given.
    fn batch(light: [f32; 3], view: [f32; 3]) -> Batch {
        let (light, view) = (unit(light), unit(view));
        let mut batch = Batch { len: BATCH, ..Batch::default() };
        for i in 0..BATCH {
            batch.u[i] = ((i * 37) % BATCH) as f32 / BATCH as f32;
            batch.v[i] = i as f32 / BATCH as f32;
            batch.irradiance[i] = 2.0;
            for c in 0..3 {
                (batch.light[c][i], batch.view[c][i]) = (light[c], view[c]);
                batch.half[c][i] = light[c] + view[c];
            }
        }
        batch
    }

    fn shaded(through: Truth, map: &Arc<NormalMap>, batch: &Batch) -> Lane {
        let mut radiance = [f32::NAN; BATCH];
        truth(through, map, &BASE).shade(batch, Shading::Ndf, &mut radiance);
        radiance
    }

    fn bumpy() -> Arc<NormalMap> {
        let wave = |u: f64, v: f64| 3.0 * (12.6 * u).sin() + 2.0 * (6.3 * (v + u)).cos();
        let heights = HeightMap::from_fn(16, 16, Wrap::Repeat, wave);
        let map = NormalMap::from_heights(&heights, 1.0);
        Arc::new(map.with_heights(Arc::new(heights)))
    }

    #[test]
    fn flat_ground_hides_nothing() {
        let flat = NormalMap::from_fn(5, 4, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]);
        let (flat, batch) = (Arc::new(flat), batch([0.5, 0.1, 0.05], [-0.4, 0.3, 0.2]));
        let bumps = shaded(Truth::Bumps, &flat, &batch);
        for through in [Truth::Masked, Truth::Relief] {
            for (got, want) in shaded(through, &flat, &batch).iter().zip(bumps) {
                assert!((got - want).abs() <= 1e-5 * want, "{got} {want}");
            }
        }
    }

    #[test]
    fn masking_treats_light_and_eye_alike() {
        let (a, b) = ([0.9, 0.2, 0.3], [-0.5, 0.7, 0.4]);
        let map = bumpy();
        let there = shaded(Truth::Masked, &map, &batch(a, b));
        assert_eq!(there, shaded(Truth::Masked, &map, &batch(b, a)));
        let dark = there.iter().filter(|r| **r == 0.0).count();
        assert!(dark > BATCH / 8 && dark < BATCH, "{dark} of {BATCH}");
    }

    #[test]
    fn what_is_masked_is_dark_and_the_rest_as_it_was() {
        let (map, batch) = (bumpy(), batch([0.9, 0.2, 0.3], [0.1, 0.2, 1.0]));
        let bumps = shaded(Truth::Bumps, &map, &batch);
        for (got, want) in shaded(Truth::Masked, &map, &batch).iter().zip(bumps) {
            assert!(*got == 0.0 || (got - want).abs() <= 1e-5 * want, "{got} {want}");
        }
    }

    #[test]
    fn looking_straight_down_the_relief_is_what_is_lit() {
        let (map, batch) = (bumpy(), batch([0.9, 0.2, 0.3], [0.0, 0.0, 1.0]));
        assert_eq!(shaded(Truth::Relief, &map, &batch), shaded(Truth::Masked, &map, &batch));
    }
}
