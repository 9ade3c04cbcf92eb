//! Fits of 1, 3 and 7 Phong peaks from the starts of Fournier's procedure, 1297 samples, one core: ours,
//! the crate `levenberg-marquardt` and argmin's `TrustRegion`. First a table of all three in turn, with the
//! costs they reach; the two others solve the same problem written plainly, with the derivatives
//! in a matrix. Then each for itself, and a whole map.
#![allow(clippy::disallowed_methods, missing_docs)]

use std::sync::Arc;

use divan::Bencher;
use nalgebra::Vector3;
use wrinkle::fit::{
    Directions, Distribution, GREEDY_SETTINGS, GreedyOptions, LevenbergMarquardt, Peak,
    PeakProblem, first_guess, fit, solve,
};
use wrinkle::geometry::HemisphereGrid;
use wrinkle::lobe::BaseLobe;
use wrinkle::method::{Method, Silent, fournier::Fournier};
use wrinkle::texture::{NormalMap, Wrap};

#[path = "../src/fit/tests/independent.rs"]
mod independent;

#[path = "fit/trust_region.rs"]
mod trust_region;

fn main() {
    compare();
    divan::main();
}

/// Times of the three solvers in one run, one after the other in turn, so that what else the machine does
/// meets all alike.
fn compare() {
    const TURNS: usize = 15;
    println!("| peaks | solver | fits a second | times slower | cost | iterations |");
    println!("|---|---|---|---|---|---|");
    for peaks in [1, 3, 7] {
        let case = Case::new(peaks);
        let mut times = [const { Vec::new() }; 3];
        let mut found = [(0.0, 0); 3];
        for _ in 0..TURNS {
            for ((times, found), solve) in times.iter_mut().zip(&mut found).zip(SOLVERS) {
                let before = std::time::Instant::now();
                *found = std::hint::black_box(solve(&case));
                times.push(before.elapsed().as_secs_f64());
            }
        }
        // The fastest: what else the machine does only adds.
        let fastest = times.map(|times| times.into_iter().fold(f64::INFINITY, f64::min));
        for ((name, time), (cost, iterations)) in NAMES.iter().zip(fastest).zip(found) {
            let slower = time / fastest[0];
            let speed = 1.0 / time;
            println!("| {peaks} | {name} | {speed:.0} | {slower:.2} | {cost:.6e} | {iterations} |");
        }
    }
}

/// Cost reached, and iterations or evaluations made.
type Solve = fn(&Case) -> (f64, u64);
const NAMES: [&str; 3] = ["ours", "levenberg-marquardt", "argmin TrustRegion"];
const SOLVERS: [Solve; 3] = [ours, levenberg_marquardt_crate, argmin_trust_region];

/// A fit to be made.
struct Case {
    directions: Directions,
    distribution: Distribution,
    start: Vec<Peak>,
}

impl Case {
    fn new(peaks: usize) -> Self {
        let directions = Directions::new(HemisphereGrid::fournier());
        let distribution = distribution(&directions);
        let start = start(&distribution, &directions, peaks);
        Self { directions, distribution, start }
    }

    /// The same problem, plainly.
    fn plain(&self) -> independent::Independent {
        let maximum = self.distribution.maximum();
        let target = self.distribution.values().iter().map(|v| v / maximum).collect();
        independent::Independent::new(self.directions.iter().collect(), target, &self.start)
    }
}

fn ours(case: &Case) -> (f64, u64) {
    let problem = PeakProblem::new(&case.directions, &case.distribution);
    let solver = LevenbergMarquardt::new(GREEDY_SETTINGS, &|| false);
    let found = solve(problem, solver, case.start.clone()).unwrap();
    (found.cost, found.iterations)
}

fn levenberg_marquardt_crate(case: &Case) -> (f64, u64) {
    let solver = levenberg_marquardt::LevenbergMarquardt::new().with_tol(GREEDY_SETTINGS.stall);
    let (_, found) = solver.minimize(case.plain());
    (found.objective_function, found.number_of_evaluations as u64)
}

fn argmin_trust_region(case: &Case) -> (f64, u64) {
    trust_region::solve(case.plain(), GREEDY_SETTINGS.stall, GREEDY_SETTINGS.iterations)
}

/// The normals of a sphere's quarter: a broad distribution, which takes all 7 peaks.
fn distribution(directions: &Directions) -> Distribution {
    let mut normals = Vec::new();
    for i in 0..16 {
        for j in 0..16 {
            let (x, y) = ((f64::from(i) + 0.5) / 16.0, (f64::from(j) + 0.5) / 16.0);
            let square = 1.0 - x * x - y * y;
            if square > 0.0 {
                let z = square.sqrt();
                let direction = Vector3::new(x, y, z);
                normals.push(Peak { amplitude: 1.0 / z, direction, exponent: 50.0 });
            }
        }
    }
    Distribution::spread(&normals, directions, &|| false).unwrap()
}

/// The start of the procedure's fit with this many peaks, in units of the maximum.
fn start(distribution: &Distribution, directions: &Directions, peaks: usize) -> Vec<Peak> {
    let options = GreedyOptions { max_peaks: peaks - 1, stop: 0.0, restarts: 0 };
    let mut start = fit(distribution, directions, options, &|| false).unwrap().peaks;
    let left = |(toward, value): (Vector3<f64>, &f64)| {
        value - start.iter().map(|p| p.value(toward)).sum::<f64>()
    };
    let residual: Vec<f64> = directions.iter().zip(distribution.values()).map(left).collect();
    start.extend(first_guess(&residual, directions));
    start.iter_mut().for_each(|p| p.amplitude /= distribution.maximum());
    start
}

#[divan::bench(args = [1, 3, 7])]
fn fit_by_ours(bencher: Bencher, peaks: usize) {
    let case = Case::new(peaks);
    bencher.bench_local(|| ours(&case));
}

#[divan::bench(args = [1, 3, 7])]
fn fit_by_the_crate(bencher: Bencher, peaks: usize) {
    let case = Case::new(peaks);
    bencher.bench_local(|| levenberg_marquardt_crate(&case));
}

#[divan::bench(args = [1, 3, 7])]
fn fit_by_trust_region(bencher: Bencher, peaks: usize) {
    let case = Case::new(peaks);
    bencher.bench_local(|| argmin_trust_region(&case));
}

/// A map of random waves: no two normals are equal, most cells take several peaks.
fn waves(side: usize) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(side, side, Wrap::Repeat, |u, v| {
        let mut slope = [0.0; 2];
        for k in 1..12 {
            let t = f64::from(k);
            let (a, b) = ((3.0 * t).sin() * 16.0, (5.0 * t).cos() * 16.0);
            let (a, b) = (a.round(), b.round());
            let phase = (std::f64::consts::TAU * (a * u + b * v) + t).cos();
            slope[0] += 0.012 * a * phase;
            slope[1] += 0.012 * b * phase;
        }
        [-slope[0], -slope[1], 1.0, 1.0]
    }))
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn map_of_128_by_128(bencher: Bencher) {
    let map = waves(128);
    let base = BaseLobe::BlinnPhong { exponent: 50.0 };
    bencher.bench(|| Fournier::default().prefilter(&map, &base, &Silent).unwrap().bytes());
}
