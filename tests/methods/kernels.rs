//! Fast kernels compute what the lobes say.

use std::sync::Arc;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use wrinkle::lobe::vector;
use wrinkle::method::{BATCH, Batch, shade_by_lobes};
use wrinkle::texture::{Interpolation, Lookup, NormalMap, Wrap};

use super::fixture::{SHADINGS, bumps, cases};

fn uniform(random: &mut impl Rng) -> f32 {
    random.next_u32() as f32 / 4_294_967_296.0
}

/// A unit vector in the upper hemisphere, often near the horizon.
fn direction(random: &mut impl Rng) -> [f32; 3] {
    let phi = std::f32::consts::TAU * uniform(random);
    let z = uniform(random).powi(2) + 0.01;
    vector::unit([phi.cos(), phi.sin(), z])
}

/// A batch of `len` random points: footprints from 2⁻⁵ to 2¹⁰ texels with any shape, every seventh lane
/// dark.
fn batch(len: usize, map: &NormalMap, random: &mut impl Rng) -> Batch {
    let mut batch = Batch { len, ..Batch::default() };
    for i in 0..len {
        (batch.u[i], batch.v[i]) = (uniform(random), uniform(random));
        let size = (15.0 * uniform(random) - 5.0).exp2() / map.width() as f32;
        for axis in &mut batch.jacobian {
            axis[i] = size * (2.0 * uniform(random) - 1.0);
        }
        let (light, view) = (direction(random), direction(random));
        for c in 0..3 {
            (batch.light[c][i], batch.view[c][i]) = (light[c], view[c]);
            batch.half[c][i] = light[c] + view[c];
        }
        batch.irradiance[i] = if i % 7 == 6 { 0.0 } else { 3.0 * uniform(random) };
    }
    batch
}

fn maps() -> Vec<Arc<NormalMap>> {
    let mut all = vec![];
    for wrap in [Wrap::Repeat, Wrap::Clamp] {
        for interpolation in [Interpolation::Bilinear, Interpolation::Nearest] {
            let map = NormalMap::clone(&bumps(6, 5, wrap));
            all.push(Arc::new(map.with_interpolation(interpolation)));
        }
    }
    all
}

/// Lookups in turn; the exact one makes fits anew for each footprint, which costs Fournier's seconds a batch.
const LOOKUPS: [Lookup; 4] =
    [Lookup::Trilinear, Lookup::Anisotropic, Lookup::Trilinear, Lookup::Ewa];

#[test]
fn kernels_agree_with_the_lobes() {
    // Two kinds of rounding: a lobe of exponent s at tangent² t is exp(−s/2 · ln(1 + t)), so a last bit
    // of the logarithm costs s/2 · ln(1+t) bits (about 100 of 10⁻⁷ where D has fallen by 10⁻⁴³); and
    // interpolated channels may be summed in another order.
    const RELATIVE: f32 = 5e-5;
    const ABSOLUTE: f32 = 1e-6;
    for case in cases() {
        for map in maps() {
            let filtered = case.on(&map);
            let mut random = Pcg64Mcg::seed_from_u64(8);
            for len in (0..=BATCH).step_by(3).chain([1, 2, BATCH - 1, BATCH]) {
                let mut batch = batch(len, &map, &mut random);
                batch.lookup = LOOKUPS[len % LOOKUPS.len()];
                for shading in SHADINGS {
                    let (mut fast, mut slow) = ([f32::NAN; BATCH], [f32::NAN; BATCH]);
                    filtered.shade(&batch, shading, &mut fast);
                    shade_by_lobes(filtered.as_ref(), &batch, shading, &mut slow);
                    for (i, (a, b)) in fast.iter().zip(&slow).enumerate().take(len) {
                        let near = (a - b).abs() <= RELATIVE * b.abs() + ABSOLUTE;
                        assert!(near, "{} {shading:?} lane {i} of {len}: {a} {b}", case.name);
                    }
                }
            }
        }
    }
}
