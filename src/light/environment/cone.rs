//! Means of an environment over cones: round ones by level alone, elliptic ones by a few of those.

use super::Environment;
use crate::geometry::Vec3;

/// The most round probes of an elliptic cone.
pub const PROBES: usize = 13;

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
        let axis = if b.abs() > 0.0 || half < 0.0 { [b, long - a] } else { [1.0, 0.0] };
        let axis = if axis == [0.0, 0.0] { [1.0, 0.0] } else { axis };
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
        let weights = &WEIGHTS[pairs - 1];
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

/// Weights of the middle probe and of each that follows to a side, for 1 to 6 pairs: e^(−f k²), which sum to
/// 1 over all probes, with f such that the variance of the places is what it should be, [`REACH`]⁻² of the
/// farthest place's square.
const WEIGHTS: [[f64; PROBES / 2 + 1]; PROBES / 2] = [
    [0.793388429752066, 0.103305785123967, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.430617522055234, 0.241847271797888, 0.042843967174495, 0.0, 0.0, 0.0, 0.0],
    [0.282118191320538, 0.221086892974959, 0.10640418582844, 0.031449825536331, 0.0, 0.0, 0.0],
    [
        0.209166703769548,
        0.183266302822501,
        0.123268700273687,
        0.063650694605485,
        0.025230950413554,
        0.0,
        0.0,
    ],
    [
        0.166010133561376,
        0.152883064341942,
        0.119408081054464,
        0.07909656423579,
        0.044435603140071,
        0.021171620447045,
        0.0,
    ],
    [
        0.137544324728575,
        0.130045104983598,
        0.109912734288933,
        0.083043315955169,
        0.056087233777067,
        0.033863046583649,
        0.018276402047296,
    ],
];
