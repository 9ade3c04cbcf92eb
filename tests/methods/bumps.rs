//! Bumps become roughness, and roughness stays.

use std::sync::Arc;

use wrinkle::geometry::HemisphereGrid;
use wrinkle::method::Prefiltered;
use wrinkle::texture::{NormalMap, Wrap};

use super::fixture::{COARSE, COARSE_ERROR, bumps, cases, centres, footprint, top, width};

fn width_at_top(filtered: &dyn Prefiltered, map: &NormalMap) -> f64 {
    width(&COARSE, &filtered.lobes_at(&footprint(map, 0.5, 0.5, top(map) as f32)))
}

#[test]
fn doubled_bumps_widen_the_lobe_of_methods_that_keep_roughness() {
    let map = bumps(8, 8, Wrap::Repeat);
    let doubled = Arc::new(map.scaled(2.0));
    for case in cases() {
        let once = width_at_top(case.on(&map).as_ref(), &map);
        let twice = width_at_top(case.on(&doubled).as_ref(), &doubled);
        if case.card.keeps_roughness {
            assert!(twice > 1.5 * once, "{}: {once} {twice}", case.name);
        } else {
            assert!((twice / once - 1.0).abs() < 0.01, "{}: {once} {twice}", case.name);
        }
    }
}

/// The mean width of a level's cells.
fn mean_width(
    grid: &HemisphereGrid,
    filtered: &dyn Prefiltered,
    map: &NormalMap,
    level: usize,
) -> f64 {
    let cells = centres(map, level);
    let total: f64 = cells.iter().map(|at| width(grid, &filtered.lobes_at(at))).sum();
    total / cells.len() as f64
}

/// On maps whose cells are all rough along much the same directions; lobes that are wider than their
/// normals (round ones about directional bumps, pedal curves) do not pool else, as their cards say.
#[test]
fn roughness_never_falls_from_level_to_level() {
    let mut wrong = vec![];
    for (w, h) in [(8, 8), (5, 3), (9, 4)] {
        let map = bumps(w, h, Wrap::Repeat);
        for case in cases() {
            let filtered = case.on(&map);
            let widths: Vec<f64> =
                (0..=top(&map)).map(|l| mean_width(&COARSE, filtered.as_ref(), &map, l)).collect();
            for pair in widths.windows(2) {
                if pair[1] < pair[0] * (1.0 - case.card.precision - COARSE_ERROR) {
                    wrong.push(format!("{} on {w}×{h}: {widths:?}", case.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
