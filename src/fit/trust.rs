//! Why fits can be trusted: planted peaks come back, derivatives are derivatives, another solver does no
//! better, and nothing that can be put in makes them hang or give what is not a number.

use std::sync::atomic::{AtomicUsize, Ordering};

use argmin::core::{Jacobian, Operator};
use nalgebra::DVector;
use proptest::prelude::*;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::independent::Independent;
use super::*;
use crate::geometry::{HemisphereGrid, Vec3};

/// Numbers evenly spread over [0, 1).
struct Random(Pcg64Mcg);

impl Random {
    fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    fn next(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Even over the hemisphere above a height z.
    fn direction(&mut self, above: f64) -> Vec3 {
        let z = above + (1.0 - above) * self.next();
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * self.next());
        let across = (1.0 - z * z).sqrt();
        Vec3::new(across * cos, across * sin, z)
    }

    /// Amplitude 0.3 to 1, up to 78° from the normal, exponent `from` to `to`, even in its logarithm.
    fn peak(&mut self, from: f64, to: f64) -> Peak {
        let exponent = from * libm::exp(self.next() * libm::log(to / from));
        Peak { amplitude: 0.3 + 0.7 * self.next(), direction: self.direction(0.2), exponent }
    }

    /// Peaks that are 1½ times the sum of their widths 1/√n apart, a width being 18° at most.
    fn separate(&mut self, count: usize, from: f64, to: f64) -> Vec<Peak> {
        let width = |p: &Peak| 1.0 / p.exponent.max(10.0).sqrt();
        let mut peaks: Vec<Peak> = Vec::new();
        while peaks.len() < count {
            let one = self.peak(from, to);
            let apart = |p: &Peak| {
                let angle = libm::acos(p.direction.dot(&one.direction).min(1.0));
                angle > 1.5 * (width(p) + width(&one))
            };
            if peaks.iter().all(apart) {
                peaks.push(one);
            }
        }
        peaks
    }

    /// As likely to be above 0 as below, of variance 1.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.next())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.next())
    }
}

