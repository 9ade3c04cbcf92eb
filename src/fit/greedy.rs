//! Fournier's procedure: a peak more at a time (1992 §2.3).

use super::distribution::root_mean_square;
use super::guess::first_guess;
use super::solver::{LevenbergMarquardt, Settings, Solution, Termination, solve};
use super::{Directions, Distribution, InputError, Peak, PeakProblem, merged};
use argmin::core::Operator;

/// The solver's settings in the greedy procedure. Its starts are near, so little damping serves (a third
/// fewer iterations than τ = 1); and a fit that gains less than 10⁻⁴ of its cost a step is good
/// enough, as the next peak changes it anyway (half the iterations of 10⁻⁶, the same residuals to
/// three digits).
pub const GREEDY_SETTINGS: Settings = Settings {
    tau: 1e-3,
    small_gradient: 1e-9,
    small_step: 1e-9,
    small_cost: 1e-20,
    stall: 1e-4,
    iterations: 100,
};

/// When to stop adding peaks, and how hard to try for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GreedyOptions {
    /// The most peaks.
    pub max_peaks: usize,
    /// Enough if the residual's rms and maximum are both below this part of the distribution's.
    pub stop: f64,
    /// How often, at the end, a peak is taken away and set anew where most is left, first the first; kept
    /// if all then fit better. 0 is the paper's procedure.
    pub restarts: usize,
}

impl Default for GreedyOptions {
    /// The paper's: 7 peaks, 5 %, no restarts.
    fn default() -> Self {
        Self { max_peaks: 7, stop: 0.05, restarts: 0 }
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
    /// ½ Σ (residual / maximum)², with the distribution's maximum: values of 10³⁰⁰ have no squares.
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
/// are refitted with it, until the residual is small or there are `max_peaks`; then come the restarts.
/// `None` if `cancelled`.
///
/// A distribution that is 0 everywhere needs no peaks. A fit that fails leaves the best one before it.
pub fn fit(
    distribution: &Distribution,
    directions: &Directions,
    options: GreedyOptions,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Fit> {
    let mut search = Search::new(distribution, directions, cancelled);
    while search.best.fitted < options.max_peaks && !search.best.within(options.stop) {
        if !search.add_peak()? {
            break;
        }
    }
    for restart in 0..options.restarts {
        search.exchange(restart % search.best.fitted.max(1))?;
    }
    Some(search.found())
}

/// The fits with 1, 2, … `max_peaks` peaks of one run of the procedure without its stopping rule: error
/// and cost against the number of peaks. Each counts the iterations since the start. Shorter if a
/// peak more gave nothing better; empty for a distribution that is 0 everywhere. `None` if `cancelled`.
pub fn by_peaks(
    distribution: &Distribution,
    directions: &Directions,
    max_peaks: usize,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Fit>> {
    let mut search = Search::new(distribution, directions, cancelled);
    let mut fits = Vec::new();
    while fits.len() < max_peaks && search.add_peak()? {
        fits.push(search.found());
    }
    Some(fits)
}

/// The procedure under way.
struct Search<'a> {
    problem: PeakProblem<'a>,
    directions: &'a Directions,
    cancelled: &'a (dyn Fn() -> bool + Sync),
    /// The fit so far, its amplitudes in units of the distribution's maximum.
    best: Fit,
    /// distribution − fit at every direction, in the same units.
    residual: Vec<f64>,
    relative_rms: f64,
}

impl<'a> Search<'a> {
    fn new(
        distribution: &'a Distribution,
        directions: &'a Directions,
        cancelled: &'a (dyn Fn() -> bool + Sync),
    ) -> Self {
        let problem = PeakProblem::new(directions, distribution).unless(cancelled);
        // Nothing is left of nothing.
        let left = if distribution.maximum() > 0.0 { 1.0 } else { 0.0 };
        let best = Fit { rms: left, maximum: left, ..Fit::exact(Vec::new()) };
        let residual = distribution.values().iter().map(|v| v / problem.scale()).collect();
        let relative_rms = distribution.relative_rms();
        Self { problem, directions, cancelled, best, residual, relative_rms }
    }

    /// Fits with a peak more: whether that is better. `None` if cancelled.
    fn add_peak(&mut self) -> Option<bool> {
        let Some(guess) = first_guess(&self.residual, self.directions) else {
            return Some(false); // nothing sticks out any more
        };
        let mut start = self.best.peaks.clone();
        start.push(guess);
        let fitted = start.len();
        let found = self.solve(start)?;
        if let Some(solution) = &found {
            self.best.termination = Some(solution.termination);
        }
        let better = |solution: &Solution<_>| fitted == 1 || solution.cost < self.best.cost;
        let better = found.filter(|solution| usable(solution) && better(solution));
        let Some(solution) = better else {
            self.best.failures += 1;
            return Some(false);
        };
        self.best.fitted = fitted;
        self.keep(solution)?;
        Some(true)
    }

    /// Exchanges a peak: takes it away, fits the others, adds one where most is left, fits all, and
    /// keeps what is better. `None` if cancelled.
    fn exchange(&mut self, peak: usize) -> Option<()> {
        let mut others = self.best.peaks.clone();
        if peak >= others.len() {
            return Some(());
        }
        others.remove(peak);
        let Some(Solution { point: mut start, .. }) = self.solve(others)? else {
            return Some(());
        };
        start.extend(first_guess(&self.left(&start)?, self.directions));
        let found = self.solve(start)?;
        let better = found.filter(|found| usable(found) && found.cost < self.best.cost);
        better.map_or(Some(()), |solution| self.keep(solution))
    }

    /// Takes what a fit found for the best. `None` if cancelled.
    fn keep(&mut self, solution: Solution<Vec<Peak>>) -> Option<()> {
        self.residual = self.left(&solution.point)?;
        self.best.rms = root_mean_square(&self.residual) / self.relative_rms;
        self.best.maximum = self.residual.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
        self.best.termination = Some(solution.termination);
        (self.best.peaks, self.best.cost) = (solution.point, solution.cost);
        Some(())
    }

    /// The outer `None` if cancelled, the inner if the solver fails.
    fn solve(&mut self, start: Vec<Peak>) -> Option<Option<Solution<Vec<Peak>>>> {
        let solver = LevenbergMarquardt::new(GREEDY_SETTINGS, self.cancelled);
        let found = solve(self.problem, solver, start).ok();
        if let Some(solution) = &found {
            self.best.iterations += solution.iterations;
        }
        let ended = found.as_ref().map(|solution| solution.termination);
        (ended != Some(Termination::Cancelled)).then_some(found)
    }

    /// distribution − fit at every direction, in units of the distribution's maximum; `None` if
    /// cancelled.
    fn left(&self, peaks: &Vec<Peak>) -> Option<Vec<f64>> {
        let negative = self.problem.apply(peaks).ok()?;
        Some(negative.iter().take(self.directions.count()).map(|r| -r).collect())
    }

    /// The fit so far, in the distribution's own units.
    fn found(&self) -> Fit {
        let mut fit = self.best.clone();
        fit.peaks.retain(|peak| peak.amplitude > 0.0);
        let scale = self.problem.scale();
        fit.peaks
            .iter_mut()
            .for_each(|peak| peak.amplitude = (peak.amplitude * scale).min(f64::MAX));
        fit
    }
}

fn usable(solution: &Solution<Vec<Peak>>) -> bool {
    solution.termination != Termination::NotFinite
}
