//! A map that is there already, shaded by the NDF measured from it (Kautz et al. 2001 §7).

use std::sync::Arc;

use super::super::{
    Batch, Card, Entry, Lane, Method, PrefilterError, Prefiltered, Progress, Refusal,
};
use super::OwnNdf;
use crate::lobe::{BaseLobe, MultipleSurface, NdfImage, Shading};
use crate::parameter::{Domain, Parameter};
use crate::synthesis::{MicroFrame, Noise, Normals, frame_about};
use crate::texture::{Footprint, Moments, NormalMap, Pyramid, Texel};

/// The NDF measured from the map, in the frame of the normal that the averaged indices of its texels lead to.
///
/// Normals n become indices r₁ = G⁻¹(M(n_x)), r₂ = G⁻¹(C(n_y|n_x)); these are averaged, and lead back to a normal:
/// from afar to the middle of the distribution. "Another extension is to generate an NDF for an existing bump map and
/// then use the NDF for shading of the bump map. Again under the assumption of a fractal surface, this will produce
/// consistent shading across different levels of detail. Of course this is still not the same as correctly mipmapping
/// a bump map as proposed by Fournier" (§7).
///
/// The NDF is the base lobe about all the map's normals. Channels: [w, w·r₁, w·r₂].
#[derive(Clone, Copy, Debug)]
pub struct Kautz {
    /// Pixels along a side of the NDF.
    pub side: usize,
}

const CARD: Card = Card {
    name: "kautz",
    source: "Kautz, Heidrich and Seidel 2001, Real-Time Bump Map Synthesis, §7",
    summary: "The NDF measured from the whole map, about the normal of the averaged indices.",
    formula: "p(h) in the frame of n(r̄₁, r̄₂), r₁ = G⁻¹(M(n_x)), r₂ = G⁻¹(C(n_y|n_x)), p the NDF of the map's normals \
              and the base lobe",
    limits: "takes bumps to go on below the texels: close up each normal is as rough as all of the map; a region unlike \
             the rest gets the rest's roughness; x comes before y, so a map and the same map turned are not quite alike",
    normalised: true,
    keeps_roughness: true,
    fractal: true,
    // Half of what a map and the same map turned by 90° may differ by: M and C treat x and y unlike.
    precision: 0.065,
};

const PARAMETERS: &[Parameter] = &[Parameter {
    name: "side",
    meaning: "pixels along a side of the NDF's image",
    domain: Domain::Whole { default: 128, min: 16, max: 512 },
}];

/// The registry's line.
pub fn entry() -> Entry {
    Entry {
        card: CARD,
        parameters: PARAMETERS,
        build: |values| Box::new(Kautz { side: values.whole("side") }),
    }
}

impl Method for Kautz {
    fn card(&self) -> Card {
        CARD
    }

    /// 1: every normal is shaded by the NDF of the whole map, so it claims nothing about single ones.
    fn base_error(&self, _base: &BaseLobe) -> Result<f64, Refusal> {
        Ok(1.0)
    }

    fn prefilter_work(&self) -> f64 {
        40.0
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        let ndf = measured(map, base, self.side);
        if progress.cancelled() {
            return Err(PrefilterError::Cancelled);
        }
        let pyramid = Pyramid::build(map, Indices(Normals::new(&ndf, Noise::default().gain)));
        let (ndf, up) = (OwnNdf::new(Arc::new(ndf)), mean_cosine(map));
        Ok(Box::new(MeasuredMap { map: Arc::clone(map), ndf, up, pyramid }))
    }
}

/// The NDF of a map's normals and the base lobe; of a map without any that point up and have weight, which sends no
/// light, the base lobe's own.
fn measured(map: &NormalMap, base: &BaseLobe, side: usize) -> NdfImage {
    NdfImage::of_normals(map.texels(), Some(base), side).unwrap_or_else(|_| {
        let own = [base.about([0.0, 0.0, 1.0], 1.0)].into_iter().collect();
        NdfImage::of_surface(&own, side).expect("a base lobe has density")
    })
}

