//! Means of an environment over cones: round ones by level alone, elliptic ones by a few of those.

use std::sync::LazyLock;

use super::Environment;
use crate::geometry::Vec3;
use crate::geometry::elementary::exp64;

/// The most round probes of an elliptic cone.
pub const PROBES: usize = 33;

/// Distance of neighbouring probes in standard deviations of one.
const SPACING: f64 = 1.5;
/// How far probes reach, in standard deviations of the long axis that the probes do not have themselves.
const REACH: f64 = 2.2;
/// The most variance that places of probes have, radians²: they stay on one side of the sphere.
const FARTHEST: f64 = 0.5;

impl Environment {
    /// The mean of the environment about a unit direction, weighted by a von Mises-Fisher distribution of
    /// variance `variance` per axis, radians².
    #[inline]
    pub fn cone(&self, direction: &Vec3, variance: f64) -> f64 {
        let spot = self.spot(direction);
        self.levels.at(&self.map, spot, variance)
    }

    /// The mean about a unit `direction`, weighted by a Gaussian of covariance `covariance` (a b; b c) in
    /// the directions `frame`, two unit vectors across it and each other, radians².
    ///
    /// Round probes as wide as the short axis stand along the great circle of the long axis, their weights
    /// a Gaussian's, as texture hardware filters anisotropically (Schilling 1997, conclusion, and his
    /// *Antialiasing of Environment Maps*: a mip map and several probes along the long axis). There are
    /// at most [`PROBES`]; where the ellipse is longer, they are wider.
    pub fn elliptic_cone(&self, direction: &Vec3, frame: &[Vec3; 2], [a, b, c]: [f64; 3]) -> f64 {
        let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
        let radius = (half * half + b * b).sqrt();
        let (long, short) = (mean + radius, (mean - radius).max(0.0));
        // Probes reach ±REACH of what they lack of the long axis.
        let most = 0.5 * (PROBES - 1) as f64 * SPACING / REACH;
        let width = short.max(long / (1.0 + most * most)).max(long - FARTHEST);
        let lacking = (long - width).max(0.0);
        let count = (REACH / SPACING * (lacking / width.max(f64::MIN_POSITIVE)).sqrt()).ceil();
        if count < 1.0 || lacking < 0.02 * long {
            return self.cone(direction, mean);
        }
        // The long axis, as the longer of two forms of it.
        let axis = if half < 0.0 { [b, long - a] } else { [long - c, b] };
        let along = (frame[0] * axis[0] + frame[1] * axis[1]).normalize();
        self.row_of_probes(direction, &along, width, lacking, (count as usize).min(PROBES / 2))
    }

    /// 2 `pairs` + 1 probes of variance `width` along a great circle; that of their places is `lacking`.
    fn row_of_probes(
        &self,
        direction: &Vec3,
        along: &Vec3,
        width: f64,
        lacking: f64,
        pairs: usize,
    ) -> f64 {
        let weights = &weights()[pairs - 1];
        let (sin, cos) = libm::sincos(REACH * lacking.sqrt() / pairs as f64);
        let mut sum = weights[0] * self.cone(direction, width);
        let (mut across, mut ahead) = (0.0, 1.0);
        for weight in &weights[1..=pairs] {
            (ahead, across) = (ahead * cos - across * sin, across * cos + ahead * sin);
            let [one, other] =
                [across, -across].map(|s| self.cone(&(direction * ahead + along * s), width));
            sum += weight * (one + other);
        }
        sum
    }
}

/// Weights of the middle probe and of each that follows to a side, for 1 to [`PROBES`]/2 pairs.
fn weights() -> &'static [Vec<f64>] {
    static ALL: LazyLock<Vec<Vec<f64>>> =
        LazyLock::new(|| (1..=PROBES / 2).map(of_pairs).collect());
    &ALL
}

/// e^(−f k²), which sum to 1 over all probes, with f such that the variance of the places is what it should be:
/// [`REACH`]⁻² of the farthest place's square. It falls with f, which is found by halving.
fn of_pairs(pairs: usize) -> Vec<f64> {
    let normalised = |f: f64| {
        let raw: Vec<f64> = (0..=pairs).map(|k| exp64(-f * (k * k) as f64)).collect();
        let total = raw.iter().skip(1).fold(raw[0], |sum, weight| sum + 2.0 * weight);
        raw.into_iter().map(|weight| weight / total).collect::<Vec<f64>>()
    };
    let variance = |weights: &[f64]| {
        weights.iter().enumerate().fold(0.0, |sum, (k, weight)| sum + 2.0 * weight * (k * k) as f64)
    };
    let wanted = (pairs as f64 / REACH) * (pairs as f64 / REACH);
    let (mut low, mut high) = (0.0, 8.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if variance(&normalised(middle)) > wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    normalised(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_the_variance_they_should() {
        for (k, weights) in weights().iter().enumerate() {
            let pairs = (k + 1) as f64;
            let (mut total, mut second) = (weights[0], 0.0);
            for (place, weight) in weights.iter().enumerate().skip(1) {
                total += 2.0 * weight;
                second += 2.0 * weight * (place * place) as f64;
            }
            assert!((total - 1.0).abs() < 1e-12);
            assert!((second * REACH * REACH / (pairs * pairs) - 1.0).abs() < 1e-9, "{pairs}");
        }
    }
}
