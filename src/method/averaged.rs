//! Averaged bumps (Blinn 1978 §5).

use std::sync::Arc;

use super::one_lobe::{OneLobe, OneLobeMap};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::{BaseLobe, EllipticLobe};
use crate::texture::{Bend, MIN_COSINE, Moments, NormalMap, Texel};

/// The base lobe about the normal of the averaged bump function.
///
/// Filtering the bump function F before it is used averages its derivatives, so the mean slope is what
/// is left of the bumps: N′ ∝ (−F̄ᵤ, −F̄ᵥ, 1). "If the bump texture is averaged the effect will be to
/// smooth out the bumps rather than average the intensities", as Blinn says: the roughness is lost.
///
/// Channels: [w, w·bₓ, w·b_y], b = n_xy / n_z.
#[derive(Clone, Copy, Debug, Default)]
pub struct Averaged;

const CARD: Card = Card {
    name: "averaged",
    source: "Blinn 1978, Simulation of Wrinkled Surfaces, §5",
    summary: "Averages the slopes over the footprint and shades the smooth surface left.",
    formula: "one base lobe about the normal of the mean slope",
    limits: "the roughness of the bumps it averages away is lost: highlights stay sharp",
    normalised: true,
    keeps_roughness: false,
    fractal: false,
    precision: 1e-3,
};

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry { card: CARD, parameters: &[], build: |_| Box::new(Averaged) }
}

impl Method for Averaged {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, _base: &BaseLobe) -> Result<f64, Refusal> {
        Ok(0.0)
    }

    fn bends(&self) -> bool {
        true
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        Ok(Box::new(OneLobeMap::build(map, base, MeanSlope { base: *base })))
    }
}

struct MeanSlope {
    base: BaseLobe,
}

impl Moments<3> for MeanSlope {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 3] {
        let per_z = w / z.max(MIN_COSINE);
        [w, x * per_z, y * per_z]
    }
}

impl OneLobe<3> for MeanSlope {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, [w, x, y]: [f32; 3]) -> EllipticLobe {
        // (x/w, y/w, 1) without the division: only the direction matters.
        self.base.about([x, y, w], w)
    }

    /// Averages of slopes are stretched as slopes are.
    #[inline(always)]
    fn bent(&self, [w, x, y]: [f32; 3], bend: &Bend) -> [f32; 3] {
        let [x, y, _] = bend.turn([x, y, w]);
        [w, x, y]
    }
}
