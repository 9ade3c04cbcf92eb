//! Detail on top of bumps that are there already (Kautz et al. 2001 §7).

use rayon::prelude::*;

use super::{Bits, IndexTexture, Synthesis};
use crate::geometry::noise::blend;
use crate::texture::{NormalMap, Texel, Wrap};

impl Synthesis {
    /// A map's bumps with synthesised ones on top: the map's normals become indices, noise of so many octaves is added to
    /// these, `amount` times as strong as on its own, and the sums become normals.
    ///
    /// With an amount of 0 the map's own normals return to about 10⁻⁵, as far as the NDF has them: of an NDF measured
    /// from the map, and of one that a part of that was [mixed](crate::lobe::NdfImage::mixed) into, all that do not
    /// point down or lie within a pixel of the rim.
    pub fn with_detail(&self, map: &NormalMap, amount: f64, octaves: f64) -> NormalMap {
        let size = [map.width(), map.height()];
        self.detailed(size, map.wrap(), amount, octaves, |i, j| {
            let [x, y, z, weight] = map.texel(i, j);
            (self.normals.indices_of([x, y, z]), weight)
        })
    }

    /// The same with `finer` times as many texels a side. Between the map's texels indices are interpolated, not
    /// normals, as a lookup of the combined index texture has it.
    pub fn with_finer_detail(
        &self,
        map: &NormalMap,
        finer: usize,
        amount: f64,
        octaves: f64,
    ) -> NormalMap {
        let size @ [width, height] = [map.width() * finer, map.height() * finer];
        let indices = IndexTexture::of_map(&self.normals, map, Bits::Float);
        self.detailed(size, map.wrap(), amount, octaves, |i, j| {
            let [u, v] = centre([width, height], i, j).map(|c| c as f32);
            (indices.at(u, v).map(f64::from), map.sample(u, v)[3])
        })
    }

    /// A map of this size from what each texel has already: its indices and its weight.
    fn detailed(
        &self,
        size @ [width, height]: [usize; 2],
        wrap: Wrap,
        amount: f64,
        octaves: f64,
        own: impl Fn(usize, usize) -> ([f64; 2], f32) + Sync,
    ) -> NormalMap {
        // Indices of no octaves are the neutral normal's, not noise.
        let strength = amount * blend(octaves);
        let texel = |i: usize, j: usize| -> Texel {
            let (own, weight) = own(i, j);
            let [u, v] = centre(size, i, j);
            let noise = self.indices(u, v, octaves);
            let [x, y, z] = self.normals.at([0, 1].map(|k| own[k] + strength * (noise[k] - 0.5)));
            [x, y, z, weight]
        };
        let row = |j: usize| -> Vec<Texel> { (0..width).map(|i| texel(i, j)).collect() };
        let rows: Vec<Vec<Texel>> = (0..height).into_par_iter().map(row).collect();
        NormalMap::new(width, height, wrap, rows.concat())
    }
}

/// Where the centre of a texel lies on the tile.
fn centre([width, height]: [usize; 2], i: usize, j: usize) -> [f64; 2] {
    [(i as f64 + 0.5) / width as f64, (j as f64 + 0.5) / height as f64]
}
