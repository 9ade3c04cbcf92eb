//! The converged reference: brute force, with its own error.

use super::Film;

/// A converged image and how far from converged it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Converged {
    /// The mean of the replicates.
    pub film: Film,
    /// Samples a pixel, all replicates together.
    pub spp: u32,
    /// Estimated root mean square error of `film`.
    ///
    /// The replicates are independent (each scrambles its points anew), so the variance of their mean
    /// is Σ (rₖ − r̄)² / (R (R − 1)) a pixel, without bias; this is its root mean over pixels.
    pub rmse: f64,
    /// The mean over pixels of the same estimate, each pixel's standard error: about what the mean absolute error is
    /// at most.
    pub mean_error: f64,
}

/// The mean of at least two independent images of one size, with `spp` samples a pixel in all.
///
/// # Panics
/// If there are fewer than two: a programming error, as one image says nothing of its own error.
pub fn average(replicates: &[Film], spp: u32) -> Converged {
    assert!(replicates.len() >= 2, "replicates of a reference");
    let (count, first) = (replicates.len() as f64, &replicates[0]);
    let mut mean = Vec::with_capacity(first.pixels().len());
    let (mut variance_sum, mut error_sum) = (0.0, 0.0);
    for i in 0..first.pixels().len() {
        let values = || replicates.iter().map(|film| f64::from(film.pixels()[i]));
        let average = values().sum::<f64>() / count;
        let scatter = values().map(|r| (r - average) * (r - average)).sum::<f64>();
        let variance = scatter / (count * (count - 1.0));
        variance_sum += variance;
        error_sum += variance.sqrt();
        mean.push(average as f32);
    }
    let pixels = mean.len() as f64;
    let (rmse, mean_error) = ((variance_sum / pixels).sqrt(), error_sum / pixels);
    Converged { film: Film::new(first.width(), first.height(), mean), spp, rmse, mean_error }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_the_standard_error_of_the_mean() {
        let films = [1.0, 2.0, 3.0, 6.0].map(|value| Film::new(1, 1, vec![value]));
        let converged = average(&films, 64);
        assert_eq!(converged.film.pixels(), [3.0]);
        // Σ (r − 3)² = 14, over 4 · 3.
        assert!((converged.rmse - (14.0f64 / 12.0).sqrt()).abs() < 1e-12);
        assert_eq!(converged.mean_error, converged.rmse, "of a single pixel");
        // A pixel that all agree on halves the mean, and the square.
        let films = [1.0, 2.0, 3.0, 6.0].map(|value| Film::new(2, 1, vec![value, 1.0]));
        let two = average(&films, 64);
        assert!((two.mean_error - 0.5 * converged.rmse).abs() < 1e-12);
        assert!((two.rmse - 0.5f64.sqrt() * converged.rmse).abs() < 1e-12);
    }
}
