//! Pyramids of moments: what filters linearly.
//!
//! Every one-lobe method keeps a handful of numbers a texel whose *averages* mean something (mean
//! normal, second moments). A pyramid holds their averages over ever larger blocks (Williams 1983).
//! Level 0 is not stored: it is encoded from the normal map as it is read, which saves three
//! quarters of the memory.

mod downsample;
mod fetch;

use rayon::prelude::*;

pub use downsample::{downsample, level_sizes, tap_weights};

use super::{Levels, NormalMap, Texel};

/// The numbers a method averages: how a texel of the normal map becomes `C` channels.
pub trait Moments<const C: usize>: Send + Sync {
    /// The moments of a single texel. Everything a coarser level holds is an average of these.
    fn encode(&self, texel: Texel) -> [f32; C];

    /// What is kept of averaged moments, and interpolated by lookups: the moments themselves unless
    /// a method's paper stores something else.
    #[inline(always)]
    fn store(&self, moments: [f32; C]) -> [f32; C] {
        moments
    }
}

/// Numbers behind the last cell, so that any channel can be the first of a vector load.
const PADDING: usize = 4;

/// Where a stored level stands in a pyramid's list of cells.
#[derive(Clone, Copy, Debug)]
struct Level {
    width: usize,
    height: usize,
    /// Cells before its first.
    start: usize,
}

/// Averages of `C` channels, at most 12, over blocks of a normal map, level by level.
#[derive(Clone, Debug)]
pub struct Pyramid<M, const C: usize> {
    moments: M,
    /// Levels 1 and up.
    levels: Vec<Level>,
    /// The channels of all their cells, one after the other; behind the last enough for a vector load.
    channels: Vec<f32>,
}

impl<M: Moments<C>, const C: usize> Pyramid<M, C> {
    /// Builds every level above the map, each from the one below.
    pub fn build(map: &NormalMap, moments: M) -> Self {
        const { assert!(C > 0 && C <= 12, "three vectors hold a cell") };
        let sizes = level_sizes(map.width(), map.height());
        let cells: usize = sizes[1..].iter().map(|(width, height)| width * height).sum();
        let mut channels = Vec::with_capacity(cells * C + PADDING);
        let mut levels = Vec::with_capacity(sizes.len() - 1);
        let mut below: Vec<[f32; C]> = Vec::new();
        for pair in sizes.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let texels = match levels.is_empty() {
                true => downsample(from, to, |i, j| moments.encode(map.texel(i, j))),
                false => downsample(from, to, |i, j| below[j * from.0 + i]),
            };
            levels.push(Level { width: to.0, height: to.1, start: channels.len() / C });
            channels.extend_from_slice(texels.as_flattened());
            below = texels;
        }
        let (cells, _) = channels.as_chunks_mut::<C>();
        cells.par_iter_mut().with_min_len(4096).for_each(|cell| *cell = moments.store(*cell));
        channels.extend([0.0; PADDING]);
        Self { moments, levels, channels }
    }

    /// How a texel becomes channels.
    pub fn moments(&self) -> &M {
        &self.moments
    }

    /// Number of levels, the map's own included.
    pub fn level_count(&self) -> usize {
        self.levels.len() + 1
    }

    /// The form of the pyramid above `map`.
    #[inline(always)]
    pub fn form(&self, map: &NormalMap) -> Levels {
        let (width, height, wrap) = (map.width(), map.height(), map.wrap());
        Levels { width, height, wrap, top: self.levels.len() }
    }

    /// Memory of the stored levels, in bytes.
    pub fn bytes(&self) -> usize {
        // Without the padding behind the last cell.
        size_of_val(&self.channels[..self.channels.len() - PADDING])
    }

    /// All cells of `level`, row by row from v = 0.
    pub fn cells(&self, map: &NormalMap, level: usize) -> Vec<[f32; C]> {
        let Some(above) = level.checked_sub(1) else {
            return map.texels().iter().map(|&texel| self.of_texel(texel)).collect();
        };
        let Level { width, height, start } = self.levels[above];
        let (cells, _) = self.channels[start * C..].as_chunks::<C>();
        cells[..width * height].to_vec()
    }

    /// What level 0 has for a texel.
    #[inline(always)]
    fn of_texel(&self, texel: Texel) -> [f32; C] {
        self.moments.store(self.moments.encode(texel))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;
    use proptest::prelude::*;

    struct Raw;
    impl Moments<4> for Raw {
        fn encode(&self, texel: Texel) -> [f32; 4] {
            texel
        }
    }

    fn noise(width: usize, height: usize, wrap: Wrap) -> NormalMap {
        let mut state = 1u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / (1u64 << 24) as f64
        };
        NormalMap::from_fn(width, height, wrap, |_, _| [next() - 0.5, next() - 0.5, 1.0, next()])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn every_level_keeps_the_mean(width in 1usize..40, height in 1usize..40) {
            let map = noise(width, height, Wrap::Repeat);
            let pyramid = Pyramid::build(&map, Raw);
            let mean = |cells: Vec<[f32; 4]>| {
                let n = cells.len() as f64;
                cells.iter().map(|c| f64::from(c[3])).sum::<f64>() / n
            };
            let truth = mean(pyramid.cells(&map, 0));
            for level in 1..pyramid.level_count() {
                prop_assert!((mean(pyramid.cells(&map, level)) - truth).abs() < 1e-6);
            }
        }

        #[test]
        fn weights_sum_to_one_and_share_each_cell_fully(from in 1usize..50, to in 1usize..50) {
            prop_assume!(to <= from);
            let mut given = vec![0.0; from];
            for k in 0..to {
                let mut total = 0.0;
                for (i, weight) in tap_weights(from, to, k) {
                    given[i] += weight;
                    total += weight;
                }
                prop_assert!((total - 1.0).abs() < 1e-12);
            }
            for share in given {
                prop_assert!((share - to as f64 / from as f64).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn sizes_halve_to_one() {
        assert_eq!(level_sizes(5, 2), [(5, 2), (2, 1), (1, 1)]);
        assert_eq!(level_sizes(1, 1), [(1, 1)]);
    }

    #[test]
    fn trilinear_meets_its_levels() {
        let map = noise(8, 8, Wrap::Repeat);
        let pyramid = Pyramid::build(&map, Raw);
        let at = |level| pyramid.trilinear(&map, 0.3, 0.7, level);
        assert_eq!(at(-2.0), at(0.0));
        assert_eq!(at(3.0), pyramid.cells(&map, 3)[0]);
        assert_eq!(at(99.0), at(3.0));
        let (low, high, between) = (at(1.0), at(2.0), at(1.25));
        for c in 0..4 {
            assert!((between[c] - (0.75 * low[c] + 0.25 * high[c])).abs() < 1e-6);
        }
    }
}
