//! From a filtered map to a magnified one without a seam.

use wrinkle::lobe::MultipleSurface;
use wrinkle::texture::Wrap;

use super::fixture::{bumps, cases, footprint, half_vectors};

const AT: (f32, f32) = (0.37, 0.58);

/// The largest change of density between neighbours when the levels from 1 to −2 are cut in `steps`.
fn largest_change(surface: impl Fn(f32) -> MultipleSurface, steps: usize) -> f32 {
    let mut largest = 0f32;
    let mut before: Option<Vec<f32>> = None;
    for k in 0..=steps {
        let at = surface(1.0 - 3.0 * k as f32 / steps as f32);
        let now: Vec<f32> = half_vectors().iter().map(|&h| at.density(h)).collect();
        for (a, b) in before.iter().flatten().zip(&now) {
            largest = largest.max((a - b).abs());
        }
        before = Some(now);
    }
    largest
}

#[test]
fn the_change_from_filtered_to_magnified_has_no_jump() {
    let map = bumps(8, 8, Wrap::Repeat);
    for case in cases() {
        let filtered = case.on(&map);
        let surface = |level| filtered.lobes_at(&footprint(&map, AT.0, AT.1, level));
        // Steps four times as fine: four times smaller changes if continuous, the same ones at a jump.
        let (coarse, fine) = (largest_change(surface, 96), largest_change(surface, 384));
        assert!(fine <= 0.4 * coarse + 1e-5, "{}: {coarse} {fine}", case.name);
    }
}

#[test]
fn a_magnified_map_is_not_filtered() {
    let map = bumps(8, 8, Wrap::Repeat);
    let [x, y, z, weight] = map.sample(AT.0, AT.1);
    for case in cases().into_iter().filter(|case| !case.card.fractal) {
        let unfiltered = case.base.about([x, y, z], weight);
        for level in [-1.0, -1.5, -2.0, -30.0, f32::NEG_INFINITY] {
            let surface = case.on(&map).lobes_at(&footprint(&map, AT.0, AT.1, level));
            assert_eq!(surface.lobes(), [unfiltered.into()], "{} level {level}", case.name);
        }
    }
}
