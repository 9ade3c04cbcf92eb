//! Schilling's modified Blinn-Phong lobe, as printed.

use super::vector::{Sym2, V3, dot, invert, quadratic, tangents, unit};
use super::{Facet, Spread, vector};
use crate::geometry::elementary::{exp32, ln_1p32};

/// amplitude · f(cos²α′) with cos²α′ = cos²α / (d⁴/q + cos²α) (Schilling 1997, appendix A).
///
/// d is the projection of n − h on the plane across the axis n, so |d|² = sin²α. In slopes x = d/cos α
/// of the half vector, tan²α′ is |x|⁴ / (xᵀ Q x) or xᵀ Q⁻¹ x, as [`Contour`] says; f is a [`Fall`].
///
/// It is not normalised: its value at the axis is `amplitude` however rough Q is. That is as printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PedalLobe {
    axis: V3,
    tangent: V3,
    bitangent: V3,
    /// Q, in units where the identity leaves α as it is.
    roughness: Sym2,
    inverse: Sym2,
    amplitude: f32,
    contour: Contour,
    fall: Fall,
}

/// What α is divided by in each direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contour {
    /// By √(dᵀ Q d)/|d|, the standard deviation in the direction of d if Q is a covariance. Contours are
    /// pedal curves of the ellipse of Q, wider than it off its axes: by up to (r + 1/r)/2, r the ratio of
    /// those. This is what the paper's q = |Dᵀd|² and |Dd|² are, with Q = D Dᵀ and Dᵀ D.
    Pedal,
    /// By the ellipse's own radius: contours are xᵀ Q⁻¹ x = const.
    Ellipse,
}

/// How brightness falls with α′.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fall {
    /// cosᵐ α′, as printed: (1 + xᵀ K⁻¹ x / m)^(−m/2) in slopes for Q = m K.
    Power {
        /// The exponent m > 0.
        exponent: f32,
    },
    /// exp(−½ tan²α′), a function of cos²α′ as the paper names it for an alternative: exp(−½ xᵀ K⁻¹ x) in
    /// slopes for Q = K. It is what [`Fall::Power`] tends to as m grows.
    Gaussian,
}

impl Fall {
    /// What a covariance of slopes is multiplied by to give Q: with it, lobes of any exponent have the same
    /// curvature at the axis, that of a Gaussian with this covariance.
    #[inline(always)]
    fn units(self) -> f32 {
        match self {
            Self::Power { exponent } => exponent,
            Self::Gaussian => 1.0,
        }
    }
}

