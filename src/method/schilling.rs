//! Antialiasing of bump maps (Schilling 1997).
//!
//! A bump pyramid keeps the mean of the perturbation vectors (slopes), a roughness pyramid their
//! covariance K over each cell, both filtered like any mip map. Shading widens the lobe by K.
//!
//! The recursive rule of the paper, K_l = ¼ Σ K_{l−1} + ¼ Σ (xᵢ − x̄)(xᵢ − x̄)ᵀ, equals the covariance
//! over the whole cell, so the pyramid here averages raw moments and takes K at each level. The base
//! roughness, I/s, is folded in at the bottom. What is stored is central, so the *spread of the means*
//! of neighbouring cells is not part of an interpolated roughness.
//!
//! The paper stores, and lookups interpolate, D = (d₁ d₂; 0 d₃) with D Dᵀ = K. Two cells whose d₂ have
//! opposite signs then lose d₂² of the variance along u, and none along v: between cells the result
//! depends on how the map is turned. The printed forms keep that; the normalised ones store K itself,
//! whose interpolation is the mean of the cells' covariances.

use std::sync::Arc;

use super::one_lobe::{OneLobe, OneLobeMap};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::vector::{Sym2, at_least, largest_eigenvalue};
use crate::lobe::{BaseLobe, EllipticLobe, PedalLobe};
use crate::texture::{MIN_COSINE, Moments, NormalMap, Texel};

/// Schilling's filter in one of four forms.
///
/// *Anisotropic* uses all of K, *isotropic* its larger eigenvalue σ₁² alone, "a conservative
/// approximation". The *printed* form shades with the modified Blinn-Phong model of appendix A, which
/// is not normalised ([`PedalLobe`]), with its constant exponent m equal to the base exponent. The
/// *normalised* form puts the same covariance into the base lobe's own slope profile
/// ([`EllipticLobe`]), exactly elliptical and of unit integral:
/// - slopes are weighted by w·n_z, as the microfacet measure asks (see [`crate::lobe`]), so that the
///   mean slope is that of the mean normal and the amplitude that of the footprint;
/// - K, measured in the surface's tangent frame, is carried to the frame of the mean normal, where a
///   tilted normal's base lobe is round again.
#[derive(Clone, Copy, Debug)]
pub struct Schilling {
    anisotropic: bool,
    printed: bool,
}

/// How far, between the centres of cells, the interpolated triangular D makes results depend on how a
/// map is turned: up to 4 % on smooth bumps with slopes up to 0.7.
const TRIANGULAR: f64 = 0.05;

const SOURCE: &str = "Schilling 1997, Antialiasing of Bump-Maps, appendix A";

const CARDS: [Card; 4] = [
    Card {
        name: "schilling-isotropic",
        source: SOURCE,
        summary: "Mean slope and the largest slope variance of the footprint, one round lobe.",
        formula: "the base lobe's profile about the mean normal, variance σ₁² + 1/s in every direction",
        limits: "one round lobe: directional bumps blur to both sides, and widths do not pool: cells \
                 rough in different directions get wider lobes than all of them together",
        normalised: true,
        keeps_roughness: true,
        precision: 1e-3,
    },
    Card {
        name: "schilling-anisotropic",
        source: SOURCE,
        summary: "Mean slope and slope covariance of the footprint, one elliptical lobe.",
        formula: "the base lobe's profile about the mean normal, slope covariance K + I/s",
        limits: "one lobe: distributions with several peaks become one broad hill",
        normalised: true,
        keeps_roughness: true,
        precision: 1e-3,
    },
    Card {
        name: "schilling-isotropic-printed",
        source: SOURCE,
        summary: "The isotropic form with the paper's own lobe, which is not normalised.",
        formula: "cosᵐα′, cos²α′ = σ₁²cos²α / (1 − cos²α + σ₁²cos²α), m = s",
        limits: "not normalised: rough footprints shine too brightly, and widths do not pool",
        normalised: false,
        keeps_roughness: true,
        precision: TRIANGULAR,
    },
    Card {
        name: "schilling-anisotropic-printed",
        source: SOURCE,
        summary: "The anisotropic form with the paper's own lobe, which is not normalised.",
        formula: "cosᵐα′, cos²α′ = cos²α / (d⁴/|Dᵀd|² + cos²α), m = s",
        limits: "not normalised: rough footprints shine too brightly, and widths do not pool",
        normalised: false,
        keeps_roughness: true,
        precision: TRIANGULAR,
    },
];

