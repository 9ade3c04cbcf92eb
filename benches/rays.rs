//! Rays a second, on one thread: `cargo bench --bench rays`.
//!
//! *Coherent* rays are those of a camera's pixels, row by row; *random* ones start all around and aim anywhere in
//! the surface's box. Building the surfaces is timed apart.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use wrinkle::geometry::Vec3;
use wrinkle::render::Camera;
use wrinkle::surface::{Shape, Sphere, drapery, teapot, teapot_mesh};

fn main() {
    divan::main();
}

/// 2 · 40² triangles on each of 32 patches, less those at the poles.
const CELLS: usize = 40;
const SURFACES: [&str; 4] = ["sphere", "drapery", "teapot", "mesh of 100,000"];
const SIDE: usize = 256;

fn surface(name: &str) -> Shape {
    match name {
        "sphere" => Shape::Sphere(Sphere::new()),
        "drapery" => Shape::Mesh(drapery()),
        "teapot" => Shape::Patches(teapot()),
        _ => Shape::Mesh(teapot_mesh(CELLS)),
    }
}

fn coherent_rays() -> Vec<(Vec3, Vec3)> {
    let camera = Camera::orbiting(4.0, 25.0, -90.0, 25.0, SIDE, SIDE);
    let pixel = |k: usize| camera.ray((k % SIDE) as f64 + 0.5, (k / SIDE) as f64 + 0.5);
    (0..SIDE * SIDE).map(|k| (camera.origin(), pixel(k))).collect()
}

fn random_rays() -> Vec<(Vec3, Vec3)> {
    // An additive sequence of five irrationals.
    let at = |k: usize, step: f64| (k as f64 * step).fract();
    let ray = |k: usize| {
        let (turn, z) =
            (std::f64::consts::TAU * at(k, 0.618_033_988_75), 2.0 * at(k, 0.754_877_666_2) - 1.0);
        let ring = (1.0 - z * z).sqrt();
        let from = Vec3::new(ring * libm::cos(turn), ring * libm::sin(turn), z) * 4.0;
        let aim =
            [0.569_840_290_99, 0.819_172_513_4, 0.671_043_606_7].map(|step| at(k, step) - 0.5);
        (from, Vec3::new(2.0 * aim[0], 1.4 * aim[1], aim[2]) - from)
    };
    (0..SIDE * SIDE).map(ray).collect()
}

#[divan::bench(args = SURFACES, sample_count = 12)]
fn coherent(bencher: Bencher, name: &str) {
    run(bencher, name, &coherent_rays());
}

#[divan::bench(args = SURFACES, sample_count = 12)]
fn random(bencher: Bencher, name: &str) {
    run(bencher, name, &random_rays());
}

fn run(bencher: Bencher, name: &str, rays: &[(Vec3, Vec3)]) {
    let surface = surface(name);
    bencher.counter(ItemsCount::new(rays.len())).bench_local(|| {
        let trace = |&(origin, direction): &(Vec3, Vec3)| surface.trace(origin, direction).1;
        black_box(rays.iter().filter(|ray| trace(ray)).count())
    });
}

/// Building a surface, its hierarchy on all cores.
#[divan::bench(args = SURFACES, sample_count = 5)]
fn build(bencher: Bencher, name: &str) {
    bencher.bench_local(|| surface(black_box(name)));
}
