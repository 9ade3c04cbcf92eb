//! A lobe as a distribution of slopes: its moment, and the Gaussians it is mixed of.

use super::vector::{Sym2, V3, dot, times};
use super::{Profile, Spread};
use crate::geometry::elementary::ln32;

/// The slopes of a lobe's normals about its pole: D(h) (h·pole) dω = `amplitude` · P(x − `mean`) dx, with
/// x = (h·tangent, h·bitangent) / (h·pole) and P as [`Profile`] says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// Unit vector the slopes are about.
    pub pole: V3,
    /// Unit vector across it.
    pub tangent: V3,
    /// Unit vector across both.
    pub bitangent: V3,
    /// ∫ D(h) (h·pole) dω.
    pub amplitude: f32,
    /// Mean slope.
    pub mean: [f32; 2],
    /// Spread matrix, as the profile reads it.
    pub spread: Sym2,
    /// How density falls.
    pub profile: Profile,
}

/// The most Gaussians that stand for a lobe.
pub const GAUSSIANS: usize = 4;

/// One of the Gaussians of a lobe's slopes: its share (all sum to 1) and its covariance.
pub type Gaussian = (f32, Sym2);

/// A few of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gaussians {
    all: [Gaussian; GAUSSIANS],
    count: usize,
}

impl Gaussians {
    fn push(&mut self, gaussian: Gaussian) {
        self.all[self.count] = gaussian;
        self.count += 1;
    }
}

impl std::ops::Deref for Gaussians {
    type Target = [Gaussian];

    fn deref(&self) -> &[Gaussian] {
        &self.all[..self.count]
    }
}

/// Shares of the mixing distribution from its low end, and the standard normal quantiles of their middles.
/// Uneven, as the low end holds the lobe's far tail.
const SHARES: [(f32, f32); GAUSSIANS] =
    [(0.05, -1.959_964), (0.15, -1.150_349_4), (0.30, -0.385_320_47), (0.50, 0.674_489_75)];

impl Slopes {
    /// The vector moment ∫ D(h) h dω.
    pub fn moment(&self) -> V3 {
        let [x, y] = self.mean;
        [0, 1, 2]
            .map(|c| self.amplitude * (self.pole[c] + x * self.tangent[c] + y * self.bitangent[c]))
    }

    /// The Gaussians whose mixture stands for the lobe.
    ///
    /// A Student-t of ν degrees of freedom in slopes is a Gaussian of covariance ν Λ / W with W ~ χ²_ν:
    /// for a Blinn-Phong lobe of exponent s, ν = s + 2 and the covariance is I/W; GGX is ν = 2 and
    /// α² I/W. W is taken at a few quantiles (Wilson and Hilferty 1931; exact for ν = 2). With 4 of
    /// them the part of a GGX lobe within any angle is right to 0.018. The larger ν, the nearer W is to
    /// its mean and the fewer are needed.
    pub fn gaussians(&self) -> Gaussians {
        let mut all = Gaussians::default();
        match self.profile {
            Profile::Gaussian => all.push((1.0, self.spread)),
            Profile::Ggx => {
                let mut below = 0.0;
                for (share, _) in SHARES {
                    let w = -2.0 * ln32(1.0 - (below + 0.5 * share));
                    all.push((share, times(self.spread, 1.0 / w)));
                    below += share;
                }
            }
            Profile::Student { exponent: s } => {
                let (nu, times_s) = (s + 2.0, times(self.spread, s));
                let scatter = 2.0 / (9.0 * nu);
                let at = |z: f32| {
                    let root = 1.0 - scatter + z * scatter.sqrt();
                    times(times_s, 1.0 / (nu * root * root * root))
                };
                if nu > 100.0 {
                    // The covariance itself.
                    all.push((1.0, self.spread));
                } else if nu > 14.0 {
                    [-1.0, 1.0].into_iter().for_each(|z| all.push((0.5, at(z))));
                } else {
                    SHARES.into_iter().for_each(|(share, z)| all.push((share, at(z))));
                }
            }
        }
        all
    }

