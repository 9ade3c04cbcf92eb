//! Floor 4: error measures between images, and between distributions of normals.
//!
//! Images are linear and compared as they are, without a tone curve. An image is a list of channels,
//! each a [`Film`]; a rendering has one. [`entries`] lists the measures with their formulas, in which A
//! is the image, R the reference, and sums and means run over all pixels of all channels.

mod distribution;
mod equivalent;
mod flicker;
mod flip;
mod lead;
mod luminance;
mod ms_ssim;
mod pixelwise;
mod registry;
mod ssim;
mod uncertain;
mod viewing;

pub use distribution::{EVEN, SLICES, kl_divergence, total_variation, wasserstein};
pub use equivalent::{Equivalent, SpeedUp, equivalent_samples};
pub use flicker::{Flicker, Step, flicker_map};
pub use flip::{Exposures, exposures};
pub use lead::{Lead, Verdict, Z};
pub use ms_ssim::SCALE_WEIGHTS;
pub use pixelwise::{DARK, HIGHLIGHT};
pub use registry::{entries, find};
pub use ssim::{K1, K2, SIGMA, WINDOW, ssim};
pub use uncertain::{Uncertain, mse_gap};
pub use viewing::{PPD, Values, Viewing};

use rayon::prelude::*;

use crate::render::Film;
use pixelwise::Pixelwise;

/// A measure of how far an image is from a reference.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name in the `metric` column of `metrics.csv`. A variant's name is that of its metric, a colon and
    /// whose it is: `relmse:pbrt`.
    pub name: &'static str,
    /// What it tells, in a few words.
    pub meaning: &'static str,
    /// Its formula, with its constants.
    pub formula: &'static str,
    /// Which values are good.
    pub best: Best,
    /// Whether the trials of experiments are scored by it.
    pub swept: bool,
    measure: Measure,
}

/// How a metric is computed.
#[derive(Clone, Copy, Debug)]
enum Measure {
    /// Pixel by pixel.
    Pixelwise(Pixelwise),
    /// As the mean of values that neighbourhoods have.
    Local(LocalMeasure),
    /// At once.
    Whole(fn(&[Film], &[Film], &Viewing) -> Option<f64>),
}

/// The values that neighbourhoods have.
type LocalMeasure = fn(&[Film], &[Film], &Viewing) -> Option<Field>;

/// Values on a grid of pixels, row by row, in double precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Values across.
    pub width: usize,
    /// All values, row by row from the top.
    pub values: Vec<f64>,
}

impl Field {
    /// The mean of all values; NaN of none.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }
}

/// The mean of several channels' fields of one size; `None` of none.
fn mean_field(channels: &[Field]) -> Option<Field> {
    let (first, more) = channels.split_first()?;
    let mut sum = first.clone();
    for field in more {
        sum.values.iter_mut().zip(&field.values).for_each(|(sum, value)| *sum += value);
    }
    sum.values.iter_mut().for_each(|sum| *sum /= channels.len() as f64);
    Some(sum)
}

/// A score, and where the score against a reference without noise lies 95 times in 100, if that is known.
pub type Scored = (&'static str, f64, Option<[f64; 2]>);

/// The scores of a rendering with their intervals; see [`scores_with_errors`].
///
/// # Panics
/// If the films or the variances differ in size: a programming error.
pub fn scores_with_intervals(test: &Film, reference: &Film, variance: &[f64]) -> Vec<Scored> {
    let least = |name| match find(name).map(|metric| metric.best) {
        Some(Best::Highest) | None => f64::NEG_INFINITY,
        Some(Best::Lowest | Best::One) => 0.0,
    };
    let found = scores_with_errors(test, reference, variance).into_iter();
    found.map(|(name, of)| (name, of.value, Some(of.interval(least(name))))).collect()
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

impl Metric {
    /// Its value for an image of one channel or more beside its reference. `None` if it has no finite value: SSIM
    /// of an image under 11 pixels, PSNR of an image equal to its reference, ratios to a black reference.
    ///
    /// # Panics
    /// If the images differ in size or number of channels: a programming error; [`same_shape`] checks images of the
    /// user's.
    pub fn value(&self, test: &[Film], reference: &[Film]) -> Option<f64> {
        self.value_seen(test, reference, &Viewing::default())
    }

    /// The same of images that hold something else than radiances, or are looked at by another viewer.
    ///
    /// # Panics
    /// As [`Metric::value`].
    pub fn value_seen(&self, test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<f64> {
        if let Err(error) = same_shape(test, reference) {
            panic!("{error}");
        }
        let value = match self.measure {
            Measure::Pixelwise(metric) => metric.value(test, reference, viewing),
            Measure::Local(field) => field(test, reference, viewing).map(|field| field.mean()),
            Measure::Whole(value) => value(test, reference, viewing),
        };
        value.filter(|value| value.is_finite())
    }

    /// Its value in each pixel or window, of metrics that are means of such: an error map. `None` of the others, and as
    /// of [`Metric::value`].
    ///
    /// # Panics
    /// As [`Metric::value`].
    pub fn field(&self, test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<Field> {
        match self.measure {
            Measure::Local(field) => field(test, reference, viewing),
            Measure::Pixelwise(_) | Measure::Whole(_) => None,
        }
    }

    /// Its value for a rendering, and what the reference's noise makes of it; `variance` has the variance of each
    /// pixel of the reference, row by row. `None` as of [`Metric::value`].
    ///
    /// # Panics
    /// If the films or the variances differ in size: a programming error.
    pub fn uncertain(&self, test: &Film, reference: &Film, variance: &[f64]) -> Option<Uncertain> {
        assert_eq!(variance.len(), reference.pixels().len(), "a variance for each pixel");
        let found = match self.measure {
            Measure::Pixelwise(metric) => uncertain::pixelwise(&metric, test, reference, variance),
            Measure::Local(field) => uncertain::local(field, test, reference, variance),
            Measure::Whole(value) => uncertain::whole(value, test, reference, variance),
        };
        found.filter(|found| found.value.is_finite())
    }
}

/// The scores of a rendering against its reference, by metric name, in the order of [`entries`]: of the metrics
/// that experiments use. A score that has no finite value is left out; see [`Metric::value`].
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
    each(|metric| metric.value(test, reference))
}

/// The scores of a rendering as of [`scores`], each with what the reference's noise makes of it; `variance` has the
/// variance of each pixel of the reference, row by row.
///
/// # Panics
/// If the films or the variances differ in size: a programming error.
pub fn scores_with_errors(
    test: &Film,
    reference: &Film,
    variance: &[f64],
) -> Vec<(&'static str, Uncertain)> {
    each(|metric| metric.uncertain(test, reference, variance))
}

/// What each metric of experiments has to say, all at once and in their order.
fn each<T: Send>(of: impl Fn(&'static Metric) -> Option<T> + Sync) -> Vec<(&'static str, T)> {
    let swept: Vec<&Metric> = entries().iter().filter(|metric| metric.swept).collect();
    let found: Vec<Option<T>> = swept.par_iter().map(|metric| of(metric)).collect();
    swept.iter().zip(found).filter_map(|(metric, found)| Some((metric.name, found?))).collect()
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

#[cfg(test)]
mod tests;
