//! Floor 2: bump sources. One file a pattern; [`entries`] lists them. Image files are a source too.

mod analytic;
pub mod baked;
mod bricks;
mod brushed;
mod corrugated;
mod cylinders;
mod depth;
pub mod file;
mod flat;
mod fourier;
mod gaussian;
mod glyphs;
mod grid;
mod hemispheres;
mod letters;
mod mound;
mod polynomial;
mod relief;
mod ripple;
mod rivets;
mod round_letters;
mod spectrum;
mod synthesised;
mod twill;
mod view;
mod waves;
mod wavy_sphere;

pub use crate::parameter::Card;
use crate::parameter::{Parameter, Values};
use crate::texture::{HeightMap, NormalMap};
pub use synthesised::square_cells;

/// A pattern the program knows.
pub struct Entry {
    /// What it is.
    pub card: Card,
    /// Its options. `width` and `height` in texels and the seed are given apart.
    pub parameters: &'static [Parameter],
    /// Makes the bumps on a map of `width` × `height` texels. The seed matters to random patterns
    /// alone. The values are complete and within their domains.
    pub build: fn(width: usize, height: usize, values: &Values, seed: u64) -> Bumps,
}

/// A bump map, and what is known of it.
#[derive(Clone, Debug)]
pub struct Bumps {
    /// The normals that shading uses.
    pub normals: NormalMap,
    /// The heights they come from, in units of a texel's side, where there are any.
    pub heights: Option<HeightMap>,
    /// Things worth knowing (how many normals were not of unit length, …).
    pub notes: Vec<String>,
}

/// Every pattern, in the order lists show them.
pub fn entries() -> Vec<Entry> {
    vec![
        flat::ENTRY,
        hemispheres::ENTRY,
        cylinders::ENTRY,
        corrugated::ENTRY,
        twill::ENTRY,
        grid::ENTRY,
        bricks::ENTRY,
        letters::ENTRY,
        rivets::ENTRY,
        round_letters::ENTRY,
        polynomial::ENTRY,
        fourier::ENTRY,
        mound::ENTRY,
        ripple::ENTRY,
        waves::ENTRY,
        gaussian::ENTRY,
        brushed::ENTRY,
        synthesised::ENTRY,
        wavy_sphere::ENTRY,
    ]
}

/// The pattern of this name.
pub fn find(name: &str) -> Option<Entry> {
    entries().into_iter().find(|entry| entry.card.name == name)
}
