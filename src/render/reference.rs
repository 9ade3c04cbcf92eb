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
}

/// The mean of at least two independent images of one size, with `spp` samples a pixel in all.
///
/// # Panics
/// If there are fewer than two: a programming error, as one image says nothing of its own error.
pub fn average(replicates: &[Film], spp: u32) -> Converged {
    assert!(replicates.len() >= 2, "replicates of a reference");
    let (count, first) = (replicates.len() as f64, &replicates[0]);
    let mut mean = Vec::with_capacity(first.pixels().len());
    let mut variance_sum = 0.0;
    for i in 0..first.pixels().len() {
        let values = || replicates.iter().map(|film| f64::from(film.pixels()[i]));
        let average = values().sum::<f64>() / count;
        let scatter = values().map(|r| (r - average) * (r - average)).sum::<f64>();
        variance_sum += scatter / (count * (count - 1.0));
        mean.push(average as f32);
    }
    let rmse = (variance_sum / mean.len() as f64).sqrt();
    Converged { film: Film::new(first.width(), first.height(), mean), spp, rmse }
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
    }
}
