//! Where a fit starts: the first guess of a peak, and further starts.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::problem::EXPONENTS;
use super::{Directions, Peak};
use crate::geometry::Frame;
use crate::geometry::elementary::{exp64, ln64};

/// A peak at the largest residual, as high as it, with the exponent that its fall-off asks for; `None`
/// if no residual is positive.
///
/// Towards a neighbour at angle γ a peak of exponent n falls by cosⁿγ, so n = ln(N/N₀)/ln cos γ. The
/// mean over the neighbours weighs each by (1 − cos γ)², as the nearest say the least.
pub fn first_guess(residual: &[f64], directions: &Directions) -> Option<Peak> {
    let highest = |best: usize, i: usize| if residual[i] > residual[best] { i } else { best };
    let at = (0..residual.len().min(directions.count())).reduce(highest)?;
    let amplitude = residual[at];
    if amplitude <= 0.0 {
        return None;
    }
    let direction = directions.at(at);
    let (mut sum, mut total) = (0.0, 0.0);
    for i in directions.neighbours(at) {
        let cosine = direction.dot(&directions.at(i));
        if cosine <= 0.0 || cosine >= 1.0 {
            continue;
        }
        // A neighbour at or below 0 fell as far as can be told.
        let fall = ln64((residual[i] / amplitude).clamp(1e-3, 1.0));
        let weight = (1.0 - cosine) * (1.0 - cosine);
        sum += weight * fall / ln64(cosine);
        total += weight;
    }
    let exponent = if total > 0.0 { sum / total } else { 1.0 };
    Some(Peak { amplitude, direction, exponent: exponent.clamp(0.1, EXPONENTS[1]) })
}

/// The start of a restart: the peaks so far, each disturbed by about its own width, and the first guess
/// of a peak more in what the disturbed ones leave. A function of `seed` alone.
pub(super) fn disturbed(peaks: &[Peak], seed: u64) -> Vec<Peak> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut symmetric = || (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    let disturb = |peak: &Peak| {
        let Frame { tangent, bitangent, .. } = Frame::about(peak.direction);
        // A peak falls to e^−½ of its height at an angle of about 1/√n.
        let width = 1.0 / (1.0 + peak.exponent).sqrt();
        let aside = tangent * (width * symmetric()) + bitangent * (width * symmetric());
        Peak {
            amplitude: peak.amplitude,
            direction: (peak.direction + aside).normalize(),
            exponent: (peak.exponent * exp64(symmetric())).clamp(EXPONENTS[0], EXPONENTS[1]),
        }
    };
    peaks.iter().map(disturb).collect()
}
