//! Nonlinear least squares by Levenberg and Marquardt's method, as a solver for argmin.

use argmin::core::{
    Error, Executor, IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus,
};
use nalgebra::{DMatrix, DVector};

use super::{LeastSquares, NormalEquations};

/// Why a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Termination {
    /// The gradient is 0 for practical purposes: a minimum.
    SmallGradient,
    /// The next step would not change the point.
    SmallStep,
    /// The residuals are 0 for practical purposes.
    SmallCost,
    /// The cost hardly falls any more.
    Stalled,
    /// The most iterations allowed were made.
    IterationLimit,
    /// It was told to stop.
    Cancelled,
    /// The residuals are not finite where it started.
    NotFinite,
}

impl Termination {
    /// The reason in a few words.
    pub fn text(self) -> &'static str {
        match self {
            Self::SmallGradient => "small gradient",
            Self::SmallStep => "small step",
            Self::SmallCost => "small cost",
            Self::Stalled => "stalled",
            Self::IterationLimit => "iteration limit",
            Self::Cancelled => "cancelled",
            Self::NotFinite => "not finite",
        }
    }
}

/// When Levenberg-Marquardt ends, and how it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// First damping, relative to the largest diagonal entry of JᵀJ: Nielsen's τ.
    pub tau: f64,
    /// Ends where the cosine between the residuals and every column of J is at most this.
    pub small_gradient: f64,
    /// Ends where a step is at most this times the point's size.
    pub small_step: f64,
    /// Ends at a cost of at most this.
    pub small_cost: f64,
    /// Ends where a step lowers the cost, and promised to, by at most this part of it.
    pub stall: f64,
    /// Ends after this many iterations.
    pub iterations: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tau: 1.0,
            small_gradient: 1e-12,
            small_step: 1e-12,
            small_cost: 0.0,
            stall: 1e-12,
            iterations: 200,
        }
    }
}

/// Levenberg-Marquardt with Nielsen's damping (H. B. Nielsen, *Damping parameter in Marquardt's
/// method*, 1999; Madsen, Nielsen and Tingleff, *Methods for non-linear least squares problems*, 2004,
/// algorithm 3.16).
pub struct LevenbergMarquardt<'a> {
    settings: Settings,
    /// Asked before each iteration.
    cancelled: &'a (dyn Fn() -> bool + Sync),
    progress: Option<Progress>,
    ended: Option<Termination>,
}

/// Where the iteration stands.
struct Progress {
    equations: NormalEquations,
    damping: f64,
    growth: f64,
}

impl<'a> LevenbergMarquardt<'a> {
    /// A solver that asks before each iteration whether it was `cancelled`.
    pub fn new(settings: Settings, cancelled: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { settings, cancelled, progress: None, ended: None }
    }
}

/// What [`solve`] found.
#[derive(Clone, Debug)]
pub struct Solution<P> {
    /// The best point.
    pub point: P,
    /// ½ rᵀr there.
    pub cost: f64,
    /// Why it ended.
    pub termination: Termination,
    /// Iterations made: evaluations of the normal equations after the first.
    pub iterations: u64,
}

/// Runs the solver on a problem from `start`.
///
/// # Errors
/// Those of the problem's own functions, unless it is cancelled: then the best point so far is the answer.
pub fn solve<P, O>(
    problem: O,
    solver: LevenbergMarquardt<'_>,
    start: P,
) -> Result<Solution<P>, Error>
where
    P: Clone,
    O: LeastSquares<P>,
{
    let limit = solver.settings.iterations;
    let result = Executor::new(problem, solver)
        .configure(|state: Current<P>| state.param(start.clone()).max_iters(limit))
        .ctrlc(false)
        .run()?;
    let mut state = result.state;
    Ok(Solution {
        point: state.take_best_param().unwrap_or(start),
        cost: state.get_best_cost(),
        termination: result.solver.ended.unwrap_or(Termination::IterationLimit),
        iterations: state.get_iter(),
    })
}

type Current<P> = IterState<P, (), (), (), (), f64>;

