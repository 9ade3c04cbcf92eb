//! Hemispheres in a square array (Fournier 1992 §2.3 and §3, his "sphere").

use super::view::{BACKGROUND, Seen, WEIGHT, from_above, place};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};

/// Hemispheres seen from above, each inscribed in its cell of the tile.
///
/// With `weight = "area"` and `background = "none"` all directions of the hemisphere are equally
/// distributed, the NDF is constant, up to the sampling by texels: E[n_x²] = E[n_y²] = E[n_z²] = 1/3.
///
/// Where cells are not square the hemisphere stays round and touches the nearer two sides. A centre
/// within a billionth of the rim (in squared radius) counts as a miss, since its weight would mean
/// nothing.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "hemispheres",
        source: "Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces, §2.3 and §3",
        summary: "Hemispheres in a square array: all directions, equally distributed.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "hemispheres along each side of the tile",
            domain: Domain::Whole { default: 1, min: 1, max: 256 },
        },
        WEIGHT,
        BACKGROUND,
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let count = values.whole("count");
    // Radius 1 is half the shorter side of a cell.
    let shorter = width.min(height) as f64;
    let (wide, high) = (width as f64 / shorter, height as f64 / shorter);
    let radius = shorter / (2 * count) as f64;
    let (normals, heights) = from_above(width, height, values, |i, j| {
        let (x, y) = (place(i, width, count).1 * wide, place(j, height, count).1 * high);
        let square = 1.0 - x * x - y * y;
        let z = square.max(0.0).sqrt();
        (square > 1e-9).then_some(Seen { normal: [x, y, z], height: radius * z })
    });
    Bumps { normals, heights: Some(heights), notes: vec![] }
}
