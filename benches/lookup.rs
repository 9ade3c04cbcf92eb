//! Nanoseconds a pixel of each method by each lookup, and texels a second of pyramids, on one thread:
//! `cargo bench --bench lookup`.
//!
//! The measure is `colour`: an unfiltered colour texture of four channels, looked up trilinearly by the same
//! kernel and shown as it is. All draw the same 256² pixels of a plane. One-lobe methods should stay within three
//! times of it, and pyramids be built at more than 100 million texels a second on two cores, 50 on one.

use std::sync::Arc;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use wrinkle::geometry::{Kernel, vectorised};
use wrinkle::light::Light;
use wrinkle::lobe::{BaseLobe, MultipleSurface, Shading};
use wrinkle::method::{self, BATCH, Batch, Lane, Prefiltered, Silent};
use wrinkle::render::{Camera, PixelSampler, View, direction, render};
use wrinkle::surface::{Plane, Shape};
use wrinkle::texture::{Footprint, Lookup, Moments, NormalMap, Pyramid, Texel, Wrap};

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one pool");
    divan::main();
}

const SIDE: usize = 256;
const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 60.0 };

/// A smooth map of bumps.
fn map(size: usize) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(size, size, Wrap::Repeat, |u, v| {
        let (x, y) = (u * 200.0, v * 200.0);
        [0.4 * libm::sin(x + 0.3 * y), 0.4 * libm::cos(y), 1.0, 1.0]
    }))
}

/// A plane seen `elevation` degrees above it, so many texels a pixel.
fn view(size: usize, elevation: f64, texels_per_pixel: f64, lookup: Lookup) -> View {
    let plane = Shape::Plane(Plane::new());
    let untiled = View {
        camera: Camera::orbiting(4.0, elevation, -90.0, 25.0, SIDE, SIDE),
        surface: plane.clone(),
        light: Light::Directional { direction: direction(40.0, 90.0), irradiance: 1.0 },
        shading: Shading::Ndf,
        wrap: Wrap::Repeat,
        lookup,
    };
    let middle = 0.5 * SIDE as f64;
    let across = untiled.footprint(middle, middle).expect("in sight").texels_across(size, size);
    View { surface: plane.tiled(texels_per_pixel / across, 1.0), ..untiled }
}

/// A texture of four channels.
struct Channels;
impl Moments<4> for Channels {
    #[inline(always)]
    fn encode(&self, texel: Texel) -> [f32; 4] {
        texel
    }
}

/// An unfiltered colour texture.
struct Colour {
    map: Arc<NormalMap>,
    pyramid: Pyramid<Channels, 4>,
}

/// Its kernel.
struct Show<'a>(&'a Colour, &'a Batch, &'a mut Lane);

impl Kernel for Show<'_> {
    #[inline(always)]
    fn run(self) {
        let Self(Colour { map, pyramid }, batch, radiance) = self;
        let (mut levels, mut found) = ([0.0; BATCH], [[0.0; BATCH]; 4]);
        for (i, level) in levels.iter_mut().enumerate() {
            *level = batch.footprint(i).level(map.width(), map.height());
        }
        pyramid.trilinear_lanes(map, (&batch.u, &batch.v, &levels), batch.len, &mut found);
        for i in 0..BATCH {
            let grey = 0.2126 * found[0][i] + 0.7152 * found[1][i] + 0.0722 * found[2][i];
            radiance[i] = batch.irradiance[i] * grey;
        }
    }
}

impl Prefiltered for Colour {
    fn bytes(&self) -> usize {
        self.pyramid.bytes()
    }

    fn lobes_at(&self, _: &Footprint) -> MultipleSurface {
        MultipleSurface::new()
    }

    fn shade(&self, batch: &Batch, _: Shading, radiance: &mut Lane) {
        vectorised(Show(self, batch, radiance));
    }
}

/// A method made ready; `colour` is none.
fn ready(name: &str, size: usize) -> Box<dyn Prefiltered> {
    let map = map(size);
    match method::build(name) {
        Some(method) => method.prefilter(&map, &BASE, &Silent).expect("takes Blinn-Phong"),
        None => Box::new(Colour { pyramid: Pyramid::build(&map, Channels), map }),
    }
}

fn names() -> Vec<&'static str> {
    let methods = method::entries().into_iter().map(|entry| entry.card.name);
    std::iter::once("colour").chain(methods).collect()
}

fn draw(bencher: Bencher, name: &str, elevation: f64, texels_per_pixel: f64, lookup: Lookup) {
    let size = 512;
    // Peaks are slow to fit, and a smaller map has as many under a pixel.
    let size = if name == "fournier" { 64 } else { size };
    let ready = ready(name, size);
    let view = view(size, elevation, texels_per_pixel, lookup);
    let sampler = PixelSampler::new(1);
    bencher
        .counter(ItemsCount::new(SIDE * SIDE))
        .bench_local(|| render(black_box(&view), ready.as_ref(), &sampler, 1, 0, &|| false));
}

/// Trilinear, 8 texels a pixel: levels above the map's own.
#[divan::bench(args = names(), sample_count = 12)]
fn trilinear(bencher: Bencher, name: &str) {
    draw(bencher, name, 40.0, 8.0, Lookup::Trilinear);
}

/// Trilinear, a texel a pixel: half of what is fetched is encoded as it is read.
#[divan::bench(args = names(), sample_count = 12)]
fn trilinear_fine(bencher: Bencher, name: &str) {
    draw(bencher, name, 40.0, 1.0, Lookup::Trilinear);
}

/// Anisotropic, seen from low: footprints about six times as long as wide.
#[divan::bench(args = names().into_iter().skip(1), sample_count = 6)]
fn anisotropic(bencher: Bencher, name: &str) {
    draw(bencher, name, 10.0, 8.0, Lookup::Anisotropic);
}

/// The same by the elliptical weighted average.
#[divan::bench(args = names().into_iter().skip(1), sample_count = 3)]
fn ewa(bencher: Bencher, name: &str) {
    draw(bencher, name, 10.0, 8.0, Lookup::Ewa);
}

/// Texels a second of the pyramids of one-lobe methods, on one core.
#[divan::bench(args = names().into_iter().skip(2).filter(|n| *n != "fournier"), sample_count = 7)]
fn pyramid(bencher: Bencher, name: &str) {
    let (size, method) = (1024, method::build(name).expect("registered"));
    let map = map(size);
    bencher
        .counter(ItemsCount::new(size * size))
        .bench_local(|| method.prefilter(&map, &BASE, &Silent).map(|p| p.bytes()));
}
