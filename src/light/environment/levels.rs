//! An environment blurred ahead, to be looked up.
//!
//! A mip map of an equirectangular picture blurs wrongly near the poles, where its cells are slivers. Here
//! each level is blurred on the sphere itself, by a von Mises-Fisher kernel, and then kept on a grid just
//! fine enough to hold it.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::grid::{Grid, Spot};
use crate::geometry::elementary::{exp64, ln64};

/// Blurred copies of a map: level k by a kernel of variance σ₀² 2ᵏ per axis, σ₀ the height of a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Levels {
    /// σ₀², radians².
    least: f64,
    grids: Vec<Grid>,
    /// The mean over the sphere: the map blurred without end.
    mean: f64,
}

/// Fewest rows of a level, if the map has as many.
const ROWS: usize = 8;
/// The last level's kernel is at least this wide, radians: all but even.
const WIDEST: f64 = 3.0;
/// Kernels end where they have fallen by e to this: they lose a part of 10⁻⁴.
const CUT: f64 = 9.0;
/// What a cell's own width and the bilinear lookup blur, a row's height squared: 1/12 + 1/6.
const OWN: f64 = 0.25;

impl Levels {
    pub fn of(map: &Grid) -> Self {
        let least = (PI / map.height as f64) * (PI / map.height as f64);
        let mut grids = Vec::new();
        let mut variance = least;
        loop {
            // Two rows a standard deviation.
            let wanted = (2.0 * PI / variance.sqrt()).ceil() as usize;
            let rows = wanted.max(ROWS).min(map.height);
            grids.push(blurred(&map.resampled(2 * rows, rows), variance));
            if variance >= WIDEST * WIDEST {
                return Self { least, grids, mean: map.mean() };
            }
            variance *= 2.0;
        }
    }

    /// Memory, in bytes.
    pub fn bytes(&self) -> usize {
        self.grids.iter().map(|grid| size_of_val(grid.values.as_slice())).sum()
    }

    /// The map blurred by a kernel of variance `variance` per axis (radians²) at a place; `map` is what
    /// this was made of.
    ///
    /// Between levels it is linear in the logarithm. The square root of ∫ (blend − kernel)² over that of
    /// ∫ kernel² is then at most 4.1 % for Gaussians, against 5.5 % linear in σ and 7.3 % in the variance;
    /// no weights do better than 3.5 %. (With levels a factor 2 of σ apart it would be 16 %.)
    #[inline]
    pub fn at(&self, map: &Grid, spot: Spot, variance: f64) -> f64 {
        let ratio = variance / self.least;
        if ratio < 1.0 {
            // The map itself is as wide as a cell and its lookup.
            let part = ln64(ratio.max(OWN) / OWN) / -ln64(OWN);
            return blend(map.at(spot), || self.grids[0].at(spot), part);
        }
        let level = ((ratio.to_bits() >> 52) as usize).saturating_sub(1023);
        let Some(low) = self.grids.get(level) else { return self.mean };
        let high = || self.grids.get(level + 1).map_or(self.mean, |grid| grid.at(spot));
        let mantissa = ratio / (1u64 << level) as f64;
        blend(low.at(spot), high, ln64(mantissa) * std::f64::consts::LOG2_E)
    }
}

#[inline]
fn blend(low: f64, high: impl FnOnce() -> f64, part: f64) -> f64 {
    if part > 0.0 { low + part * (high() - low) } else { low }
}

/// The map blurred by the kernel exp(κ (cos γ − 1)), κ one over the variance, over its own sum, so that an
/// even map stays as it is. Of the variance goes off what the grid blurs by itself.
fn blurred(map: &Grid, variance: f64) -> Grid {
    let step = PI / map.height as f64;
    let kappa = 1.0 / (variance - OWN * step * step);
    let mut values = vec![0.0f32; map.values.len()];
    values.par_chunks_mut(map.width).enumerate().for_each(|(row, out)| {
        blur_row(map, kappa, row, out);
    });
    Grid { width: map.width, height: map.height, values }
}

fn blur_row(map: &Grid, kappa: f64, row: usize, out: &mut [f32]) {
    let width = map.width;
    let polar = |row: usize| libm::sincos(PI * (row as f64 + 0.5) / map.height as f64);
    let (sin, cos) = polar(row);
    let cosines: Vec<f64> =
        (0..=width / 2).map(|k| libm::cos(2.0 * PI * k as f64 / width as f64)).collect();
    let mut sums = vec![0.0f64; width];
    let mut total = 0.0;
    let mut kernel = Vec::with_capacity(width / 2 + 1);
    for source in 0..map.height {
        let (sin_from, cos_from) = polar(source);
        let (level, swing) = (kappa * (cos * cos_from - 1.0), kappa * sin * sin_from);
        // Kernel at k columns away, as far as it matters.
        kernel.clear();
        let exponents = cosines.iter().map(|cosine| level + swing * cosine);
        let area = map.solid_angle(source);
        kernel.extend(exponents.take_while(|e| *e > -CUT).map(|e| area * exp64(e)));
        if kernel.is_empty() {
            continue;
        }
        let line = &map.values[source * width..(source + 1) * width];
        for (k, &weight) in kernel.iter().enumerate() {
            total += add_shifted(&mut sums, line, k, weight);
        }
    }
    for (out, sum) in out.iter_mut().zip(sums) {
        *out = (sum / total) as f32;
    }
}

/// Adds `weight` times the line, moved by k columns both ways, and gives the weight added a cell.
fn add_shifted(sums: &mut [f64], line: &[f32], k: usize, weight: f64) -> f64 {
    let width = line.len();
    let mut add = |shift: usize| {
        let (head, tail) = sums.split_at_mut(width - shift);
        let (first, rest) = line.split_at(shift);
        head.iter_mut().zip(rest).for_each(|(sum, &v)| *sum += weight * f64::from(v));
        tail.iter_mut().zip(first).for_each(|(sum, &v)| *sum += weight * f64::from(v));
    };
    add(k);
    if k == 0 || 2 * k == width {
        return weight;
    }
    add(width - k);
    2.0 * weight
}
