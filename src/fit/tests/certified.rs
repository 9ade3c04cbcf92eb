//! The solver against certified answers: every nonlinear regression problem of the Statistical Reference
//! Datasets (NIST StRD), from both published starts. The numbers are in `nist/`.

use argmin::core::{Error, Jacobian, Operator};
use nalgebra::{Complex, DMatrix, DVector};

use super::*;

type C = Complex<f64>;

/// y = f(b, x), written for complex numbers: its derivatives are imaginary parts.
type Model = fn(&[C], &[f64]) -> C;

/// A problem as its file tells it.
struct Regression {
    model: Model,
    /// Response, then predictors, by observation.
    data: Vec<Vec<f64>>,
    starts: [DVector<f64>; 2],
    certified: Vec<f64>,
    squares: f64,
}

impl Regression {
    fn parse(file: &str, model: Model) -> Self {
        let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect();
        let mut sections: Vec<Vec<Vec<f64>>> = Vec::new();
        let mut within = false;
        for line in file.lines() {
            if line.starts_with('#') {
                within = false;
            } else if within {
                sections.last_mut().unwrap().push(numbers(line));
            } else {
                within = true;
                sections.push(vec![numbers(line)]);
            }
        }
        let [unknowns, squares, data] = sections.try_into().unwrap();
        let start = |i| DVector::from_iterator(unknowns.len(), unknowns.iter().map(|row| row[i]));
        let starts = [start(0), start(1)];
        let certified = unknowns.iter().map(|row| row[2]).collect();
        Self { model, data, starts, certified, squares: squares[0][0] }
    }
}

impl Operator for &Regression {
    type Param = DVector<f64>;
    type Output = DVector<f64>;
    fn apply(&self, b: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let b: Vec<C> = b.iter().map(|&b| b.into()).collect();
        Ok(DVector::from_fn(self.data.len(), |i, _| {
            (self.model)(&b, &self.data[i][1..]).re - self.data[i][0]
        }))
    }
}

/// ∂f/∂b = Im f(b + ih) / h, exact to rounding as h² vanishes (Squire and Trapp 1998).
impl Jacobian for &Regression {
    type Param = DVector<f64>;
    type Jacobian = DMatrix<f64>;
    fn jacobian(&self, b: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        const H: f64 = 1e-200;
        let mut b: Vec<C> = b.iter().map(|&b| b.into()).collect();
        let mut jacobian = DMatrix::zeros(self.data.len(), b.len());
        for j in 0..b.len() {
            b[j].im = H;
            for (i, row) in self.data.iter().enumerate() {
                jacobian[(i, j)] = (self.model)(&b, &row[1..]).im / H;
            }
            b[j].im = 0.0;
        }
        Ok(jacobian)
    }
}

impl LeastSquares<DVector<f64>> for &Regression {
    fn moved(&self, at: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        at + step
    }
    fn size(&self, at: &DVector<f64>) -> f64 {
        at.norm()
    }
}

fn misra1a(b: &[C], x: &[f64]) -> C {
    b[0] * (C::from(1.0) - (-b[1] * x[0]).exp())
}

fn misra1b(b: &[C], x: &[f64]) -> C {
    b[0] * (C::from(1.0) - (b[1] * x[0] / 2.0 + 1.0).powi(-2))
}

fn misra1c(b: &[C], x: &[f64]) -> C {
    b[0] * (C::from(1.0) - power(b[1] * x[0] * 2.0 + 1.0, (-0.5).into()))
}

fn misra1d(b: &[C], x: &[f64]) -> C {
    b[0] * b[1] * x[0] / (b[1] * x[0] + 1.0)
}

fn chwirut(b: &[C], x: &[f64]) -> C {
    (-b[0] * x[0]).exp() / (b[1] + b[2] * x[0])
}

/// Lanczos1 to 3.
fn exponentials(b: &[C], x: &[f64]) -> C {
    b.chunks(2).map(|b| b[0] * (-b[1] * x[0]).exp()).sum()
}

fn mgh17(b: &[C], x: &[f64]) -> C {
    b[0] + b[1] * (-b[3] * x[0]).exp() + b[2] * (-b[4] * x[0]).exp()
}

/// Gauss1 to 3.
fn gaussians(b: &[C], x: &[f64]) -> C {
    let bell = |b: &[C]| b[0] * (-((-b[1] + x[0]) / b[2]).powi(2)).exp();
    b[0] * (-b[1] * x[0]).exp() + bell(&b[2..5]) + bell(&b[5..8])
}

fn danwood(b: &[C], x: &[f64]) -> C {
    b[0] * power(x[0].into(), b[1])
}

/// Rational functions of degree (b.len() − 1) / 2: Kirby2, Hahn1, Thurber.
fn rational(b: &[C], x: &[f64]) -> C {
    let (above, below) = b.split_at(b.len().div_ceil(2));
    let sum = |b: &[C]| b.iter().rev().fold(C::from(0.0), |sum, &b| sum * x[0] + b);
    sum(above) / (sum(below) * x[0] + 1.0)
}

fn nelson(b: &[C], x: &[f64]) -> C {
    b[0] - b[1] * x[0] * (-b[2] * x[1]).exp()
}

