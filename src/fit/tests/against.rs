//! Another solver, written by others, does no better from the same starts.

use super::independent::Independent;
use super::random::Random;
use super::*;

/// Cost of the independent solver from a start, on the same samples in the same unit.
fn independent_cost(distribution: &Distribution, directions: &Directions, start: &[Peak]) -> f64 {
    let target = distribution.values().iter().map(|v| v / distribution.maximum()).collect();
    let problem = Independent::new(directions.iter().collect(), target, start);
    let (_, report) = levenberg_marquardt::LevenbergMarquardt::new().minimize(problem);
    report.objective_function
}

/// 210 problems, seeds 0 to 209: one to three peaks fitted to one more than that, a quarter as high, so that
/// the least cost is not 0, from starts turned by up to 12° with half to twice the exponents. From farther
/// ones, or where what is left out is wide, each of the two may end in a minimum of its own.
#[test]
fn no_worse_than_an_independent_solver_from_near() {
    let directions = grid();
    for seed in 0..210 {
        let mut random = Random::new(seed);
        let count = 1 + seed as usize % 3;
        let mut planted = random.separate(count + 1, 15.0, 80.0);
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
