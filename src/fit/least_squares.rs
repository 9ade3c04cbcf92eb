//! Nonlinear least-squares problems.

use argmin::core::{Error, Jacobian, Operator};
use nalgebra::{DMatrix, DVector};

/// The normal equations JᵀJ h = −Jᵀr of a step h, at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalEquations {
    /// ½ rᵀr.
    pub cost: f64,
    /// Jᵀr.
    pub gradient: DVector<f64>,
    /// JᵀJ.
    pub gram: DMatrix<f64>,
}

/// A least-squares problem: residuals r(p) and their derivatives J by a step from p.
pub trait LeastSquares<P>:
    Operator<Param = P, Output = DVector<f64>> + Jacobian<Param = P, Jacobian = DMatrix<f64>>
{
    /// The normal equations at `at`. A problem with a special form overrides this to spare the
    /// storage of J, and leaves out (as zeros) unknowns that stand at a bound and would leave it.
    ///
    /// # Errors
    /// Those of the residuals and the Jacobian.
    fn normal_equations(&self, at: &P) -> Result<NormalEquations, Error> {
        let (residuals, jacobian) = (self.apply(at)?, self.jacobian(at)?);
        let count = jacobian.ncols();
        let column = |i| jacobian.column(i);
        Ok(NormalEquations {
            cost: 0.5 * residuals.dot(&residuals),
            gradient: DVector::from_fn(count, |i, _| column(i).dot(&residuals)),
            gram: DMatrix::from_fn(count, count, |i, j| column(i).dot(&column(j))),
        })
    }

    /// The step, held within bounds.
    fn held(&self, at: &P, step: DVector<f64>) -> DVector<f64> {
        let _ = at;
        step
    }

    /// Where a step from `at` leads.
    fn moved(&self, at: &P, step: &DVector<f64>) -> P;

    /// How large a point is, in the units of a step: what a small step is small against.
    fn size(&self, at: &P) -> f64;
}
