//! Distributions of normals moved and stretched in slope space: what is left of a lobe when its mean, its width or
//! its anisotropy is replaced by another's.
//!
//! A slope is x = (h·x̂, h·ŷ) / (h·ẑ), ẑ the surface's normal. A distribution of normals D is one of slopes,
//! P(x) = D(h) cos⁴θ, with ∫ P dx = ∫ D cosθ dω. The map x ↦ to + A (x − from) makes of it another, with
//! P′(x′) = P(x) / det A: it keeps the integral, moves the mean from `from` to `to` and makes of the covariance K
//! A K Aᵀ.

use super::vector::{V3, tangents, unit};
use super::{Facet, MultipleSurface, Profile, Slopes, Spread};

/// A symmetric 2×2 matrix (a b; b c) as [a, b, c], double precision.
type Sym = [f64; 3];
/// Rows of a 2×2 matrix.
type Rows = [[f64; 2]; 2];

/// The least cosine to the surface's normal at which slopes are taken: what leans further is taken to lean so far.
const LEAST_COSINE: f64 = 1.0 / 64.0;

/// The slopes of a distribution of normals in the surface's frame, up to the second order.
///
/// The mean is exact, as ∫ x P dx = ∫ D h_xy dω. The second moments of tilted lobes with tails diverge (a
/// Blinn-Phong lobe that leans has a density at the horizon, where slopes are infinite), so each lobe brings its
/// covariance about its own pole, carried to the surface's slopes to first order; of a single normal of slope b and
/// base variance v that is (1 + |b|²)(I + b bᵀ) v, as in LEAN mapping. A GGX lobe, which has no variance, counts as
/// the Beckmann lobe of its α, to which bumps add alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopeMoments {
    /// ∫ D cosθ dω > 0.
    pub mass: f64,
    /// Mean slope.
    pub mean: [f64; 2],
    /// Covariance of the slopes (a b; b c) as [a, b, c]; positive definite.
    pub covariance: [f64; 3],
}

impl SlopeMoments {
    /// Those of the sum of some lobes. `None` if they have no mass or no width.
    pub fn of<'a, L: Spread + 'a>(lobes: impl Iterator<Item = &'a L>) -> Option<Self> {
        let mut sums = [0.0f64; 6];
        for lobe in lobes {
            let Some((mass, [x, y], [xx, xy, yy])) = of_lobe(&lobe.slopes()) else { continue };
            let parts = [1.0, x, y, xx + x * x, xy + x * y, yy + y * y];
            for (sum, part) in sums.iter_mut().zip(parts) {
                *sum += mass * part;
            }
        }
        let [mass, ..] = sums;
        let [_, x, y, xx, xy, yy] = sums.map(|sum| sum / mass);
        let covariance = [xx - x * x, xy - x * y, yy - y * y];
        let whole = mass > 0.0 && mass.is_finite() && determinant(covariance) > 0.0;
        (whole && trace(covariance).is_finite() && trace(covariance) > 0.0).then_some(Self {
            mass,
            mean: [x, y],
            covariance,
        })
    }
}

/// Mass, mean and covariance of one lobe; `None` if it sends nothing upwards.
fn of_lobe(slopes: &Slopes) -> Option<(f64, [f64; 2], Sym)> {
    let [pole, tangent, bitangent] =
        [slopes.pole, slopes.tangent, slopes.bitangent].map(|v| v.map(f64::from));
    let [across, along] = slopes.mean.map(f64::from);
    let axis = [0, 1, 2].map(|c| pole[c] + across * tangent[c] + along * bitangent[c]);
    let mass = f64::from(slopes.amplitude) * axis[2];
    let up = axis[2].max(LEAST_COSINE);
    let mean = [axis[0] / up, axis[1] / up];
    let unit = if slopes.profile == Profile::Ggx { 0.5 } else { 1.0 };
    let own = slopes.spread.map(|entry| unit * f64::from(entry));
    let carried = sandwich(jacobian(mean, up, [tangent, bitangent]), own);
    (mass > 0.0 && mass.is_finite()).then_some((mass, mean, carried))
}

