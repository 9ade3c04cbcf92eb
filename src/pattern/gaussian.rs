//! Gaussian random surfaces: heights, and so slopes, normally distributed.
//!
//! Spectral synthesis: a cosine wave of random phase for every wave vector (kx, ky) that repeats with
//! the tile, its squared amplitude in proportion to exp(−(kx² Lx² + ky² Ly²)/4), the spectrum of the
//! autocorrelation exp(−x²/Lx² − y²/Ly²). Slopes are then sums of many small independent waves: near
//! normal in two dimensions, the better the more bumps fit in the tile.
//!
//! With σx² and σy² the slope variances, Lx/Ly = σy/σx. The correlation length given is the one along
//! the steeper axis; the other is found so that *this tile's* waves have exactly the ratio asked for.

use std::f64::consts::TAU;

use super::spectrum::{Field, Wave, most_periods, uniform};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};

/// A periodic random surface with stated slope variances along u and v and no covariance.
///
/// Heights are scaled so that the mean over the texels of (∂F/∂x)² *is* `slope_variance_u`, and of
/// (∂F/∂y)² `slope_variance_v`, for every seed: realised values, not expectations. (Waves of whole
/// periods below half a period a texel are orthogonal over the texels, so the mean slopes and their
/// covariance are 0 as well.) Slopes are the waves' own derivatives.
///
/// A side of one or two texels holds no wave, so there is no slope along it; notes say so.
///
/// Source: the random-phase method (Rice 1944; Shinozuka and Jan 1972, *Digital Simulation of Random
/// Processes and its Applications*).
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "gaussian",
        source: "Shinozuka and Jan 1972, Digital Simulation of Random Processes (random phases)",
        summary: "A Gaussian random surface with stated slope variances along u and v.",
    },
    parameters: &[
        Parameter {
            name: "slope_variance_u",
            meaning: "variance of the slope along u, (height per length) squared",
            domain: Domain::Real { default: 0.04, min: 0.0, max: 100.0 },
        },
        Parameter {
            name: "slope_variance_v",
            meaning: "variance of the slope along v, (height per length) squared",
            domain: Domain::Real { default: 0.04, min: 0.0, max: 100.0 },
        },
        Parameter {
            name: "correlation_length",
            meaning: "distance along the steeper axis over which the heights' correlation falls \
                      to 1/e, texels",
            domain: Domain::Real { default: 6.0, min: 1.0, max: 65536.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, seed: u64) -> Bumps {
    let size = [width, height];
    let mut notes = vec![];
    let mut variance = ["slope_variance_u", "slope_variance_v"].map(|name| values.number(name));
    for axis in [0, 1] {
        if variance[axis] > 0.0 && most_periods(size[axis]) == 0 {
            let (name, side) = (["u", "v"][axis], size[axis]);
            notes.push(format!("no slope along {name}: a side of {side} texels holds no wave"));
            variance[axis] = 0.0;
        }
    }
    let steep = usize::from(variance[1] > variance[0]);
    if variance[steep] == 0.0 {
        return Field::new(width, height, &[]).bumps(0.0, notes);
    }
    let spectrum = spectrum(size, variance, steep, values.number("correlation_length"), &mut notes);
    let field = Field::new(width, height, &waves(&spectrum, seed));
    let scale = (variance[steep] / field.mean_square_slopes()[steep]).sqrt();
    field.bumps(scale, notes)
}

/// The spectrum along u and along v, which multiply.
fn spectrum(
    size: [usize; 2],
    variance: [f64; 2],
    steep: usize,
    correlation_length: f64,
    notes: &mut Vec<String>,
) -> [Axis; 2] {
    let gentle = 1 - steep;
    // A quarter of the side: longer, and one wave would make the whole surface.
    let longest = size[steep] as f64 / 4.0;
    if correlation_length > longest {
        notes.push(format!("correlation length held to {longest} texels, a quarter of the side"));
    }
    let along_steep = Axis::new(size[steep], correlation_length.min(longest));
    let target = along_steep.mean_square() * variance[gentle] / variance[steep];
    let along_gentle = Axis::with_mean_square(size[gentle], target);
    let reached = along_gentle.mean_square() / target;
    if target > 0.0 && (reached - 1.0).abs() > 1e-6 {
        let (name, got) = (["u", "v"][gentle], variance[gentle] * reached);
        notes.push(format!(
            "slope variance along {name} is {got:.4}: the side is too short for more"
        ));
    }
    if steep == 0 { [along_steep, along_gentle] } else { [along_gentle, along_steep] }
}

/// One wave for each pair of periods, of one of each two opposite vectors.
fn waves([u, v]: &[Axis; 2], seed: u64) -> Vec<Wave> {
    let mut random = uniform(seed);
    let mut waves = vec![];
    for (m, power_u) in (0..).zip(&u.power) {
        let reach = v.power.len() as i32 - 1;
        for n in if m == 0 { 1 } else { -reach }..=reach {
            let power = power_u * v.power[n.unsigned_abs() as usize];
            waves.push(Wave { m, n, amplitude: power.sqrt(), phase: TAU * random() });
        }
    }
    waves
}

/// The spectrum along one axis: exp(−k² L²/4) at 0, 1, … periods; the same for negative ones.
struct Axis {
    size: usize,
    power: Vec<f64>,
}

impl Axis {
    /// Periods whose power is below this are left out; they would not change a single-precision normal.
    const FAINTEST: f64 = 1e-12;

    fn new(size: usize, correlation_length: f64) -> Self {
        let power = |periods: i32| {
            let phase = TAU * f64::from(periods) / size as f64 * correlation_length;
            libm::exp(-phase * phase / 4.0)
        };
        let bright = |&p: &f64| p > Self::FAINTEST;
        Self { size, power: (0..=most_periods(size)).map(power).take_while(bright).collect() }
    }

    /// Mean of k² over the spectrum, radians² a texel².
    fn mean_square(&self) -> f64 {
        let (mut square, mut total) = (0.0, self.power[0]);
        for (periods, power) in self.power.iter().enumerate().skip(1) {
            let k = TAU * periods as f64 / self.size as f64;
            square += 2.0 * k * k * power;
            total += 2.0 * power;
        }
        square / total
    }

    /// The spectrum with this mean of k², which falls as the correlation length grows: by bisection. A
    /// target above what the axis can hold gives the nearest; 0 gives no wave at all.
    fn with_mean_square(size: usize, target: f64) -> Self {
        let (mut short, mut long) = (1e-6_f64, 1e12);
        for _ in 0..100 {
            let middle = (short * long).sqrt();
            if Self::new(size, middle).mean_square() > target {
                short = middle
            } else {
                long = middle
            }
        }
        Self::new(size, long)
    }
}
