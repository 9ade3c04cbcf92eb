//! Where a fit starts: the first guess of a peak.

use super::problem::EXPONENTS;
use super::{Directions, Peak};
use crate::geometry::elementary::ln64;

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
