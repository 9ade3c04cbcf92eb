//! Fits on the paper's grid; the other files hold them to more.

mod against;
mod certified;
mod independent;
mod random;
mod recovery;
mod sound;

use argmin::core::{Jacobian, Operator};
use nalgebra::DVector;

use super::*;
use crate::geometry::{HemisphereGrid, Vec3};

fn grid() -> Directions {
    Directions::new(HemisphereGrid::fournier())
}

/// A peak at (x, y, ·) on the upper hemisphere.
fn peak(amplitude: f64, x: f64, y: f64, exponent: f64) -> Peak {
    Peak { amplitude, direction: Vec3::new(x, y, (1.0 - x * x - y * y).sqrt()), exponent }
}

fn three() -> [Peak; 3] {
    [peak(1.0, 0.1, 0.2, 40.0), peak(0.7, -0.6, 0.1, 15.0), peak(0.4, 0.3, -0.7, 80.0)]
}

fn spread(peaks: &[Peak], directions: &Directions) -> Distribution {
    Distribution::spread(peaks, directions, &|| false).unwrap()
}

fn fitted(
    distribution: &Distribution,
    directions: &Directions,
    max_peaks: usize,
    restarts: usize,
) -> Fit {
    let options = GreedyOptions { max_peaks, stop: 0.0, restarts };
    fit(distribution, directions, options, &|| false).unwrap()
}

#[test]
fn planted_peaks_are_recovered() {
    let directions = grid();
    let fitted = fit(
        &spread(&three(), &directions),
        &directions,
        GreedyOptions { max_peaks: 3, stop: 0.0, restarts: 0 },
        &|| false,
    )
    .unwrap();
    for planted in three() {
        let nearest = fitted
            .peaks
            .iter()
            .max_by(|a, b| {
                let to = |p: &Peak| p.direction.dot(&planted.direction);
                to(a).total_cmp(&to(b))
            })
            .unwrap();
        assert!((nearest.direction - planted.direction).norm() < 1e-6, "{nearest:?}");
        assert!((nearest.amplitude / planted.amplitude - 1.0).abs() < 1e-6, "{nearest:?}");
        assert!((nearest.exponent / planted.exponent - 1.0).abs() < 1e-6, "{nearest:?}");
    }
    assert!(fitted.rms < 1e-6 && fitted.failures == 0, "{fitted:?}");
}

/// A least-squares problem without a form of its own for the normal equations.
struct Plain<'a>(PeakProblem<'a>);
impl Operator for Plain<'_> {
    type Param = Vec<Peak>;
    type Output = DVector<f64>;
    fn apply(&self, at: &Vec<Peak>) -> Result<DVector<f64>, argmin::core::Error> {
        self.0.apply(at)
    }
}
impl Jacobian for Plain<'_> {
    type Param = Vec<Peak>;
    type Jacobian = nalgebra::DMatrix<f64>;
    fn jacobian(&self, at: &Vec<Peak>) -> Result<Self::Jacobian, argmin::core::Error> {
        self.0.jacobian(at)
    }
}
impl LeastSquares<Vec<Peak>> for Plain<'_> {
    fn moved(&self, at: &Vec<Peak>, step: &DVector<f64>) -> Vec<Peak> {
        self.0.moved(at, step)
    }
    fn size(&self, at: &Vec<Peak>) -> f64 {
        self.0.size(at)
    }
}

#[test]
fn accumulated_normal_equations_are_those_of_the_jacobian() {
    let directions = grid();
    let distribution = spread(&three(), &directions);
    let problem = PeakProblem::new(&directions, &distribution);
    let at = vec![peak(0.8, 0.2, 0.1, 3.0), peak(0.3, -0.5, 0.3, 900.0), peak(0.1, 0.0, 0.9, 7.0)];
    let fast = problem.normal_equations(&at).unwrap();
    let slow = Plain(problem).normal_equations(&at).unwrap();
    assert!((fast.cost / slow.cost - 1.0).abs() < 1e-12);
    assert!((fast.gradient - &slow.gradient).amax() < 1e-12 * slow.gradient.amax());
    assert!((fast.gram - &slow.gram).amax() < 1e-12 * slow.gram.amax());
}

