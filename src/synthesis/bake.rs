//! Synthesised bumps as a normal map.

use rayon::prelude::*;

use super::Synthesis;
use crate::texture::{NormalMap, Texel, Wrap};

/// As many octaves as a map of these sides can hold: the last one's lattice cells are 2 texels long or a little more.
pub fn octaves_for([width, height]: [usize; 2], cells: [u32; 2]) -> f64 {
    let along = |side: usize, cells: u32| (side / 2).checked_div(cells as usize).unwrap_or(0);
    let least = along(width, cells[0]).min(along(height, cells[1]));
    f64::from(least.checked_ilog2().map_or(0, |octaves| octaves + 1))
}

impl Synthesis {
    /// The synthesised normals as a map that repeats, with so many octaves: normals of the exact indices, not rounded by
    /// a table.
    pub fn bake(&self, width: usize, height: usize, octaves: f64) -> NormalMap {
        let row = |j: usize| -> Vec<Texel> {
            let v = (j as f64 + 0.5) / height as f64;
            let texel = |i: usize| {
                let u = (i as f64 + 0.5) / width as f64;
                let [x, y, z] = self.normals.at(self.indices(u, v, octaves));
                [x, y, z, 1.0]
            };
            (0..width).map(texel).collect()
        };
        let rows: Vec<Vec<Texel>> = (0..height).into_par_iter().map(row).collect();
        NormalMap::new(width, height, Wrap::Repeat, rows.concat())
    }
}
