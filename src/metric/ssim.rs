//! Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004, Image Quality Assessment: From Error
//! Visibility to Structural Similarity, eq. 13).

use super::{Field, Viewing, mean_field};
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

/// The similarity in each window, the mean of the channels.
pub(super) fn of_channels(test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<Field> {
    let range = viewing.range(reference);
    let channels: Option<Vec<Field>> =
        test.iter().zip(reference).map(|(test, reference)| field(test, reference, range)).collect();
    mean_field(&channels?)
}

/// The similarity in each window that lies inside; see [`ssim`].
fn field(test: &Film, reference: &Film, range: f64) -> Option<Field> {
    of_plane(&Plane::of(test), &Plane::of(reference), range)
}

/// The same of one channel in double precision.
pub(super) fn of_plane(test: &Plane, reference: &Plane, range: f64) -> Option<Field> {
    let found = windows(test, reference, range)?;
    Some(Field { width: found.width, values: found.whole })
}

/// One channel in double precision.
pub(super) struct Plane {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// All values, row by row.
    pub values: Vec<f64>,
}

impl Plane {
    /// A film's.
    pub fn of(film: &Film) -> Self {
        let values = film.pixels().iter().map(|p| f64::from(*p)).collect();
        Self { width: film.width(), height: film.height(), values }
    }
}

/// What is alike in each window that lies inside an image.
pub(super) struct Windows {
    /// Windows across.
    pub width: usize,
    /// Luminance, contrast and structure.
    pub whole: Vec<f64>,
    /// Contrast and structure alone.
    pub contrast: Vec<f64>,
}

/// The windows of two images; `None` if none fits.
///
/// # Panics
/// If they differ in size: a programming error.
pub(super) fn windows(test: &Plane, reference: &Plane, range: f64) -> Option<Windows> {
    let Plane { width, height, .. } = *reference;
    assert_eq!((test.width, test.height), (width, height), "shape of images");
    if width < WINDOW || height < WINDOW {
        return None;
    }
    let weights = window();
    let blurred = |f: fn(f64, f64) -> f64| {
        let pairs = test.values.iter().zip(&reference.values);
        let product: Vec<f64> = pairs.map(|(a, r)| f(*a, *r)).collect();
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
        let (alike, apart) = (2.0 * covariance + c2, var_a + var_r + c2);
        let whole = (2.0 * a * r + c1) * alike / ((a * a + r * r + c1) * apart);
        (whole, alike / apart)
    };
    let (whole, contrast) = (0..mean_a.len()).map(at).unzip();
    Some(Windows { width: width - WINDOW + 1, whole, contrast })
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
