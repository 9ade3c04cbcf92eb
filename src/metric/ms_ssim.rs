//! Structural similarity at several scales (Wang, Simoncelli and Bovik 2003, Multiscale Structural Similarity for Image
//! Quality Assessment, eq. 7).
//!
//! Contrast and structure are compared at five scales, each the 2 × 2 means of the one before, and luminance at the
//! last; means over windows inside the image are multiplied, each to the power of its scale's weight. A mean below 0
//! counts as 0. Of several channels the mean is taken.

use super::Viewing;
use super::ssim::{Plane, Windows, windows};
use crate::geometry::elementary::pow64;
use crate::render::Film;

/// The weights of the scales, finest first.
pub const SCALE_WEIGHTS: [f64; 5] = [0.0448, 0.2856, 0.3001, 0.2363, 0.1333];

/// MS-SSIM; `None` if a side is under 176 pixels, so that a window does not fit into the coarsest scale.
pub(super) fn ms_ssim(test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<f64> {
    let range = viewing.range(reference);
    let channels: Option<Vec<f64>> = test
        .iter()
        .zip(reference)
        .map(|(a, r)| of_plane(Plane::of(a), Plane::of(r), range))
        .collect();
    let channels = channels?;
    (!channels.is_empty()).then(|| channels.iter().sum::<f64>() / channels.len() as f64)
}

/// MS-SSIM of one channel.
pub(super) fn of_plane(mut test: Plane, mut reference: Plane, range: f64) -> Option<f64> {
    let mut product = 1.0;
    for (scale, weight) in SCALE_WEIGHTS.into_iter().enumerate() {
        if scale > 0 {
            (test, reference) = (halved(&test), halved(&reference));
        }
        let Windows { whole, contrast, .. } = windows(&test, &reference, range)?;
        let last = scale + 1 == SCALE_WEIGHTS.len();
        product *= pow64(mean(if last { &whole } else { &contrast }), weight);
    }
    Some(product)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The means of 2 × 2 values; an odd last row or column is left out.
fn halved(plane: &Plane) -> Plane {
    let (width, height) = (plane.width / 2, plane.height / 2);
    let at = |x: usize, y: usize| plane.values[y * plane.width + x];
    let mean =
        |(x, y): (usize, usize)| 0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1));
    let corners = (0..height).flat_map(|y| (0..width).map(move |x| (2 * x, 2 * y)));
    Plane { width, height, values: corners.map(mean).collect() }
}