impl PedalLobe {
    /// The lobe about `axis` (any length) whose slopes have covariance `covariance` (base included).
    #[inline(always)]
    pub fn new(axis: V3, covariance: Sym2, amplitude: f32, contour: Contour, fall: Fall) -> Self {
        let axis = unit(axis);
        let (tangent, bitangent) = tangents(axis);
        let roughness = vector::times(covariance, fall.units());
        let (inverse, _) = invert(roughness);
        Self { axis, tangent, bitangent, roughness, inverse, amplitude, contour, fall }
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
        let pedal = square * (square / q);
        let ellipse = quadratic(self.inverse, x, y).max(0.0);
        let tan_squared = if self.contour == Contour::Ellipse { ellipse } else { pedal }.min(1e30);
        let fall = match self.fall {
            Fall::Power { exponent } => exp32(-0.5 * exponent * ln_1p32(tan_squared)),
            Fall::Gaussian => exp32(-0.5 * tan_squared),
        };
        if cosine > 0.0 { self.amplitude * fall } else { 0.0 }
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        let scale = match self.fall {
            // Walter et al. 2007: α² = 2/(m + 2) for a Phong lobe of exponent m.
            Fall::Power { exponent } => 2.0 / (exponent + 2.0),
            Fall::Gaussian => 2.0,
        };
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

    const UP: V3 = [0.0, 0.0, 1.0];

    fn phong(covariance: Sym2, contour: Contour, exponent: f32) -> PedalLobe {
        PedalLobe::new(UP, covariance, 1.0, contour, Fall::Power { exponent })
    }

    #[test]
    fn isotropic_form_is_the_papers_simplified_one() {
        // cos²α′ = σ²cos²α / (1 − cos²α + σ²cos²α), with K = σ² I, whatever the contour.
        let (m, sigma_squared) = (20.0_f32, 3.0_f32);
        for contour in [Contour::Pedal, Contour::Ellipse] {
            let lobe = phong([sigma_squared / m, 0.0, sigma_squared / m], contour, m);
            for tilt in [0.0_f32, 0.1, 0.5, 1.0] {
                let cos2 = tilt.cos().powi(2);
                let primed = sigma_squared * cos2 / (1.0 - cos2 + sigma_squared * cos2);
                let want = primed.powf(0.5 * m);
                let got = lobe.density([tilt.sin(), 0.0, tilt.cos()]);
                assert!((got - want).abs() < 1e-5, "{tilt}: {got} {want}");
            }
        }
    }

    /// K = (2.5 1.5; 1.5 2.5): standard deviations 2 along 45° and 1 across.
    const SLANTED: Sym2 = [2.5, 1.5, 2.5];
    const M: f32 = 100.0;

    fn slanted(contour: Contour) -> PedalLobe {
        phong(vector::times(SLANTED, 1.0 / M), contour, M)
    }

    fn towards(degrees: f32, tan: f32) -> V3 {
        let (s, c) = degrees.to_radians().sin_cos();
        [tan * c, tan * s, 1.0]
    }

    #[test]
    fn widest_along_the_covariances_long_axis() {
        let single = |tan: f32| (-0.5 * M * (tan * tan).ln_1p()).exp();
        for contour in [Contour::Pedal, Contour::Ellipse] {
            let lobe = slanted(contour);
            let at = |degrees: f32| lobe.density(towards(degrees, 0.1));
            for degrees in [0.0, 20.0, 63.4, 90.0, 135.0] {
                assert!(at(45.0) > at(degrees), "{degrees}°");
            }
            // Along both axes the angle is divided by the standard deviation exactly.
            assert!((at(45.0) / single(0.05) - 1.0).abs() < 1e-4);
            assert!((at(135.0) / single(0.1) - 1.0).abs() < 1e-4);
        }
    }

    /// Where along a direction the lobe has fallen to what it is at tan α′ = 0.1.
    fn radius(contour: Contour, degrees: f32) -> f32 {
        let (lobe, level) = (slanted(contour), (-0.5 * M * 0.01f32.ln_1p()).exp());
        let (mut low, mut high) = (0.0, 10.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let above = lobe.density(towards(degrees, middle)) > level;
            (low, high) = if above { (middle, high) } else { (low, middle) };
        }
        low / 0.1
    }

    #[test]
    fn contours_are_pedal_curves_or_ellipses() {
        for degrees in [0.0f32, 30.0, 45.0, 80.0, 120.0] {
            let (s, c) = degrees.to_radians().sin_cos();
            let deviation = quadratic(SLANTED, c, s).sqrt();
            let ellipse = 1.0 / quadratic(invert(SLANTED).0, c, s).sqrt();
            assert!((radius(Contour::Pedal, degrees) - deviation).abs() < 1e-3, "{degrees}");
            assert!((radius(Contour::Ellipse, degrees) - ellipse).abs() < 1e-3, "{degrees}");
        }
        // r = 2: the pedal curve is wider by up to (r + 1/r)/2, halfway between the axes.
        let wider = radius(Contour::Pedal, 90.0) / radius(Contour::Ellipse, 90.0);
        assert!((wider - 1.25).abs() < 1e-3, "{wider}");
    }

    #[test]
    fn many_times_the_exponent_is_the_gaussian_fall() {
        let k = [0.05, 0.01, 0.03];
        let gauss = PedalLobe::new(UP, k, 1.0, Contour::Ellipse, Fall::Gaussian);
        let power = phong(k, Contour::Ellipse, 1e4);
        for h in [towards(10.0, 0.1), towards(70.0, 0.3), towards(200.0, 0.5)] {
            let want = (-0.5 * quadratic(invert(k).0, h[0], h[1])).exp();
            assert!((gauss.density(h) - want).abs() < 1e-6);
            assert!((power.density(h) - want).abs() < 1e-3);
        }
    }
}
