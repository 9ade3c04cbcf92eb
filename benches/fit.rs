//! Fits of 1, 3 and 7 Phong peaks from the starts of Fournier's procedure, against the crate
//! `levenberg-marquardt` on the same problem, and a whole map.
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

fn main() {
    divan::main();
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
fn ours(bencher: Bencher, peaks: usize) {
    let directions = Directions::new(HemisphereGrid::fournier());
    let distribution = distribution(&directions);
    let start = start(&distribution, &directions, peaks);
    let problem = PeakProblem::new(&directions, &distribution);
    let run = || {
        solve(problem, LevenbergMarquardt::new(GREEDY_SETTINGS, &|| false), start.clone()).unwrap()
    };
    let found = run();
    eprintln!(
        "ours, {peaks}: cost {:.6e}, {} iterations, {:?}",
        found.cost, found.iterations, found.termination
    );
    bencher.bench(run);
}

#[divan::bench(args = [1, 3, 7])]
fn levenberg_marquardt_crate(bencher: Bencher, peaks: usize) {
    let directions = Directions::new(HemisphereGrid::fournier());
    let distribution = distribution(&directions);
    let start = start(&distribution, &directions, peaks);
    let places: Vec<_> = directions.iter().collect();
    let maximum = distribution.maximum();
    let target: Vec<f64> = distribution.values().iter().map(|v| v / maximum).collect();
    let run = || {
        let problem = independent::Independent::new(places.clone(), target.clone(), &start);
        levenberg_marquardt::LevenbergMarquardt::new()
            .with_tol(GREEDY_SETTINGS.stall)
            .minimize(problem)
            .1
    };
    let found = run();
    eprintln!(
        "crate, {peaks}: cost {:.6e}, {} evaluations, {:?}",
        found.objective_function, found.number_of_evaluations, found.termination
    );
    bencher.bench(run);
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
