//! Schilling's modified Blinn-Phong lobe, as printed.

use super::vector::{Sym2, V3, dot, quadratic, tangents, unit};
use super::{Facet, Spread, vector};
use crate::geometry::elementary::{exp32, ln_1p32};

/// amplitude · cosᵐ α′ with cos²α′ = cos²α / (d⁴/q + cos²α), q = dᵀ K d (Schilling 1997, appendix A).
///
/// d is the projection of n − h on the plane across the axis n, so |d|² = sin²α. In slopes x = d/cos α
/// this is tan²α′ = |x|⁴ / (xᵀ K x): the angle is divided by the standard deviation in the direction
/// of h. Its contours are pedal curves, wider than the ellipse of K off its axes. The print's Dᵀ and D
/// are easily confused; |Dᵀd|² = dᵀKd is the form whose wide axis agrees with K's.
///
/// It is not normalised: its value at the axis is `amplitude` however rough K is. That is as printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PedalLobe {
    axis: V3,
    tangent: V3,
    bitangent: V3,
    /// K with the base roughness added, in units where the identity leaves α as it is.
    roughness: Sym2,
    amplitude: f32,
    /// Exponent m.
    exponent: f32,
}

impl PedalLobe {
    /// The lobe about `axis` (any length) whose slopes have covariance `covariance` (base included).
    /// A lobe of exponent m has slope variance of about 1/m where K is the identity, so K is m times
    /// the covariance.
    #[inline(always)]
    pub fn new(axis: V3, covariance: Sym2, amplitude: f32, exponent: f32) -> Self {
        let axis = unit(axis);
        let (tangent, bitangent) = tangents(axis);
        let roughness = vector::times(covariance, exponent);
        Self { axis, tangent, bitangent, roughness, amplitude, exponent }
    }

    /// The same lobe with its density multiplied by `factor`.
    pub fn faded(self, factor: f32) -> Self {
        Self { amplitude: self.amplitude * factor, ..self }
    }
}

impl Spread for PedalLobe {
    #[inline(always)]
    fn density(&self, h: V3) -> f32 {
        let cosine = dot(h, self.axis);
        let inverse_cosine = 1.0 / cosine.max(f32::MIN_POSITIVE);
        let x = dot(h, self.tangent) * inverse_cosine;
        let y = dot(h, self.bitangent) * inverse_cosine;
        let square = x * x + y * y;
        let q = quadratic(self.roughness, x, y).max(f32::MIN_POSITIVE);
        // tan²α′, with 0/0 on the axis taken as 0; divided twice so that nothing overflows.
        let tan_squared = square * (square / q);
        let fall = exp32(-0.5 * self.exponent * ln_1p32(tan_squared.min(1e30)));
        if cosine > 0.0 { self.amplitude * fall } else { 0.0 }
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        let scale = 2.0 / (self.exponent + 2.0);
        Facet {
            axis: self.axis,
            tangent: self.tangent,
            bitangent: self.bitangent,
            alpha_squared: vector::times(self.roughness, scale),
            ggx: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::vector::tan_squared;

    #[test]
    fn isotropic_form_is_the_papers_simplified_one() {
        // cos²α′ = σ²cos²α / (1 − cos²α + σ²cos²α), with K = σ² I.
        let (m, sigma_squared) = (20.0_f32, 3.0_f32);
        let lobe =
            PedalLobe::new([0.0, 0.0, 1.0], [sigma_squared / m, 0.0, sigma_squared / m], 1.0, m);
        for tilt in [0.0_f32, 0.1, 0.5, 1.0] {
            let cos2 = tilt.cos().powi(2);
            let primed = sigma_squared * cos2 / (1.0 - cos2 + sigma_squared * cos2);
            let want = primed.powf(0.5 * m);
            let got = lobe.density([tilt.sin(), 0.0, tilt.cos()]);
            assert!((got - want).abs() < 1e-5, "{tilt}: {got} {want}");
        }
    }

    #[test]
    fn widest_along_the_covariances_long_axis() {
        // K = (2.5 1.5; 1.5 2.5): standard deviations 2 along 45° and 1 across.
        let m = 100.0;
        let lobe = PedalLobe::new([0.0, 0.0, 1.0], [2.5 / m, 1.5 / m, 2.5 / m], 1.0, m);
        let at = |degrees: f32| {
            let (s, c) = degrees.to_radians().sin_cos();
            lobe.density([0.1 * c, 0.1 * s, 1.0])
        };
        for degrees in [0.0, 20.0, 63.4, 90.0, 135.0] {
            assert!(at(45.0) > at(degrees), "{degrees}°");
        }
        // Along the axes the angle is divided by the standard deviation exactly.
        let single = |tan: f32| (-0.5 * m * (tan * tan).ln_1p()).exp();
        let diagonal = 0.1 / std::f32::consts::SQRT_2;
        let along = lobe.density([diagonal, diagonal, 1.0]);
        assert!((along / single(0.05) - 1.0).abs() < 1e-4);
        assert!(tan_squared([0.0, 0.0, 1.0], [diagonal, diagonal, 1.0]) > 0.0099);
    }
}