#[test]
fn what_cannot_be_fitted_is_said_or_answered_exactly() {
    let directions = grid();
    let options = GreedyOptions::default();
    let answer = |normals: &[Peak]| reconstruct(normals, &directions, options, &|| false);
    let nothing = answer(&[]).unwrap().unwrap();
    assert!(nothing.peaks.is_empty() && nothing.rms == 0.0);
    let bad = Peak { exponent: f64::NAN, ..three()[0] };
    assert!(matches!(answer(&[three()[0], bad]), Err(InputError::Normal { index: 1, .. })));
    // Nine normals that all point down spread nothing over the upper hemisphere.
    let down = |i: usize| Peak { direction: Vec3::new(1e-3 * i as f64, 0.0, -1.0), ..three()[0] };
    let below: Vec<Peak> = (0..9).map(|i| Peak { exponent: 1e4, ..down(i) }).collect();
    assert!(answer(&below).unwrap().unwrap().peaks.is_empty());
    // Exponents far out: answered, whatever the quality.
    for exponent in [0.0, 1e-9, 1e6] {
        let many: Vec<Peak> = (0..20)
            .map(|i| peak(1.0, 0.04 * f64::from(i), -0.02 * f64::from(i), exponent))
            .collect();
        let fit = answer(&many).unwrap().unwrap();
        assert!(fit.rms.is_finite() && fit.maximum.is_finite(), "{exponent}: {fit:?}");
        assert!(fit.peaks.iter().all(|p| p.amplitude.is_finite() && p.exponent.is_finite()));
    }
    let cancelled = reconstruct(&below, &directions, options, &|| true).unwrap();
    assert!(cancelled.is_none());
}

#[test]
fn few_normals_are_kept_as_they_are() {
    let mut normals = three().to_vec();
    normals.extend(three());
    let fit = reconstruct(
        &normals,
        &grid(),
        GreedyOptions { max_peaks: 3, ..GreedyOptions::default() },
        &|| false,
    )
    .unwrap()
    .unwrap();
    assert_eq!((fit.peaks.len(), fit.termination, fit.cost), (3, None, 0.0));
    let total: f64 = fit.peaks.iter().map(|p| p.amplitude).sum();
    assert!((total - 2.0 * 2.1).abs() < 1e-12);
}

#[test]
fn a_cancelled_or_bounded_solver_says_so() {
    let directions = grid();
    let distribution = spread(&three(), &directions);
    let problem = PeakProblem::new(&directions, &distribution);
    let start = vec![peak(1.0, 0.0, 0.0, 10.0)];
    let run = |iterations, cancelled: &(dyn Fn() -> bool + Sync)| {
        let settings = Settings { iterations, ..Settings::default() };
        solve(problem, LevenbergMarquardt::new(settings, cancelled), start.clone()).unwrap()
    };
    assert_eq!(run(3, &|| false).termination, Termination::IterationLimit);
    assert_eq!(run(3, &|| false).iterations, 3);
    assert_eq!(run(99, &|| true).termination, Termination::Cancelled);
    assert_eq!(run(99, &|| true).point, start);
}

#[test]
fn the_first_guess_of_a_single_peak_is_nearly_the_peak() {
    let directions = grid();
    let direction = directions.at(400);
    let planted = Peak { amplitude: 2.0, direction, exponent: 33.0 };
    let guess = first_guess(spread(&[planted], &directions).values(), &directions).unwrap();
    assert_eq!((guess.amplitude, guess.direction), (2.0, direction));
    assert!((guess.exponent - 33.0).abs() < 1e-9, "{}", guess.exponent);
}
