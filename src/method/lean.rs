//! LEAN mapping (Olano and Baker 2010).

use std::sync::Arc;

use super::one_lobe::{OneLobe, OneLobeMap};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::vector::{Sym2, at_least};
use crate::lobe::{BaseLobe, EllipticLobe};
use crate::texture::{MIN_COSINE, Moments, NormalMap, Texel};

/// One lobe in the slopes of the surface's own frame, from their first two moments.
///
/// B = E[b], M = E[b bᵀ], Σ = M − B Bᵀ + I/s (§3.2): all linear but the last step, so the moments are
/// what is stored and interpolated, and the spread *between* the texels of a lookup counts too. Two
/// choices the paper leaves open:
/// - a tilted normal's base lobe is wider in the surface's frame than about itself, so each texel
///   brings (1 + |b|²)(I + b bᵀ)/s in place of I/s: to first order what it is, and as linear;
/// - slopes weigh w·n_z, as the microfacet measure asks (see [`crate::lobe`]), and the lobe's moment
///   along the surface's normal is the mean of w·n_z. (The paper's own normalisation has an erratum.)
///
/// Channels: p = w·n_z, p·b, and p·(b bᵀ + base) as xx, xy, yy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lean;

const CARD: Card = Card {
    name: "lean",
    source: "Olano and Baker 2010, LEAN Mapping, §3",
    summary: "First and second moments of the slopes, one elliptical lobe in the surface's frame.",
    formula: "the base lobe's profile in slopes, mean B, covariance M − B Bᵀ + base",
    limits: "one lobe; a steep normal's lobe is not an ellipse in the surface's slopes",
    normalised: true,
    keeps_roughness: true,
    fractal: false,
    precision: 1e-3,
};

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry { card: CARD, parameters: &[], build: |_| Box::new(Lean) }
}

impl Method for Lean {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        // Measured: at most 0.92 |b| √v for a normal of slope b, nothing for a flat one; √v is the base
        // roughness as a slope. This is the bound for normals that lean by up to 65° (see the tests).
        Ok(2.0 * f64::from(SlopeMoments::of(base).variance).sqrt())
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        Ok(Box::new(OneLobeMap::build(map, base, SlopeMoments::of(base))))
    }
}

struct SlopeMoments {
    base: BaseLobe,
    /// The base lobe's spread in units of slope variance.
    variance: f32,
    /// What a slope variance of 1 adds to the lobe's spread matrix. GGX has no variance; bumps add to
    /// its α² as they add to Beckmann's, which is twice the variance.
    share: f32,
}

impl SlopeMoments {
    fn of(base: &BaseLobe) -> Self {
        let share = if matches!(base, BaseLobe::Ggx { .. }) { 2.0 } else { 1.0 };
        Self { base: *base, variance: base.spread() as f32 / share, share }
    }
}

impl Moments<6> for SlopeMoments {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 6] {
        let z = z.max(MIN_COSINE);
        let (p, x, y) = (w * z, x / z, y / z);
        let lift = self.variance * (1.0 + x * x + y * y);
        let cross = x * y * (1.0 + lift);
        [
            p,
            p * x,
            p * y,
            p * (x * x * (1.0 + lift) + lift),
            p * cross,
            p * (y * y * (1.0 + lift) + lift),
        ]
    }
}

