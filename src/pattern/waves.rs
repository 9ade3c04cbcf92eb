//! A few sinusoids that cross (Blinn 1978 §3: "a bivariate Fourier series").

use std::f64::consts::TAU;

use super::spectrum::{Field, Wave, most_periods, uniform};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};

/// A sum of cosine waves of about one length, with seeded directions and phases.
///
/// Each wave's vector is moved to the nearest one that repeats with the tile and that the texels can
/// hold (fewer than half a period a texel), so lengths and directions are kept roughly in small tiles.
/// All waves are equally steep, and the whole is scaled so that the root mean square of |∇F| over the
/// texels is `slope` exactly. Slopes are the waves' own derivatives.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "waves",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3 (a bivariate Fourier series)",
        summary: "Crossing sinusoids, smooth everywhere.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "number of waves",
            domain: Domain::Whole { default: 5, min: 1, max: 64 },
        },
        Parameter {
            name: "wavelength",
            meaning: "distance between crests, texels",
            domain: Domain::Real { default: 24.0, min: 2.0, max: 65536.0 },
        },
        Parameter {
            name: "slope",
            meaning: "root mean square slope |grad F|, height per length",
            domain: Domain::Real { default: 0.3, min: 0.0, max: 10.0 },
        },
        Parameter {
            name: "direction",
            meaning: "the direction waves travel in, degrees from +u towards +v",
            domain: Domain::Real { default: 0.0, min: -360.0, max: 360.0 },
        },
        Parameter {
            name: "spread",
            meaning: "the range directions are drawn from, degrees (0: all alike)",
            domain: Domain::Real { default: 360.0, min: 0.0, max: 360.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, seed: u64) -> Bumps {
    let mut random = uniform(seed);
    let centre = values.number("direction").to_radians();
    let spread = values.number("spread").to_radians();
    let waves: Vec<Wave> = (0..values.whole("count"))
        .filter_map(|_| {
            let angle = centre + spread * (random() - 0.5);
            let phase = TAU * random();
            wave([width, height], values.number("wavelength"), angle, phase)
        })
        .collect();
    let field = Field::new(width, height, &waves);
    let [xx, yy] = field.mean_square_slopes();
    if xx + yy < 1e-12 {
        return field.bumps(0.0, vec!["the map is too small to hold a wave: it is flat".into()]);
    }
    field.bumps(values.number("slope") / (xx + yy).sqrt(), vec![])
}

/// A wave of slope amplitude 1 near this length and direction that the map can hold, if any.
fn wave(size: [usize; 2], wavelength: f64, angle: f64, phase: f64) -> Option<Wave> {
    let (sin, cos) = libm::sincos(angle);
    let wanted = [cos, sin].map(|c| c / wavelength);
    let held = |axis: usize| {
        let most = f64::from(most_periods(size[axis]));
        (wanted[axis] * size[axis] as f64).clamp(-most, most)
    };
    let exact = [held(0), held(1)];
    let mut periods = exact.map(|p| p.round() as i32);
    if periods == [0, 0] {
        // Longer than the tile: one period along the side it runs along most.
        let axis = usize::from(most_periods(size[0]) == 0 || exact[1].abs() > exact[0].abs());
        periods[axis] = most_periods(size[axis]).min(1);
    }
    let k = |axis: usize| TAU * f64::from(periods[axis]) / size[axis] as f64;
    let length = (k(0) * k(0) + k(1) * k(1)).sqrt();
    (length > 0.0).then(|| Wave { m: periods[0], n: periods[1], amplitude: 1.0 / length, phase })
}