impl<O, P> Solver<O, Current<P>> for LevenbergMarquardt<'_>
where
    P: Clone,
    O: LeastSquares<P>,
{
    fn name(&self) -> &str {
        "Levenberg-Marquardt"
    }

    fn init(
        &mut self,
        problem: &mut Problem<O>,
        mut state: Current<P>,
    ) -> Result<(Current<P>, Option<KV>), Error> {
        let at = state.take_param().ok_or_else(|| Error::msg("no starting point"))?;
        let equations = match evaluate(problem, &at) {
            Err(_) if (self.cancelled)() => {
                self.ended = Some(Termination::Cancelled);
                return Ok((state.param(at).cost(f64::INFINITY), None));
            }
            equations => equations?,
        };
        let cost = equations.cost;
        self.ended = if cost.is_finite() {
            self.converged(&equations)
        } else {
            Some(Termination::NotFinite)
        };
        let damping =
            self.settings.tau * equations.gram.diagonal().iter().fold(0.0, |m: f64, &d| m.max(d));
        self.progress = Some(Progress { equations, damping, growth: 2.0 });
        Ok((state.param(at).cost(cost), None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        mut state: Current<P>,
    ) -> Result<(Current<P>, Option<KV>), Error> {
        let at = state.take_param().ok_or_else(|| Error::msg("no point to step from"))?;
        let mut progress = self.progress.take().ok_or_else(|| Error::msg("not initialised"))?;
        let next = match self.step(problem, &at, &mut progress) {
            Err(_) if (self.cancelled)() => {
                self.ended = Some(Termination::Cancelled);
                None
            }
            next => next?,
        };
        let cost = progress.equations.cost;
        self.progress = Some(progress);
        Ok((state.param(next.unwrap_or(at)).cost(cost), None))
    }

    fn terminate(&mut self, _state: &Current<P>) -> TerminationStatus {
        if (self.cancelled)() {
            self.ended = Some(Termination::Cancelled);
        }
        self.ended.map_or(TerminationStatus::NotTerminated, |reason| {
            TerminationStatus::Terminated(TerminationReason::SolverExit(reason.text().into()))
        })
    }
}

fn evaluate<P, O: LeastSquares<P>>(
    problem: &mut Problem<O>,
    at: &P,
) -> Result<NormalEquations, Error> {
    problem.problem("normal_equations_count", |p| p.normal_equations(at))
}

impl LevenbergMarquardt<'_> {
    /// One trial step: where it leads if it lowers the cost, and the damping for the next.
    fn step<P, O: LeastSquares<P>>(
        &mut self,
        problem: &mut Problem<O>,
        at: &P,
        progress: &mut Progress,
    ) -> Result<Option<P>, Error> {
        let Progress { equations, damping, growth } = progress;
        let NormalEquations { cost, gradient, gram } = &*equations;
        let mut damped = gram.clone();
        for i in 0..damped.nrows() {
            damped[(i, i)] += *damping;
        }
        let Some(factor) = damped.cholesky() else {
            self.reject(damping, growth);
            return Ok(None);
        };
        let full = -factor.solve(gradient);
        let (step, size, next) = problem.problem("step_count", |p| {
            let step = p.held(at, full);
            let next = p.moved(at, &step);
            Ok((step, p.size(at), next))
        })?;
        if step.norm() <= self.settings.small_step * size {
            self.ended = Some(Termination::SmallStep);
            return Ok(None);
        }
        let promised = -gradient.dot(&step) - 0.5 * quadratic(gram, &step);
        let trial = evaluate(problem, &next)?;
        let gained = cost - trial.cost;
        // Also false if the trial is not finite.
        let better = gained > 0.0 && trial.cost.is_finite();
        if !better {
            self.reject(damping, growth);
            return Ok(None);
        }
        let ratio = if promised > 0.0 { gained / promised } else { 0.0 };
        let bend = 2.0 * ratio - 1.0;
        *damping *= (1.0 - bend * bend * bend).clamp(1.0 / 3.0, 2.0);
        *growth = 2.0;
        let stalled =
            gained <= self.settings.stall * cost && promised <= self.settings.stall * cost;
        self.ended = self.converged(&trial).or(stalled.then_some(Termination::Stalled));
        *equations = trial;
        Ok(Some(next))
    }

    /// The step led up: damp more, and faster each time.
    fn reject(&mut self, damping: &mut f64, growth: &mut f64) {
        *damping *= *growth;
        *growth *= 2.0;
        if !damping.is_finite() || *damping == 0.0 {
            self.ended = Some(Termination::SmallStep);
        }
    }

    /// Whether a point is as good as it gets.
    fn converged(&self, at: &NormalEquations) -> Option<Termination> {
        let length = (2.0 * at.cost).sqrt();
        let flat = |(g, column): (&f64, f64)| {
            g.abs() <= self.settings.small_gradient * length * column.sqrt()
        };
        if at.cost <= self.settings.small_cost {
            Some(Termination::SmallCost)
        } else if at.gradient.iter().zip(at.gram.diagonal().iter().copied()).all(flat) {
            Some(Termination::SmallGradient)
        } else {
            None
        }
    }
}

/// hᵀ A h, summed in order.
fn quadratic(a: &DMatrix<f64>, h: &DVector<f64>) -> f64 {
    a.column_iter().zip(h.iter()).map(|(column, h_j)| h_j * column.dot(h)).sum()
}
