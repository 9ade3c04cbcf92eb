//! Base lobes as kernels want them: round, about a normal of any length, single precision, one type
//! each so that a loop over lanes knows which it has.

use std::f32::consts::{PI, TAU};

use super::facet::{smith_beckmann, smith_ggx};
use super::vector::{V3, cross, dot};
use crate::geometry::elementary::{exp32, ln_1p32};

/// A base lobe; see [`super::BaseLobe`] for the formulas.
pub trait RoundLobe: Copy {
    /// D where the squared tangent of the angle to the normal is `t` ≥ 0, per steradian.
    fn density(self, t: f32) -> f32;

    /// Smith's G₁ where α² tan² of the angle to the normal is `a`.
    fn smith(a: f32) -> f32;

    /// α² of its facet.
    fn alpha_squared(self) -> f32;

    /// G₁(l) G₁(v) / (4 n·v) about a normal of any length; 0 if light or eye is below it.
    #[inline(always)]
    fn geometry(self, normal: V3, light: V3, view: V3) -> f32 {
        let length_squared = dot(normal, normal);
        let g1 = |d: V3, cosine: f32| {
            let sine = cross(normal, d);
            let square = (cosine * cosine).max(f32::MIN_POSITIVE);
            Self::smith(self.alpha_squared() * dot(sine, sine) / square)
        };
        let (to_light, to_view) = (dot(normal, light), dot(normal, view));
        let cosine = (to_view / length_squared.sqrt()).max(f32::MIN_POSITIVE);
        let value = g1(light, to_light) * g1(view, to_view) / (4.0 * cosine);
        if (to_light > 0.0) & (to_view > 0.0) { value } else { 0.0 }
    }
}

/// Blinn-Phong.
#[derive(Clone, Copy, Debug)]
pub struct Phong {
    minus_half_exponent: f32,
    peak: f32,
    alpha_squared: f32,
}

impl Phong {
    /// With exponent s > 0.
    pub fn new(exponent: f64) -> Self {
        let s = exponent as f32;
        Self {
            minus_half_exponent: -0.5 * s,
            peak: (s + 2.0) / TAU,
            alpha_squared: 2.0 / (s + 2.0),
        }
    }
}

impl RoundLobe for Phong {
    #[inline(always)]
    fn density(self, t: f32) -> f32 {
        self.peak * exp32(self.minus_half_exponent * ln_1p32(t))
    }

    #[inline(always)]
    fn smith(a: f32) -> f32 {
        smith_beckmann(a)
    }

    #[inline(always)]
    fn alpha_squared(self) -> f32 {
        self.alpha_squared
    }
}

/// Beckmann.
#[derive(Clone, Copy, Debug)]
pub struct Beckmann {
    minus_inverse: f32,
    peak: f32,
    alpha_squared: f32,
}

impl Beckmann {
    /// With roughness α > 0.
    pub fn new(alpha: f64) -> Self {
        let square = (alpha * alpha) as f32;
        Self { minus_inverse: -1.0 / square, peak: 1.0 / (PI * square), alpha_squared: square }
    }
}

impl RoundLobe for Beckmann {
    #[inline(always)]
    fn density(self, t: f32) -> f32 {
        let secant_squared = 1.0 + t;
        self.peak * exp32(self.minus_inverse * t) * (secant_squared * secant_squared)
    }

    #[inline(always)]
    fn smith(a: f32) -> f32 {
        smith_beckmann(a)
    }

    #[inline(always)]
    fn alpha_squared(self) -> f32 {
        self.alpha_squared
    }
}

/// GGX.
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    inverse: f32,
    peak: f32,
    alpha_squared: f32,
}

impl Ggx {
    /// With roughness α > 0.
    pub fn new(alpha: f64) -> Self {
        let square = (alpha * alpha) as f32;
        Self { inverse: 1.0 / square, peak: 1.0 / (PI * square), alpha_squared: square }
    }
}

impl RoundLobe for Ggx {
    #[inline(always)]
    fn density(self, t: f32) -> f32 {
        let ratio = (1.0 + t) / (1.0 + t * self.inverse);
        self.peak * (ratio * ratio)
    }

    #[inline(always)]
    fn smith(a: f32) -> f32 {
        smith_ggx(a)
    }

    #[inline(always)]
    fn alpha_squared(self) -> f32 {
        self.alpha_squared
    }
}
