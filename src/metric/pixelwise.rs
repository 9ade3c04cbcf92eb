//! Metrics that are means over pixels, as data: what a pixel adds, what that is divided by, and what is made of
//! the mean. Sums are in double precision and in the order of the pixels.

use super::Viewing;
use crate::render::Film;

/// ε of `relmse` as a part of the squared mean of the reference. It keeps dark pixels from deciding,
/// and scales with the light, so that the measure does not depend on exposure. ε of `mape` and `smape`, which
/// are not squared, is its root times the mean.
pub const DARK: f64 = 0.01;

/// A pixel is of the highlight if the reference exceeds this part of its greatest pixel there.
pub const HIGHLIGHT: f64 = 0.5;

/// What a pixel adds, from A, R and the metric's level.
pub(super) type Term = fn(a: f64, r: f64, level: f64) -> f64;

/// A metric that looks at one pixel at a time: outer(Σ term / Σ over).
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixelwise {
    /// What a pixel adds.
    pub term: Term,
    /// What the sum is divided by, as a sum too: [`one`] for a mean.
    pub over: Term,
    /// A number drawn from the reference as a whole: an ε, a threshold, a peak.
    pub level: Level,
    /// What is made of the mean.
    pub outer: Outer,
}

/// A number that a metric draws from the reference as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Level {
    /// This number, whatever the reference.
    Fixed(f64),
    /// So many times the reference's mean.
    OfMean(f64),
    /// So many times the square of the reference's mean.
    OfSquaredMean(f64),
    /// So many times the reference's greatest pixel.
    OfGreatest(f64),
    /// The data range: of radiances the reference's greatest pixel, or 1 if it has no light; else 1.
    Range,
}

impl Level {
    fn of(self, reference: &[Film], viewing: &Viewing) -> f64 {
        match self {
            Self::Fixed(number) => number,
            Self::OfMean(part) => part * mean(reference),
            Self::OfSquaredMean(part) => {
                let mean = mean(reference);
                part * mean * mean
            }
            Self::OfGreatest(part) => part * greatest(reference),
            Self::Range => viewing.range(reference),
        }
    }
}

/// What is made of the mean m.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outer {
    /// m.
    Mean,
    /// √m.
    Root,
    /// 10 log₁₀ (L² / m), L the level.
    Decibels,
}

impl Outer {
    /// Of a mean at least 0 where a root or a logarithm is taken: less counts as 0.
    pub(super) fn of(self, mean: f64, level: f64) -> f64 {
        match self {
            Self::Mean => mean,
            Self::Root => mean.max(0.0).sqrt(),
            Self::Decibels => 10.0 * libm::log10(level * level / mean.max(0.0)),
        }
    }
}

impl Pixelwise {
    /// outer(mean of `term`), with nothing drawn from the reference.
    pub(super) const fn mean(term: Term) -> Self {
        Self { term, over: one, level: Level::Fixed(0.0), outer: Outer::Mean }
    }

    pub(super) const fn level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    pub(super) const fn outer(self, outer: Outer) -> Self {
        Self { outer, ..self }
    }

    pub(super) const fn over(self, over: Term) -> Self {
        Self { over, ..self }
    }

    /// Its level for a reference.
    pub(super) fn level_of(&self, reference: &[Film], viewing: &Viewing) -> f64 {
        self.level.of(reference, viewing)
    }

    /// Its value; `None` if there is nothing to divide by.
    pub(super) fn value(
        &self,
        test: &[Film],
        reference: &[Film],
        viewing: &Viewing,
    ) -> Option<f64> {
        let level = self.level_of(reference, viewing);
        let sums = pairs(test, reference).fold((0.0, 0.0), |(term, over), (a, r)| {
            (term + (self.term)(a, r, level), over + (self.over)(a, r, level))
        });
        (sums.1 > 0.0).then(|| self.outer.of(sums.0 / sums.1, level))
    }
}

/// 1: a mean over pixels.
pub(super) fn one(_: f64, _: f64, _: f64) -> f64 {
    1.0
}

/// |A − R|
pub(super) fn absolute(a: f64, r: f64, _: f64) -> f64 {
    (a - r).abs()
}

/// (A − R)²
pub(super) fn squared(a: f64, r: f64, _: f64) -> f64 {
    (a - r) * (a - r)
}

/// (A − R)² / (R² + ε)
pub(super) fn relative_squared(a: f64, r: f64, epsilon: f64) -> f64 {
    (a - r) * (a - r) / (r * r + epsilon)
}

/// (A − R)² / (R + ε)²
pub(super) fn shifted_squared(a: f64, r: f64, epsilon: f64) -> f64 {
    let over = r + epsilon;
    (a - r) * (a - r) / (over * over)
}

/// |A − R| / (|R| + ε)
pub(super) fn relative(a: f64, r: f64, epsilon: f64) -> f64 {
    (a - r).abs() / (r.abs() + epsilon)
}

/// |A − R| / (R + ε)
pub(super) fn relative_signed(a: f64, r: f64, epsilon: f64) -> f64 {
    (a - r).abs() / (r + epsilon)
}

/// 2 |A − R| / (|A| + |R| + 2 ε); 0 of two equal pixels.
pub(super) fn symmetric(a: f64, r: f64, epsilon: f64) -> f64 {
    if a == r { 0.0 } else { 2.0 * (a - r).abs() / (a.abs() + r.abs() + 2.0 * epsilon) }
}

/// A
pub(super) fn light(a: f64, _: f64, _: f64) -> f64 {
    a
}

/// R
pub(super) fn true_light(_: f64, r: f64, _: f64) -> f64 {
    r
}

/// A where R exceeds the level.
pub(super) fn bright(a: f64, r: f64, threshold: f64) -> f64 {
    if r > threshold { a } else { 0.0 }
}

/// R where it exceeds the level.
pub(super) fn truly_bright(_: f64, r: f64, threshold: f64) -> f64 {
    if r > threshold { r } else { 0.0 }
}

/// Every pixel of the image and the reference, channel after channel.
pub(super) fn pairs<'a>(
    test: &'a [Film],
    reference: &'a [Film],
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let films = test.iter().zip(reference);
    let pixels = films.flat_map(|(test, reference)| test.pixels().iter().zip(reference.pixels()));
    pixels.map(|(a, r)| (f64::from(*a), f64::from(*r)))
}

/// The mean over all pixels and channels; 0 without pixels.
fn mean(image: &[Film]) -> f64 {
    let pixels = image.iter().flat_map(Film::pixels);
    let (sum, count) = pixels.fold((0.0, 0usize), |(sum, n), &p| (sum + f64::from(p), n + 1));
    sum / count.max(1) as f64
}

/// The greatest pixel; 0 if there is none above.
fn greatest(image: &[Film]) -> f64 {
    image.iter().flat_map(Film::pixels).fold(0.0, |most, &pixel| f64::from(pixel).max(most))
}

/// The data range L: the reference's greatest pixel, or 1 if it has no light.
pub(super) fn data_range(reference: &[Film]) -> f64 {
    let greatest = greatest(reference);
    if greatest > 0.0 { greatest } else { 1.0 }
}
