//! The solver against certified answers: nonlinear regression problems of the Statistical Reference
//! Datasets (NIST StRD), each from both published starts.

use argmin::core::{Error, Jacobian, Operator};
use nalgebra::{DMatrix, DVector};

use super::*;

/// y = f(b, x): the value and its derivatives by b.
type Model = fn(&DVector<f64>, f64) -> (f64, Vec<f64>);

#[derive(Clone, Copy)]
struct Regression {
    model: Model,
    x: &'static [f64],
    y: &'static [f64],
}

impl Operator for Regression {
    type Param = DVector<f64>;
    type Output = DVector<f64>;
    fn apply(&self, b: &DVector<f64>) -> Result<DVector<f64>, Error> {
        Ok(DVector::from_fn(self.x.len(), |i, _| (self.model)(b, self.x[i]).0 - self.y[i]))
    }
}

impl Jacobian for Regression {
    type Param = DVector<f64>;
    type Jacobian = DMatrix<f64>;
    fn jacobian(&self, b: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        Ok(DMatrix::from_fn(self.x.len(), b.len(), |i, j| (self.model)(b, self.x[i]).1[j]))
    }
}

impl LeastSquares<DVector<f64>> for Regression {
    fn moved(&self, at: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        at + step
    }
    fn size(&self, at: &DVector<f64>) -> f64 {
        at.norm()
    }
}

/// Solves from each start and holds every parameter to seven certified digits.
fn check(name: &str, problem: Regression, starts: &[&[f64]], certified: &[f64], squares: f64) {
    let settings = Settings {
        small_gradient: 1e-13,
        small_step: 1e-15,
        stall: 1e-15,
        iterations: 5000,
        ..Settings::default()
    };
    for start in starts {
        let solver = LevenbergMarquardt::new(settings, &|| false);
        let found = solve(problem, solver, DVector::from_column_slice(start)).unwrap();
        for (got, want) in found.point.iter().zip(certified) {
            assert!((got / want - 1.0).abs() < 1e-7, "{name} from {start:?}: {found:?}");
        }
        assert!((2.0 * found.cost / squares - 1.0).abs() < 1e-8, "{name}: {found:?}");
    }
}

const PRESSURE: &[f64] = &[
    77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0,
];
const VOLUME: &[f64] = &[
    10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
    81.78,
];

fn misra(model: Model) -> Regression {
    Regression { model, x: PRESSURE, y: VOLUME }
}

#[test]
fn misra1a() {
    let problem = misra(|b, x| {
        let e = (-b[1] * x).exp();
        (b[0] * (1.0 - e), vec![1.0 - e, b[0] * x * e])
    });
    let starts: [&[f64]; 2] = [&[500.0, 1e-4], &[250.0, 5e-4]];
    check("Misra1a", problem, &starts, &[2.3894212918e2, 5.5015643181e-4], 1.2455138894e-1);
}

#[test]
fn misra1b() {
    let problem = misra(|b, x| {
        let base = 1.0 + 0.5 * b[1] * x;
        (b[0] * (1.0 - base.powi(-2)), vec![1.0 - base.powi(-2), b[0] * x * base.powi(-3)])
    });
    let starts: [&[f64]; 2] = [&[500.0, 1e-4], &[300.0, 2e-4]];
    check("Misra1b", problem, &starts, &[3.3799746163e2, 3.9039091287e-4], 7.5464681533e-2);
}

#[test]
fn misra1c() {
    let problem = misra(|b, x| {
        let base = 1.0 + 2.0 * b[1] * x;
        (b[0] * (1.0 - base.powf(-0.5)), vec![1.0 - base.powf(-0.5), b[0] * x * base.powf(-1.5)])
    });
    let starts: [&[f64]; 2] = [&[500.0, 1e-4], &[600.0, 2e-4]];
    check("Misra1c", problem, &starts, &[6.3642725809e2, 2.0813627256e-4], 4.0966836971e-2);
}

#[test]
fn misra1d() {
    let problem = misra(|b, x| {
        let base = 1.0 + b[1] * x;
        (b[0] * b[1] * x / base, vec![b[1] * x / base, b[0] * x / (base * base)])
    });
    let starts: [&[f64]; 2] = [&[500.0, 1e-4], &[450.0, 3e-4]];
    check("Misra1d", problem, &starts, &[4.3736970754e2, 3.0227324449e-4], 5.6419295283e-2);
}

#[test]
fn danwood() {
    let problem = Regression {
        model: |b, x| (b[0] * x.powf(b[1]), vec![x.powf(b[1]), b[0] * x.powf(b[1]) * x.ln()]),
        x: &[1.309, 1.471, 1.490, 1.565, 1.611, 1.680],
        y: &[2.138, 3.421, 3.597, 4.340, 4.882, 5.660],
    };
    let starts: [&[f64]; 2] = [&[1.0, 5.0], &[0.7, 4.0]];
    check("DanWood", problem, &starts, &[7.6886226176e-1, 3.8604055871], 4.3173084083e-3);
}
