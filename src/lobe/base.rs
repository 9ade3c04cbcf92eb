//! Base lobes: how the unbumped surface spreads light, before any filter.

use serde::{Deserialize, Serialize};

use super::{EllipticLobe, Profile};
use crate::geometry::elementary::{exp64, ln64};

/// The spread of microfacet normals about a surface's own normal.
///
/// Each is normalised: ∫ D(h) (h·n) dω = 1 over the hemisphere about n. With t = tan² of the angle
/// between h and n:
///
/// | lobe | D | slope variance per axis |
/// |---|---|---|
/// | Blinn-Phong (Blinn 1977) | (s+2)/2π · (1+t)^(−s/2), which is (s+2)/2π · cosˢ | 1/s |
/// | Beckmann (Cook-Torrance 1982) | exp(−t/α²) (1+t)² / (π α²) | α²/2 |
/// | GGX (Walter et al. 2007) | (1+t)² / (π α² (1 + t/α²)²) | infinite |
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "lobe", rename_all = "kebab-case")]
pub enum BaseLobe {
    /// Blinn-Phong with exponent s > 0: what the five papers use.
    BlinnPhong {
        /// The exponent s.
        exponent: f64,
    },
    /// Beckmann with roughness α > 0 (α² is the mean squared slope; not the artist's √α).
    Beckmann {
        /// The roughness α.
        alpha: f64,
    },
    /// GGX, also called Trowbridge-Reitz, with roughness α > 0.
    Ggx {
        /// The roughness α.
        alpha: f64,
    },
}

impl BaseLobe {
    /// The lobe's name in specs and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::BlinnPhong { .. } => "blinn-phong",
            Self::Beckmann { .. } => "beckmann",
            Self::Ggx { .. } => "ggx",
        }
    }

    /// The number that states its width: exponent or α.
    pub fn parameter(&self) -> f64 {
        match *self {
            Self::BlinnPhong { exponent } => exponent,
            Self::Beckmann { alpha } | Self::Ggx { alpha } => alpha,
        }
    }

    /// The spread matrix entry of [`Profile`] that reproduces this lobe: slope variance per axis for
    /// Blinn-Phong and Beckmann, α² for GGX, which has none.
    pub fn spread(&self) -> f64 {
        match *self {
            Self::BlinnPhong { exponent } => 1.0 / exponent,
            Self::Beckmann { alpha } => 0.5 * alpha * alpha,
            Self::Ggx { alpha } => alpha * alpha,
        }
    }

    /// The slope profile of this lobe.
    pub fn profile(&self) -> Profile {
        match *self {
            Self::BlinnPhong { exponent } => Profile::Student { exponent: exponent as f32 },
            Self::Beckmann { .. } => Profile::Gaussian,
            Self::Ggx { .. } => Profile::Ggx,
        }
    }

    /// D at an angle whose squared tangent is `t` ≥ 0, per steradian, in double precision.
    pub fn density(&self, t: f64) -> f64 {
        use std::f64::consts::{PI, TAU};
        let ln_sec_squared = if t < 1e-4 { libm::log1p(t) } else { ln64(1.0 + t) };
        match *self {
            Self::BlinnPhong { exponent: s } => (s + 2.0) / TAU * exp64(-0.5 * s * ln_sec_squared),
            Self::Beckmann { alpha } => {
                let square = alpha * alpha;
                exp64(-t / square) * (1.0 + t) * (1.0 + t) / (PI * square)
            }
            Self::Ggx { alpha } => {
                let square = alpha * alpha;
                let ratio = (1.0 + t) / (1.0 + t / square);
                ratio * ratio / (PI * square)
            }
        }
    }

    /// This lobe about a normal of any length, with an amplitude, as a slope lobe.
    #[inline(always)]
    pub fn about(&self, normal: super::vector::V3, amplitude: f32) -> EllipticLobe {
        let spread = self.spread() as f32;
        EllipticLobe::new(normal, [spread, 0.0, spread], amplitude, self.profile())
    }
}

impl std::fmt::Display for BaseLobe {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::BlinnPhong { exponent } => write!(f, "Blinn-Phong, exponent {exponent}"),
            Self::Beckmann { alpha } => write!(f, "Beckmann, α {alpha}"),
            Self::Ggx { alpha } => write!(f, "GGX, α {alpha}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<BaseLobe> {
        let mut lobes = Vec::new();
        for alpha in [0.05, 0.2, 0.7] {
            lobes.extend([BaseLobe::Beckmann { alpha }, BaseLobe::Ggx { alpha }]);
        }
        lobes.extend([1.0, 10.0, 200.0, 5000.0].map(|exponent| BaseLobe::BlinnPhong { exponent }));
        lobes
    }

    /// ∫ f(t) dω over the hemisphere with t = tan²θ, by the substitution c = cos²θ and the midpoint
    /// rule after a further u⁴ stretch that resolves narrow lobes.
    fn integrate(f: impl Fn(f64, f64) -> f64) -> f64 {
        let n = 200_000;
        (0..n)
            .map(|i| {
                let u = (f64::from(i) + 0.5) / f64::from(n);
                // θ = (π/2) u³
                let theta = std::f64::consts::FRAC_PI_2 * u * u * u;
                let d_theta = std::f64::consts::FRAC_PI_2 * 3.0 * u * u / f64::from(n);
                let (sin, cos) = libm::sincos(theta);
                let tan = sin / cos;
                f(tan * tan, cos) * std::f64::consts::TAU * sin * d_theta
            })
            .sum()
    }

    #[test]
    fn every_base_lobe_passes_the_furnace() {
        for lobe in all() {
            let total = integrate(|t, cos| lobe.density(t) * cos);
            assert!((total - 1.0).abs() < 1e-6, "{lobe}: {total}");
        }
    }

    #[test]
    fn slope_variance_is_the_spread() {
        for lobe in all().into_iter().filter(|l| !matches!(l, BaseLobe::Ggx { .. })) {
            if lobe == (BaseLobe::BlinnPhong { exponent: 1.0 }) {
                continue; // its tail falls so slowly that the midpoint rule is not enough
            }
            // The variance per axis is half of E[tan²].
            let variance = 0.5 * integrate(|t, cos| lobe.density(t) * cos * t);
            assert!((variance / lobe.spread() - 1.0).abs() < 1e-4, "{lobe}: {variance}");
        }
    }

    #[test]
    fn the_slope_lobe_is_the_base_lobe() {
        use crate::lobe::Spread;
        for lobe in all() {
            let slope_lobe = lobe.about([0.0, 0.0, 1.0], 1.0);
            for degrees in [0.0f64, 0.5, 3.0, 20.0, 60.0] {
                let (sin, cos) = libm::sincos(degrees.to_radians());
                let h = [sin as f32, 0.0, cos as f32];
                let t = (f64::from(h[0]) / f64::from(h[2])).powi(2);
                let want = lobe.density(t);
                let got = f64::from(slope_lobe.density(h));
                let error = (got - want).abs();
                assert!(
                    error <= 2e-5 * want + 1e-9 * lobe.density(0.0),
                    "{lobe} {degrees}°: {got} {want}"
                );
            }
        }
    }
}