/// The registry's lines.
pub(super) fn entries() -> [Entry; 4] {
    let entry = |index: usize, build| Entry { card: CARDS[index], parameters: &[], build };
    [
        entry(0, |_| Box::new(Schilling { anisotropic: false, printed: false })),
        entry(1, |_| Box::new(Schilling { anisotropic: true, printed: false })),
        entry(2, |_| Box::new(Schilling { anisotropic: false, printed: true })),
        entry(3, |_| Box::new(Schilling { anisotropic: true, printed: true })),
    ]
}

impl Method for Schilling {
    fn card(&self) -> Card {
        CARDS[usize::from(self.anisotropic) + 2 * usize::from(self.printed)]
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        match base {
            BaseLobe::BlinnPhong { .. } => Ok(0.0),
            _ if !self.printed => Ok(0.0),
            other => Err(Refusal(format!(
                "the paper's lobe is a modified Blinn-Phong; it has no {} form",
                other.name()
            ))),
        }
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        self.base_error(base)?;
        let (base, anisotropic) = (*base, self.anisotropic);
        Ok(if self.printed {
            Box::new(OneLobeMap::build(map, &base, Printed { base, anisotropic }))
        } else {
            Box::new(OneLobeMap::build(map, &base, Normalised { base, anisotropic }))
        })
    }
}

/// Raw moments [p, p·b, p·b bᵀ] of a slope b with weight p.
#[inline(always)]
fn raw_moments(p: f32, x: f32, y: f32) -> [f32; 6] {
    [p, p * x, p * y, p * x * x, p * x * y, p * y * y]
}

/// From averaged raw moments to [p, p·b̄, K].
#[inline(always)]
fn central_moments([p, px, py, pxx, pxy, pyy]: [f32; 6]) -> [f32; 6] {
    let per = 1.0 / p.max(f32::MIN_POSITIVE);
    let (x, y) = (px * per, py * per);
    let central = [pxx * per - x * x, pxy * per - x * y, pyy * per - y * y];
    let [a, b, c] = at_least(central, 0.0);
    [p, px, py, a, b, c]
}

/// D of K = D Dᵀ: d₁ = √(a − b²/c), d₂ = b/√c, d₃ = √c (Schilling 1997, *The roughness pyramid*).
/// Since K is a covariance |d₂| is at most √a; holding it there keeps rounding from making much of a
/// direction with next to no variance.
#[inline(always)]
fn factor([a, b, c]: Sym2) -> [f32; 3] {
    let (most, d3) = (a.max(0.0).sqrt(), c.max(0.0).sqrt());
    let d2 = (b / d3.max(f32::MIN_POSITIVE)).clamp(-most, most);
    [(a - d2 * d2).max(0.0).sqrt(), d2, d3]
}

/// K = D Dᵀ.
#[inline(always)]
fn covariance(d1: f32, d2: f32, d3: f32) -> Sym2 {
    [d1 * d1 + d2 * d2, d2 * d3, d3 * d3]
}

/// K where all of it counts, σ₁² I where it does not.
#[inline(always)]
fn shaped(k: Sym2, anisotropic: bool) -> Sym2 {
    let widest = largest_eigenvalue(k);
    if anisotropic { k } else { [widest, 0.0, widest] }
}

/// J K Jᵀ with J = c (I − b bᵀ c²/(1 + c)), c = 1/√(1 + |b|²): a slope covariance about slope b in the
/// tangent frame, carried to the frame of the normal (−b, 1). It is the derivative of one frame's
/// slopes by the other's, and takes (1 + |b|²)(I + b bᵀ) to I.
#[inline(always)]
fn carried(k: Sym2, x: f32, y: f32) -> Sym2 {
    let c = 1.0 / (1.0 + x * x + y * y).sqrt();
    let pull = c * c / (1.0 + c);
    let j = [c * (1.0 - x * x * pull), -c * x * y * pull, c * (1.0 - y * y * pull)];
    let kj = [
        [k[0] * j[0] + k[1] * j[1], k[0] * j[1] + k[1] * j[2]],
        [k[1] * j[0] + k[2] * j[1], k[1] * j[1] + k[2] * j[2]],
    ];
    [
        j[0] * kj[0][0] + j[1] * kj[1][0],
        j[0] * kj[0][1] + j[1] * kj[1][1],
        j[1] * kj[0][1] + j[2] * kj[1][1],
    ]
}

