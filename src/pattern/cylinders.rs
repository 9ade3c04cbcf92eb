//! Parallel half cylinders (Fournier 1992 §2.3 and §4).

use super::view::{Seen, WEIGHT, from_above, place};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};

/// Half cylinders side by side, seen from above; they leave no ground between them.
///
/// With `weight = "area"` the normals are equally distributed over the half circle across the axes, up
/// to the sampling by texels: for axes along v, E[n_x²] = E[n_z²] = 1/2 and n_y = 0. A texel whose centre
/// is right on the line where two cylinders touch (an odd number of texels under an even number of
/// cylinders) would weigh without bound: it counts as flat.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "cylinders",
        source: "Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces, §2.3 and §4",
        summary: "Parallel half cylinders: normals in a plane, equally distributed in it.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "cylinders in the tile, side by side",
            domain: Domain::Whole { default: 1, min: 1, max: 4096 },
        },
        Parameter {
            name: "axis",
            meaning: "the direction the cylinders run in",
            domain: Domain::Choice { words: &["v", "u"] },
        },
        WEIGHT,
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let (count, along_v) = (values.whole("count"), values.word("axis") == "v");
    let radius = if along_v { width } else { height } as f64 / (2 * count) as f64;
    let (normals, heights) = from_above(width, height, values, |i, j| {
        let across = if along_v { place(i, width, count).1 } else { place(j, height, count).1 };
        let z = (1.0 - across * across).sqrt();
        let normal = match (z > 0.0, along_v) {
            (false, _) => [0.0, 0.0, 1.0],
            (true, true) => [across, 0.0, z],
            (true, false) => [0.0, across, z],
        };
        Some(Seen { normal, height: radius * z })
    });
    Bumps { normals, heights: Some(heights), notes: vec![] }
}