    /// The slopes of any lobe by numerical integration of its density about its facet's axis: a polar rule
    /// of 12 × 12 points, stretched to the facet's roughness. Amplitudes of Gaussian-like lobes come out within
    /// 10⁻³. It stands for the lobe by a single Gaussian.
    pub fn integrated<L: Spread + ?Sized>(lobe: &L) -> Self {
        let facet = lobe.facet();
        let [a, b, c] = facet.alpha_squared;
        // A root of α²: (r 0; s t).
        let r = a.max(f32::MIN_POSITIVE).sqrt();
        let s = b / r;
        let t = (c - s * s).max(0.0).sqrt();
        let mut sums = [0.0f64; 6];
        for (cos, sin) in DOZEN {
            for (y, weight) in GAUSS_LEGENDRE {
                // Squared radii of density 2 / (1 + q)³: heavier in the tail than any lobe that is sampled.
                let q = 1.0 / y.sqrt() - 1.0;
                let radius = q.sqrt();
                let (u, v) = (radius * cos, radius * sin);
                let (x, z) = (r * u, s * u + t * v);
                let h = [0, 1, 2]
                    .map(|k| facet.axis[k] + x * facet.tangent[k] + z * facet.bitangent[k]);
                let square = 1.0 + x * x + z * z;
                // D cos dω = D cos⁴ dx, and dx = ½ det dq dφ.
                let mass = lobe.density(h) / (square * square) * weight * (1.0 + q).powi(3);
                for (sum, part) in sums.iter_mut().zip([1.0, x, z, x * x, x * z, z * z]) {
                    *sum += f64::from(mass * part);
                }
            }
        }
        let scale = f64::from(r * t) * std::f64::consts::PI / DOZEN.len() as f64 / 2.0;
        let total = sums[0].max(f64::MIN_POSITIVE);
        let [_, x, z, xx, xz, zz] = sums.map(|sum| sum / total);
        Self {
            pole: facet.axis,
            tangent: facet.tangent,
            bitangent: facet.bitangent,
            amplitude: (sums[0] * scale) as f32,
            mean: [x as f32, z as f32],
            spread: [xx - x * x, xz - x * z, zz - z * z].map(|entry| entry as f32),
            profile: Profile::Gaussian,
        }
    }

    /// The part of `v` along the pole, and along the slopes' axes.
    pub fn local(&self, v: V3) -> V3 {
        [dot(v, self.tangent), dot(v, self.bitangent), dot(v, self.pole)]
    }
}

/// Cosine and sine of 12 angles, 30° apart from 15° on.
const DOZEN: [(f32, f32); 12] = {
    const C: [f32; 3] = [0.965_925_8, 0.707_106_77, 0.258_819_04];
    [
        (C[0], C[2]),
        (C[1], C[1]),
        (C[2], C[0]),
        (-C[2], C[0]),
        (-C[1], C[1]),
        (-C[0], C[2]),
        (-C[0], -C[2]),
        (-C[1], -C[1]),
        (-C[2], -C[0]),
        (C[2], -C[0]),
        (C[1], -C[1]),
        (C[0], -C[2]),
    ]
};