/// How the slope at `mean`, of a direction of height `up`, changes with steps of that direction along two vectors.
fn jacobian(mean: [f64; 2], up: f64, steps: [[f64; 3]; 2]) -> Rows {
    [0, 1].map(|row| [0, 1].map(|c| (steps[c][row] - mean[row] * steps[c][2]) / up))
}

/// Which moments of a distribution are replaced by another's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Replacing {
    /// ∫ D cosθ dω.
    pub energy: bool,
    /// The mean slope.
    pub direction: bool,
    /// The trace of the covariance, its axes and their ratio kept.
    pub width: bool,
    /// The axes of the covariance and their ratio, its trace kept.
    pub anisotropy: bool,
}

/// x ↦ to + A (x − from), and a factor on the density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warp {
    from: [f64; 2],
    to: [f64; 2],
    forward: Sym,
    inverse: Sym,
    factor: f64,
    identity: bool,
}

impl Warp {
    /// Leaves everything as it is, bit by bit.
    pub const IDENTITY: Self = Self {
        from: [0.0; 2],
        to: [0.0; 2],
        forward: [1.0, 0.0, 1.0],
        inverse: [1.0, 0.0, 1.0],
        factor: 1.0,
        identity: true,
    };

    /// Makes of a distribution with moments `own` one that has of `other`'s what `replacing` says. A is the symmetric
    /// matrix with A K Aᵀ = K′: among all maps that do so, it moves slopes least.
    pub fn new(own: &SlopeMoments, other: &SlopeMoments, replacing: Replacing) -> Self {
        if replacing == Replacing::default() {
            return Self::IDENTITY;
        }
        let ratio = trace(other.covariance) / trace(own.covariance);
        let forward = match (replacing.width, replacing.anisotropy) {
            (false, false) => [1.0, 0.0, 1.0],
            (true, false) => [ratio.sqrt(), 0.0, ratio.sqrt()],
            (false, true) => between(own.covariance, scaled(other.covariance, 1.0 / ratio)),
            (true, true) => between(own.covariance, other.covariance),
        };
        let energy = if replacing.energy { other.mass / own.mass } else { 1.0 };
        let to = if replacing.direction { other.mean } else { own.mean };
        let warp = Self {
            from: own.mean,
            to,
            forward,
            inverse: inverse(forward),
            factor: energy / determinant(forward),
            identity: false,
        };
        if warp.is_finite() { warp } else { Self::IDENTITY }
    }

    fn is_finite(&self) -> bool {
        let Self { from, to, forward, inverse, factor, .. } = self;
        from.iter().chain(to).chain(forward).chain(inverse).chain([factor]).all(|x| x.is_finite())
    }

    /// The direction that this takes to `h`, and what its density is multiplied by. Directions below the surface have
    /// no slope, and stay.
    fn back(&self, h: V3) -> (V3, f32) {
        let [x, y, z] = h.map(f64::from);
        if self.identity || z <= 0.0 {
            return (h, 1.0);
        }
        let there = [x / z, y / z];
        let [dx, dy] = applied(self.inverse, [there[0] - self.to[0], there[1] - self.to[1]]);
        let here = [self.from[0] + dx, self.from[1] + dy];
        // D′ cos⁴θ′ = D cos⁴θ factor, and 1/cos²θ = 1 + |x|².
        let cosines = (1.0 + square(there)) / (1.0 + square(here));
        let [u, v] = here.map(|slope| slope as f32);
        ([u, v, 1.0], (self.factor * cosines * cosines) as f32)
    }