impl OneLobe<6> for SlopeMoments {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, [p, px, py, pxx, pxy, pyy]: [f32; 6]) -> EllipticLobe {
        let per = 1.0 / p.max(f32::MIN_POSITIVE);
        let (x, y) = (px * per, py * per);
        let covariance: Sym2 = [pxx * per - x * x, pxy * per - x * y, pyy * per - y * y];
        // No exact Σ is below the base lobe's own; differences of rounded moments can be.
        let spread = at_least(covariance, self.variance).map(|m| self.share * m);
        EllipticLobe::new([0.0, 0.0, 1.0], spread, p, self.base.profile()).with_mean([x, y])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Frame, HemisphereGrid, Vec3};
    use crate::lobe::Spread;

    fn lobe_of(base: &BaseLobe, texels: &[Texel]) -> EllipticLobe {
        let moments = SlopeMoments::of(base);
        let mut mean = [0.0; 6];
        for texel in texels {
            for (sum, m) in mean.iter_mut().zip(moments.encode(*texel)) {
                *sum += m / texels.len() as f32;
            }
        }
        moments.lobe(mean)
    }

    fn tilted(degrees: f64) -> Texel {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        [sin as f32, 0.0, cos as f32, 1.0]
    }

    /// ½ ∫ |D − D_base| |h·n| dω over all directions, those below the normal's horizon too.
    fn distance(base: &BaseLobe, normal: Texel) -> f64 {
        let [x, y, z, _] = normal;
        let frame = Frame::about(Vec3::new(x.into(), y.into(), z.into()));
        let (exact, lean) = (base.about([x, y, z], 1.0), lobe_of(base, &[normal]));
        let gap = |v: Vec3| {
            let h = [v.x as f32, v.y as f32, v.z as f32];
            f64::from((exact.density(h) - lean.density(h)).abs())
        };
        let both = |d: Vec3| {
            let h = frame.world_from_local(d);
            (gap(h) + gap(-h)) * d.z
        };
        0.5 * HemisphereGrid::new(360, 360).integrate(both)
    }

    fn lobes() -> Vec<BaseLobe> {
        let mut all =
            [1.0, 10.0, 50.0, 1000.0].map(|exponent| BaseLobe::BlinnPhong { exponent }).to_vec();
        for alpha in [0.1, 0.2, 0.5, 1.0] {
            all.extend([BaseLobe::Beckmann { alpha }, BaseLobe::Ggx { alpha }]);
        }
        all
    }

    #[test]
    fn a_flat_normal_is_the_base_lobe() {
        for base in lobes() {
            assert!(distance(&base, tilted(0.0)) < 1e-4, "{base}");
        }
    }

    #[test]
    fn a_tilted_normal_is_as_near_as_claimed() {
        for base in lobes() {
            let claimed = Lean.base_error(&base).unwrap();
            for degrees in [10.0f64, 20.0, 45.0, 65.0] {
                let slope = libm::tan(degrees.to_radians());
                let found = distance(&base, tilted(degrees));
                assert!(found <= 0.46 * claimed * slope, "{base} {degrees}°: {found}");
                assert!(found <= claimed, "{base} {degrees}°: {found}");
            }
        }
    }

    #[test]
    fn the_lobe_has_the_moments_of_the_footprint() {
        let base = BaseLobe::Beckmann { alpha: 0.1 };
        let slopes = [[0.3f32, 0.1], [-0.2, 0.4], [0.0, -0.3], [0.5, 0.2]];
        let texels = slopes.map(|[x, y]| {
            let z = 1.0 / (1.0 + x * x + y * y).sqrt();
            [x * z, y * z, z, 1.0 / z] // a weight of 1/n_z: slopes count alike
        });
        let mean = [0, 1].map(|c| slopes.iter().map(|b| b[c]).sum::<f32>() / 4.0);
        let mixed = |c: usize, d: usize| {
            let about = |b: &[f32; 2]| (b[c] - mean[c]) * (b[d] - mean[d]);
            let own = |b: &[f32; 2]| {
                (1.0 + b[0] * b[0] + b[1] * b[1]) * (f32::from(u8::from(c == d)) + b[c] * b[d])
            };
            slopes.iter().map(|b| about(b) + 0.005 * own(b)).sum::<f32>() / 4.0
        };
        let lobe = lobe_of(&base, &texels);
        for (got, want) in lobe.spread().into_iter().zip([mixed(0, 0), mixed(0, 1), mixed(1, 1)]) {
            assert!((got - want).abs() < 1e-6, "{got} {want}");
        }
        let axis = lobe.facet().axis;
        assert!((axis[0] / axis[2] - mean[0]).abs() < 1e-6);
        assert!((axis[1] / axis[2] - mean[1]).abs() < 1e-6);
    }

    #[test]
    fn the_amplitude_is_the_projected_area() {
        let base = BaseLobe::BlinnPhong { exponent: 100.0 };
        let texels = [tilted(30.0), tilted(-10.0), [0.0, 0.6, 0.8, 2.0]];
        let want = texels.iter().map(|t| f64::from(t[2] * t[3])).sum::<f64>() / 3.0;
        let lobe = lobe_of(&base, &texels);
        let found = HemisphereGrid::new(360, 360)
            .integrate(|d| f64::from(lobe.density([d.x as f32, d.y as f32, d.z as f32])) * d.z);
        assert!((found / want - 1.0).abs() < 1e-3, "{found} {want}");
    }
}
