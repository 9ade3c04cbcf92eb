//! Fournier's procedure: a peak more at a time (1992 §2.3).

use super::distribution::root_mean_square;
use super::problem::EXPONENTS;
use super::solver::{LevenbergMarquardt, Settings, Termination, solve};
use super::{Directions, Distribution, InputError, Peak, PeakProblem, merged};
use crate::geometry::elementary::ln64;
use argmin::core::Operator;

/// Settings of each fit: the next peak changes it anyway.
const SETTINGS: Settings = Settings {
    tau: 1.0,
    small_gradient: 1e-9,
    small_step: 1e-9,
    small_cost: 1e-20,
    stall: 1e-6,
    iterations: 100,
};

/// When to stop adding peaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GreedyOptions {
    /// The most peaks.
    pub max_peaks: usize,
    /// Enough if the residual's rms and maximum are both below this part of the distribution's.
    pub stop: f64,
}

impl Default for GreedyOptions {
    /// The paper's: 7 peaks, 5 %.
    fn default() -> Self {
        Self { max_peaks: 7, stop: 0.05 }
    }
}

/// What a region's normals became.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The peaks; those that a fit brought to amplitude 0 are left out.
    pub peaks: Vec<Peak>,
    /// Peaks fitted, those left out included; 0 if nothing had to be fitted.
    pub fitted: usize,
    /// Residual rms over the distribution's rms.
    pub rms: f64,
    /// Largest absolute residual over the distribution's maximum.
    pub maximum: f64,
    /// ½ Σ residual² in units of the distribution's maximum.
    pub cost: f64,
    /// Why the last fit ended; `None` if there was none.
    pub termination: Option<Termination>,
    /// Solver iterations over all fits.
    pub iterations: u64,
    /// Fits that gave nothing better than a peak less.
    pub failures: usize,
}

impl Fit {
    /// Peaks that are the distribution, not an approximation to it.
    fn exact(peaks: Vec<Peak>) -> Self {
        Self {
            peaks,
            fitted: 0,
            rms: 0.0,
            maximum: 0.0,
            cost: 0.0,
            termination: None,
            iterations: 0,
            failures: 0,
        }
    }

    /// Whether both the rms and the maximum of the residual are below `stop`.
    pub fn within(&self, stop: f64) -> bool {
        self.rms < stop && self.maximum < stop
    }
}

/// Represents normals, each with its amplitude and exponent, by few peaks: themselves if at most
/// `max_peaks` are distinct, else a [`fit`] to what they spread to. `Ok(None)` if `cancelled`.
///
/// # Errors
/// [`InputError::Normal`] if one is not usable.
pub fn reconstruct(
    normals: &[Peak],
    directions: &Directions,
    options: GreedyOptions,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Fit>, InputError> {
    let distinct = merged(normals)?;
    if distinct.len() <= options.max_peaks {
        return Ok(Some(Fit::exact(distinct)));
    }
    Ok(Distribution::spread(&distinct, directions, cancelled)
        .and_then(|distribution| fit(&distribution, directions, options, cancelled)))
}

/// Fits peaks to a distribution: the first guess of each is at the largest residual so far, and all
/// are refitted with it, until the residual is small or there are `max_peaks`. `None` if `cancelled`.
///
/// A distribution that is 0 everywhere needs no peaks. A fit that fails leaves the best one before it.
pub fn fit(
    distribution: &Distribution,
    directions: &Directions,
    options: GreedyOptions,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Fit> {
    let problem = PeakProblem::new(directions, distribution);
    let mut best = Fit { rms: 1.0, maximum: 1.0, ..Fit::exact(Vec::new()) };
    if distribution.maximum() <= 0.0 {
        return Some(Fit::exact(Vec::new()));
    }
    let mut residual: Vec<f64> =
        distribution.values().iter().map(|v| v / problem.scale()).collect();
    while best.fitted < options.max_peaks && !best.within(options.stop) {
        let mut start = best.peaks.clone();
        start.extend(first_guess(&residual, directions));
        if start.len() == best.peaks.len() {
            break; // nothing sticks out any more
        }
        let fitted = start.len();
        let solver = LevenbergMarquardt::new(SETTINGS, cancelled);
        let Ok(solution) = solve(problem, solver, start) else {
            best.failures += 1;
            break;
        };
        best.iterations += solution.iterations;
        best.termination = Some(solution.termination);
        if solution.termination == Termination::Cancelled {
            return None;
        }
        if fitted > 1 && !(solution.cost < best.cost) {
            best.failures += 1;
            break;
        }
        residual = residuals(&problem, &solution.point, directions.count())?;
        let norm = root_mean_square(&residual) * problem.scale();
        best.rms = norm / distribution.rms();
        best.maximum = residual.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
        (best.peaks, best.cost, best.fitted) = (solution.point, solution.cost, fitted);
    }
    best.peaks.retain(|peak| peak.amplitude > 0.0);
    best.peaks.iter_mut().for_each(|peak| peak.amplitude *= problem.scale());
    Some(best)
}

/// distribution − fit at every direction, in units of the distribution's maximum.
fn residuals(problem: &PeakProblem<'_>, peaks: &Vec<Peak>, count: usize) -> Option<Vec<f64>> {
    let negative = problem.apply(peaks).ok()?;
    Some(negative.iter().take(count).map(|r| -r).collect())
}

/// A peak at the largest residual, as high as it, with the exponent that its fall-off asks for; `None`
/// if no residual is positive.
///
/// Towards a neighbour at angle γ a peak of exponent n falls by cosⁿγ, so n = ln(N/N₀)/ln cos γ. The
/// mean over the neighbours weighs each by (1 − cos γ)², as the nearest say the least.
pub fn first_guess(residual: &[f64], directions: &Directions) -> Option<Peak> {
    let samples = directions.grid().samples();
    let highest = |best: usize, i: usize| if residual[i] > residual[best] { i } else { best };
    let at = (0..residual.len().min(samples.len())).reduce(highest)?;
    let amplitude = residual[at];
    if !(amplitude > 0.0) {
        return None;
    }
    let direction = samples[at].direction;
    let (mut sum, mut total) = (0.0, 0.0);
    for i in directions.grid().neighbours(at) {
        let cosine = direction.dot(&samples[i].direction);
        if cosine <= 0.0 || cosine >= 1.0 {
            continue;
        }
        // A neighbour at or below 0 fell as far as can be told.
        let fall = ln64((residual[i] / amplitude).clamp(1e-3, 1.0));
        let weight = (1.0 - cosine) * (1.0 - cosine);
        sum += weight * fall / ln64(cosine);
        total += weight;
    }
    let exponent = if total > 0.0 { sum / total } else { 1.0 };
    Some(Peak { amplitude, direction, exponent: exponent.clamp(0.1, EXPONENTS[1]) })
}
