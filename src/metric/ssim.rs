//! Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004, Image Quality Assessment: From Error
//! Visibility to Structural Similarity, eq. 13).

use super::pixelwise::data_range;
use super::{Field, mean_field};
use crate::geometry::elementary::exp64;
use crate::render::Film;

/// Pixels along a side of the window.
pub const WINDOW: usize = 11;
/// Standard deviation of the window's Gaussian, pixels.
pub const SIGMA: f64 = 1.5;
/// C₁ = (K₁ L)².
pub const K1: f64 = 0.01;
/// C₂ = (K₂ L)².
pub const K2: f64 = 0.03;

/// The mean structural similarity of two films with data range `range` = L > 0, over every window
/// that lies inside; `None` if a side is under 11 pixels. Variances are those of the window's weights
/// (no sample correction).
///
/// # Panics
/// If the films differ in size: a programming error.
pub fn ssim(test: &Film, reference: &Film, range: f64) -> Option<f64> {
    Some(field(test, reference, range)?.mean())
}

/// The similarity in each window, the mean of the channels, with the reference's greatest pixel as data range.
pub(super) fn of_channels(test: &[Film], reference: &[Film]) -> Option<Field> {
    with_range(test, reference, data_range(reference))
}

fn with_range(test: &[Film], reference: &[Film], range: f64) -> Option<Field> {
    let channels: Option<Vec<Field>> =
        test.iter().zip(reference).map(|(test, reference)| field(test, reference, range)).collect();
    mean_field(&channels?)
}

/// The similarity in each window that lies inside; see [`ssim`].
fn field(test: &Film, reference: &Film, range: f64) -> Option<Field> {
    let (width, height) = (test.width(), test.height());
    assert_eq!((width, height), (reference.width(), reference.height()), "shape of films");
    if width < WINDOW || height < WINDOW {
        return None;
    }
    let weights = window();
    let blurred = |f: fn(f64, f64) -> f64| {
        let pairs = test.pixels().iter().zip(reference.pixels());
        let product: Vec<f64> = pairs.map(|(a, r)| f(f64::from(*a), f64::from(*r))).collect();
        blur(&blur(&product, width, &weights), height, &weights)
    };
    let mean_a = blurred(|a, _| a);
    let mean_r = blurred(|_, r| r);
    let mean_aa = blurred(|a, _| a * a);
    let mean_rr = blurred(|_, r| r * r);
    let mean_ar = blurred(|a, r| a * r);
    let (c1, c2) = ((K1 * range) * (K1 * range), (K2 * range) * (K2 * range));
    let at = |i: usize| {
        let (a, r) = (mean_a[i], mean_r[i]);
        let (var_a, var_r) = (mean_aa[i] - a * a, mean_rr[i] - r * r);
        let covariance = mean_ar[i] - a * r;
        let alike = (2.0 * a * r + c1) * (2.0 * covariance + c2);
        alike / ((a * a + r * r + c1) * (var_a + var_r + c2))
    };
    let values = (0..mean_a.len()).map(at).collect();
    Some(Field { width: width - WINDOW + 1, values })
}

/// The window along one axis; it sums to 1.
fn window() -> [f64; WINDOW] {
    let weight = |i: usize| {
        let x = (i as f64 - (WINDOW / 2) as f64) / SIGMA;
        exp64(-0.5 * x * x)
    };
    let weights: [f64; WINDOW] = std::array::from_fn(weight);
    let sum: f64 = weights.iter().sum();
    weights.map(|w| w / sum)
}

/// The rows of `width` values, weighted wherever the window lies inside, and transposed: applied again
/// it does the columns.
fn blur(values: &[f64], width: usize, weights: &[f64; WINDOW]) -> Vec<f64> {
    let at = |row: &[f64]| row.iter().zip(weights).map(|(value, w)| value * w).sum::<f64>();
    (0..=width - WINDOW)
        .flat_map(|i| values.chunks_exact(width).map(move |row| at(&row[i..i + WINDOW])))
        .collect()
}