fn grid() -> Directions {
    Directions::new(HemisphereGrid::fournier())
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

/// Peaks brought to the minimum that they are near, where the greedy settings stop a little above.
fn polished(fit: &Fit, distribution: &Distribution, directions: &Directions) -> Vec<Peak> {
    let problem = PeakProblem::new(directions, distribution);
    let scaled = |factor: f64| move |p: &Peak| Peak { amplitude: p.amplitude * factor, ..*p };
    let start = fit.peaks.iter().map(scaled(1.0 / problem.scale())).collect();
    let settings = Settings { tau: 1e-3, stall: 0.0, iterations: 500, ..Settings::default() };
    let solver = LevenbergMarquardt::new(settings, &|| false);
    solve(problem, solver, start).unwrap().point.iter().map(scaled(problem.scale())).collect()
}

/// How far the planted peaks are from the nearest found: the largest relative error of amplitude and
/// exponent, and distance of directions.
fn worst_gap(planted: &[Peak], found: &[Peak]) -> f64 {
    let gap = |p: &Peak, q: &Peak| {
        let [a, n] = [q.amplitude / p.amplitude, q.exponent / p.exponent];
        (q.direction - p.direction).norm().max((a - 1.0).abs()).max((n - 1.0).abs())
    };
    let nearest = |p: &Peak| found.iter().map(|q| gap(p, q)).fold(f64::INFINITY, f64::min);
    planted.iter().map(nearest).fold(0.0, f64::max)
}

/// Seeds 0 to 9 a number of peaks, exponents 1 to 1000: with up to four peaks all come back to six digits;
/// with more, the procedure may end in another minimum, which restarts leave.
#[test]
fn one_to_seven_planted_peaks_are_recovered() {
    let directions = grid();
    for count in 1..=7 {
        let recovered = |seed: &u64| {
            let planted = Random::new(100 * count as u64 + seed).separate(count, 1.0, 1000.0);
            let distribution = spread(&planted, &directions);
            [0, 4 * count].iter().any(|&restarts| {
                let fit = fitted(&distribution, &directions, count, restarts);
                worst_gap(&planted, &polished(&fit, &distribution, &directions)) < 1e-6
            })
        };
        let found = (0..10).filter(recovered).count();
        assert!(found == 10 || (count > 4 && found == 9), "{count} peaks: {found} of 10");
    }
}

/// Seed 7; 3000 directions even over the hemisphere, noise of 2 % of the value and 0.5 % of the largest.
/// A peak of width 1/√n stands on some 3000/n samples, at least 30: its parts err by some
/// 2 %/√30 = 0.4 %, and all twelve by less than 5 times that with a probability above 0.999.
#[test]
fn planted_peaks_are_recovered_from_noisy_scattered_samples() {
    let mut random = Random::new(7);
    let planted = random.separate(3, 5.0, 100.0);
    let vectors: Vec<Vec3> = (0..3000).map(|_| random.direction(0.0)).collect();
    let directions = Directions::scattered(&vectors).unwrap();
    let exact = spread(&planted, &directions);
    let noisy: Vec<f64> = exact
        .values()
        .iter()
        .map(|v| (v * (1.0 + 0.02 * random.normal()) + 0.005 * random.normal()).max(0.0))
        .collect();
    let distribution = Distribution::from_samples(&noisy, &directions).unwrap();
    let fit = fitted(&distribution, &directions, 3, 0);
    let gap = worst_gap(&planted, &fit.peaks);
    assert!(gap < 0.02, "{gap}: {fit:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    /// Central differences with steps of 10⁻⁵ widths of the peak err by 10⁻¹⁰ of the derivative where it
    /// is smooth, and by rounding, 10⁻¹⁶/10⁻⁵. From exponent 4 on it is smooth at the horizon too.
    #[test]
    fn the_jacobian_is_the_slope_of_the_residuals(seed in any::<u64>(), count in 1usize..5) {
        let mut random = Random::new(seed);
        let directions = grid();
        let distribution = spread(&[random.peak(1.0, 1000.0)], &directions);
        let problem = PeakProblem::new(&directions, &distribution);
        let at: Vec<Peak> = (0..count).map(|_| random.peak(4.0, 1000.0)).collect();
        let jacobian = problem.jacobian(&at).unwrap();
        for unknown in 0..4 * count {
            let step = 1e-5 / at[unknown / 4].exponent.sqrt();
            let along = |h: f64| {
                let mut by = DVector::zeros(4 * count);
                by[unknown] = h;
                problem.apply(&problem.moved(&at, &by)).unwrap()
            };
            let slope = (along(step) - along(-step)) / (2.0 * step);
            let scale = jacobian.column(unknown).amax().max(1e-3);
            let gap = (slope - jacobian.column(unknown)).amax() / scale;
            prop_assert!(gap < 1e-7, "unknown {unknown} of {at:?}: {gap}");
        }
    }

    /// Whatever the numbers: an answer or a refusal, and no peak with a part that is not a number.
    #[test]
    fn no_normals_hang_it(
        parts in prop::collection::vec(prop::array::uniform5(prop::num::f64::ANY), 0..40),
        wild in any::<bool>(),
    ) {
        let directions = Directions::new(HemisphereGrid::new(5, 12));
        let tame = |x: f64, most: f64| if wild { x } else { x.abs().min(most).max(1e-3) };
        let normals: Vec<Peak> = parts
            .iter()
            .map(|&[a, x, y, z, n]| Peak {
                amplitude: tame(a, 1e300),
                direction: Vec3::new(tame(x, 9.0), tame(y, 9.0), tame(z, 9.0)),
                exponent: tame(n, 1e6),
            })
            .collect();
        if let Ok(found) = reconstruct(&normals, &directions, GreedyOptions::default(), &|| false) {
            for peak in found.unwrap().peaks {
                prop_assert!(peak.amplitude.is_finite() && peak.exponent.is_finite(), "{peak:?}");
                prop_assert!(peak.amplitude >= 0.0 && (peak.direction.norm() - 1.0).abs() < 1e-9);
            }
        }
    }

    /// The same of measured samples: any values, any number of directions, all alike or all apart.
    #[test]
    fn no_samples_hang_it(
        rows in prop::collection::vec(prop::array::uniform4(-2i8..3), 1..60),
        unit in -300i32..300,
        max_peaks in 1usize..9,
        restarts in 0usize..3,
    ) {
        let row = |r: &[i8; 4]| {
            let [x, y, z, v] = r.map(f64::from);
            format!("{x},{y},{z},{:e}\n", v.max(0.0) * libm::pow(10.0, f64::from(unit)))
        };
        let text: String = rows.iter().filter(|r| r[..3] != [0; 3]).map(row).collect();
        if let Ok(Samples { directions, distribution }) = Samples::parse(&text) {
            let options = GreedyOptions { max_peaks, stop: 0.01, restarts };
            let found = fit(&distribution, &directions, options, &|| false).unwrap();
            prop_assert!(found.rms.is_finite() && found.maximum.is_finite() && found.cost.is_finite());
            prop_assert!(found.termination.is_some() && found.fitted <= max_peaks);
            for peak in &found.peaks {
                prop_assert!(peak.amplitude >= 0.0 && peak.amplitude.is_finite(), "{peak:?}");
                prop_assert!((1e-3..=1e4).contains(&peak.exponent), "{peak:?}");
            }
        }
    }
}

/// Cost of the independent solver from a start, on the same samples in the same unit.
fn independent_cost(distribution: &Distribution, directions: &Directions, start: &[Peak]) -> f64 {
    let target = distribution.values().iter().map(|v| v / distribution.maximum()).collect();
    let problem = Independent::new(directions.iter().collect(), target, start);
    let (_, report) = levenberg_marquardt::LevenbergMarquardt::new().minimize(problem);
    report.objective_function
}

/// 210 problems, seeds 0 to 209: one to three peaks fitted to one more than that, so that the least cost is
/// not 0, from starts turned by up to 12° with half to twice the exponents. From farther ones each of the
/// two may end in a minimum of its own.
#[test]
fn no_worse_than_an_independent_solver_from_near() {
    let directions = grid();
    for seed in 0..210 {
        let mut random = Random::new(seed);
        let count = 1 + seed as usize % 3;
        let mut planted = random.separate(count + 1, 5.0, 100.0);
        planted[count].amplitude *= 0.25;
        let distribution = spread(&planted, &directions);
        let near = |p: &Peak| {
            let mut aside = || 0.12 * (2.0 * random.next() - 1.0);
            let direction = (p.direction + Vec3::new(aside(), aside(), aside())).normalize();
            let exponent = p.exponent * libm::exp(0.7 * (2.0 * random.next() - 1.0));
            Peak { amplitude: 0.5, direction, exponent }
        };
        let start: Vec<Peak> = planted[..count].iter().map(near).collect();
        let theirs = independent_cost(&distribution, &directions, &start);
        let ours = cost(Settings::default(), &distribution, &directions, start);
        assert!(ours <= 1.01 * theirs, "{seed}: {ours} against {theirs}");
    }
}

/// 210 problems, seeds 0 to 209: 3 to 12 peaks anywhere, fitted by 1 to 7 from where the procedure starts
/// with so many, by its own settings. Such costs have many minima: in 1 of the 210 the independent solver
/// ends in a lower one (seed 39), in 1 in a higher one (seed 65), and in all others in the same.
#[test]
fn as_good_as_an_independent_solver_in_the_procedure() {
    let directions = grid();
    let (mut better, mut worse) = (0, 0);
    for seed in 0..210 {
        let mut random = Random::new(seed);
        let planted: Vec<Peak> = (0..3 + seed % 10).map(|_| random.peak(5.0, 200.0)).collect();
        let distribution = spread(&planted, &directions);
        let start = procedures_start(&distribution, &directions, 1 + seed as usize % 7);
        let theirs = independent_cost(&distribution, &directions, &start);
        let ours = cost(GREEDY_SETTINGS, &distribution, &directions, start);
        // The rest is where both find an exact fit, at costs that are rounding or nearly.
        worse += usize::from(ours > 1.01 * theirs + 1e-6);
        better += usize::from(theirs > 1.01 * ours + 1e-6);
    }
    assert!(worse <= 1 && better >= 1, "worse {worse}, better {better}");
}

fn cost(
    settings: Settings,
    distribution: &Distribution,
    directions: &Directions,
    start: Vec<Peak>,
) -> f64 {
    let solver = LevenbergMarquardt::new(settings, &|| false);
    solve(PeakProblem::new(directions, distribution), solver, start).unwrap().cost
}

/// Where the procedure starts to fit `count` peaks, in units of the largest value.
fn procedures_start(
    distribution: &Distribution,
    directions: &Directions,
    count: usize,
) -> Vec<Peak> {
    let mut start = fitted(distribution, directions, count - 1, 0).peaks;
    let left =
        |(toward, value): (Vec3, &f64)| value - start.iter().map(|p| p.value(toward)).sum::<f64>();
    let residual: Vec<f64> = directions.iter().zip(distribution.values()).map(left).collect();
    start.extend(first_guess(&residual, directions));
    start.iter_mut().for_each(|p| p.amplitude /= distribution.maximum());
    start
}

#[test]
fn restarts_never_make_it_worse_and_by_peaks_is_the_procedure() {
    let directions = grid();
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let many: Vec<Peak> = (0..12).map(|_| random.peak(7.0, 150.0)).collect();
        let distribution = spread(&many, &directions);
        let fits = by_peaks(&distribution, &directions, 5, &|| false).unwrap();
        assert_eq!(fits.len(), 5);
        for (count, one) in (1..).zip(&fits) {
            assert_eq!(*one, fitted(&distribution, &directions, count, 0), "the same bits");
        }
        assert!(fits.windows(2).all(|pair| {
            pair[1].cost < pair[0].cost && pair[1].iterations > pair[0].iterations
        }));
        let restarted = fitted(&distribution, &directions, 5, 5);
        assert!(restarted.cost <= fits[4].cost && restarted.fitted == 5);
        // rms² Σ N² = 2 cost, in units of the maximum.
        let sum = distribution.relative_rms().powi(2) * 1297.0;
        assert!((fits[4].rms.powi(2) * sum / (2.0 * fits[4].cost) - 1.0).abs() < 1e-9);
    }
    let none = Distribution::from_samples(&[0.0; 1297], &directions).unwrap();
    assert_eq!(by_peaks(&none, &directions, 5, &|| false), Some(vec![]));
}

/// A hundred thousand samples are asked for in pieces: whoever cancels waits for one.
#[test]
fn a_long_fit_is_cancelled_within_a_pass() {
    let mut random = Random::new(1);
    let vectors: Vec<Vec3> = (0..100_000).map(|_| random.direction(-1.0)).collect();
    let directions = Directions::scattered(&vectors).unwrap();
    let distribution = spread(&random.separate(3, 5.0, 50.0), &directions);
    for patience in [0, 1, 10, 30, 100] {
        let asked = AtomicUsize::new(0);
        let cancelled = || asked.fetch_add(1, Ordering::Relaxed) >= patience;
        assert_eq!(fit(&distribution, &directions, GreedyOptions::default(), &cancelled), None);
        assert!(asked.into_inner() <= patience + 3, "goes on after it was cancelled");
    }
    let asked = AtomicUsize::new(0);
    let count = || asked.fetch_add(1, Ordering::Relaxed) == usize::MAX;
    let one = GreedyOptions { max_peaks: 1, ..GreedyOptions::default() };
    let fit = fit(&distribution, &directions, one, &count).unwrap();
    let passes = fit.iterations as usize + 1;
    assert!(asked.into_inner() >= 20 * passes, "25 times a pass of 100 000");
}

/// The cost is in units of the largest value: the same for values of any size.
#[test]
fn a_fit_scales_with_its_values() {
    let directions = grid();
    let plain = spread(&Random::new(3).separate(3, 5.0, 50.0), &directions);
    let of = |unit: f64| {
        let values: Vec<f64> = plain.values().iter().map(|v| v * unit).collect();
        fitted(&Distribution::from_samples(&values, &directions).unwrap(), &directions, 2, 0)
    };
    let one = of(1.0);
    for unit in [1e-300, 1e-20, 1e300] {
        let other = of(unit);
        assert!((other.cost / one.cost - 1.0).abs() < 1e-6);
        assert!((other.rms / one.rms - 1.0).abs() < 1e-6);
        for (p, q) in one.peaks.iter().zip(&other.peaks) {
            assert!((q.amplitude / unit / p.amplitude - 1.0).abs() < 1e-6);
            assert!((q.exponent / p.exponent - 1.0).abs() < 1e-6);
        }
    }
}
