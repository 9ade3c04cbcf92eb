//! Detail on top of bumps that are there already (Kautz et al. 2001 §7).

use rayon::prelude::*;

use super::{Bits, IndexTexture, Synthesis};
use crate::geometry::noise::blend;
use crate::texture::{NormalMap, Texel};

impl Synthesis {
    /// A map's bumps with synthesised ones on top, `finer` times as many texels a side: the map's normals become indices,
    /// noise of so many octaves is added to these, `amount` times as strong as on its own, and the sums become normals.
    ///
    /// Between the map's texels indices are interpolated, not normals. With an amount of 0 the map's own normals
    /// return, as far as the NDF has them.
    pub fn with_detail(
        &self,
        map: &NormalMap,
        finer: usize,
        amount: f64,
        octaves: f64,
    ) -> NormalMap {
        let (width, height) = (map.width() * finer, map.height() * finer);
        let indices = IndexTexture::of_map(&self.normals, map, Bits::Float);
        let row = |j: usize| -> Vec<Texel> {
            let v = (j as f64 + 0.5) / height as f64;
            let texel = |i: usize| {
                let u = (i as f64 + 0.5) / width as f64;
                let own = indices.at(u as f32, v as f32);
                // Indices of no octaves are the neutral normal's, not noise.
                let (noise, strength) = (self.indices(u, v, octaves), amount * blend(octaves));
                let sum = [0, 1].map(|k| f64::from(own[k]) + strength * (noise[k] - 0.5));
                let [x, y, z] = self.normals.at(sum);
                [x, y, z, map.sample(u as f32, v as f32)[3]]
            };
            (0..width).map(texel).collect()
        };
        let rows: Vec<Vec<Texel>> = (0..height).into_par_iter().map(row).collect();
        NormalMap::new(width, height, map.wrap(), rows.concat())
    }
}
