//! Normal distribution mapping (Olano and North 1997).
//!
//! The distribution under a footprint is a 3D Gaussian restricted to the sphere: nine numbers, a mean
//! u and raw second moments E₂, which filter linearly; S = E₂ − uᵀu. A texel starts as a Gaussian of
//! mean n and isotropic covariance v·I, v the base lobe's slope variance, which restricted to the
//! sphere is a von Mises-Fisher lobe.

use std::sync::Arc;

use super::one_lobe::{OneLobe, OneLobeMap};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::vector::{V3, at_least, dot, tangents, unit};
use crate::lobe::{BaseLobe, EllipticLobe, PearsonLobe, Profile};
use crate::texture::{Moments, NormalMap, Texel};

/// Olano and North's filter.
///
/// The *printed* form is the one of the paper's pictures: Pearson II with m = 8, divided by √det S
/// alone. Its constant is chosen so that a single normal has unit energy. The *normalised* form is the
/// paper's second option, "re-approximate with a projected 2D Gaussian for rendering": the Gaussian
/// restricted to the plane that touches the sphere at the mean direction n,
/// μ = Tᵀu + S_tr (1 − n·u)/S_rr, C = S_tt − S_tr S_trᵀ/S_rr, projected onto the sphere; its integral
/// is known in closed form, and its amplitude is |u|, the footprint's own.
#[derive(Clone, Copy, Debug)]
pub struct OlanoNorth {
    printed: bool,
}

const CARDS: [Card; 2] = [
    Card {
        name: "olano-north",
        source: "Olano and North 1997, Normal Distribution Mapping, §6 (projected 2D Gaussian)",
        summary: "Nine linear moments of the normals; a Gaussian on the plane touching the mean.",
        formula: "N₂(Tᵀh/(n·h); μ, C)/(n·h)⁴ with S = E₂ − uᵀu cut by the plane n·x = 1",
        limits: "one Gaussian: several peaks become one hill, and heavy tails (GGX) are out of reach",
        normalised: true,
        keeps_roughness: true,
        precision: 1e-3,
    },
    Card {
        name: "olano-north-printed",
        source: "Olano and North 1997, Normal Distribution Mapping, §6 (as in its pictures)",
        summary: "The same nine moments, shaded by an unnormalised Pearson II.",
        formula: "(1 − q/16)⁸/√det S, q = (h − u) S⁻¹ (h − u)ᵀ",
        limits: "not normalised over the sphere: brightness drifts with roughness",
        normalised: false,
        keeps_roughness: true,
        precision: 1e-3,
    },
];

/// The registry's lines.
pub(super) fn entries() -> [Entry; 2] {
    let entry = |index: usize, build| Entry { card: CARDS[index], parameters: &[], build };
    [
        entry(0, |_| Box::new(OlanoNorth { printed: false })),
        entry(1, |_| Box::new(OlanoNorth { printed: true })),
    ]
}

impl Method for OlanoNorth {
    fn card(&self) -> Card {
        CARDS[usize::from(self.printed)]
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        // Total variation from a Gaussian in slopes to Blinn-Phong of the same variance, measured:
        // 0.054 at s = 10, 0.020 at 30, 0.006 at 100.
        let to_gaussian = match *base {
            BaseLobe::BlinnPhong { exponent } => (0.65 / exponent).min(1.0),
            BaseLobe::Beckmann { .. } => 0.0,
            BaseLobe::Ggx { .. } => {
                return Err(Refusal(
                    "a Gaussian has no variance to give a GGX lobe, whose own \
                                    slope variance is infinite"
                        .into(),
                ));
            }
        };
        // Pearson II is too narrow by 2m/(2m + 5) in variance at m = 8, and on the sphere its shape
        // is not quite a slope Gaussian's.
        let to_pearson = if self.printed { 0.09 + 2.0 * base.spread() } else { 0.0 };
        Ok(to_gaussian + to_pearson)
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        self.base_error(base)?;
        let nine = NineNumbers { variance: base.spread() as f32 };
        Ok(if self.printed {
            Box::new(OneLobeMap::build(map, base, Printed { unit_peak: unit_peak(base), nine }))
        } else {
            Box::new(OneLobeMap::build(map, base, Projected { nine }))
        })
    }
}

