//! Pyramids of moments: what filters linearly.
//!
//! Every one-lobe method keeps a handful of numbers a texel whose *averages* mean something (mean
//! normal, second moments). A pyramid holds their averages over ever larger blocks (Williams 1983).
//! Level 0 is not stored: it is encoded from the normal map as it is read, which saves three
//! quarters of the memory.

use rayon::prelude::*;

use super::normal_map::bilinear;
use super::{NormalMap, Texel};

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

/// The sizes of all levels from the map's own down to 1 × 1; each side is half of the one below,
/// rounded down, and at least 1.
pub fn level_sizes(width: usize, height: usize) -> Vec<(usize, usize)> {
    let halve =
        |&(w, h): &(usize, usize)| (w > 1 || h > 1).then(|| ((w / 2).max(1), (h / 2).max(1)));
    std::iter::successors(Some((width, height)), halve).collect()
}

/// Which of `from` cells lie under cell `k` when the same length is cut into `to` cells, and with
/// what share: (index, weight) in order, weights summing to 1. Odd sizes share a cell between two.
pub fn tap_weights(from: usize, to: usize, k: usize) -> impl Iterator<Item = (usize, f64)> {
    // In units where a source cell is `to` long and a target cell is `from` long, all is integer.
    let (start, end) = (k * from, (k + 1) * from);
    (start / to..end.div_ceil(to)).map(move |i| {
        let overlap = end.min((i + 1) * to) - start.max(i * to);
        (i, overlap as f64 / from as f64)
    })
}

/// Averages a `from`-sized grid of channels into a `to`-sized one, each target cell weighing what
/// lies under it by area. Rows run in parallel; sums are in double precision in a fixed order, so
/// the result is the same at any thread count.
pub fn downsample<const C: usize>(
    from: (usize, usize),
    to: (usize, usize),
    read: impl Fn(usize, usize) -> [f32; C] + Sync,
) -> Vec<[f32; C]> {
    let columns: Vec<Vec<(usize, f64)>> =
        (0..to.0).map(|i| tap_weights(from.0, to.0, i).collect()).collect();
    let mut out = vec![[0.0; C]; to.0 * to.1];
    out.par_chunks_mut(to.0).enumerate().for_each(|(j, row)| {
        let rows: Vec<(usize, f64)> = tap_weights(from.1, to.1, j).collect();
        for (cell, columns) in row.iter_mut().zip(&columns) {
            let mut sum = [0.0f64; C];
            for &(y, weight_y) in &rows {
                for &(x, weight_x) in columns {
                    let (value, weight) = (read(x, y), weight_x * weight_y);
                    for c in 0..C {
                        sum[c] += weight * f64::from(value[c]);
                    }
                }
            }
            *cell = sum.map(|s| s as f32);
        }
    });
    out
}

/// A stored level of a pyramid.
#[derive(Clone, Debug)]
struct Level<const C: usize> {
    width: usize,
    height: usize,
    texels: Vec<[f32; C]>,
}

/// Averages of `C` channels over blocks of a normal map, level by level.
#[derive(Clone, Debug)]
pub struct Pyramid<M, const C: usize> {
    moments: M,
    /// Levels 1 and up.
    levels: Vec<Level<C>>,
}

impl<M: Moments<C>, const C: usize> Pyramid<M, C> {
    /// Builds every level above the map, each from the one below.
    pub fn build(map: &NormalMap, moments: M) -> Self {
        let sizes = level_sizes(map.width(), map.height());
        let mut levels: Vec<Level<C>> = Vec::with_capacity(sizes.len() - 1);
        for pair in sizes.windows(2) {
            let ((from, to), below) = ((pair[0], pair[1]), levels.last());
            let texels = match below {
                None => downsample(from, to, |i, j| moments.encode(map.texel(i, j))),
                Some(level) => downsample(from, to, |i, j| level.texels[j * level.width + i]),
            };
            levels.push(Level { width: to.0, height: to.1, texels });
        }
        for level in &mut levels {
            level.texels.par_iter_mut().for_each(|cell| *cell = moments.store(*cell));
        }
        Self { moments, levels }
    }

    /// How a texel becomes channels.
    pub fn moments(&self) -> &M {
        &self.moments
    }

    /// Number of levels, the map's own included.
    pub fn level_count(&self) -> usize {
        self.levels.len() + 1
    }

    /// Memory of the stored levels, in bytes.
    pub fn bytes(&self) -> usize {
        self.levels.iter().map(|l| std::mem::size_of_val(l.texels.as_slice())).sum()
    }

    /// All cells of `level`, row by row from v = 0.
    pub fn cells(&self, map: &NormalMap, level: usize) -> Vec<[f32; C]> {
        match level {
            0 => map.texels().iter().map(|&t| self.moments.store(self.moments.encode(t))).collect(),
            _ => self.levels[level - 1].texels.clone(),
        }
    }

    /// The channels at folded coordinates (u, v), bilinear within `level`.
    #[inline(always)]
    fn at_level(&self, map: &NormalMap, level: usize, u: f32, v: f32) -> [f32; C] {
        let wrap = map.wrap();
        if level == 0 {
            let across = wrap.taps(u, map.width());
            let along = wrap.taps(v, map.height());
            bilinear(across, along, |i, j| self.moments.store(self.moments.encode(map.texel(i, j))))
        } else {
            let Level { width, height, texels } = &self.levels[level - 1];
            let (across, along) = (wrap.taps(u, *width), wrap.taps(v, *height));
            bilinear(across, along, |i, j| texels[j * width + i])
        }
    }

    /// The channels at folded coordinates (u, v) of the map this pyramid was built from, bilinear
    /// within the two levels around `level` and linear between them (*trilinear*, Williams 1983).
    /// A `level` outside the pyramid is held to its ends.
    #[inline(always)]
    pub fn trilinear(&self, map: &NormalMap, u: f32, v: f32, level: f32) -> [f32; C] {
        let held = level.clamp(0.0, self.levels.len() as f32);
        let below = held as usize;
        let blend = held - below as f32;
        let mut low = self.at_level(map, below, u, v);
        if blend > 0.0 {
            let high = self.at_level(map, below + 1, u, v);
            for c in 0..C {
                low[c] += blend * (high[c] - low[c]);
            }
        }
        low
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
