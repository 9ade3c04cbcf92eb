//! Averages over blocks, level by level.

use rayon::prelude::*;

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
    if from.0 == 2 * to.0 && from.1 == 2 * to.1 {
        return halve(to, read);
    }
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

/// [`downsample`] where each target cell has just four cells under it.
fn halve<const C: usize>(
    to: (usize, usize),
    read: impl Fn(usize, usize) -> [f32; C] + Sync,
) -> Vec<[f32; C]> {
    let mut out = vec![[0.0; C]; to.0 * to.1];
    out.par_chunks_mut(to.0).enumerate().for_each(|(j, row)| {
        for (i, cell) in row.iter_mut().enumerate() {
            // Written out: the compiler leaves `map` over an array of cells as copies.
            let mut sum = [0.0f64; C];
            for y in 0..2 {
                for x in 0..2 {
                    let value = read(2 * i + x, 2 * j + y);
                    for c in 0..C {
                        sum[c] += f64::from(value[c]);
                    }
                }
            }
            for c in 0..C {
                cell[c] = (0.25 * sum[c]) as f32;
            }
        }
    });
    out
}