/// The moments [w u, w E₂] of a Gaussian about a single normal; E₂ as xx, xy, xz, yy, yz, zz.
struct NineNumbers {
    variance: f32,
}

/// A 3D Gaussian of a footprint.
struct Gaussian3 {
    /// Mean weight w.
    weight: f32,
    /// u.
    mean: V3,
    /// S as xx, xy, xz, yy, yz, zz.
    covariance: [f32; 6],
}

impl NineNumbers {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 9] {
        let v = self.variance;
        let e2 = [x * x + v, x * y, x * z, y * y + v, y * z, z * z + v];
        let mut moments = [x, y, z, e2[0], e2[1], e2[2], e2[3], e2[4], e2[5]];
        for moment in &mut moments {
            *moment *= w;
        }
        moments
    }

    /// S = E₂ − uᵀu. The weight needs no tenth number: normals are unit vectors, so the trace of E₂
    /// is w (1 + 3v). Averages of rounded numbers can leave S without positivity, so its diagonal is
    /// held at half the base variance, below what an exact S can have.
    #[inline(always)]
    fn gaussian(&self, [wx, wy, wz, xx, xy, xz, yy, yz, zz]: [f32; 9]) -> Gaussian3 {
        let weight = (xx + yy + zz) / (1.0 + 3.0 * self.variance);
        let per = 1.0 / weight.max(f32::MIN_POSITIVE);
        let [x, y, z] = [wx * per, wy * per, wz * per];
        let floor = 0.5 * self.variance;
        let covariance = [
            (xx * per - x * x).max(floor),
            xy * per - x * y,
            xz * per - x * z,
            (yy * per - y * y).max(floor),
            yz * per - y * z,
            (zz * per - z * z).max(floor),
        ];
        Gaussian3 { weight, mean: [x, y, z], covariance }
    }
}

/// aᵀ S b
#[inline(always)]
fn between([xx, xy, xz, yy, yz, zz]: [f32; 6], a: V3, b: V3) -> f32 {
    let row = [dot([xx, xy, xz], b), dot([xy, yy, yz], b), dot([xz, yz, zz], b)];
    dot(a, row)
}

struct Projected {
    nine: NineNumbers,
}

impl Moments<9> for Projected {
    #[inline(always)]
    fn encode(&self, texel: Texel) -> [f32; 9] {
        self.nine.encode(texel)
    }
}

impl OneLobe<9> for Projected {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, channels: [f32; 9]) -> EllipticLobe {
        let Gaussian3 { weight, mean, covariance: s } = self.nine.gaussian(channels);
        let length = dot(mean, mean).sqrt();
        let n = unit(mean);
        let (t, b) = tangents(n);
        let radial = 1.0 / between(s, n, n).max(f32::MIN_POSITIVE);
        let (tr, br) = (between(s, t, n), between(s, b, n));
        let c = [
            between(s, t, t) - tr * tr * radial,
            between(s, t, b) - tr * br * radial,
            between(s, b, b) - br * br * radial,
        ];
        let reach = (1.0 - length) * radial;
        EllipticLobe::new(
            n,
            at_least(c, 0.5 * self.nine.variance),
            weight * length,
            Profile::Gaussian,
        )
        .with_mean([tr * reach, br * reach])
    }
}

struct Printed {
    nine: NineNumbers,
    unit_peak: f32,
}

impl Moments<9> for Printed {
    #[inline(always)]
    fn encode(&self, texel: Texel) -> [f32; 9] {
        self.nine.encode(texel)
    }
}

