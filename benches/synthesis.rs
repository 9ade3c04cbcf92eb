//! Synthesis, and what bumps cost beside none: `cargo bench --bench synthesis`.
//!
//! Noise and indices are of one thread; a baked map is of all cores, and is to take under 2 s at 1024². Shading is of one
//! thread, batches of [`BATCH`] points: bumps, averaged bumps, and each form of Kautz et al. 2001. What bumps cost beside
//! Phong shading and a colour texture (Blinn 1978 §6) is told first.

use std::sync::Arc;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use wrinkle::evidence::{self, Task};
use wrinkle::geometry::noise::Turbulence;
use wrinkle::lobe::{BaseLobe, NdfImage, Shading};
use wrinkle::method::kautz::{SinglePass, Synthesised};
use wrinkle::method::{BATCH, Batch, Prefiltered, Silent, brute_force, build};
use wrinkle::parameter::Values;
use wrinkle::synthesis::{Bits, Noise, Synthesis, octaves_for};

fn main() {
    cost_ratios();
    divan::main();
}

/// Row `blinn-t` of Blinn 1978's evidence: what bumps cost beside Phong shading and a colour texture.
fn cost_ratios() {
    let paper = evidence::find("blinn-1978").expect("a paper");
    let row = paper.rows.iter().find(|row| row.name == "blinn-t").expect("a row of it");
    let values = Values::defaults(row.parameters);
    let task = Task { values: &values, seed: 1, parts: &[], progress: &Silent };
    let timed = (row.make)(&task).expect("nothing halts it").timed;
    for claim in &timed.claims {
        println!("{}: {:?} in 1978, {:?} here", claim.what, claim.paper, claim.here);
    }
}

const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 30.0 };
const CELLS: [u32; 2] = [16; 2];

fn synthesis() -> Arc<Synthesis> {
    let surface = [BASE.about([0.0, 0.0, 1.0], 1.0)].into_iter().collect();
    let ndf = NdfImage::of_surface(&surface, 256).expect("a lobe has density");
    Arc::new(Synthesis::new(ndf, Noise { cells: CELLS, ..Noise::default() }))
}

/// Places spread over the tile.
fn places() -> Vec<[f64; 2]> {
    (0..4096).map(|k| [f64::from(k) / 4096.0, (f64::from(k) * 0.618_033_988_75).fract()]).collect()
}

/// One octave at a place.
#[divan::bench]
fn noise(bencher: Bencher) {
    let noise = Turbulence { cells: CELLS, gain: 0.5, seed: 1, offset: 0.0 };
    let places = places();
    bencher.counter(ItemsCount::new(places.len())).bench(|| {
        let octave = |[u, v]: &[f64; 2]| noise.octave(*u, *v, 3);
        black_box(&places).iter().map(octave).sum::<f64>()
    });
}

/// Both turbulences of six octaves, and the normal of their indices.
#[divan::bench]
fn indices_and_normal(bencher: Bencher) {
    let (synthesis, places) = (synthesis(), places());
    bencher.counter(ItemsCount::new(places.len())).bench(|| {
        let normal = |[u, v]: &[f64; 2]| synthesis.normals.at(synthesis.indices(*u, *v, 6.0))[0];
        black_box(&places).iter().map(normal).sum::<f32>()
    });
}

/// The tables of an NDF of 256², G measured.
#[divan::bench(sample_count = 10)]
fn tables(bencher: Bencher) {
    bencher.bench(synthesis);
}

/// A whole map, all cores.
#[divan::bench(args = [256, 1024], sample_count = 5)]
fn baked(bencher: Bencher, side: usize) {
    let synthesis = synthesis();
    let octaves = octaves_for([side; 2], CELLS);
    bencher.counter(ItemsCount::new(side * side)).bench(|| synthesis.bake(side, side, octaves));
}

const WAYS: [&str; 5] =
    ["bumps", "averaged", "kautz, of a map", "kautz, single pass", "kautz, turbulence"];

fn way(name: &str) -> Box<dyn Prefiltered> {
    let synthesis = synthesis();
    let map = |side: usize| Arc::new(synthesis.bake(side, side, octaves_for([side; 2], CELLS)));
    let of = |method: Box<dyn wrinkle::method::Method>, side: usize| {
        method.prefilter(&map(side), &BASE, &Silent).expect("a base lobe it takes")
    };
    match name {
        "bumps" => of(brute_force(), 512),
        "averaged" => of(build("averaged").expect("a method"), 512),
        "kautz, of a map" => of(build("kautz").expect("a method"), 512),
        "kautz, single pass" => Box::new(SinglePass::new(synthesis, 512, 5.0, Bits::Sixteen, None)),
        _ => Box::new(Synthesised::new(synthesis, 20.0)),
    }
}

/// Batches whose footprints are two texels of a map of 512² wide.
#[divan::bench(args = WAYS)]
fn shading(bencher: Bencher, name: &str) {
    let prefiltered = way(name);
    let mut batch = Batch { len: BATCH, ..Batch::default() };
    for i in 0..BATCH {
        let t = i as f32 / BATCH as f32;
        (batch.u[i], batch.v[i], batch.irradiance[i]) = (t, (7.3 * t).fract(), 1.0);
        (batch.jacobian[0][i], batch.jacobian[3][i]) = (1.0 / 256.0, 1.0 / 256.0);
        (batch.half[0][i], batch.half[2][i]) = (0.2, 1.9);
    }
    let mut radiance = [0.0; BATCH];
    bencher.counter(ItemsCount::new(BATCH)).bench_local(|| {
        prefiltered.shade(black_box(&batch), Shading::Ndf, &mut radiance);
        radiance[0]
    });
}