fn roszman1(b: &[C], x: &[f64]) -> C {
    b[0] - b[1] * x[0] - arctan(b[2] / (-b[3] + x[0])) / std::f64::consts::PI
}

fn enso(b: &[C], x: &[f64]) -> C {
    let wave = |period: C, c: C, s: C| {
        let angle = C::from(std::f64::consts::TAU * x[0]) / period;
        c * angle.cos() + s * angle.sin()
    };
    b[0] + wave(12.0.into(), b[1], b[2]) + wave(b[3], b[4], b[5]) + wave(b[6], b[7], b[8])
}

fn mgh09(b: &[C], x: &[f64]) -> C {
    b[0] * (b[1] * x[0] + x[0] * x[0]) / (b[2] * x[0] + b[3] + x[0] * x[0])
}

fn mgh10(b: &[C], x: &[f64]) -> C {
    b[0] * (b[1] / (b[2] + x[0])).exp()
}

/// Rat42 and Rat43.
fn growth(b: &[C], x: &[f64]) -> C {
    let below = (b[1] - b[2] * x[0]).exp() + 1.0;
    b[0] / b.get(3).map_or(below, |&b| power(below, b.inv()))
}

fn eckerle4(b: &[C], x: &[f64]) -> C {
    b[0] / b[1] * (((-b[2] + x[0]) / b[1]).powi(2) * -0.5).exp()
}

fn bennett5(b: &[C], x: &[f64]) -> C {
    b[0] * power(b[1] + x[0], -b[2].inv())
}

/// zᵖ of what is positive; not a number of what is not.
fn power(z: C, p: C) -> C {
    if z.re > 0.0 { (z.ln() * p).exp() } else { C::from(f64::NAN) }
}

/// arctan to first order in the imaginary part, which the complex function loses.
fn arctan(z: C) -> C {
    C::new(z.re.atan(), z.im / (1.0 + z.re * z.re))
}

/// The problem of this name.
macro_rules! problem {
    ($name:literal, $model:expr) => {
        ($name, Regression::parse(include_str!(concat!("nist/", $name, ".dat")), $model))
    };
}

/// Solves from both starts, with one setting for all: every unknown to `digits` (where it hardly matters to
/// the sum of squares, rounding of that decides the seventh), and the residual sum of
/// squares to eight (or to the rounding of the residuals, where the data are exact but for it).
fn check((name, problem): (&str, Regression), digits: i32) {
    let settings = Settings {
        small_gradient: 1e-13,
        small_step: 1e-15,
        stall: 0.0,
        iterations: 10_000,
        ..Settings::default()
    };
    for start in &problem.starts {
        let solver = LevenbergMarquardt::new(settings, &|| false);
        let found = solve(&problem, solver, start.clone()).unwrap();
        for (got, want) in found.point.iter().zip(&problem.certified) {
            assert!((got / want - 1.0).abs() < 0.1f64.powi(digits), "{name} {start}: {found:?}");
        }
        let gap = (2.0 * found.cost - problem.squares).abs();
        assert!(gap < 1e-8 * problem.squares + 1e-27, "{name} {start}: {found:?}");
        let limit = found.termination == Termination::IterationLimit;
        assert!(!limit, "{name} {start}: {found:?}");
    }
}

#[test]
fn lower_difficulty() {
    check(problem!("Misra1a", misra1a), 7);
    check(problem!("Misra1b", misra1b), 7);
    check(problem!("Chwirut1", chwirut), 6);
    check(problem!("Chwirut2", chwirut), 6);
    check(problem!("Lanczos3", exponentials), 6);
    check(problem!("Gauss1", gaussians), 6);
    check(problem!("Gauss2", gaussians), 6);
    check(problem!("DanWood", danwood), 7);
}

#[test]
fn average_difficulty() {
    check(problem!("Misra1c", misra1c), 7);
    check(problem!("Misra1d", misra1d), 7);
    check(problem!("Kirby2", rational), 6);
    check(problem!("Hahn1", rational), 6);
    check(problem!("MGH17", mgh17), 6);
    check(problem!("Lanczos1", exponentials), 6);
    check(problem!("Lanczos2", exponentials), 6);
    check(problem!("Gauss3", gaussians), 6);
    check(problem!("Roszman1", roszman1), 6);
    check(problem!("ENSO", enso), 6);
    // The response is the logarithm of what is listed.
    let (name, mut nelson) = problem!("Nelson", nelson);
    nelson.data.iter_mut().for_each(|row| row[0] = row[0].ln());
    check((name, nelson), 6);
}

/// MGH10 takes five thousand steps from its first start; no other more than six hundred.
#[test]
fn higher_difficulty() {
    check(problem!("MGH09", mgh09), 6);
    check(problem!("MGH10", mgh10), 6);
    check(problem!("Thurber", rational), 6);
    check(problem!("BoxBOD", misra1a), 6);
    check(problem!("Rat42", growth), 6);
    check(problem!("Rat43", growth), 6);
    check(problem!("Eckerle4", eckerle4), 6);
    check(problem!("Bennett5", bennett5), 6);
}
