//! Fournier's Phong peak.

use super::vector::{V3, dot, tan_squared, tangents};
use super::{Facet, Profile, Slopes, Spread};
use crate::geometry::elementary::{exp32, ln_1p32};

/// a · max(0, h·d)ⁿ: amplitude, direction, exponent (Fournier 1992 §2.2). Four unknowns a peak, as
/// printed; each peak has its own exponent, which the printed sum leaves unclear.
///
/// The amplitude is a density per steradian at the peak; ∫ a cosⁿ · cos dω = 2π a / (n + 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongPeak {
    /// Density at the peak, a ≥ 0.
    pub amplitude: f32,
    /// Unit direction d in tangent space.
    pub direction: V3,
    /// Exponent n > 0.
    pub exponent: f32,
}

impl Spread for PhongPeak {
    #[inline(always)]
    fn density(&self, h: V3) -> f32 {
        let fall = exp32(-0.5 * self.exponent * ln_1p32(tan_squared(self.direction, h)));
        if dot(h, self.direction) > 0.0 { self.amplitude * fall } else { 0.0 }
    }

    /// A Blinn-Phong lobe's, times the amplitude.
    fn slopes(&self) -> Slopes {
        let (tangent, bitangent) = tangents(self.direction);
        let n = self.exponent.max(1e-3);
        Slopes {
            pole: self.direction,
            tangent,
            bitangent,
            amplitude: std::f32::consts::TAU * self.amplitude / (n + 2.0),
            mean: [0.0; 2],
            spread: [1.0 / n, 0.0, 1.0 / n],
            profile: Profile::Student { exponent: n },
        }
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        let (tangent, bitangent) = tangents(self.direction);
        // Walter et al. 2007: the Beckmann α of a Phong lobe.
        let alpha_squared = 2.0 / (self.exponent + 2.0);
        Facet {
            axis: self.direction,
            tangent,
            bitangent,
            alpha_squared: [alpha_squared, 0.0, alpha_squared],
            ggx: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::BaseLobe;

    #[test]
    fn a_peak_with_the_base_amplitude_is_the_base_lobe() {
        let s = 37.5_f32;
        let peak = PhongPeak {
            amplitude: (s + 2.0) / std::f32::consts::TAU,
            direction: [0.6, 0.0, 0.8],
            exponent: s,
        };
        let base = BaseLobe::BlinnPhong { exponent: f64::from(s) }.about([0.6, 0.0, 0.8], 1.0);
        for h in [[0.6, 0.0, 0.8], [0.0, 0.0, 1.0], [0.3, 0.4, 0.7], [-0.8, 0.0, 0.1]] {
            let (a, b) = (peak.density(h), base.density(h));
            assert!((a - b).abs() <= 2e-5 * b + 1e-6, "{h:?}: {a} {b}");
        }
    }
}
