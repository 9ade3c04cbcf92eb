//! A gridwork of high and low values (Blinn 1978 §3, figure 5).

use super::relief::{cell, rise};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{HeightMap, NormalMap, Wrap};

/// A table of heights: square plates with grooves between them, or the other way round with a negative
/// `depth`. Normals come from central differences over one texel either side, as in the paper; where a
/// bevel is shorter than that, no more of the slope than a difference can show remains.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "grid",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3, figure 5",
        summary: "A gridwork of high and low values: plates and grooves.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "plates along each side of the tile",
            domain: Domain::Whole { default: 4, min: 1, max: 1024 },
        },
        Parameter {
            name: "groove",
            meaning: "width of a groove's floor, texels",
            domain: Domain::Real { default: 3.0, min: 0.0, max: 65536.0 },
        },
        Parameter {
            name: "bevel",
            meaning: "width of the slope between floor and plate, texels (0: a cliff)",
            domain: Domain::Real { default: 3.0, min: 0.0, max: 65536.0 },
        },
        Parameter {
            name: "depth",
            meaning: "height of the plates above the grooves, texels",
            domain: Domain::Real { default: 2.0, min: -1000.0, max: 1000.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let count = values.whole("count");
    let [groove, bevel, depth] = ["groove", "bevel", "depth"].map(|name| values.number(name));
    let plate = |i, size| {
        let (_, [start, end]) = cell(i, size, count, 0.0);
        rise(start.min(end) - groove / 2.0, bevel)
    };
    let texels = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
    let heights = texels.map(|(i, j)| depth * plate(i, width).min(plate(j, height))).collect();
    let heights = HeightMap::new(width, height, Wrap::Repeat, heights);
    let normals = NormalMap::from_heights(&heights, 1.0);
    Bumps { normals, heights: Some(heights), notes: vec![] }
}
