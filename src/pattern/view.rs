//! Geometry seen from above, texel by texel: how Fournier made his bump maps (1992 §3).
//!
//! A ray straight down through each texel's centre finds a normal. A surface that leans covers more
//! area than its texel, by 1/n_z; "the amplitude of the sampled normals is corrected by the cosine"
//! means this weight. Only it makes a hemisphere's normals equally distributed over all directions.

use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{HeightMap, NormalMap, Wrap};

/// Whether leaning surface counts by its own area.
pub(super) const WEIGHT: Parameter = Parameter {
    name: "weight",
    meaning: "what a texel's normal counts for: the surface's own area (1/n_z), or 1",
    domain: Domain::Choice { words: &["area", "equal"] },
};

/// What stands where a ray misses the geometry.
pub(super) const BACKGROUND: Parameter = Parameter {
    name: "background",
    meaning: "what is seen beside the geometry: a flat ground, or nothing (weight 0)",
    domain: Domain::Choice { words: &["flat", "none"] },
};

/// What a ray straight down meets: the surface's unit normal, z > 0, and its height above the ground in
/// sides of a texel.
pub(super) struct Seen {
    pub normal: [f64; 3],
    pub height: f64,
}

/// Maps of `width` × `height` texels, tiled, of what `look(i, j)` sees at texel (i, j), where nothing is
/// the ground. `values` must hold [`WEIGHT`]; [`BACKGROUND`] too if `look` can miss.
pub(super) fn from_above(
    width: usize,
    height: usize,
    values: &Values,
    look: impl Fn(usize, usize) -> Option<Seen>,
) -> (NormalMap, HeightMap) {
    let by_area = values.word(WEIGHT.name) == "area";
    let texel = |seen: &Option<Seen>| match *seen {
        Some(Seen { normal: [x, y, z], .. }) => [x, y, z, if by_area { 1.0 / z } else { 1.0 }],
        None => [0.0, 0.0, 1.0, if values.word(BACKGROUND.name) == "flat" { 1.0 } else { 0.0 }],
    };
    let places = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
    let (texels, heights) = places
        .map(|(i, j)| look(i, j))
        // Adding 0 turns −0 into 0, so that equal normals have equal bits.
        .map(|seen| (texel(&seen).map(|c| c as f32 + 0.0), seen.map_or(0.0, |seen| seen.height)))
        .unzip();
    let normals = NormalMap::new(width, height, Wrap::Repeat, texels);
    (normals, HeightMap::new(width, height, Wrap::Repeat, heights))
}

/// Where the centre of texel `i` of `size` stands when the side is cut into `count` equal cells: the
/// cell, and the place in it from −1 to 1. Whole-number arithmetic, so that cells of equal layout give
/// equal bits.
pub(super) fn place(i: usize, size: usize, count: usize) -> (usize, f64) {
    let doubled = (2 * i + 1) * count; // in units where a cell is 2·size long
    (doubled / (2 * size), (doubled % (2 * size)) as f64 / size as f64 - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_centres() {
        assert_eq!(place(0, 1, 1), (0, 0.0));
        assert_eq!(place(3, 4, 1), (0, 0.75));
        assert_eq!(
            [0, 1, 2, 3].map(|i| place(i, 4, 2)),
            [(0, -0.5), (0, 0.5), (1, -0.5), (1, 0.5)]
        );
    }
}
