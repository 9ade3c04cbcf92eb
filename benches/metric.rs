//! What a score costs: pictures of 512 × 384 pixels.

use divan::{Bencher, black_box};
use wrinkle::metric::find;
use wrinkle::render::Film;

fn main() {
    divan::main();
}

fn film(phase: usize) -> Film {
    let pixel = |i: usize| ((i % 512 * 7 + i / 512 * 3 + phase) % 61) as f32 / 60.0;
    Film::new(512, 384, (0..512 * 384).map(pixel).collect())
}

#[divan::bench(args = ["rmse", "smape", "ssim", "ms_ssim", "flip", "flip:hdr"])]
fn score(bencher: Bencher, name: &str) {
    let (test, reference) = ([film(0)], [film(5)]);
    let metric = find(name).expect("a metric");
    bencher.bench(|| metric.value(black_box(&test), black_box(&reference)));
}

#[divan::bench(args = ["rmse", "ssim", "flip"])]
fn score_with_error(bencher: Bencher, name: &str) {
    let (test, reference) = (film(0), film(5));
    let variance = vec![1e-4; test.pixels().len()];
    let metric = find(name).expect("a metric");
    bencher.bench(|| metric.uncertain(black_box(&test), black_box(&reference), &variance));
}
