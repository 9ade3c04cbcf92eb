//! Textures of indices (Kautz et al. 2001 §5.2.2).

use rayon::prelude::*;

use super::{Normals, Synthesis};
use crate::texture::{Footprint, Levels, NormalMap, Wrap, level_sizes};

/// What an index is stored in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bits {
    /// 8 bits: "the indices in the noise-texture are limited to 8 bits by the hardware" (§6).
    Eight,
    /// 16 bits.
    Sixteen,
    /// As computed.
    #[default]
    Float,
}

impl Bits {
    /// The value as stored.
    #[inline(always)]
    pub fn rounded(self, r: f32) -> f32 {
        let most = match self {
            Self::Eight => 255.0,
            Self::Sixteen => 65535.0,
            Self::Float => return r,
        };
        ((r.clamp(0.0, 1.0) * most + 0.5) as u32) as f32 / most
    }
}

/// Pairs (r₁, r₂), level by level.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexTexture {
    form: Levels,
    /// Cells of each level, row by row from v = 0.
    levels: Vec<Vec<[f32; 2]>>,
}

impl IndexTexture {
    /// Noise, mipmapped: "the finest mipmap level contains the most octaves, every coarser mipmap level contains one
    /// octave less". It repeats.
    pub fn of_noise(
        synthesis: &Synthesis,
        [width, height]: [usize; 2],
        octaves: f64,
        bits: Bits,
    ) -> Self {
        let sizes = level_sizes(width, height);
        let level = |(level, &(width, height)): (usize, &(usize, usize))| -> Vec<[f32; 2]> {
            let octaves = (octaves - level as f64).max(0.0);
            let cell = |k: usize| {
                let (i, j) = (k % width, k / width);
                let (u, v) = ((i as f64 + 0.5) / width as f64, (j as f64 + 0.5) / height as f64);
                synthesis.indices(u, v, octaves).map(|r| bits.rounded(r as f32))
            };
            (0..width * height).into_par_iter().map(cell).collect()
        };
        let levels: Vec<Vec<[f32; 2]>> = sizes.iter().enumerate().map(level).collect();
        let form = Levels { width, height, wrap: Wrap::Repeat, top: levels.len() - 1 };
        Self { form, levels }
    }

    /// The indices of a map's normals, a single level.
    pub fn of_map(normals: &Normals, map: &NormalMap, bits: Bits) -> Self {
        let cell = |&[x, y, z, _]: &[f32; 4]| {
            normals.indices_of([x, y, z]).map(|r| bits.rounded(r as f32))
        };
        let levels = vec![map.texels().par_iter().map(cell).collect()];
        let form = Levels { width: map.width(), height: map.height(), wrap: map.wrap(), top: 0 };
        Self { form, levels }
    }

    /// The pair under a footprint, by its lookup.
    #[inline]
    pub fn fetch(&self, at: &Footprint) -> [f32; 2] {
        let mut sum = [0.0; 2];
        at.each_cell(&self.form, |cell| {
            let [r1, r2] = self.levels[cell.level][cell.j * self.form.size(cell.level).0 + cell.i];
            sum[0] += cell.weight * r1;
            sum[1] += cell.weight * r2;
        });
        sum
    }

    /// The pair at folded coordinates, bilinear in the finest level.
    pub fn at(&self, u: f32, v: f32) -> [f32; 2] {
        self.fetch(&Footprint { u, v, ..Footprint::default() })
    }

    /// The pairs of a level, row by row from v = 0; of no level beyond the coarsest.
    pub fn level(&self, level: usize) -> &[[f32; 2]] {
        self.levels.get(level).map_or(&[], Vec::as_slice)
    }

    /// Memory as floats, in bytes.
    pub fn bytes(&self) -> usize {
        self.levels.iter().map(|level| size_of_val(level.as_slice())).sum()
    }
}
