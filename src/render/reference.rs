//! The converged reference: brute force, with its own error, pixel by pixel.

use serde::{Deserialize, Serialize};

use super::Film;

/// A converged image and how far from converged it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Converged {
    /// The mean of the replicates.
    pub film: Film,
    /// The variance of each pixel of `film`, in the order of its pixels.
    ///
    /// The replicates are independent (each scrambles its points anew), so the variance of their mean
    /// is Σ (rₖ − r̄)² / (R (R − 1)) a pixel, without bias.
    pub variance: Vec<f64>,
    /// Samples a pixel, all replicates together.
    pub spp: u32,
    /// Estimated root mean square error of `film`: the root of the mean of `variance`.
    pub rmse: f64,
    /// The mean over pixels of each pixel's standard error: about what the mean absolute error is at most.
    pub mean_error: f64,
}

impl Converged {
    /// The standard error of each pixel, as an image.
    pub fn error(&self) -> Film {
        let errors = self.variance.iter().map(|v| v.sqrt() as f32).collect();
        Film::new(self.film.width(), self.film.height(), errors)
    }
}

/// Independent replicates of an image, summed pixel by pixel, so that more can be added at any time: the sums hold
/// the same bits however often they were put down and taken up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Pixels across.
    width: usize,
    /// Pixels down.
    height: usize,
    /// Samples a pixel of each replicate.
    spp: u32,
    /// Replicates so far.
    replicates: u32,
    /// Σ rₖ, a pixel.
    sums: Vec<f64>,
    /// Σ (rₖ − r̄)², a pixel.
    scatter: Vec<f64>,
}

impl Tally {
    /// No replicates yet, of so many pixels and samples a pixel each.
    pub fn new(width: usize, height: usize, spp: u32) -> Self {
        let zeros = vec![0.0; width * height];
        Self { width, height, spp, replicates: 0, sums: zeros.clone(), scatter: zeros }
    }

    /// How many replicates it holds.
    pub fn replicates(&self) -> u32 {
        self.replicates
    }

    /// Whether its sums are of as many pixels as it says and finite: false of a file that was tampered with.
    pub fn is_sound(&self) -> bool {
        let pixels = self.width.checked_mul(self.height);
        let whole = |sums: &[f64]| Some(sums.len()) == pixels && sums.iter().all(|s| s.is_finite());
        whole(&self.sums) && whole(&self.scatter) && self.spp.checked_mul(self.replicates).is_some()
    }

    /// Adds a replicate.
    ///
    /// # Panics
    /// If it is of another size: a programming error.
    pub fn add(&mut self, replicate: &Film) {
        assert_eq!((replicate.width(), replicate.height()), (self.width, self.height), "its size");
        let before = f64::from(self.replicates);
        self.replicates += 1;
        let pixels = replicate.pixels().iter().map(|r| f64::from(*r));
        for ((r, sum), scatter) in pixels.zip(&mut self.sums).zip(&mut self.scatter) {
            if before > 0.0 {
                // Welford 1962: what a new value adds to the sum of squares about the mean.
                let off = r - *sum / before;
                *scatter += off * off * before / (before + 1.0);
            }
            *sum += r;
        }
    }

    /// The mean of the replicates, and its error.
    ///
    /// # Panics
    /// If there are fewer than two: a programming error, as one image says nothing of its own error.
    pub fn converged(&self) -> Converged {
        assert!(self.replicates >= 2, "replicates of a reference");
        let count = f64::from(self.replicates);
        let mean = self.sums.iter().map(|sum| (sum / count) as f32).collect();
        let variance: Vec<f64> =
            self.scatter.iter().map(|scatter| scatter / (count * (count - 1.0))).collect();
        let pixels = variance.len() as f64;
        let rmse = (variance.iter().sum::<f64>() / pixels).sqrt();
        let mean_error = variance.iter().map(|v| v.sqrt()).sum::<f64>() / pixels;
        let spp = self.spp * self.replicates;
        Converged {
            film: Film::new(self.width, self.height, mean),
            variance,
            spp,
            rmse,
            mean_error,
        }
    }
}

/// The mean of at least two independent images of one size, with `spp` samples a pixel in all.
///
/// # Panics
/// If there are fewer than two: a programming error, as one image says nothing of its own error.
pub fn average(replicates: &[Film], spp: u32) -> Converged {
    assert!(replicates.len() >= 2, "replicates of a reference");
    let (width, height) = (replicates[0].width(), replicates[0].height());
    let mut tally = Tally::new(width, height, spp / replicates.len() as u32);
    replicates.iter().for_each(|replicate| tally.add(replicate));
    tally.converged()
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
        assert!((converged.variance[0] - 14.0 / 12.0).abs() < 1e-12);
        assert_eq!(converged.mean_error, converged.rmse, "of a single pixel");
        assert_eq!(converged.spp, 64);
        // A pixel that all agree on halves the mean, and the square.
        let films = [1.0, 2.0, 3.0, 6.0].map(|value| Film::new(2, 1, vec![value, 1.0]));
        let two = average(&films, 64);
        assert_eq!(two.error().pixels()[1], 0.0);
        assert!((two.mean_error - 0.5 * converged.rmse).abs() < 1e-12);
        assert!((two.rmse - 0.5f64.sqrt() * converged.rmse).abs() < 1e-12);
    }

    #[test]
    fn a_tally_goes_on_with_the_same_bits_from_a_file() {
        let film = |k: u32| {
            let pixels = (0..12).map(|i| ((k * 37 + i * 11) % 23) as f32 / 7.0);
            Film::new(4, 3, pixels.collect())
        };
        let mut whole = Tally::new(4, 3, 16);
        (0..8).for_each(|k| whole.add(&film(k)));
        let mut parts = Tally::new(4, 3, 16);
        for k in 0..8 {
            parts.add(&film(k));
            let text = serde_json::to_string(&parts).unwrap();
            parts = serde_json::from_str(&text).unwrap();
            assert!(parts.is_sound());
        }
        assert_eq!(whole, parts);
        assert_eq!(parts.converged().spp, 128);
    }
}
