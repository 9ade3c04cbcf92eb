//! Mipmapping normal maps (Toksvig 2004).

use std::sync::Arc;

use super::one_lobe::{OneLobe, OneLobeMap};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::vector::dot;
use crate::lobe::{BaseLobe, EllipticLobe, Profile};
use crate::texture::{Moments, NormalMap, Texel};

/// One round lobe about the mean normal, wider the shorter that mean is.
///
/// Unit normals that disagree have a mean of length R < 1. A narrow round Gaussian of slope variance σ²
/// an axis leaves R ≈ 1/(1 + σ²), so σ² = (1 − R)/R, and 1/s′ = 1/s + σ² (the paper's equation for
/// its "Toksvig factor", s′ = s·R/(R + s(1 − R))). It needs no channel that a mip map of normals has
/// not got already. The lobe is normalised here as any base lobe is, in place of the paper's
/// (1 + s′)/(1 + s).
///
/// Channels: [w·n, w].
#[derive(Clone, Copy, Debug, Default)]
pub struct Toksvig;

const CARD: Card = Card {
    name: "toksvig",
    source: "Toksvig 2004, Mipmapping Normal Maps",
    summary: "The mean normal, and a round lobe as wide as that mean is short.",
    formula: "the base lobe about the mean normal, variance 1/s + (1 − R)/R, R = |mean unit normal|",
    limits: "one round lobe: directional bumps blur to both sides, two peaks become one broad hill",
    normalised: true,
    keeps_roughness: true,
    fractal: false,
    precision: 1e-3,
};

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry { card: CARD, parameters: &[], build: |_| Box::new(Toksvig) }
}

impl Method for Toksvig {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, _base: &BaseLobe) -> Result<f64, Refusal> {
        Ok(0.0)
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        Ok(Box::new(OneLobeMap::build(map, base, MeanNormal { base: *base })))
    }
}

struct MeanNormal {
    base: BaseLobe,
}

impl Moments<4> for MeanNormal {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 4] {
        [w * x, w * y, w * z, w]
    }
}

impl OneLobe<4> for MeanNormal {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, [wx, wy, wz, w]: [f32; 4]) -> EllipticLobe {
        let sum = [wx, wy, wz];
        let amplitude = dot(sum, sum).sqrt();
        // Held to 1/64 like slopes: opposite normals leave no mean at all.
        let length = (amplitude / w.max(f32::MIN_POSITIVE)).clamp(SHORTEST, 1.0);
        let variance = (1.0 - length) / length;
        let spread = self.base.spread() as f32;
        let (spread, profile) = match self.base {
            // A Phong lobe of exponent s′: its tails widen as its peak does.
            BaseLobe::BlinnPhong { .. } => {
                let spread = spread + variance;
                (spread, Profile::Student { exponent: 1.0 / spread })
            }
            BaseLobe::Beckmann { .. } => (spread + variance, Profile::Gaussian),
            // GGX has no variance; bumps add to its α² as they add to Beckmann's, twice theirs.
            BaseLobe::Ggx { .. } => (spread + 2.0 * variance, Profile::Ggx),
        };
        EllipticLobe::new(sum, [spread, 0.0, spread], amplitude, profile)
    }
}

/// The shortest mean normal that is still measured.
const SHORTEST: f32 = 1.0 / 64.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::Spread;

    const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 50.0 };

    fn lobe(base: BaseLobe, channels: [f32; 4]) -> EllipticLobe {
        MeanNormal { base }.lobe(channels)
    }

    #[test]
    fn a_single_normal_is_the_base_lobe() {
        let bases = [BASE, BaseLobe::Beckmann { alpha: 0.2 }, BaseLobe::Ggx { alpha: 0.2 }];
        for base in bases {
            let got = lobe(base, MeanNormal { base }.encode([0.6, 0.0, 0.8, 1.5]));
            let want = base.about([0.6, 0.0, 0.8], 1.5);
            for h in [[0.6, 0.0, 0.8], [0.5, 0.1, 0.85], [0.0, 0.0, 1.0]] {
                assert!((got.density(h) / want.density(h) - 1.0).abs() < 1e-4, "{base}");
            }
        }
    }

    #[test]
    fn the_exponent_is_the_papers() {
        // s′ = s·R/(R + s (1 − R)), and the peak that of a Phong lobe of exponent s′.
        let (s, r) = (50.0f32, 0.9f32);
        let narrowed = s * r / (r + s * (1.0 - r));
        let lobe = lobe(BASE, [0.0, 0.0, r, 1.0]);
        assert!((lobe.spread()[0] * narrowed - 1.0).abs() < 1e-5);
        let phong = BaseLobe::BlinnPhong { exponent: narrowed.into() };
        for t in [0.0f32, 0.04, 0.5] {
            let want = phong.density(t.into()) as f32 * r;
            let h = [t.sqrt(), 0.0, 1.0].map(|c| c / (1.0 + t).sqrt());
            assert!((lobe.density(h) / want - 1.0).abs() < 1e-4, "{t}");
        }
    }

    #[test]
    fn a_von_mises_fisher_spread_is_measured_as_one_over_kappa_less_one() {
        // Mean length coth κ − 1/κ, which is 1 − 1/κ to far below rounding here.
        for kappa in [20.0f32, 100.0, 1000.0] {
            let spread = lobe(BASE, [0.0, 0.0, 1.0 - 1.0 / kappa, 1.0]).spread()[0];
            assert!(((spread - 0.02) * (kappa - 1.0) - 1.0).abs() < 1e-3, "{kappa}: {spread}");
        }
    }

    #[test]
    fn opposite_normals_still_make_a_finite_lobe() {
        let lobe = lobe(BASE, [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(lobe.density([0.0, 0.0, 1.0]), 0.0);
    }
}