/// Abscissas and weights of the 12-point Gauss-Legendre rule on [0, 1].
const GAUSS_LEGENDRE: [(f32, f32); 12] = [
    (0.009219683, 0.023587668),
    (0.04794137, 0.05346966),
    (0.11504866, 0.080039166),
    (0.20634103, 0.10158371),
    (0.31608424, 0.11674627),
    (0.4373833, 0.12457352),
    (0.5626167, 0.12457352),
    (0.68391573, 0.11674627),
    (0.793659, 0.10158371),
    (0.88495135, 0.080039166),
    (0.9520586, 0.05346966),
    (0.9907803, 0.023587668),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::{
        BaseLobe, Contour, Cut, Fall, Generator, PedalLobe, PhongPeak, RestrictedLobe,
    };

    #[test]
    fn shares_sum_to_one() {
        for base in [
            BaseLobe::Ggx { alpha: 0.3 },
            BaseLobe::BlinnPhong { exponent: 2.0 },
            BaseLobe::BlinnPhong { exponent: 30.0 },
            BaseLobe::BlinnPhong { exponent: 1000.0 },
        ] {
            let gaussians = base.about([0.0, 0.0, 1.0], 1.0).slopes().gaussians();
            let total: f32 = gaussians.iter().map(|g| g.0).sum();
            assert!((total - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn a_mixture_holds_what_its_lobe_holds_within_an_angle() {
        // The part of a lobe within tan θ: 1 − 1/(1 + t/α²) for GGX, 1 − (1 + t)^(−s/2 − 1) for
        // Blinn-Phong; of a Gaussian of variance v, 1 − e^(−t/2v).
        for (base, most) in [
            (BaseLobe::Ggx { alpha: 0.3 }, 0.019),
            (BaseLobe::BlinnPhong { exponent: 2.0 }, 0.02),
            (BaseLobe::BlinnPhong { exponent: 10.0 }, 0.02),
            (BaseLobe::BlinnPhong { exponent: 30.0 }, 0.01),
            (BaseLobe::BlinnPhong { exponent: 200.0 }, 0.01),
        ] {
            let gaussians = base.about([0.0, 0.0, 1.0], 1.0).slopes().gaussians();
            for i in 0..200 {
                let t = f64::from(i) * 0.02 * base.spread();
                let outside: f64 = gaussians
                    .iter()
                    .map(|g| f64::from(g.0) * (-0.5 * t / f64::from(g.1[0])).exp())
                    .sum();
                let exact = match base {
                    BaseLobe::BlinnPhong { exponent } => (1.0 + t).powf(-0.5 * exponent - 1.0),
                    _ => 1.0 / (1.0 + t / base.spread()),
                };
                assert!((outside - exact).abs() < most, "{base} {t}: {outside} {exact}");
            }
        }
    }

    /// Amplitude, mean and covariance by a fine polar grid about the facet's axis.
    fn fine(lobe: &impl Spread) -> [f64; 4] {
        let facet = lobe.facet();
        let n = 400;
        let mut sums = [0.0; 4];
        for i in 0..n {
            let theta = (f64::from(i) + 0.5) / f64::from(n) * std::f64::consts::FRAC_PI_2;
            for k in 0..n {
                let phi = (f64::from(k) + 0.5) / f64::from(n) * std::f64::consts::TAU;
                let local = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
                let h = [0, 1, 2].map(|c| {
                    (local[0] * f64::from(facet.tangent[c])
                        + local[1] * f64::from(facet.bitangent[c])
                        + local[2] * f64::from(facet.axis[c])) as f32
                });
                let mass = f64::from(lobe.density(h)) * theta.sin() * theta.cos();
                let (x, y) = (local[0] / local[2], local[1] / local[2]);
                for (sum, part) in sums.iter_mut().zip([1.0, x * x, x * y, y * y]) {
                    *sum += mass * part;
                }
            }
        }
        let cell = std::f64::consts::FRAC_PI_2 * std::f64::consts::TAU / f64::from(n * n);
        [sums[0] * cell, sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]]
    }

    #[test]
    fn printed_lobes_are_integrated() {
        let fall = Fall::Power { exponent: 60.0 };
        let covariance = [0.02, 0.01, 0.03];
        let pedal = PedalLobe::new([0.2, 0.0, 1.0], covariance, 3.0, Contour::Pedal, fall);
        let cut = Cut {
            axis: [0.0, 0.0, 1.0],
            length: 0.97,
            radial: 0.02,
            lean: [0.0; 2],
            across: [0.02, 0.0, 0.0125],
        };
        let restricted = RestrictedLobe::new(cut, 2.0, Generator::Pearson { m: 8 });
        let check = |slopes: Slopes, want: [f64; 4]| {
            let [xx, xy, yy] = slopes.spread.map(f64::from);
            assert!(
                (f64::from(slopes.amplitude) / want[0] - 1.0).abs() < 0.02,
                "{slopes:?} {want:?}"
            );
            for (got, want) in [(xx, want[1]), (xy, want[2]), (yy, want[3])] {
                assert!((got - want).abs() < 0.05 * xx.max(yy), "{slopes:?} {want}");
            }
        };
        check(pedal.slopes(), fine(&pedal));
        check(restricted.slopes(), fine(&restricted));
    }

    #[test]
    fn a_peak_is_its_base_lobe() {
        let s = 40.0_f32;
        let amplitude = (s + 2.0) / std::f32::consts::TAU;
        let peak = PhongPeak { amplitude, direction: [0.6, 0.0, 0.8], exponent: s };
        let moment = peak.slopes().moment();
        for (got, want) in moment.into_iter().zip(peak.direction) {
            assert!((got - want).abs() < 1e-6);
        }
        assert!((peak.slopes().spread[0] * s - 1.0).abs() < 1e-6);
    }
}
