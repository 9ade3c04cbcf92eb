//! The same problem for argmin's stock solver `TrustRegion` with `Steihaug` (Nocedal and Wright 2006,
//! algorithms 4.1 and 7.2), with JᵀJ for the second derivatives. The stock solver has no stopping rule: it
//! is given the one of the procedure, a step that gains less than a part of the cost.

use std::cell::RefCell;

use argmin::core::{
    CostFunction, Error, Executor, Gradient, Hessian, IterState, KV, Problem, Solver, State,
    TerminationReason, TerminationStatus,
};
use argmin::solver::trustregion::{Steihaug, TrustRegion};
use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector};

use super::independent::Independent;

type Vector = DVector<f64>;
type Current = IterState<Vector, Vector, (), DMatrix<f64>, (), f64>;

/// Cost, Jᵀr and JᵀJ, made together once a point.
struct Stock(RefCell<(Independent, Made)>);

#[derive(Clone, Default)]
struct Made {
    cost: f64,
    gradient: Vector,
    hessian: DMatrix<f64>,
}

impl Stock {
    fn at<T>(&self, x: &Vector, part: impl FnOnce(&Made) -> T) -> T {
        let (problem, made) = &mut *self.0.borrow_mut();
        if made.gradient.is_empty() || problem.params() != *x {
            problem.set_params(x);
            let residuals = problem.residuals().expect("always there");
            let jacobian = problem.jacobian().expect("always there");
            made.cost = 0.5 * residuals.norm_squared();
            made.gradient = jacobian.tr_mul(&residuals);
            made.hessian = jacobian.tr_mul(&jacobian);
        }
        part(made)
    }
}

impl CostFunction for Stock {
    type Param = Vector;
    type Output = f64;
    fn cost(&self, x: &Vector) -> Result<f64, Error> {
        Ok(self.at(x, |made| made.cost))
    }
}

impl Gradient for Stock {
    type Param = Vector;
    type Gradient = Vector;
    fn gradient(&self, x: &Vector) -> Result<Vector, Error> {
        Ok(self.at(x, |made| made.gradient.clone()))
    }
}

impl Hessian for Stock {
    type Param = Vector;
    type Hessian = DMatrix<f64>;
    fn hessian(&self, x: &Vector) -> Result<DMatrix<f64>, Error> {
        Ok(self.at(x, |made| made.hessian.clone()))
    }
}

/// The stock solver, ended where a step gains less than `stall` of the cost.
struct Stopping {
    solver: TrustRegion<Steihaug<Vector, f64>, f64>,
    stall: f64,
    stalled: bool,
}

impl Solver<Stock, Current> for Stopping {
    fn name(&self) -> &str {
        "Trust region with a stopping rule"
    }

    fn init(
        &mut self,
        problem: &mut Problem<Stock>,
        state: Current,
    ) -> Result<(Current, Option<KV>), Error> {
        self.solver.init(problem, state)
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Stock>,
        state: Current,
    ) -> Result<(Current, Option<KV>), Error> {
        let before = state.get_cost();
        let (state, told) = self.solver.next_iter(problem, state)?;
        let gained = before - state.get_cost();
        self.stalled = gained > 0.0 && gained <= self.stall * before;
        Ok((state, told))
    }

    fn terminate(&mut self, _: &Current) -> TerminationStatus {
        if self.stalled {
            let reason = TerminationReason::SolverExit("stalled".into());
            return TerminationStatus::Terminated(reason);
        }
        TerminationStatus::NotTerminated
    }
}

/// Cost reached and iterations made.
pub fn solve(problem: Independent, stall: f64, iterations: u64) -> (f64, u64) {
    let start = problem.params();
    let stock = Stock(RefCell::new((problem, Made::default())));
    let solver = Stopping { solver: TrustRegion::new(Steihaug::new()), stall, stalled: false };
    let result = Executor::new(stock, solver)
        .configure(|state| state.param(start).max_iters(iterations))
        .ctrlc(false)
        .run()
        .expect("the problem has no errors");
    (result.state.get_best_cost(), result.state.get_iter())
}
