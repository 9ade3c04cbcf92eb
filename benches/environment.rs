//! Environments: building their blurred copies, and looking them up. `cargo bench --bench environment`

use wrinkle::geometry::{Frame, Vec3};
use wrinkle::light::environment::{Environment, maps};
use wrinkle::parameter::Values;

fn main() {
    divan::main();
}

fn studio(height: usize) -> Environment {
    let entry = maps::find("studio").expect("a registered map");
    let radiance = (entry.build)(&Values::defaults(entry.parameters));
    Environment::of(&*radiance, height, 0.0, 1.0)
}

/// Directions that go round the sphere.
fn directions() -> Vec<Vec3> {
    let direction = |k: u32| {
        let (z, turn) = (1.0 - (f64::from(k) + 0.5) / 128.0, 2.4 * f64::from(k));
        let (sin, cos) = libm::sincos(turn);
        Vec3::new(cos, sin, z / (1.0 - z * z).max(1e-3).sqrt()).normalize()
    };
    (0..256).map(direction).collect()
}

#[divan::bench(args = [128, 512], sample_count = 5)]
fn build(height: usize) -> f64 {
    studio(height).mean()
}

#[divan::bench(args = [0.02, 0.2, 1.0])]
fn cone(bencher: divan::Bencher, sigma: f64) {
    let (environment, directions) = (studio(256), directions());
    bencher
        .counter(directions.len())
        .bench_local(|| directions.iter().map(|d| environment.cone(d, sigma * sigma)).sum::<f64>());
}

#[divan::bench(args = [1.2, 2.0, 4.0])]
fn elliptic_cone(bencher: divan::Bencher, stretch: f64) {
    let (environment, directions) = (studio(256), directions());
    let short = 0.01;
    bencher.counter(directions.len()).bench_local(|| {
        let mut sum = 0.0;
        for d in &directions {
            let frame = Frame::about(*d);
            let across = [frame.tangent, frame.bitangent];
            sum += environment.elliptic_cone(d, &across, [short * stretch * stretch, 0.0, short]);
        }
        sum
    });
}

#[divan::bench]
fn sample(bencher: divan::Bencher) {
    let environment = studio(256);
    bencher.bench_local(|| environment.sample(0.37, 0.61));
}
