//! From a lobe to light: the bare distribution, or a microfacet BRDF.

use serde::{Deserialize, Serialize};

use super::Slopes;
use super::intensity::{Fresnel, groove, phong_half};
use super::vector::{Sym2, V3, dot, quadratic};

/// What a lobe's density means for the light that leaves the surface.
///
/// With E the irradiance on a plane facing the light, l, v and h the unit directions to light and eye
/// and their half vector, D the lobe's density and n its axis:
///
/// | shading | radiance |
/// |---|---|
/// | `ndf` | E · D(h) |
/// | `microfacet` | E · D(h) · G₁(l) G₁(v) / (4 n·v), 0 unless n·l > 0 and n·v > 0 |
/// | `phong` | E · D(h′), h′ as far from n as makes cosˢ of it (r·v)^(s/4), r the mirrored direction; 0 unless n·l > 0 |
/// | `torrance-sparrow` | E · D(h) · G F / (4 n·v), 0 unless n·l > 0 and n·v > 0 |
///
/// `ndf` is what the five papers draw: the distribution itself at the half vector. `microfacet` is
/// the reflection model (Cook-Torrance 1982, Walter et al. 2007) with separable Smith shadowing and
/// Fresnel 1; the cosine to the light is cancelled by the model's own denominator. `phong` is Phong's highlight
/// (1975) about the mirrored direction, without ambient and diffuse light, as high as the `ndf` of the same lobe.
/// `torrance-sparrow` is the model of Blinn 1977, with grooves instead of Smith's shadowing; see
/// [`crate::lobe::intensity`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// The bare distribution at the half vector.
    #[default]
    Ndf,
    /// A microfacet BRDF about the lobe's axis.
    Microfacet,
    /// Phong 1975: a highlight about the mirrored direction.
    Phong,
    /// Blinn 1977 after Torrance and Sparrow 1967: facets in V-shaped grooves.
    TorranceSparrow(Fresnel),
}

impl Shading {
    /// Its name in specs and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ndf => "ndf",
            Self::Microfacet => "microfacet",
            Self::Phong => "phong",
            Self::TorranceSparrow(_) => "torrance-sparrow",
        }
    }

    /// Whether it looks at the directions to light and eye, and not at the half vector alone.
    pub fn needs_directions(self) -> bool {
        self != Self::Ndf
    }
}

/// A spread of normals: what every lobe can do.
pub trait Spread {
    /// D(h) per steradian for a half vector of any length in tangent space; 0 where it has none.
    /// See the module for the measure.
    fn density(&self, h: V3) -> f32;

    /// The facet that shadowing and masking are reckoned about.
    fn facet(&self) -> Facet;

    /// The lobe as a distribution of slopes about a pole.
    fn slopes(&self) -> Slopes {
        Slopes::integrated(self)
    }

    /// Radiance for unit irradiance (see [`Shading`]), with l and v unit vectors.
    #[inline(always)]
    fn radiance(&self, shading: Shading, half: V3, light: V3, view: V3) -> f32 {
        let density = self.density(half);
        match shading {
            Shading::Ndf => density,
            Shading::Microfacet => density * self.facet().geometry(light, view),
            Shading::Phong => self.phong(half, light, view),
            Shading::TorranceSparrow(fresnel) => {
                let cosine = dot(light, half) / dot(half, half).sqrt().max(f32::MIN_POSITIVE);
                let open = groove(self.facet().axis, half, light, view);
                density * open * fresnel.reflectance(cosine)
            }
        }
    }

    /// Phong's highlight of a lobe that is as wide in all directions as if it were a base lobe's: its density at
    /// [`phong_half`].
    #[inline(always)]
    fn phong(&self, half: V3, light: V3, view: V3) -> f32 {
        let (half, seen) = phong_half(self.facet().axis, half, light, view);
        let density = self.density(half);
        if seen { density } else { 0.0 }
    }
}

/// A rough facet: an axis and how rough it is along each direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Unit axis n.
    pub axis: V3,
    /// Unit vector across it.
    pub tangent: V3,
    /// Unit vector across both.
    pub bitangent: V3,
    /// Roughness α² as a matrix in (tangent, bitangent): α² along a unit direction d is dᵀ M d.
    pub alpha_squared: Sym2,
    /// Whether Smith's G₁ is GGX's; else Beckmann's.
    pub ggx: bool,
}

