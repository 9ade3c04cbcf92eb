//! Least squared difference of density between a few lobes and many, in closed form.

use nalgebra::{DMatrix, DVector};

use super::bins::least_exponent;
use super::cloud::{Axis, Cloud, LANES};
use super::fisher::{Fisher, Integrals, kappa_of};
use crate::geometry::Vec3;
use crate::geometry::elementary::ln64;

/// Unknowns of a lobe: its factor's logarithm, and η.
const PER_LOBE: usize = 4;
/// Damping at the start, relative to the diagonal, and how it changes.
const DAMPING: f64 = 1e-3;
const MORE: f64 = 10.0;
const LESS: f64 = 0.2;
/// Damping beyond which there is no way down.
const HOPELESS: f64 = 1e5;
/// The largest factor of κ and of the peak's density in a step: what a linear model can be trusted for.
const LONGEST: f64 = 3.0;

/// How long to go on.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// Steps at most.
    pub steps: usize,
    /// A step that gains less than this part of the cost is the last.
    pub stall: f64,
}

/// The cloud to be represented, with what is known of it once and for all.
pub(super) struct Problem<'a> {
    cloud: &'a Cloud,
    /// For each lobe b of the cloud, ∫ cloud · lobe_b / e^λ_b dω.
    own: Axis,
    /// The same of the lobes that were looked at last.
    seen: Axis,
    /// ∫ cloud² dω.
    square: f64,
    /// The bounds of κ.
    kappas: [f64; 2],
}

/// What components lack.
pub(super) struct Missing {
    /// A base lobe where most is missing, seen through a base lobe, as high as would fill that; `None` if
    /// nothing is.
    pub seed: Option<Fisher>,
    /// The largest difference so seen, over the cloud's largest.
    pub largest: f64,
}

/// ½∫(Σ lobes − cloud)² dω − ½∫ cloud² dω, its slope, and the Gauss-Newton approximation to its curvature.
struct Equations {
    cost: f64,
    gradient: DVector<f64>,
    gram: DMatrix<f64>,
}

impl<'a> Problem<'a> {
    /// The problem of a cloud of lobes of base exponent `s`. `None` if `cancelled`.
    pub fn new(cloud: &'a Cloud, s: f64, cancelled: &(dyn Fn() -> bool + Sync)) -> Option<Self> {
        let mut own = vec![[0.0; LANES]; cloud.chunks()];
        let mut square = 0.0;
        for lobe in &cloud.lobes {
            if cancelled() {
                return None;
            }
            square += cloud.products(lobe, &mut own)[0];
        }
        let seen = vec![[0.0; LANES]; cloud.chunks()];
        Some(Self { cloud, own, seen, square, kappas: [least_exponent(s), s].map(kappa_of) })
    }

    /// What is missing of the cloud in `components`.
    pub fn missing(&mut self, components: &[Fisher]) -> Missing {
        self.seen.iter_mut().for_each(|chunk| *chunk = [0.0; LANES]);
        for component in components {
            self.cloud.products(component, &mut self.seen);
        }
        let count = self.cloud.lobes.len();
        let own = |b: usize| self.own[b / LANES][b % LANES];
        let left = |b: usize| own(b) - self.seen[b / LANES][b % LANES];
        let most = (0..count).fold(0.0, |most: f64, b| most.max(own(b)));
        let largest = (0..count).fold(0.0, |most: f64, b| most.max(left(b).abs()));
        let at = (0..count).reduce(|a, b| if left(b) > left(a) { b } else { a });
        let seed = at.and_then(|at| {
            let lobe = Fisher { log_peak: 0.0, ..self.cloud.lobes[at] };
            let (_, t, scale) = lobe.times(&lobe);
            let height = left(at) / (scale * Integrals::at(t).zeroth);
            let log_peak = ln64(height.max(f64::MIN_POSITIVE));
            (height > 0.0).then_some(Fisher { log_peak, ..lobe })
        });
        Missing { seed, largest: if most > 0.0 { largest / most } else { 0.0 } }
    }

    /// √∫(Σ lobes − cloud)² dω over √∫ cloud² dω, from the cost.
    fn error(&self, cost: f64) -> f64 {
        ((2.0 * cost + self.square) / self.square).max(0.0).sqrt()
    }