/// Σ w n_z / Σ w over normals that point up: what is left of a base lobe's unit of light when its normal leans. An NDF
/// has it normalised away.
fn mean_cosine(map: &NormalMap) -> f32 {
    let up = map.texels().iter().filter(|t| t[2] > 0.0);
    let (sum, weight) = up.fold((0.0f64, 0.0f64), |(sum, weight), [_, _, z, w]| {
        (sum + f64::from(w * z), weight + f64::from(*w))
    });
    if weight > 0.0 { (sum / weight) as f32 } else { 1.0 }
}

/// From a texel to its weighted indices.
struct Indices(Normals);

impl Moments<3> for Indices {
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 3] {
        let [r1, r2] = self.0.indices_of([x, y, z]).map(|r| r as f32);
        [w, w * r1, w * r2]
    }
}

struct MeasuredMap {
    map: Arc<NormalMap>,
    ndf: OwnNdf,
    /// See [`mean_cosine`].
    up: f32,
    pyramid: Pyramid<Indices, 3>,
}

impl MeasuredMap {
    /// The microfacet of the averaged indices, and its amplitude.
    fn microfacet(&self, at: &Footprint) -> (MicroFrame, f32) {
        let [w, r1, r2] = self.pyramid.fetch(&self.map, at);
        let mean = [r1, r2].map(|r| f64::from(r / w.max(f32::MIN_POSITIVE)));
        (frame_about(self.pyramid.moments().0.at(mean)), w * self.up)
    }
}

impl Prefiltered for MeasuredMap {
    fn bytes(&self) -> usize {
        self.pyramid.bytes() + self.ndf.image.bytes()
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let (frame, weight) = self.microfacet(at);
        self.ndf.about(frame, weight)
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        self.ndf.shade(batch, shading, radiance, |i| self.microfacet(&batch.footprint(i)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Silent;
    use crate::texture::Wrap;

    const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 40.0 };

    fn on(map: NormalMap) -> Box<dyn Prefiltered> {
        Kautz { side: 128 }.prefilter(&Arc::new(map), &BASE, &Silent).unwrap()
    }

    #[test]
    fn from_afar_it_is_the_mixture_of_all_base_lobes() {
        // Bumps that lean to all sides alike: the middle of their distribution is the surface's own normal.
        let map = NormalMap::from_fn(32, 32, Wrap::Repeat, |u, v| {
            let [x, y] = [u, v].map(|c| libm::sin(std::f64::consts::TAU * c));
            [0.4 * x, 0.3 * y, 1.0, 1.0]
        });
        let mixture: MultipleSurface =
            map.texels().iter().map(|t| BASE.about([t[0], t[1], t[2]], 1.0 / 1024.0)).collect();
        let far = on(map).lobes_at(&Footprint::whole());
        for h in [[0.0, 0.0, 1.0], [0.3, 0.1, 0.9], [-0.4, 0.4, 0.8], [0.1, -0.5, 0.7]] {
            let h = crate::lobe::vector::unit(h);
            let (want, got) = (mixture.density(h), far.density(h));
            assert!(
                (got - want).abs() < 0.03 * mixture.density([0.0, 0.0, 1.0]),
                "{h:?}: {got} {want}"
            );
        }
    }

    #[test]
    fn a_flat_map_is_the_base_lobe() {
        let surface = on(NormalMap::from_fn(4, 4, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]))
            .lobes_at(&Footprint::whole());
        for x in [0.0f32, 0.1, 0.3, 0.5] {
            let t = f64::from(x * x / (1.0 - x * x));
            let got = f64::from(surface.density([x, 0.0, (1.0 - x * x).sqrt()]));
            assert!((got - BASE.density(t)).abs() < 0.01 * BASE.density(0.0), "{x}: {got}");
        }
    }

    #[test]
    fn a_map_without_weight_is_dark() {
        let nothing = on(NormalMap::new(2, 2, Wrap::Repeat, vec![[0.0, 0.0, 1.0, 0.0]; 4]));
        assert_eq!(nothing.lobes_at(&Footprint::whole()).density([0.0, 0.0, 1.0]), 0.0);
    }
}
