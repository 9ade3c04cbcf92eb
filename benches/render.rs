//! Samples and pixels a second, on one thread: `cargo bench --bench render`.
//!
//! The plane carries a 1024² normal map seen so that neighbouring samples read neighbouring texels
//! (coherent access), lit by one directional light.

use std::sync::Arc;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use wrinkle::light::Light;
use wrinkle::lobe::{BaseLobe, Shading};
use wrinkle::method::{self, Silent};
use wrinkle::render::{Camera, PixelSampler, View, direction, render};
use wrinkle::surface::{Plane, Shape};
use wrinkle::texture::{Lookup, NormalMap, Wrap};

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one pool");
    divan::main();
}

/// A smooth 1024² map of bumps.
fn map(size: usize) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(size, size, Wrap::Repeat, |u, v| {
        let (x, y) = (u * 200.0, v * 200.0);
        [0.4 * libm::sin(x + 0.3 * y), 0.4 * libm::cos(y), 1.0, 1.0]
    }))
}

fn view(size: usize, shading: Shading, texels_per_pixel: f64) -> View {
    let camera = Camera::orbiting(4.0, 40.0, -90.0, 25.0, 256, 256);
    let plane = Shape::Plane(Plane::new());
    let untiled = View {
        camera,
        surface: plane.clone(),
        light: Light::Directional { direction: direction(40.0, 90.0), irradiance: 1.0 },
        shading,
        wrap: Wrap::Repeat,
        lookup: Lookup::default(),
    };
    let across = untiled.footprint(128.0, 128.0).expect("in sight").texels_across(size, size);
    View { surface: plane.tiled(texels_per_pixel / across, 1.0), ..untiled }
}

/// (lobe, shading) of the reference rows.
const BASES: [(&str, BaseLobe); 3] = [
    ("blinn-phong", BaseLobe::BlinnPhong { exponent: 60.0 }),
    ("beckmann", BaseLobe::Beckmann { alpha: 0.2 }),
    ("ggx", BaseLobe::Ggx { alpha: 0.2 }),
];

/// Reference samples a second: 16 samples in each of 256² pixels.
#[divan::bench(args = BASES.map(|(name, _)| name), sample_count = 12)]
fn reference(bencher: Bencher, name: &str) {
    run(bencher, name, Shading::Ndf);
}

/// The same, as a microfacet BRDF.
#[divan::bench(args = BASES.map(|(name, _)| name), sample_count = 12)]
fn reference_microfacet(bencher: Bencher, name: &str) {
    run(bencher, name, Shading::Microfacet);
}

fn run(bencher: Bencher, name: &str, shading: Shading) {
    let (_, base) = BASES.iter().find(|(known, _)| *known == name).expect("a listed lobe");
    let unfiltered = method::build("unfiltered")
        .expect("registered")
        .prefilter(&map(1024), base, &Silent)
        .expect("takes every lobe");
    let view = view(1024, shading, 4.0);
    let sampler = PixelSampler::new(16);
    bencher
        .counter(ItemsCount::new(256 * 256 * 16usize))
        .bench_local(|| render(black_box(&view), unfiltered.as_ref(), &sampler, 1, 0, &|| false));
}

/// One sample a pixel of every method, at 8 texels a pixel.
#[divan::bench(args = method_names(), sample_count = 12)]
fn pixels(bencher: Bencher, name: &str) {
    let base = BaseLobe::BlinnPhong { exponent: 60.0 };
    let size = 128;
    let prefiltered = method::build(name)
        .expect("registered")
        .prefilter(&map(size), &base, &Silent)
        .expect("takes Blinn-Phong");
    let view = view(size, Shading::Ndf, 8.0);
    let sampler = PixelSampler::new(1);
    bencher
        .counter(ItemsCount::new(256 * 256usize))
        .bench_local(|| render(black_box(&view), prefiltered.as_ref(), &sampler, 1, 0, &|| false));
}

/// Prefilter texels a second of the one-lobe methods, a 1024² map.
#[divan::bench(args = method_names().into_iter().filter(|n| !n.starts_with("fournier")), sample_count = 5)]
fn prefilter(bencher: Bencher, name: &str) {
    let base = BaseLobe::BlinnPhong { exponent: 60.0 };
    let method = method::build(name).expect("registered");
    let map = map(1024);
    bencher
        .counter(ItemsCount::new(1024 * 1024usize))
        .bench_local(|| method.prefilter(&map, &base, &Silent).map(|p| p.bytes()));
}

fn method_names() -> Vec<&'static str> {
    method::entries().iter().map(|entry| entry.card.name).collect()
}
