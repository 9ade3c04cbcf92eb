//! The converged reference: brute force, with its own error.

use super::{Cancelled, Film, PixelSampler, View, render};
use crate::method::Prefiltered;

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

/// Renders `replicates` ≥ 2 independent images of `spp / replicates` samples a pixel each and takes
/// their mean. `advance` is told after each how many are done.
///
/// # Errors
/// [`Cancelled`] if `cancelled` says so.
pub fn converge(
    view: &View,
    unfiltered: &dyn Prefiltered,
    spp: u32,
    replicates: u32,
    seed: u64,
    cancelled: &(dyn Fn() -> bool + Sync),
    advance: &dyn Fn(u32),
) -> Result<Converged, Cancelled> {
    let sampler = PixelSampler::new(spp / replicates);
    let films = (0..replicates)
        .map(|replicate| {
            // Replicate 0 belongs to the trials; the reference shares no random number with them.
            let film = render(view, unfiltered, &sampler, seed, replicate + 1, cancelled)?;
            advance(replicate + 1);
            Ok(film)
        })
        .collect::<Result<Vec<Film>, Cancelled>>()?;
    let count = f64::from(replicates);
    let pixel_count = films[0].pixels().len();
    let mut mean = Vec::with_capacity(pixel_count);
    let mut variance_sum = 0.0;
    for i in 0..pixel_count {
        let values = || films.iter().map(|film| f64::from(film.pixels()[i]));
        let average = values().sum::<f64>() / count;
        let scatter = values().map(|r| (r - average) * (r - average)).sum::<f64>();
        variance_sum += scatter / (count * (count - 1.0));
        mean.push(average as f32);
    }
    let rmse = (variance_sum / pixel_count as f64).sqrt();
    let film = Film::new(films[0].width(), films[0].height(), mean);
    Ok(Converged { film, spp, rmse })
}