    fn equations(&mut self, lobes: &[Fisher]) -> Equations {
        let count = PER_LOBE * lobes.len();
        let (mut gradient, mut gram) = (DVector::zeros(count), DMatrix::zeros(count, count));
        let mut cost = 0.0;
        self.seen.iter_mut().for_each(|chunk| *chunk = [0.0; LANES]);
        for (p, lobe) in lobes.iter().enumerate() {
            let of_cloud = self.cloud.products(lobe, &mut self.seen);
            cost -= of_cloud[0];
            (0..PER_LOBE).for_each(|c| gradient[PER_LOBE * p + c] -= of_cloud[c]);
            for (q, other) in lobes[..=p].iter().enumerate() {
                let block = block(lobe, other);
                cost += if p == q { 0.5 * block[0][0] } else { block[0][0] };
                for a in 0..PER_LOBE {
                    gradient[PER_LOBE * p + a] += block[a][0];
                    for b in 0..PER_LOBE {
                        gram[(PER_LOBE * p + a, PER_LOBE * q + b)] = block[a][b];
                        gram[(PER_LOBE * q + b, PER_LOBE * p + a)] = block[a][b];
                    }
                    if p != q {
                        gradient[PER_LOBE * q + a] += block[a][0];
                    }
                }
            }
        }
        Equations { cost, gradient, gram }
    }

    /// Where a step leads, held within bounds.
    fn moved(&self, lobe: &Fisher, step: &[f64]) -> Fisher {
        let natural = lobe.natural + Vec3::new(step[1], step[2], step[3]);
        let length = natural.norm().max(f64::MIN_POSITIVE);
        let [least, most] = self.kappas;
        let kappa = length.clamp(least.max(lobe.kappa / LONGEST), most.min(lobe.kappa * LONGEST));
        let rise = step[0] + length - lobe.kappa;
        let longest = ln64(LONGEST);
        let log_peak = lobe.log_peak + rise.clamp(-longest, longest);
        Fisher { natural: natural * (kappa / length), kappa, log_peak }
    }
}

/// Integrals of the product of two lobes over 1, ω and ω ωᵀ, as the symmetric matrix of (1, ω)(1, ω)ᵀ.
fn block(a: &Fisher, b: &Fisher) -> [[f64; PER_LOBE]; PER_LOBE] {
    let (sum, t, scale) = a.times(b);
    let (axis, Integrals { zeroth, first, second }) = (sum / t, Integrals::at(t));
    let across = first / t;
    let mut block = [[0.0; PER_LOBE]; PER_LOBE];
    block[0][0] = scale * zeroth;
    for i in 0..3 {
        block[0][i + 1] = scale * first * axis[i];
        block[i + 1][0] = block[0][i + 1];
        for j in 0..3 {
            let along = (second - across) * axis[i] * axis[j];
            block[i + 1][j + 1] = scale * if i == j { along + across } else { along };
        }
    }
    block
}

/// Moves lobes to where the squared difference to the cloud is least, and tells its root relative to the
/// cloud's. `None` if `cancelled`.
pub(super) fn refine(
    lobes: &mut Vec<Fisher>,
    problem: &mut Problem,
    effort: Effort,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<f64> {
    let mut at = problem.equations(lobes);
    let mut damping = DAMPING;
    for _ in 0..effort.steps {
        if cancelled() {
            return None;
        }
        let Some(step) = at.step(damping) else {
            damping *= MORE;
            continue;
        };
        let one = |(p, lobe): (usize, &Fisher)| {
            problem.moved(lobe, &step.as_slice()[PER_LOBE * p..PER_LOBE * (p + 1)])
        };
        let trial: Vec<Fisher> = lobes.iter().enumerate().map(one).collect();
        let next = problem.equations(&trial);
        let gained = at.cost - next.cost;
        // Also false if it is not a number.
        if gained > 0.0 {
            let left = next.cost + 0.5 * problem.square;
            (*lobes, at) = (trial, next);
            damping *= LESS;
            if gained <= effort.stall * left {
                break;
            }
        } else {
            damping *= MORE;
            if damping > HOPELESS {
                break;
            }
        }
    }
    Some(problem.error(at.cost))
}

impl Equations {
    /// The damped Gauss-Newton step.
    fn step(&self, damping: f64) -> Option<DVector<f64>> {
        let mut damped = self.gram.clone();
        for i in 0..damped.nrows() {
            damped[(i, i)] *= 1.0 + damping;
        }
        let step = -damped.cholesky()?.solve(&self.gradient);
        step.iter().all(|s| s.is_finite()).then_some(step)
    }
}