impl OneLobe<9> for Printed {
    type Lobe = PearsonLobe;

    #[inline(always)]
    fn lobe(&self, channels: [f32; 9]) -> PearsonLobe {
        let Gaussian3 { weight, mean, covariance: s } = self.nine.gaussian(channels);
        let [xx, xy, xz, yy, yz, zz] = s;
        let mut inverse = [
            yy * zz - yz * yz,
            xz * yz - xy * zz,
            xy * yz - xz * yy,
            xx * zz - xz * xz,
            xy * xz - xx * yz,
            xx * yy - xy * xy,
        ];
        let v = self.nine.variance;
        let smallest = 0.125 * v * v * v;
        let determinant = (xx * inverse[0] + xy * inverse[1] + xz * inverse[2]).max(smallest);
        for cofactor in &mut inverse {
            *cofactor /= determinant;
        }
        let amplitude = weight * self.unit_peak * (v * v * v / determinant).sqrt();
        let n = unit(mean);
        let across = 0.5 * (xx + yy + zz - between(s, n, n));
        PearsonLobe::new(mean, inverse, amplitude, across)
    }
}

/// The amplitude that gives a single normal unit energy: 1 / ∫ (1 − q/16)⁸ cos dω with
/// q = 2(1 − cos)/v over the hemisphere, in closed form.
fn unit_peak(base: &BaseLobe) -> f32 {
    let v = base.spread();
    // With y = (1 − cos)/8v the integral is 16πv ∫₀^Y (1 − y)⁸ (1 − 8v y) dy.
    let rest = 1.0 - (1.0 / (8.0 * v)).min(1.0);
    let power = |n: i32| (0..n).fold(1.0, |product, _| product * rest);
    let zeroth = (1.0 - power(9)) / 9.0;
    let first = zeroth - (1.0 - power(10)) / 10.0;
    (1.0 / (16.0 * std::f64::consts::PI * v * (zeroth - 8.0 * v * first))) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Pyramid, Wrap};

    #[test]
    fn moments_of_a_mixture_add_linearly() {
        // E₂ of the top level is the mean of uᵀu + vI over all texels (Olano and North 1997 §5).
        let map = NormalMap::from_fn(8, 8, Wrap::Repeat, |u, v| {
            [libm::sin(7.0 * u), 0.5 * libm::sin(9.0 * v), 1.0, 1.0]
        });
        let nine = NineNumbers { variance: 0.01 };
        let pyramid = Pyramid::build(&map, Projected { nine });
        let top = pyramid.moments().nine.gaussian(pyramid.cells(&map, 3)[0]);
        let mean_of = |f: &dyn Fn(&Texel) -> f32| {
            map.texels().iter().map(|t| f64::from(f(t))).sum::<f64>() / 64.0
        };
        let (ux, uz) = (mean_of(&|t| t[0]), mean_of(&|t| t[2]));
        let xz = mean_of(&|t| t[0] * t[2]) - ux * uz;
        let xx = mean_of(&|t| t[0] * t[0]) + 0.01 - ux * ux;
        assert!((f64::from(top.covariance[0]) - xx).abs() < 1e-6);
        assert!((f64::from(top.covariance[2]) - xz).abs() < 1e-6);
        assert!((top.weight - 1.0).abs() < 1e-6);
        assert!((f64::from(top.mean[2]) - uz).abs() < 1e-6);
    }

    #[test]
    fn a_single_normal_projects_to_beckmann() {
        let base = BaseLobe::Beckmann { alpha: 0.3 };
        let projected = Projected { nine: NineNumbers { variance: base.spread() as f32 } };
        let lobe = projected.lobe(projected.encode([0.6, 0.0, 0.8, 2.0]));
        let spread = lobe.spread();
        assert!((spread[0] - 0.045).abs() < 1e-6 && spread[1].abs() < 1e-6, "{spread:?}");
    }
}