impl Facet {
    /// G₁(l) G₁(v) / (4 n·v); 0 if light or eye is below the facet.
    #[inline(always)]
    pub fn geometry(&self, light: V3, view: V3) -> f32 {
        let (cos_light, cos_view) = (dot(light, self.axis), dot(view, self.axis));
        let above = cos_light > 0.0 && cos_view > 0.0;
        let shadowing = self.smith(light, cos_light) * self.smith(view, cos_view);
        let value = shadowing / (4.0 * cos_view.max(f32::MIN_POSITIVE));
        if above { value } else { 0.0 }
    }

    /// Smith's G₁ for direction `d` with cosine `cos` to the axis: exact for GGX, the rational fit of
    /// Walter et al. 2007 (relative error below 0.35 %) for Beckmann.
    #[inline(always)]
    fn smith(&self, d: V3, cos: f32) -> f32 {
        let (x, y) = (dot(d, self.tangent), dot(d, self.bitangent));
        let alpha_tan_squared =
            quadratic(self.alpha_squared, x, y).max(0.0) / (cos * cos).max(f32::MIN_POSITIVE);
        if self.ggx { smith_ggx(alpha_tan_squared) } else { smith_beckmann(alpha_tan_squared) }
    }
}

/// Smith's G₁ of GGX where α² tan² is `a`.
#[inline(always)]
pub(super) fn smith_ggx(a: f32) -> f32 {
    2.0 / (1.0 + (1.0 + a).sqrt())
}

/// Smith's G₁ of Beckmann where α² tan² is `a`, by the rational fit of Walter et al. 2007.
#[inline(always)]
pub(super) fn smith_beckmann(a: f32) -> f32 {
    let cotangent = 1.0 / a.sqrt().max(f32::MIN_POSITIVE);
    let c = cotangent.min(1.6);
    let fit = (3.535 * c + 2.181 * c * c) / (1.0 + 2.276 * c + 2.577 * c * c);
    if cotangent < 1.6 { fit } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::BaseLobe;
    use crate::lobe::vector::unit;

    #[test]
    fn smith_matches_its_integral() {
        // G₁(v) = cosθ / ∫ max(0, v·h) D(h) dω (Heitz 2014, eq. 43), by brute force.
        for base in [BaseLobe::Beckmann { alpha: 0.4 }, BaseLobe::Ggx { alpha: 0.3 }] {
            for degrees in [20.0f64, 50.0, 75.0] {
                let (sin, cos) = libm::sincos(degrees.to_radians());
                let mut visible = 0.0;
                let n = 600;
                for i in 0..n {
                    let theta = (f64::from(i) + 0.5) / f64::from(n) * std::f64::consts::FRAC_PI_2;
                    let (st, ct) = libm::sincos(theta);
                    let density = base.density((st / ct).powi(2));
                    for k in 0..n {
                        let phi = (f64::from(k) + 0.5) / f64::from(n) * std::f64::consts::TAU;
                        let toward = (st * libm::cos(phi) * sin + ct * cos).max(0.0);
                        visible += toward * density * st;
                    }
                }
                visible *= std::f64::consts::FRAC_PI_2 / 600.0 * std::f64::consts::TAU / 600.0;
                let facet = base.about([0.0, 0.0, 1.0], 1.0).facet();
                let view = [sin as f32, 0.0, cos as f32];
                let got = f64::from(facet.smith(view, view[2]));
                let want = cos / visible;
                assert!((got / want - 1.0).abs() < 6e-3, "{base} {degrees}°: {got} {want}");
            }
        }
    }

    #[test]
    fn nothing_from_below() {
        let facet = BaseLobe::Ggx { alpha: 0.3 }.about([0.0, 0.0, 1.0], 1.0).facet();
        let up = unit([0.2, 0.0, 1.0]);
        assert_eq!(facet.geometry(unit([0.2, 0.0, -0.1]), up), 0.0);
        assert_eq!(facet.geometry(up, unit([0.9, 0.0, -0.1])), 0.0);
        assert!(facet.geometry(up, up) > 0.0);
    }
}
