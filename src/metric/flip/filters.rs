//! FLIP's filters. All are products of a filter along rows and one along columns; beyond the border of the picture
//! its last pixels go on.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::geometry::elementary::exp64;

/// Σ a √(π/b) exp(−π² x²/b), x in degrees: a and b for Y, Cx and Cz (2020, table 1).
const CONTRAST: [&[(f64, f64)]; 3] =
    [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];

/// w: the width of what edges and points are looked for by, degrees.
const FEATURE: f64 = 0.082;

/// The filters of a viewer.
pub(super) struct Filters {
    /// For each channel Gaussians along an axis, each with its share.
    contrast: [Vec<(f64, Vec<f64>)>; 3],
    /// A Gaussian, its first and its second derivative, along an axis.
    feature: [Vec<f64>; 3],
}

impl Filters {
    /// For `ppd` pixels to a degree.
    pub fn new(ppd: f64) -> Self {
        let widest = CONTRAST.iter().copied().flatten().fold(0.0f64, |most, (_, b)| most.max(*b));
        let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * ppd).ceil() as i64;
        let contrast = CONTRAST.map(|terms| contrast(terms, ppd, radius));
        let sigma = 0.5 * FEATURE * ppd;
        Self { contrast, feature: feature(sigma, (3.0 * sigma).ceil() as i64) }
    }

    /// A plane seen through the contrast sensitivity of channel `c`.
    pub fn contrast(&self, c: usize, plane: &[f64], width: usize) -> Vec<f64> {
        let mut sum = vec![0.0; plane.len()];
        for (share, kernel) in &self.contrast[c] {
            let blurred = down(&across(plane, width, kernel), width, kernel);
            sum.iter_mut().zip(blurred).for_each(|(sum, value)| *sum += share * value);
        }
        sum
    }

    /// The strengths of edges and of points: lengths of the first and second derivatives of Y, scaled to [0, 1],
    /// blurred (2020, eq. 6).
    pub fn features(&self, y: &[f64], width: usize) -> Vec<[f64; 2]> {
        let level: Vec<f64> = y.iter().map(|y| (y + 16.0) / 116.0).collect();
        let [blur, ..] = &self.feature;
        let blurred = across(&level, width, blur);
        let strength = |derivative: &Vec<f64>| -> Vec<f64> {
            let along_x = down(&across(&level, width, derivative), width, blur);
            let along_y = down(&blurred, width, derivative);
            along_x.iter().zip(along_y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        let [edges, points] = [1, 2].map(|k| strength(&self.feature[k]));
        edges.into_iter().zip(points).map(|(edge, point)| [edge, point]).collect()
    }
}

/// The Gaussians of a channel along an axis, each with its share of the whole, which sums to 1.
fn contrast(terms: &[(f64, f64)], ppd: f64, radius: i64) -> Vec<(f64, Vec<f64>)> {
    let gaussians = terms.iter().map(|(a, b)| {
        let at = |i: i64| {
            let x = i as f64 / ppd;
            exp64(-PI * PI * x * x / b)
        };
        let kernel: Vec<f64> = (-radius..=radius).map(at).collect();
        let sum: f64 = kernel.iter().sum();
        (a * (PI / b).sqrt() * sum * sum, kernel.into_iter().map(|k| k / sum).collect::<Vec<f64>>())
    });
    let gaussians: Vec<(f64, Vec<f64>)> = gaussians.collect();
    let whole: f64 = gaussians.iter().map(|(share, _)| share).sum();
    gaussians.into_iter().map(|(share, kernel)| (share / whole, kernel)).collect()
}

/// A Gaussian that sums to 1, and −x and x²/σ² − 1 times it, whose weights above 0 sum to 1 and those below to −1.
fn feature(sigma: f64, radius: i64) -> [Vec<f64>; 3] {
    let gaussian = |x: f64| exp64(-x * x / (2.0 * sigma * sigma));
    let kernel = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let weights: Vec<f64> = (-radius..=radius).map(|i| f(i as f64)).collect();
        let part = |sign: f64| weights.iter().map(|w| (w * sign).max(0.0)).sum::<f64>();
        let (above, below) = (part(1.0), part(-1.0));
        weights
            .into_iter()
            .map(|w| if w > 0.0 { w / above } else { w / below.max(f64::MIN_POSITIVE) })
            .collect()
    };
    [
        kernel(&gaussian),
        kernel(&|x| -x * gaussian(x)),
        kernel(&|x| (x * x / (sigma * sigma) - 1.0) * gaussian(x)),
    ]
}

/// Rows a thread takes at once.
const ROWS: usize = 32;

/// Filtered along rows.
fn across(values: &[f64], width: usize, kernel: &[f64]) -> Vec<f64> {
    let radius = kernel.len() / 2;
    let mut out = vec![0.0; values.len()];
    let rows = out.par_chunks_exact_mut(width).zip(values.par_chunks_exact(width));
    rows.with_min_len(ROWS).for_each(|(out, row)| {
        let before = std::iter::repeat_n(row[0], radius);
        let after = std::iter::repeat_n(row[width - 1], radius);
        let padded: Vec<f64> = before.chain(row.iter().copied()).chain(after).collect();
        for (i, weight) in kernel.iter().enumerate() {
            out.iter_mut().zip(&padded[i..]).for_each(|(out, value)| *out += weight * value);
        }
    });
    out
}

/// Filtered along columns.
fn down(values: &[f64], width: usize, kernel: &[f64]) -> Vec<f64> {
    let (radius, height) = (kernel.len() / 2, values.len() / width);
    let mut out = vec![0.0; values.len()];
    out.par_chunks_exact_mut(width).enumerate().with_min_len(ROWS).for_each(|(y, out)| {
        for (i, weight) in kernel.iter().enumerate() {
            let from = (y + i).saturating_sub(radius).min(height - 1) * width;
            let row = &values[from..from + width];
            out.iter_mut().zip(row).for_each(|(out, value)| *out += weight * value);
        }
    });
    out
}
