//! Measures that are sums over pixels, in double precision and in the order of the pixels.

use super::data_range;
use crate::render::Film;

/// ε of `relmse` as a part of the squared mean of the reference. It keeps dark pixels from deciding,
/// and scales with the light, so that the measure does not depend on exposure.
pub const DARK: f64 = 0.01;

/// A pixel is of the highlight if the reference exceeds this part of its greatest pixel there.
pub const HIGHLIGHT: f64 = 0.5;

/// Every pixel of the image and the reference, channel after channel.
fn pairs<'a>(test: &'a [Film], reference: &'a [Film]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let films = test.iter().zip(reference);
    let pixels = films.flat_map(|(test, reference)| test.pixels().iter().zip(reference.pixels()));
    pixels.map(|(a, r)| (f64::from(*a), f64::from(*r)))
}

/// The mean of `f(A, R)` over all pixels; `None` without pixels.
fn mean(test: &[Film], reference: &[Film], f: impl Fn(f64, f64) -> f64) -> Option<f64> {
    let count: usize = test.iter().map(|film| film.pixels().len()).sum();
    let sum: f64 = pairs(test, reference).map(|(a, r)| f(a, r)).sum();
    (count > 0).then(|| sum / count as f64)
}

fn mse(test: &[Film], reference: &[Film]) -> Option<f64> {
    mean(test, reference, |a, r| (a - r) * (a - r))
}

/// The greatest pixel; 0 if there is none above.
pub(super) fn greatest(image: &[Film]) -> f64 {
    image.iter().flat_map(Film::pixels).fold(0.0, |most, &pixel| f64::from(pixel).max(most))
}

pub(super) fn rmse(test: &[Film], reference: &[Film]) -> Option<f64> {
    mse(test, reference).map(f64::sqrt)
}

pub(super) fn relmse(test: &[Film], reference: &[Film]) -> Option<f64> {
    let level = mean(test, reference, |_, r| r)?;
    let epsilon = DARK * level * level;
    mean(test, reference, |a, r| (a - r) * (a - r) / (r * r + epsilon))
}

pub(super) fn psnr(test: &[Film], reference: &[Film]) -> Option<f64> {
    let range = data_range(reference);
    mse(test, reference).map(|mse| 10.0 * libm::log10(range * range / mse))
}

pub(super) fn energy(test: &[Film], reference: &[Film]) -> Option<f64> {
    ratio(pairs(test, reference))
}

pub(super) fn highlight_energy(test: &[Film], reference: &[Film]) -> Option<f64> {
    let threshold = HIGHLIGHT * greatest(reference);
    ratio(pairs(test, reference).filter(|(_, r)| *r > threshold))
}

/// Σ A / Σ R.
fn ratio(pairs: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let (a, r) = pairs.fold((0.0, 0.0), |(a, r), pair| (a + pair.0, r + pair.1));
    (r > 0.0).then(|| a / r)
}
