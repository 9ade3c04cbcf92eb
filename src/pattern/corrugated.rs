//! Corrugated sheet (Schilling 1997: "corrugated sheet iron").

use std::f64::consts::{PI, TAU};

use super::spectrum::Field;
use super::view::place;
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};

/// Waves along one axis, straight along the other. The profile is a cosine, or arcs of circles that bend up and
/// down in turn and meet without a kink, as rolled sheet has them.
///
/// Slopes are the profile's own derivative. Arcs deeper than 0.45 of the pitch would stand upright where they
/// meet: they are held there, and a note says so.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "corrugated",
        source: "Schilling 1997, Antialiasing of Bump-Maps (corrugated sheet iron)",
        summary: "Corrugated sheet: smooth waves along one axis.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "waves in the tile, side by side",
            domain: Domain::Whole { default: 4, min: 1, max: 1024 },
        },
        Parameter {
            name: "axis",
            meaning: "the direction crests run in",
            domain: Domain::Choice { words: &["v", "u"] },
        },
        Parameter {
            name: "profile",
            meaning: "a cosine, or arcs of circles",
            domain: Domain::Choice { words: &["sine", "arcs"] },
        },
        Parameter {
            name: "depth",
            meaning: "height of crests above troughs, parts of the distance between crests",
            domain: Domain::Real { default: 0.2, min: 0.0, max: 1.0 },
        },
    ],
    build,
};

/// Deepest arcs, parts of the pitch: at 0.5 they are half circles.
const DEEPEST_ARCS: f64 = 0.45;

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let (count, along_v) = (values.whole("count"), values.word("axis") == "v");
    let (arcs, wanted) = (values.word("profile") == "arcs", values.number("depth"));
    let depth = if arcs { wanted.min(DEEPEST_ARCS) } else { wanted };
    let mut notes = vec![];
    if depth < wanted {
        notes.push(format!("arcs held to a depth of {DEEPEST_ARCS} of their pitch"));
    }
    let size = if along_v { width } else { height };
    let pitch = size as f64 / count as f64;
    let profile = if arcs { arc } else { sine };
    let line: Vec<[f64; 2]> = (0..size)
        .map(|i| profile(0.5 * place(i, size, count).1, depth))
        .map(|[h, slope]| [h * pitch, slope])
        .collect();
    let point = |at: usize| {
        let [h, slope] = line[if along_v { at % width } else { at / width }];
        if along_v { [h, slope, 0.0] } else { [h, 0.0, slope] }
    };
    let points = (0..width * height).map(point).collect();
    Field::from_points(width, points).bumps(1.0, notes)
}

/// [F, F′] of a cosine of unit pitch at x in [−½, ½] from its crest, `depth` from trough to crest.
fn sine(x: f64, depth: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(TAU * x);
    [0.5 * depth * cos, -PI * depth * sin]
}

/// The same of arcs: half a pitch, L = ½, bends down about the crest, the other half up. The arc's rise is
/// s = depth/2 over the chord L, so its radius is (L²/4 + s²)/2s.
fn arc(x: f64, depth: f64) -> [f64; 2] {
    let rise = 0.5 * depth;
    if rise < 1e-9 {
        return [0.0; 2];
    }
    let radius = (0.0625 + rise * rise) / (2.0 * rise);
    let crest = x.abs() <= 0.25;
    let across = if crest { x } else { x - 0.5_f64.copysign(x) };
    let below = (radius * radius - across * across).sqrt();
    // √(R² − x²) − (R − s), without the difference of two long radii.
    let height = rise - across * across / (radius + below);
    let slope = -across / below;
    if crest { [height, slope] } else { [-height, -slope] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_are_smooth_and_as_deep_as_asked() {
        for (profile, deepest) in [(sine as fn(f64, f64) -> [f64; 2], 1.0), (arc, DEEPEST_ARCS)] {
            for depth in [0.0, 1e-6, 0.1, 0.3, deepest] {
                let d = 1e-8;
                assert!((profile(0.0, depth)[0] - 0.5 * depth).abs() < 1e-9);
                assert!((profile(0.5, depth)[0] + 0.5 * depth).abs() < 1e-9);
                for i in -499..500 {
                    let x = f64::from(i) / 1000.0;
                    let slope = (profile(x + d, depth)[0] - profile(x - d, depth)[0]) / (2.0 * d);
                    assert!((slope - profile(x, depth)[1]).abs() < 1e-4, "{depth} at {x}");
                }
            }
        }
    }
}
