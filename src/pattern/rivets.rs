//! Rivets: a ball in a depth buffer, many times (Blinn 1978 §3, figure 7).

use super::depth::{DepthBuffer, Rod};
use super::{Bumps, Card, Entry};
use crate::geometry::Vec3;
use crate::parameter::{Domain, Parameter, Values};

/// Balls that stand out of the ground in a square array, as a depth buffer sees them. Unlike `hemispheres`, whose
/// normals are the ball's own, normals come from differences of the buffer, as in the paper: they are off by a
/// texel at the rim.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "rivets",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3, figure 7",
        summary: "Balls half in the ground, from a depth buffer.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "rivets along each side of the tile",
            domain: Domain::Whole { default: 4, min: 1, max: 1024 },
        },
        Parameter {
            name: "radius",
            meaning: "radius of a ball, of half its cell",
            domain: Domain::Real { default: 0.7, min: 0.0, max: 2.0 },
        },
        Parameter {
            name: "sunk",
            meaning: "how deep its centre lies below the ground, of its radius",
            domain: Domain::Real { default: 0.3, min: -1.0, max: 1.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let count = values.whole("count");
    let cell = [width, height].map(|size| size as f64 / count as f64);
    let radius = 0.5 * cell[0].min(cell[1]) * values.number("radius");
    let mut buffer = DepthBuffer::new(width, height);
    for (i, j) in (0..count * count).map(|k| (k % count, k / count)) {
        let [x, y] = [i as f64 + 0.5, j as f64 + 0.5];
        let centre = Vec3::new(x * cell[0], y * cell[1], -radius * values.number("sunk"));
        buffer.render(&Rod::ball(centre, radius));
    }
    buffer.bumps()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rivet_is_a_cap_of_its_ball() {
        let bumps = build(64, 64, &Values::defaults(ENTRY.parameters), 0);
        let heights = bumps.heights.unwrap();
        let (radius, sunk) = (8.0 * 0.7, 8.0 * 0.7 * 0.3);
        for (k, &h) in heights.values().iter().enumerate() {
            let [x, y] = [k % 64, k / 64].map(|c| (c % 16) as f64 + 0.5 - 8.0);
            let square: f64 = radius * radius - x * x - y * y;
            let cap = square.max(0.0).sqrt() - sunk;
            assert!((h - cap.max(0.0)).abs() < 1e-9, "{k}: {h} {cap}");
        }
    }
}