    /// Where this takes a facet: its axis moves with its slope, its roughness is carried to first order.
    fn carried(&self, facet: Facet) -> Facet {
        let [x, y, z] = facet.axis.map(f64::from);
        if self.identity || z <= LEAST_COSINE {
            return facet;
        }
        let here = [x / z, y / z];
        let [dx, dy] = applied(self.forward, [here[0] - self.from[0], here[1] - self.from[1]]);
        let there = [self.to[0] + dx, self.to[1] + dy];
        let axis = unit([there[0] as f32, there[1] as f32, 1.0]);
        let (tangent, bitangent) = tangents(axis);
        let steps = |across: V3, along: V3| [across, along].map(|v| v.map(f64::from));
        let out = jacobian(here, z, steps(facet.tangent, facet.bitangent));
        let into = jacobian(there, f64::from(axis[2]), steps(tangent, bitangent));
        let stretched = product(rows(self.forward), out);
        let whole = product(inverted(into), stretched);
        let alpha_squared =
            sandwich(whole, facet.alpha_squared.map(f64::from)).map(|entry| entry as f32);
        Facet { axis, tangent, bitangent, alpha_squared, ..facet }
    }
}

/// A lobe seen through a warp. Its Phong highlight takes no account of the lobe's own spread.
#[derive(Clone, Copy, Debug)]
pub struct Warped<'a, L> {
    /// The lobe.
    pub lobe: &'a L,
    /// The warp.
    pub warp: &'a Warp,
}

impl<L: Spread> Spread for Warped<'_, L> {
    fn density(&self, h: V3) -> f32 {
        let (h, factor) = self.warp.back(h);
        self.lobe.density(h) * factor
    }

    fn facet(&self) -> Facet {
        self.warp.carried(self.lobe.facet())
    }
}

impl MultipleSurface {
    /// The moments of its slopes; see [`SlopeMoments::of`].
    pub fn slope_moments(&self) -> Option<SlopeMoments> {
        SlopeMoments::of(self.lobes().iter())
    }
}

fn trace([a, _, c]: Sym) -> f64 {
    a + c
}

fn determinant([a, b, c]: Sym) -> f64 {
    a * c - b * b
}

fn scaled(m: Sym, by: f64) -> Sym {
    m.map(|entry| entry * by)
}

fn inverse([a, b, c]: Sym) -> Sym {
    scaled([c, -b, a], 1.0 / determinant([a, b, c]))
}

fn applied([a, b, c]: Sym, [x, y]: [f64; 2]) -> [f64; 2] {
    [a * x + b * y, b * x + c * y]
}

