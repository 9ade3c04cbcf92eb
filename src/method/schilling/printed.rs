//! The printed forms: the modified Blinn-Phong model of appendix A.

use super::roughness::{
    Codes, central_moments, covariance, divided, factor, multiplied, raw_moments, widest,
};
use crate::geometry::elementary::exp64;
use crate::lobe::vector::Sym2;
use crate::lobe::{BaseLobe, Contour, Fall, PedalLobe};
use crate::method::nearness::{energy, tan_squared};
use crate::method::one_lobe::OneLobe;
use crate::texture::{MIN_COSINE, Moments, Texel};

/// How far, between the centres of cells, the interpolated triangular D makes results depend on how a
/// map is turned: up to 4 % on smooth bumps with slopes up to 0.7.
pub const TRIANGULAR: f64 = 0.05;
/// The same where D is taken for its transpose, which depends on it within cells too.
const TRANSPOSED: f64 = 0.3;

/// What the print's d⁴/|Dd|² is taken to be, d the projection of n − h.
///
/// | reading | q of d⁴/q | what it does |
/// |---|---|---|
/// | deviation | \|Dᵀd\|² = dᵀK d | divides tan α by the standard deviation in the direction of d: evidently meant |
/// | literal | \|Dd\|² | as printed: with b ≠ 0 widest along another axis than K, (2.5 1.5; 1.5 2.5) at 63.4° |
/// | elliptical | d⁴/\|D⁻¹d\|² | contours xᵀK⁻¹x = const |
///
/// On round K they are one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    Deviation,
    Literal,
    Elliptical,
}

impl Reading {
    /// A relative error of its own; see [`crate::method::Card::precision`].
    pub fn precision(self) -> f64 {
        if self == Self::Literal { TRANSPOSED } else { 0.0 }
    }

    fn contour(self) -> Contour {
        if self == Self::Elliptical { Contour::Ellipse } else { Contour::Pedal }
    }
}

/// The lobe at a single normal: its fall, its variance at the bottom level, and its peak of unit energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    fall: Fall,
    variance: f64,
    peak: f64,
}

impl Shape {
    /// cosᵐ α′: in slopes (1 + |x|²/(m v))^(−m/2), v the base lobe's variance. So that its width means v, the
    /// paper's σ is √(m v), 1 if m is the base exponent; tails are heavier the smaller m is, and the
    /// variance of slopes is v for that m alone.
    pub fn power(base: &BaseLobe, exponent: f64) -> Self {
        let fall = Fall::Power { exponent: exponent as f32 };
        let shape = Self { fall, variance: base.spread(), peak: 1.0 };
        let peak = if shape.is(base) {
            (exponent + 2.0) / std::f64::consts::TAU
        } else {
            1.0 / energy(|x| shape.density(x))
        };
        Self { peak, ..shape }
    }

    /// exp(−½ tan²α′): in slopes exp(−|x|²/2v).
    pub fn gaussian(base: &BaseLobe) -> Self {
        let shape = Self { fall: Fall::Gaussian, variance: base.spread(), peak: 1.0 };
        Self { peak: 1.0 / energy(|x| shape.density(x)), ..shape }
    }

    /// Whether it is the base lobe.
    pub fn is(&self, base: &BaseLobe) -> bool {
        match (self.fall, *base) {
            (Fall::Power { exponent: m }, BaseLobe::BlinnPhong { exponent }) => {
                m == exponent as f32
            }
            _ => false,
        }
    }

    /// Its density where 1 − cos α is `x`.
    pub fn density(&self, x: f64) -> f64 {
        if x >= 1.0 {
            return 0.0;
        }
        let q = tan_squared(x) / self.variance;
        let log = match self.fall {
            Fall::Power { exponent } => {
                let m = f64::from(exponent);
                -0.5 * m * libm::log1p(q / m)
            }
            Fall::Gaussian => -0.5 * q,
        };
        self.peak * exp64(log)
    }
}

/// Channels: w, w·b, and d₁, d₂, d₃ of K with the base variance added; σ₁, 0, 0 in the isotropic form.
pub struct Printed {
    pub shape: Shape,
    pub reading: Reading,
    pub anisotropic: bool,
    pub codes: Option<Codes>,
}

impl Printed {
    /// D, or σ₁, of averaged moments beside weight and slopes as they are.
    #[inline(always)]
    fn factored(&self, moments: [f32; 6]) -> [f32; 6] {
        let base = self.shape.variance as f32;
        let [w, wx, wy, a, b, c] = central_moments(moments);
        let k = [a + base, b, c + base];
        let [d1, d2, d3] =
            if self.anisotropic { factor(k) } else { [widest(k)[0].sqrt(), 0.0, 0.0] };
        [w, wx, wy, d1, d2, d3]
    }

    /// What is written of averaged moments: [w, b̄, d₁, d₂, d₃], or [w, b̄, σ₁, 0, 0].
    #[inline(always)]
    pub fn written(&self, moments: [f32; 6]) -> [f32; 6] {
        divided(self.factored(moments))
    }

    /// The matrix Q of the lobe in slopes.
    #[inline(always)]
    fn roughness(&self, d1: f32, d2: f32, d3: f32) -> Sym2 {
        let literal = [d1 * d1, d1 * d2, d2 * d2 + d3 * d3];
        let meant = covariance(d1, d2, d3);
        let all = if self.reading == Reading::Literal { literal } else { meant };
        if self.anisotropic { all } else { [d1 * d1, 0.0, d1 * d1] }
    }
}

impl Moments<6> for Printed {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 6] {
        let z = z.max(MIN_COSINE);
        raw_moments(w, x / z, y / z)
    }

    #[inline(always)]
    fn store(&self, moments: [f32; 6]) -> [f32; 6] {
        match &self.codes {
            None => self.factored(moments),
            Some(codes) => multiplied(codes.rough().round(self.written(moments))),
        }
    }
}

impl OneLobe<6> for Printed {
    type Lobe = PedalLobe;

    #[inline(always)]
    fn lobe(&self, [w, wx, wy, d1, d2, d3]: [f32; 6]) -> PedalLobe {
        let q = self.roughness(d1, d2, d3);
        let amplitude = w * self.shape.peak as f32;
        PedalLobe::new([wx, wy, w], q, amplitude, self.reading.contour(), self.shape.fall)
    }
}