struct Normalised {
    base: BaseLobe,
    anisotropic: bool,
}

impl Moments<6> for Normalised {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 6] {
        let z = z.max(MIN_COSINE);
        raw_moments(w * z, x / z, y / z)
    }

    #[inline(always)]
    fn store(&self, moments: [f32; 6]) -> [f32; 6] {
        central_moments(moments)
    }
}

impl OneLobe<6> for Normalised {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, [p, px, py, kxx, kxy, kyy]: [f32; 6]) -> EllipticLobe {
        let per = 1.0 / p.max(f32::MIN_POSITIVE);
        let (x, y) = (px * per, py * per);
        let k = shaped(carried([kxx, kxy, kyy], x, y), self.anisotropic);
        // GGX has no variance; bumps add to its α² as they add to Beckmann's, which is twice K.
        let share = if matches!(self.base, BaseLobe::Ggx { .. }) { 2.0 } else { 1.0 };
        let spread = self.base.spread() as f32;
        let widened = [share * k[0] + spread, share * k[1], share * k[2] + spread];
        let amplitude = (p * p + px * px + py * py).sqrt();
        EllipticLobe::new([px, py, p], widened, amplitude, self.base.profile())
    }
}

struct Printed {
    base: BaseLobe,
    anisotropic: bool,
}

impl Moments<6> for Printed {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 6] {
        let z = z.max(MIN_COSINE);
        raw_moments(w, x / z, y / z)
    }

    #[inline(always)]
    fn store(&self, moments: [f32; 6]) -> [f32; 6] {
        let base = self.base.spread() as f32;
        let [p, px, py, a, b, c] = central_moments(moments);
        let [d1, d2, d3] = factor([a + base, b, c + base]);
        [p, px, py, d1, d2, d3]
    }
}

impl OneLobe<6> for Printed {
    type Lobe = PedalLobe;