fn square([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

fn rows([a, b, c]: Sym) -> Rows {
    [[a, b], [b, c]]
}

fn product(a: Rows, b: Rows) -> Rows {
    a.map(|[x, y]| [x * b[0][0] + y * b[1][0], x * b[0][1] + y * b[1][1]])
}

fn inverted([[a, b], [c, d]]: Rows) -> Rows {
    let per = 1.0 / (a * d - b * c);
    [[d * per, -b * per], [-c * per, a * per]]
}

/// J M Jᵀ.
fn sandwich([[a, b], [c, d]]: Rows, [x, y, z]: Sym) -> Sym {
    [
        a * a * x + 2.0 * a * b * y + b * b * z,
        a * c * x + (a * d + b * c) * y + b * d * z,
        c * c * x + 2.0 * c * d * y + d * d * z,
    ]
}

/// The symmetric square root of a positive definite matrix: (M + √det I) / √(tr + 2 √det).
fn root(m: Sym) -> Sym {
    let det = determinant(m).max(0.0).sqrt();
    let [a, b, c] = m;
    scaled([a + det, b, c + det], 1.0 / (a + c + 2.0 * det).sqrt())
}

/// The symmetric A with A K Aᵀ = K′: K^{−½} (K^{½} K′ K^{½})^{½} K^{−½}.
fn between(k: Sym, other: Sym) -> Sym {
    let half = root(k);
    sandwich(rows(inverse(half)), root(sandwich(rows(half), other)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::{BaseLobe, EllipticLobe, Shading};
    use proptest::prelude::*;

    fn gaussian(mean: [f32; 2], spread: [f32; 3]) -> EllipticLobe {
        EllipticLobe::new([0.0, 0.0, 1.0], spread, 1.3, Profile::Gaussian).with_mean(mean)
    }

    /// ∫ P, ∫ x P / ∫ P and the covariance, by the midpoint rule over slopes within 6: P falls to nothing there.
    fn measured(lobe: &impl Spread) -> SlopeMoments {
        const STEPS: i32 = 480;
        let step = 12.0 / f64::from(STEPS);
        let mut sums = [0.0f64; 6];
        for i in 0..STEPS {
            for j in 0..STEPS {
                let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) * step - 6.0);
                let square = 1.0 + x * x + y * y;
                let density = lobe.density([x as f32, y as f32, 1.0]);
                let mass = f64::from(density) / (square * square) * step * step;
                for (sum, part) in sums.iter_mut().zip([1.0, x, y, x * x, x * y, y * y]) {
                    *sum += mass * part;
                }
            }
        }
        let [_, x, y, xx, xy, yy] = sums.map(|sum| sum / sums[0]);
        let covariance = [xx - x * x, xy - x * y, yy - y * y];
        SlopeMoments { mass: sums[0], mean: [x, y], covariance }
    }

    fn spread(a: f64, ratio: f64, lean: f64) -> Sym {
        let c = a * ratio;
        [a, lean * (a * c).sqrt(), c]
    }

    fn near(got: &SlopeMoments, want: &SlopeMoments) {
        let flat = |m: &SlopeMoments| {
            [m.mass, m.mean[0], m.mean[1], m.covariance[0], m.covariance[1], m.covariance[2]]
        };
        // Single precision of densities, and Gaussians cut where they are 10⁻⁵ of their peak at most.
        for (got, want) in flat(got).into_iter().zip(flat(want)) {
            assert!((got - want).abs() < 2e-3 * (0.1 + want.abs()), "{got} {want}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]

        #[test]
        fn a_warped_lobe_has_the_moments_asked_for(
            means in prop::array::uniform4(-0.5f64..0.5),
            widths in prop::array::uniform2(0.02f64..0.3),
            ratios in prop::array::uniform2(0.3f64..3.0),
            leans in prop::array::uniform2(-0.7f64..0.7),
            choice in 0u8..16,
        ) {
            let own = spread(widths[0], ratios[0], leans[0]);
            let lobe = gaussian([means[0] as f32, means[1] as f32], own.map(|x| x as f32));
            let own = SlopeMoments { mass: f64::from(1.3f32), mean: [means[0], means[1]], covariance: own };
            let asked = spread(widths[1], ratios[1], leans[1]);
            let other = SlopeMoments { mass: 0.8, mean: [means[2], means[3]], covariance: asked };
            let [energy, direction, width, anisotropy] = [0, 1, 2, 3].map(|bit| choice >> bit & 1 == 1);
            let warp = Warp::new(&own, &other, Replacing { energy, direction, width, anisotropy });
            let warped = measured(&Warped { lobe: &lobe, warp: &warp });
            let ratio = trace(asked) / trace(own.covariance);
            let covariance = match (width, anisotropy) {
                (false, false) => own.covariance,
                (true, false) => scaled(own.covariance, ratio),
                (false, true) => scaled(asked, 1.0 / ratio),
                (true, true) => asked,
            };
            let want = SlopeMoments {
                mass: if energy { 0.8 } else { own.mass },
                mean: if direction { other.mean } else { own.mean },
                covariance,
            };
            near(&warped, &want);
        }

        #[test]
        fn the_map_between_two_matrices_is_symmetric_and_exact(
            widths in prop::array::uniform2(1e-4f64..10.0),
            ratios in prop::array::uniform2(1e-3f64..1e3),
            leans in prop::array::uniform2(-0.99f64..0.99),
        ) {
            let [k, other] = [0, 1].map(|i| spread(widths[i], ratios[i], leans[i]));
            let got = sandwich(rows(between(k, other)), k);
            for (got, want) in got.into_iter().zip(other) {
                prop_assert!((got - want).abs() < 1e-9 * trace(other), "{got} {want}");
            }
        }
    }

    #[test]
    fn moments_of_flat_lobes_are_their_own() {
        let lobe = gaussian([0.2, -0.1], [0.05, 0.01, 0.08]);
        let moments = SlopeMoments::of([lobe].iter()).unwrap();
        near(&moments, &measured(&lobe));
    }

    #[test]
    fn a_tilted_base_lobe_is_as_wide_as_in_lean_mapping() {
        let base = BaseLobe::BlinnPhong { exponent: 200.0 };
        let [bx, by] = [0.4f64, -0.3];
        let lobe = base.about([bx as f32, by as f32, 1.0], 2.0);
        let moments = SlopeMoments::of([lobe].iter()).unwrap();
        let scale = (1.0 + bx * bx + by * by) / 200.0;
        let want = SlopeMoments {
            mass: 2.0 / (1.0 + bx * bx + by * by).sqrt(),
            mean: [bx, by],
            covariance: [scale * (1.0 + bx * bx), scale * bx * by, scale * (1.0 + by * by)],
        };
        let flat =
            |m: &SlopeMoments| [m.mass, m.mean[0], m.mean[1]].into_iter().chain(m.covariance);
        for (got, want) in flat(&moments).zip(flat(&want).collect::<Vec<_>>()) {
            assert!((got - want).abs() < 1e-6, "{got} {want}");
        }
    }

    #[test]
    fn replacing_moments_by_themselves_changes_nothing() {
        let surface: MultipleSurface = [[0.1f32, 0.2, 1.0], [-0.4, 0.1, 1.0]]
            .map(|n| BaseLobe::Ggx { alpha: 0.3 }.about(n, 1.0))
            .into_iter()
            .collect();
        let own = surface.slope_moments().unwrap();
        let all = Replacing { energy: true, direction: true, width: true, anisotropy: true };
        let (light, view) = (unit([0.4, 0.3, 0.8]), unit([-0.2, 0.1, 0.9]));
        let half = [0, 1, 2].map(|c| light[c] + view[c]);
        for shading in [Shading::Ndf, Shading::Microfacet] {
            let plain = surface.radiance(shading, half, light, view);
            let at = |warp| surface.warped_radiance(warp, shading, half, light, view);
            assert_eq!(at(&Warp::IDENTITY).to_bits(), plain.to_bits());
            let same = at(&Warp::new(&own, &own, all));
            assert!((same / plain - 1.0).abs() < 1e-5, "{same} {plain}");
        }
    }

    #[test]
    fn a_facet_is_carried_as_its_lobe() {
        // A lobe at the pole, moved and stretched: its roughness is what the stretched lobe's own facet has.
        let lobe = gaussian([0.0; 2], [0.04, 0.0, 0.04]);
        let own = SlopeMoments { mass: 1.3, mean: [0.0; 2], covariance: [0.04, 0.0, 0.04] };
        let other = SlopeMoments { mass: 1.3, mean: [0.0; 2], covariance: [0.09, 0.02, 0.05] };
        let all = Replacing { energy: true, direction: true, width: true, anisotropy: true };
        let warp = Warp::new(&own, &other, all);
        let got = Warped { lobe: &lobe, warp: &warp }.facet();
        let want = gaussian([0.0; 2], [0.09, 0.02, 0.05]).facet();
        for (got, want) in got.alpha_squared.into_iter().zip(want.alpha_squared) {
            assert!((got - want).abs() < 1e-6);
        }
        assert_eq!(got.axis, want.axis);
    }
}
