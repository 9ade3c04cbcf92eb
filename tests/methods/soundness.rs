//! Whatever the map and the footprint: light is finite and not negative.

use std::sync::Arc;

use proptest::prelude::*;
use wrinkle::lobe::vector;
use wrinkle::method::{BATCH, Batch};
use wrinkle::texture::{NormalMap, Texel, Wrap};

use super::fixture::{SHADINGS, cases};

/// Normals in any direction, also below the horizon, some of no length, some without weight.
fn texel() -> impl Strategy<Value = Texel> {
    let coordinate = || prop_oneof![8 => -1.0f32..1.0, 1 => Just(0.0)];
    (coordinate(), coordinate(), coordinate(), prop_oneof![4 => 0.0f32..3.0, 1 => Just(0.0)])
        .prop_map(|(x, y, z, w)| [x, y, z, w])
}

fn map() -> impl Strategy<Value = Arc<NormalMap>> {
    let wrap = prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp)];
    (1usize..=5, 1usize..=5, wrap).prop_flat_map(|(width, height, wrap)| {
        prop::collection::vec(texel(), width * height)
            .prop_map(move |texels| Arc::new(NormalMap::new(width, height, wrap, texels)))
    })
}

/// A side of a footprint: nothing, anything ordinary, more than numbers can hold, not a number.
fn side() -> impl Strategy<Value = f32> {
    let odd = [0.0, 1e-30, 1e30, f32::INFINITY, f32::NAN];
    prop_oneof![3 => -4.0f32..4.0, 1 => prop::sample::select(odd.to_vec())]
}

type Lane = (f32, f32, [f32; 4], [f32; 2], [f32; 2]);

fn lane() -> impl Strategy<Value = Lane> {
    let unit = || prop_oneof![6 => 0.0f32..1.0, 1 => Just(0.0), 1 => Just(1.0)];
    let tilt = || [-3.0f32..3.0, -3.0f32..3.0];
    (unit(), unit(), [side(), side(), side(), side()], tilt(), tilt())
}

fn batch(lanes: &[Lane]) -> Batch {
    let mut batch = Batch { len: lanes.len(), ..Batch::default() };
    for (i, (u, v, jacobian, light, view)) in lanes.iter().enumerate() {
        (batch.u[i], batch.v[i], batch.irradiance[i]) = (*u, *v, 1.0);
        let [light, view] = [light, view].map(|[x, y]| vector::unit([*x, *y, 1.0]));
        for (axis, value) in batch.jacobian.iter_mut().zip(jacobian) {
            axis[i] = *value;
        }
        for c in 0..3 {
            (batch.light[c][i], batch.view[c][i]) = (light[c], view[c]);
            batch.half[c][i] = light[c] + view[c];
        }
    }
    batch
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn light_is_finite_and_not_negative(
        map in map(), lanes in prop::collection::vec(lane(), 1..24)
    ) {
        let batch = batch(&lanes);
        for case in cases() {
            let filtered = case.on(&map);
            for shading in SHADINGS {
                let mut radiance = [f32::NAN; BATCH];
                filtered.shade(&batch, shading, &mut radiance);
                for (i, r) in radiance.iter().enumerate().take(lanes.len()) {
                    prop_assert!(
                        r.is_finite() && *r >= 0.0,
                        "{} {:?} lane {}: {}", case.name, shading, i, r
                    );
                }
            }
        }
    }
}
