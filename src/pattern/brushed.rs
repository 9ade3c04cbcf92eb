//! Brushed metal (Schilling 1997: "brushed metal, small scrapes on a glossy surface").

use std::f64::consts::{PI, TAU};

use super::spectrum::{Field, uniform};
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};

/// Long fine scratches along u at random places: each a groove with a Gaussian profile across and a bulge's,
/// sin², along, so that it has no ends. Lengths vary by half either way, depths from a quarter to all.
///
/// Heights are scaled so that the root mean square slope across the scratches *is* `slope` over the texels. The
/// tile repeats: a scratch that leaves it comes in at the other side.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "brushed",
        source: "Schilling 1997, Antialiasing of Bump-Maps (brushed metal)",
        summary: "Brushed metal: long fine scratches along u.",
    },
    parameters: &[
        Parameter {
            name: "length",
            meaning: "mean length of a scratch, texels",
            domain: Domain::Real { default: 96.0, min: 4.0, max: 4096.0 },
        },
        Parameter {
            name: "breadth",
            meaning: "standard deviation of a scratch's profile, texels",
            domain: Domain::Real { default: 1.0, min: 0.5, max: 8.0 },
        },
        Parameter {
            name: "density",
            meaning: "scratches that a line across them meets, a texel",
            domain: Domain::Real { default: 0.5, min: 0.01, max: 2.0 },
        },
        Parameter {
            name: "slope",
            meaning: "root mean square slope across the scratches, height per length",
            domain: Domain::Real { default: 0.2, min: 0.0, max: 10.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, seed: u64) -> Bumps {
    let [length, deviation, density] =
        ["length", "breadth", "density"].map(|key| values.number(key));
    let mut random = uniform(seed);
    let mut points = vec![[0.0; 3]; width * height];
    let count = (density * (width * height) as f64 / length).ceil() as usize;
    for _ in 0..count {
        let scratch = Scratch {
            start: random() * width as f64,
            centre: random() * height as f64,
            length: length * (0.5 + random()),
            depth: 0.25 + 0.75 * random(),
            deviation,
        };
        scratch.carve(&mut points, width, height);
    }
    let field = Field::from_points(width, points);
    let across = field.mean_square_slopes()[1];
    if across < 1e-12 {
        let flat = Field::from_points(width, vec![[0.0; 3]; width * height]);
        return flat.bumps(0.0, vec!["the map is too small to hold a scratch: it is flat".into()]);
    }
    field.bumps(values.number("slope") / across.sqrt(), vec![])
}

/// A groove along u; texels.
struct Scratch {
    start: f64,
    centre: f64,
    length: f64,
    depth: f64,
    deviation: f64,
}

impl Scratch {
    /// Adds it to a field of [F, ∂F/∂x, ∂F/∂y], with what of it lies beyond the tile's sides.
    fn carve(&self, points: &mut [[f64; 3]], width: usize, height: usize) {
        /// Reach across, in standard deviations: exp(−r²/2) is 10⁻⁸ there.
        const REACH: f64 = 6.0;
        let across = texels(self.centre - REACH * self.deviation, 2.0 * REACH * self.deviation);
        let rows: Vec<(usize, [f64; 2])> = across
            .map(|j| {
                let y = (j as f64 + 0.5 - self.centre) / self.deviation;
                let profile = libm::exp(-0.5 * y * y);
                (wrapped(j, height), [profile, -y / self.deviation * profile])
            })
            .collect();
        for i in texels(self.start, self.length) {
            let (sin, cos) = libm::sincos(PI * (i as f64 + 0.5 - self.start) / self.length);
            let (bulge, growth) = (sin * sin, TAU / self.length * sin * cos);
            let column = wrapped(i, width);
            for &(row, [profile, slope]) in &rows {
                let point = &mut points[row * width + column];
                point[0] -= self.depth * bulge * profile;
                point[1] -= self.depth * growth * profile;
                point[2] -= self.depth * bulge * slope;
            }
        }
    }
}

/// The texels whose centres are in [start, start + length).
fn texels(start: f64, length: f64) -> std::ops::Range<i64> {
    (start - 0.5).ceil() as i64..(start + length - 0.5).ceil() as i64
}

fn wrapped(index: i64, size: usize) -> usize {
    index.rem_euclid(size as i64) as usize
}
