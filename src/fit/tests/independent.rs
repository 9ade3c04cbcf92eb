//! The same problem written a second time, plainly, for the crate `levenberg-marquardt` (MINPACK's
//! algorithm, by QR): what tests and benchmarks hold the solver to.
//!
//! The unknowns of a peak are √a, (u, v) in a chart fixed at the start, and ln n; the arithmetic is the
//! standard library's.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::{DMatrix, DVector, Dyn, Owned, Vector3};

use super::Peak;

pub struct Independent {
    directions: Vec<Vector3<f64>>,
    target: Vec<f64>,
    frames: Vec<[Vector3<f64>; 3]>,
    unknowns: DVector<f64>,
}

impl Independent {
    /// The problem with directions and values (in units of their maximum), from these peaks.
    pub fn new(directions: Vec<Vector3<f64>>, target: Vec<f64>, start: &[Peak]) -> Self {
        let frame = |p: &Peak| {
            let d = p.direction;
            let aside = if d.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
            let e1 = d.cross(&aside).normalize();
            [d, e1, d.cross(&e1)]
        };
        let unknown = |p: &Peak| [p.amplitude.sqrt(), 0.0, 0.0, p.exponent.ln()];
        Self {
            directions,
            target,
            frames: start.iter().map(frame).collect(),
            unknowns: DVector::from_vec(start.iter().flat_map(unknown).collect()),
        }
    }

    /// Value and derivatives of peak p in direction w.
    fn peak(&self, p: usize, w: &Vector3<f64>) -> (f64, [f64; 4]) {
        let [d0, e1, e2] = &self.frames[p];
        let x = self.unknowns.rows(4 * p, 4);
        let (root, u, v, n) = (x[0], x[1], x[2], x[3].clamp(-6.9, 9.21).exp());
        let leaning = d0 + e1 * u + e2 * v;
        let length = leaning.norm();
        let d = leaning / length;
        let c = w.dot(&d);
        if c <= 0.0 {
            return (0.0, [0.0; 4]);
        }
        let power = c.powf(n);
        let value = root * root * power;
        let by = |e: &Vector3<f64>| n * value / c * (w.dot(e) - c * d.dot(e)) / length;
        (value, [2.0 * root * power, by(e1), by(e2), value * c.ln() * n])
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Independent {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.unknowns.copy_from(x);
    }

    fn params(&self) -> DVector<f64> {
        self.unknowns.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let at = |i: usize| {
            let sum: f64 =
                (0..self.frames.len()).map(|p| self.peak(p, &self.directions[i]).0).sum();
            sum - self.target[i]
        };
        Some(DVector::from_fn(self.directions.len(), |i, _| at(i)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut jacobian = DMatrix::zeros(self.directions.len(), self.unknowns.len());
        for p in 0..self.frames.len() {
            for (i, w) in self.directions.iter().enumerate() {
                let (_, derivatives) = self.peak(p, w);
                for (k, derivative) in derivatives.into_iter().enumerate() {
                    jacobian[(i, 4 * p + k)] = derivative;
                }
            }
        }
        Some(jacobian)
    }
}
