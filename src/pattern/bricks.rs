//! A brick wall (Blinn 1978 §3, figure 8: "a hand drawn unit cell of bricks").

use super::relief::{cell, rise};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{HeightMap, NormalMap, Wrap};

/// A table of heights: courses of bricks, every other one shifted by half a brick, with rounded edges
/// and mortar between. Normals come from central differences over one texel either side, as in the
/// paper. With an odd number of courses the wall does not meet itself at the top; a note says so.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "bricks",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3, figure 8",
        summary: "A brick wall: flat faces, sloped edges, mortar.",
    },
    parameters: &[
        Parameter {
            name: "columns",
            meaning: "bricks along u",
            domain: Domain::Whole { default: 3, min: 1, max: 1024 },
        },
        Parameter {
            name: "courses",
            meaning: "rows of bricks along v",
            domain: Domain::Whole { default: 6, min: 1, max: 1024 },
        },
        Parameter {
            name: "mortar",
            meaning: "width of a joint's floor, texels",
            domain: Domain::Real { default: 2.0, min: 0.0, max: 65536.0 },
        },
        Parameter {
            name: "bevel",
            meaning: "width of a brick's rounded edge, texels (0: a cliff)",
            domain: Domain::Real { default: 3.0, min: 0.0, max: 65536.0 },
        },
        Parameter {
            name: "depth",
            meaning: "height of the bricks above the mortar, texels",
            domain: Domain::Real { default: 2.0, min: -1000.0, max: 1000.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let (columns, courses) = (values.whole("columns"), values.whole("courses"));
    let [mortar, bevel, depth] = ["mortar", "bevel", "depth"].map(|name| values.number(name));
    let mut heights = Vec::with_capacity(width * height);
    for j in 0..height {
        let (course, [below, above]) = cell(j, height, courses, 0.0);
        let shift = if course % 2 == 0 { 0.0 } else { 0.5 };
        heights.extend((0..width).map(|i| {
            let (_, [left, right]) = cell(i, width, columns, shift);
            let to_joint = left.min(right).min(below).min(above) - mortar / 2.0;
            depth * rise(to_joint, bevel)
        }));
    }
    let odd = courses % 2 == 1 && courses > 1;
    let seam = "an odd number of courses: the wall does not meet itself at the top";
    let heights = HeightMap::new(width, height, Wrap::Repeat, heights);
    let normals = NormalMap::from_heights(&heights, 1.0);
    let notes = odd.then(|| seam.to_owned()).into_iter().collect();
    Bumps { normals, heights: Some(heights), notes }
}