    #[inline(always)]
    fn lobe(&self, [w, wx, wy, d1, d2, d3]: [f32; 6]) -> PedalLobe {
        let k = shaped(covariance(d1, d2, d3), self.anisotropic);
        let exponent = self.base.parameter() as f32;
        let amplitude = w * (exponent + 2.0) / std::f32::consts::TAU;
        PedalLobe::new([wx, wy, w], k, amplitude, exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Pyramid, Wrap};
    use proptest::prelude::*;

    #[test]
    fn the_recursive_rule_is_the_covariance_of_the_whole_cell() {
        // Schilling 1997: "equivalent to the calculation of the covariance matrix for all fu and fv
        // values in the highest resolution level". The rule, in double precision, level by level.
        let slope = |i: usize, k: f64| libm::sin(i as f64 * k) * 0.7;
        let slopes: Vec<[f64; 2]> = (0..64).map(|i| [slope(i, 1.7), slope(i, 2.9)]).collect();
        let mut cells: Vec<([f64; 2], [f64; 3])> = slopes.iter().map(|&b| (b, [0.0; 3])).collect();
        while cells.len() > 1 {
            cells = cells
                .chunks(4)
                .map(|four| {
                    let mean = [0, 1].map(|c| four.iter().map(|f| f.0[c]).sum::<f64>() / 4.0);
                    let mut k = [0.0; 3];
                    for (b, below) in four {
                        let d = [b[0] - mean[0], b[1] - mean[1]];
                        for (c, outer) in [d[0] * d[0], d[0] * d[1], d[1] * d[1]].iter().enumerate()
                        {
                            k[c] += (below[c] + outer) / 4.0;
                        }
                    }
                    (mean, k)
                })
                .collect();
        }
        let mean = [0, 1].map(|c| slopes.iter().map(|b| b[c]).sum::<f64>() / 64.0);
        let direct = |c: usize, d: usize| {
            slopes.iter().map(|b| (b[c] - mean[c]) * (b[d] - mean[d])).sum::<f64>() / 64.0
        };
        let (_, k) = cells[0];
        for (got, want) in k.iter().zip([direct(0, 0), direct(0, 1), direct(1, 1)]) {
            assert!((got - want).abs() < 5e-15);
        }
    }

    #[test]
    fn the_pyramid_holds_that_covariance() {
        let base = BaseLobe::BlinnPhong { exponent: 50.0 };
        let map = NormalMap::from_fn(8, 8, Wrap::Repeat, |u, v| {
            [0.5 * libm::sin(9.0 * u + v), 0.4 * libm::cos(7.0 * v), 1.0, 1.0]
        });
        let pyramid = Pyramid::build(&map, Printed { base, anisotropic: true });
        let slopes: Vec<[f64; 2]> =
            map.texels().iter().map(|t| [f64::from(t[0] / t[2]), f64::from(t[1] / t[2])]).collect();
        let mean = [0, 1].map(|c| slopes.iter().map(|b| b[c]).sum::<f64>() / 64.0);
        let direct = |c: usize, d: usize| {
            slopes.iter().map(|b| (b[c] - mean[c]) * (b[d] - mean[d])).sum::<f64>() / 64.0
        };
        let [_, _, _, d1, d2, d3] = pyramid.cells(&map, 3)[0];
        let k = covariance(d1, d2, d3);
        let want = [direct(0, 0) + 0.02, direct(0, 1), direct(1, 1) + 0.02];
        for c in 0..3 {
            assert!((f64::from(k[c]) - want[c]).abs() < 1e-6, "{k:?} {want:?}");
        }
    }

    proptest! {
        #[test]
        fn factoring_is_undone(a in 0.0f32..2.0, b in -1.0f32..1.0, c in 0.01f32..2.0) {
            prop_assume!(a * c > b * b + 1e-4);
            let [d1, d2, d3] = factor([a, b, c]);
            for (got, want) in covariance(d1, d2, d3).into_iter().zip([a, b, c]) {
                prop_assert!((got - want).abs() < 1e-5);
            }
        }

        #[test]
        fn carrying_makes_a_tilted_base_lobe_round(x in -2.0f32..2.0, y in -2.0f32..2.0) {
            let lift = 1.0 + x * x + y * y;
            let tilted = [lift * (1.0 + x * x), lift * x * y, lift * (1.0 + y * y)];
            let [a, b, c] = carried(tilted, x, y);
            prop_assert!((a - 1.0).abs() < 1e-4 && b.abs() < 1e-4 && (c - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn isotropic_widths_do_not_pool() {
        // Half of a cell rough along u alone, half along v alone: K is the mean of the two, and its
        // largest eigenvalue half of theirs. Bilinear lookups between them agree.
        let (along_u, along_v) = ([0.3, 0.0, 0.0], [0.0, 0.0, 0.3]);
        let pooled = [0.15, 0.0, 0.15];
        assert_eq!(shaped(along_u, false), shaped(along_v, false));
        assert_eq!(shaped(pooled, false), [0.15, 0.0, 0.15]);
        assert_eq!(shaped(along_u, false)[0], 0.3);
    }

    #[test]
    fn between_cells_the_normalised_form_has_the_mean_covariance() {
        // Slopes along one diagonal in the left cell, along the other in the right.
        let (a, b) = ([0.3, 0.1, 1.0, 1.0], [-0.3, -0.1, 1.0, 1.0]);
        let (c, d) = ([0.3, -0.1, 1.0, 1.0], [-0.3, 0.1, 1.0, 1.0]);
        let map = NormalMap::new(4, 2, Wrap::Clamp, vec![a, b, c, d, b, a, d, c]);
        let base = BaseLobe::Beckmann { alpha: 0.2 };
        let pyramid = Pyramid::build(&map, Normalised { base, anisotropic: true });
        let [_, _, _, a, b, c] = pyramid.trilinear(&map, 0.5, 0.5, 1.0);
        assert!(
            (a - 0.09).abs() < 1e-6 && b.abs() < 1e-6 && (c - 0.01).abs() < 1e-6,
            "{a} {b} {c}"
        );
    }

    #[test]
    fn a_flat_direction_factors() {
        assert_eq!(factor([0.25, 0.0, 0.0]), [0.5, 0.0, 0.0]);
        // A covariance that rounding left without positivity stays bounded.
        assert_eq!(factor([0.25, 1e-9, 0.0]), [0.0, 0.5, 0.0]);
    }
}
