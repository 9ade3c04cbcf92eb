//! Floor 4: error measures between images, and between distributions.

use crate::geometry::HemisphereGrid;
use crate::render::Film;

/// stub
pub fn scores(test: &Film, reference: &Film) -> Vec<(&'static str, f64)> {
    let n = test.pixels().len() as f64;
    let sum: f64 =
        test.pixels().iter().zip(reference.pixels()).map(|(a, b)| f64::from(a - b).powi(2)).sum();
    vec![("rmse", (sum / n).sqrt())]
}

/// stub
pub fn total_variation(grid: &HemisphereGrid, a: &[f32], b: &[f32]) -> f64 {
    grid.samples()
        .iter()
        .zip(a)
        .zip(b)
        .map(|((s, a), b)| 0.5 * f64::from((a - b).abs()) * s.direction.z * s.solid_angle)
        .sum()
}
