//! What a reference's noise makes of a score.
//!
//! A converged image R̂ = R + n is the truth R and noise n of mean 0, independent from pixel to pixel, of a
//! variance v that the reference knows. A score against R̂ is a random number then: on average it is off by a *bias*
//! (noise of the reference counts as error of the image: of a mean square error it is the mean of v), and it
//! scatters by a *standard error*. Both are told here, from one noisy reference.
//!
//! # Metrics of single pixels
//! The mean and variance of what a pixel adds, f(A, R̂ + n), are taken by Gauss and Hermite's rule of three points:
//! n = 0 and ± √(3v) with weights 2/3, 1/6 and 1/6. For a quadratic f the rule is exact: the bias of (A − R)² is v, its
//! variance 4 (A − R)² v + 2 v². Pixels are independent, so variances add. The outer function (a root, a logarithm) is
//! applied to what noise makes of the mean. An ε, threshold or peak that is drawn from the reference is taken as it is.
//!
//! The rule is applied about R̂, as R is not known. So (A − R̂)², which holds v, stands for (A − R)²: of an image whose
//! error is within the noise, the standard error of a mean square comes out up to √3 times too large.
//!
//! # Metrics of neighbourhoods
//! See `uncertain/local.rs`: one pair of noisy references, and the scatter from block to block.

mod local;

pub(super) use local::{local, whole};

use super::pixelwise::{Pixelwise, pairs};
use super::{Viewing, Z};
use crate::render::Film;

/// A score and what the reference's noise makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The score against the noisy reference.
    pub value: f64,
    /// By how much noise changes it on average: `value − bias` is about the score against the truth.
    pub bias: f64,
    /// The standard error, at least 0: how much it would scatter from one noisy reference to another.
    pub error: f64,
}

impl Uncertain {
    /// Where the score against the truth lies 95 times in 100, of a score that cannot be below `least`.
    pub fn interval(&self, least: f64) -> [f64; 2] {
        let middle = self.value - self.bias;
        [middle - Z * self.error, middle + Z * self.error].map(|end| end.max(least))
    }
}

/// Gauss and Hermite's points in standard deviations, with their weights.
const POINTS: [(f64, f64); 3] =
    [(0.0, 2.0 / 3.0), (1.732_050_807_568_877_2, 1.0 / 6.0), (-1.732_050_807_568_877_2, 1.0 / 6.0)];

/// Sums over pixels of a metric's term and what it is divided by.
#[derive(Default)]
struct Sums {
    /// As measured.
    term: f64,
    over: f64,
    /// As expected when noise comes in once more.
    noisy_term: f64,
    noisy_over: f64,
}

/// A metric of single pixels; `variance` has one number for each pixel of the only channel.
pub(super) fn pixelwise(
    metric: &Pixelwise,
    test: &Film,
    reference: &Film,
    variance: &[f64],
) -> Option<Uncertain> {
    let (tests, references) = (std::slice::from_ref(test), std::slice::from_ref(reference));
    let level = metric.level_of(references, &Viewing::default());
    let at = |a: f64, r: f64| [(metric.term)(a, r, level), (metric.over)(a, r, level)];
    let mut sums = Sums::default();
    for ((a, r), v) in pairs(tests, references).zip(variance) {
        let sigma = v.max(0.0).sqrt();
        let [term, over] = at(a, r);
        (sums.term, sums.over) = (sums.term + term, sums.over + over);
        for (x, weight) in POINTS {
            let [term, over] = at(a, r + x * sigma);
            sums.noisy_term += weight * term;
            sums.noisy_over += weight * over;
        }
    }
    if sums.over <= 0.0 {
        return None;
    }
    let mean = sums.term / sums.over;
    let mut scatter = 0.0;
    for ((a, r), v) in pairs(tests, references).zip(variance) {
        let sigma = v.max(0.0).sqrt();
        // What the pixel does to a ratio, to first order.
        let pull = |x: f64| {
            let [term, over] = at(a, r + x * sigma);
            term - mean * over
        };
        let pulls = POINTS.map(|(x, weight)| (pull(x), weight));
        let average: f64 = pulls.iter().map(|(p, w)| p * w).sum();
        scatter += pulls.iter().map(|(p, w)| w * (p - average) * (p - average)).sum::<f64>();
    }
    let noisy = if sums.noisy_over > 0.0 { sums.noisy_term / sums.noisy_over } else { mean };
    Some(pushed(metric, level, mean, noisy - mean, scatter.sqrt() / sums.over))
}

/// Value, bias and error of a mean, through the outer function. The error is what one standard error more does to the
/// value, which is finite wherever the value is. A mean that the bias would take below 0 counts as 0; where that has no
/// value (decibels), the bias is what as much noise again would do.
fn pushed(metric: &Pixelwise, level: f64, mean: f64, bias: f64, error: f64) -> Uncertain {
    let outer = |mean: f64| metric.outer.of(mean, level);
    let value = outer(mean);
    let corrected = outer(mean - bias);
    let bias = if corrected.is_finite() { value - corrected } else { outer(mean + bias) - value };
    Uncertain { value, bias, error: (outer(mean + error) - value).abs() }
}

/// By how much the mean square error of `a` is above that of `b`, both against the same noisy reference, and the
/// standard error of that.
///
/// The difference is mean (A − B)(A + B − 2R): linear in the reference, so noise leaves it without bias, and where A and
/// B agree a pixel's noise does not count at all. Its variance is 4/N² Σ (A − B)² v, exactly. That is much less than
/// the variances of the two errors would have one think.
///
/// # Panics
/// If the films or the variances differ in size: a programming error.
pub fn mse_gap(a: &Film, b: &Film, reference: &Film, variance: &[f64]) -> (f64, f64) {
    let count = reference.pixels().len();
    let sizes = [a.pixels().len(), b.pixels().len(), variance.len()];
    assert_eq!(sizes, [count; 3], "films and variances of one size");
    let (mut gap, mut scatter) = (0.0, 0.0);
    for (i, v) in variance.iter().enumerate() {
        let [a, b, r] = [a, b, reference].map(|film| f64::from(film.pixels()[i]));
        gap += (a - b) * (a + b - 2.0 * r);
        scatter += (a - b) * (a - b) * v.max(0.0);
    }
    let count = count.max(1) as f64;
    (gap / count, 2.0 * scatter.sqrt() / count)
}

#[cfg(test)]
mod tests;
