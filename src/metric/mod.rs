//! Floor 4: error measures between images, and between distributions of normals.
//!
//! Images are linear and compared as they are, without a tone curve. An image is a list of channels,
//! each a [`Film`]; a rendering has one. [`entries`] lists the measures with their formulas, in which A
//! is the image, R the reference, and sums and means run over all pixels of all channels.

mod distribution;
mod equivalent;
mod flicker;
mod lead;
mod pixelwise;
mod ssim;

pub use distribution::total_variation;
pub use equivalent::{Equivalent, SpeedUp, equivalent_samples};
pub use flicker::{Flicker, Step, flicker_map};
pub use lead::{Lead, Verdict, Z};
pub use pixelwise::{DARK, HIGHLIGHT};
pub use ssim::{K1, K2, SIGMA, WINDOW, ssim};

use crate::render::Film;

/// A measure of how far an image is from a reference.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name in the `metric` column of `metrics.csv`.
    pub name: &'static str,
    /// What it tells, in a few words.
    pub meaning: &'static str,
    /// Its formula, with its constants.
    pub formula: &'static str,
    /// Which values are good.
    pub best: Best,
    measure: fn(&[Film], &[Film]) -> Option<f64>,
}

/// Which values of a metric are good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Best {
    /// The lower the better.
    Lowest,
    /// The higher the better.
    Highest,
    /// The nearer to 1 the better.
    One,
}

/// Every metric, in the order tables show them.
pub fn entries() -> [Metric; 6] {
    [
        Metric {
            name: "rmse",
            meaning: "root mean square error",
            formula: "√ mean (A − R)²",
            best: Best::Lowest,
            measure: pixelwise::rmse,
        },
        Metric {
            name: "relmse",
            meaning: "mean square error relative to the reference",
            formula: "mean (A − R)² / (R² + ε), ε = 0.01 (mean R)²",
            best: Best::Lowest,
            measure: pixelwise::relmse,
        },
        Metric {
            name: "psnr",
            meaning: "peak signal-to-noise ratio in decibels",
            formula: "10 log₁₀ (L² / mean (A − R)²), L = max R",
            best: Best::Highest,
            measure: pixelwise::psnr,
        },
        Metric {
            name: "ssim",
            meaning: "structural similarity (Wang et al. 2004), 1 for equal images",
            formula: "mean over windows of (2 μ_A μ_R + C₁)(2 σ_AR + C₂) / ((μ_A² + μ_R² + C₁)(σ_A² + σ_R² + C₂)); \
                      Gaussian window of 11 × 11 pixels, σ = 1.5, inside the image; C₁ = (0.01 L)², C₂ = (0.03 L)², \
                      L = max R",
            best: Best::Highest,
            measure: structure,
        },
        Metric {
            name: "energy",
            meaning: "the share of the reference's light that the image holds",
            formula: "Σ A / Σ R",
            best: Best::One,
            measure: pixelwise::energy,
        },
        Metric {
            name: "highlight_energy",
            meaning: "the share of the reference's light that the image holds in its highlights",
            formula: "Σ A / Σ R over the pixels with R > 0.5 max R",
            best: Best::One,
            measure: pixelwise::highlight_energy,
        },
    ]
}

/// The metric of this name.
pub fn find(name: &str) -> Option<Metric> {
    entries().into_iter().find(|metric| metric.name == name)
}

/// The scores of a rendering against its reference, by metric name, in the order of [`entries`]. A
/// score that has no finite value is left out: SSIM of an image under 11 pixels, PSNR of an image equal
/// to its reference, ratios to a black reference.
///
/// # Panics
/// If the films differ in size: a programming error; [`same_shape`] checks images of the user's.
pub fn scores(test: &Film, reference: &Film) -> Vec<(&'static str, f64)> {
    channel_scores(std::slice::from_ref(test), std::slice::from_ref(reference))
}

/// The scores of an image of several channels; see [`scores`].
///
/// # Panics
/// If the images differ in size or number of channels.
pub fn channel_scores(test: &[Film], reference: &[Film]) -> Vec<(&'static str, f64)> {
    if let Err(error) = same_shape(test, reference) {
        panic!("{error}");
    }
    let score = |metric: Metric| Some((metric.name, (metric.measure)(test, reference)?));
    entries().into_iter().filter_map(score).filter(|(_, value)| value.is_finite()).collect()
}

/// Why two images cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the images differ in shape: {} × {} pixels in {} channel(s) against {} × {} in {}; compare images of one size",
    test[0], test[1], test[2], reference[0], reference[1], reference[2]
)]
pub struct ShapeMismatch {
    /// Pixels across, pixels down and channels of the image.
    pub test: [usize; 3],
    /// The same of the reference.
    pub reference: [usize; 3],
}

/// Checks that two images can be compared.
///
/// # Errors
/// [`ShapeMismatch`] if they differ in size or number of channels.
pub fn same_shape(test: &[Film], reference: &[Film]) -> Result<(), ShapeMismatch> {
    let all = test.iter().chain(reference);
    let one_size =
        all.clone().all(|f| (f.width(), f.height()) == (test[0].width(), test[0].height()));
    if one_size && test.len() == reference.len() {
        return Ok(());
    }
    let shape = |image: &[Film]| {
        let side = |f: fn(&Film) -> usize| image.first().map_or(0, f);
        [side(Film::width), side(Film::height), image.len()]
    };
    Err(ShapeMismatch { test: shape(test), reference: shape(reference) })
}

/// The data range L: the reference's greatest pixel, or 1 if it has no light.
fn data_range(reference: &[Film]) -> f64 {
    let greatest = pixelwise::greatest(reference);
    if greatest > 0.0 { greatest } else { 1.0 }
}

/// The mean SSIM of the channels.
fn structure(test: &[Film], reference: &[Film]) -> Option<f64> {
    let range = data_range(reference);
    let channels: Option<Vec<f64>> =
        test.iter().zip(reference).map(|(test, reference)| ssim(test, reference, range)).collect();
    let channels = channels?;
    Some(channels.iter().sum::<f64>() / channels.len() as f64)
}

#[cfg(test)]
mod tests;
