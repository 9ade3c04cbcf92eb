//! No direction of the map is special.

use std::sync::Arc;

use wrinkle::lobe::MultipleSurface;
use wrinkle::texture::{Footprint, Wrap};

use super::fixture::{bumps, cases, footprint, half_vectors};

/// A footprint of the map, as the map turned by 90° counter-clockwise has it.
fn turned(at: Footprint) -> Footprint {
    let turn = |[u, v]: [f32; 2]| [-v, u];
    Footprint { u: 1.0 - at.v, v: at.u, along_x: turn(at.along_x), along_y: turn(at.along_y), ..at }
}

/// How far apart the two are: the root of Σ (D − D′)² over Σ D², D′ turned back.
fn apart(before: &MultipleSurface, after: &MultipleSurface) -> f64 {
    let (mut difference, mut total) = (0.0, 0.0);
    for [x, y, z] in half_vectors() {
        let (a, b) = (f64::from(before.density([x, y, z])), f64::from(after.density([-y, x, z])));
        difference += (a - b) * (a - b);
        total += a * a;
    }
    (difference / total).sqrt()
}

#[test]
fn turning_the_map_turns_the_result() {
    let mut wrong = vec![];
    for (w, h) in [(8, 8), (6, 5)] {
        let map = bumps(w, h, Wrap::Repeat);
        let round = Arc::new(map.rotated());
        for case in cases() {
            let (still, rotated) = (case.on(&map), case.on(&round));
            for (u, v, level) in
                [(0.3, 0.6, -3.0), (0.31, 0.62, 0.0), (0.9, 0.05, 1.4), (0.5, 0.5, 9.0)]
            {
                let at = footprint(&map, u, v, level);
                let off = apart(&still.lobes_at(&at), &rotated.lobes_at(&turned(at)));
                // Two results, each as far from what it should be as the method's precision allows.
                if off > 2.0 * case.card.precision {
                    wrong.push(format!("{} on {w}×{h} level {level}: {off}", case.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
