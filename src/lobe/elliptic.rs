//! Lobes whose contours are ellipses in slopes about an axis.

use std::f32::consts::{PI, TAU};

use super::intensity::phong_half;
use super::vector::{Sym2, V3, at_least, cross, dot, invert, quadratic, sandwich, tangents, unit};
use super::{Facet, Slopes, Spread, vector};
use crate::geometry::elementary::{exp32, ln_1p32};

/// How density falls with q = xᵀ M⁻¹ x, where x is the slope of h about the lobe's axis and M the
/// spread matrix. Each P(x) integrates to 1 over the plane of slopes.
///
/// | profile | P(x) | M is |
/// |---|---|---|
/// | Student | (s+2)/(2π s √det M) · (1 + q/s)^(−(s+4)/2) | the slope covariance |
/// | Gaussian | exp(−q/2) / (2π √det M) | the slope covariance |
/// | Ggx | 1 / (π √det M (1 + q)²) | α² along each axis |
///
/// With M = I/s, Student is exactly the Blinn-Phong lobe of exponent s: a bivariate Student-t in
/// slopes with s + 2 degrees of freedom. Its elliptical and tilted forms are thus Blinn-Phong made
/// anisotropic, in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// Blinn-Phong's.
    Student {
        /// The base exponent s.
        exponent: f32,
    },
    /// Beckmann's.
    Gaussian,
    /// GGX's.
    Ggx,
}

impl Profile {
    /// P(0) √det M.
    #[inline(always)]
    fn at_zero(self) -> f32 {
        match self {
            Self::Student { exponent: s } => (s + 2.0) / (TAU * s),
            Self::Gaussian => 1.0 / TAU,
            Self::Ggx => 1.0 / PI,
        }
    }
}

/// D(h) = amplitude · P(x − b) / (h·pole)⁴ for h above the plane across the pole, else 0, with x the
/// slopes of h about the pole and b the mean slope.
///
/// Its vector moment along the pole, ∫ D(h) (h·pole) dω, is `amplitude`: P integrates to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticLobe {
    pole: V3,
    tangent: V3,
    bitangent: V3,
    mean: [f32; 2],
    spread: Sym2,
    inverse: Sym2,
    peak: f32,
    profile: Profile,
}

impl EllipticLobe {
    /// The lobe about `pole` (any length), its mean slope 0, with spread matrix `spread` in the frame
    /// that the smallest rotation from z carries to the pole.
    #[inline(always)]
    pub fn new(pole: V3, spread: Sym2, amplitude: f32, profile: Profile) -> Self {
        let pole = unit(pole);
        let (tangent, bitangent) = tangents(pole);
        let (inverse, determinant) = invert(spread);
        let peak = amplitude * profile.at_zero() / determinant.sqrt();
        Self { pole, tangent, bitangent, mean: [0.0; 2], spread, inverse, peak, profile }
    }

    /// The same lobe with mean slope `mean` about its pole.
    #[inline(always)]
    pub fn with_mean(self, mean: [f32; 2]) -> Self {
        Self { mean, ..self }
    }

    /// Its spread matrix about the pole (see [`Profile`]).
    pub fn spread(&self) -> Sym2 {
        self.spread
    }

    /// The same lobe with its density multiplied by `factor`.
    pub fn faded(self, factor: f32) -> Self {
        Self { peak: self.peak * factor, ..self }
    }
}

impl Spread for EllipticLobe {
    #[inline(always)]
    fn density(&self, h: V3) -> f32 {
        let cosine = dot(h, self.pole);
        let inverse_cosine = 1.0 / cosine.max(f32::MIN_POSITIVE);
        let x = dot(h, self.tangent) * inverse_cosine;
        let y = dot(h, self.bitangent) * inverse_cosine;
        let q = quadratic(self.inverse, x - self.mean[0], y - self.mean[1]).max(0.0);
        let t = x * x + y * y;
        // Each profile falls as e^(−q/2) or as a power of 1 + q/s. Told by numbers and not by a branch, so that
        // loops over lanes become vector code.
        let (tail, per, gaussian) = match self.profile {
            Profile::Student { exponent: s } => (-0.5 * (s + 4.0), 1.0 / s, false),
            Profile::Gaussian => (0.0, 0.0, true),
            Profile::Ggx => (-2.0, 1.0, false),
        };
        let power = tail * ln_1p32(per * q);
        let fall = if gaussian { -0.5 * q } else { power };
        // With 1 / (h·pole)⁴ of a unit h, (1 + t)².
        let fall = exp32(fall + 2.0 * ln_1p32(t));
        if cosine > 0.0 { self.peak * fall } else { 0.0 }
    }

    /// Phong's highlight. The base lobe's own part of the spread is round about the mirrored direction; the rest is
    /// of normals, whose mirrored directions are spread less across the plane of incidence than along it, by the
    /// cosine of incidence.
    fn phong(&self, half: V3, light: V3, view: V3) -> f32 {
        let Facet { axis, .. } = self.facet();
        let (half, seen) = phong_half(axis, half, light, view);
        if !seen {
            return 0.0;
        }
        let Profile::Student { exponent } = self.profile else { return self.density(half) };
        // A step across the plane of incidence, as slopes about the pole.
        let across = cross(light, axis);
        let (to_pole, up) = (dot(axis, self.pole), dot(across, self.pole));
        let step =
            [self.tangent, self.bitangent].map(|t| dot(across, t) * to_pole - dot(axis, t) * up);
        let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
        if length <= 1e-6 {
            return self.density(half);
        }
        let [x, y] = step.map(|c| c / length);
        let narrow = 1.0 - dot(light, axis);
        let squeeze = [1.0 - narrow * x * x, -narrow * x * y, 1.0 - narrow * y * y];
        let own = 1.0 / exponent;
        let [xx, xy, yy] = self.spread;
        let [xx, xy, yy] = sandwich(squeeze, [xx - own, xy, yy - own]);
        let spread = at_least([xx + own, xy, yy + own], 1e-3 * own);
        let (inverse, determinant) = invert(spread);
        let peak = self.peak * (invert(self.spread).1 / determinant).sqrt();
        Self { spread, inverse, peak, ..*self }.density(half)
    }

    fn slopes(&self) -> Slopes {
        let Self { pole, tangent, bitangent, mean, spread, profile, .. } = *self;
        let amplitude = self.peak / profile.at_zero() * invert(spread).1.sqrt();
        Slopes { pole, tangent, bitangent, amplitude, mean, spread, profile }
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        let (scale, ggx) = match self.profile {
            // Walter et al. 2007: α² = 2/(s + 2) for a Phong lobe of exponent s.
            Profile::Student { exponent: s } => (2.0 * s / (s + 2.0), false),
            Profile::Gaussian => (2.0, false),
            Profile::Ggx => (1.0, true),
        };
        let [x, y] = self.mean;
        let axis =
            unit([0, 1, 2].map(|c| self.pole[c] + x * self.tangent[c] + y * self.bitangent[c]));
        let (tangent, bitangent) = tangents(axis);
        Facet { axis, tangent, bitangent, alpha_squared: vector::times(self.spread, scale), ggx }
    }
}
