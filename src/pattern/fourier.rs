//! A Fourier series in u and v (Blinn 1978 §3).

use std::f64::consts::TAU;

use super::{Bumps, Card, Entry, analytic};
use crate::parameter::{Column, Domain, Parameter, Values};

/// F(u, v) = Σ a cos 2π(k u + l v) + b sin 2π(k u + l v), u and v from 0 to 1 over the tile and F in widths of
/// the tile. Its own derivatives are its slopes. Waves that the texels cannot hold are folded, as any sampling
/// folds them.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "fourier",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3 (a bivariate Fourier series)",
        summary: "A Fourier series in u and v of given coefficients.",
    },
    parameters: &[Parameter {
        name: "terms",
        meaning: "the terms a cos 2π(k u + l v) + b sin 2π(k u + l v), heights in widths of the tile",
        domain: Domain::Rows {
            columns: &[
                Column { name: "k", min: -2048.0, max: 2048.0, whole: true },
                Column { name: "l", min: -2048.0, max: 2048.0, whole: true },
                Column { name: "a", min: -1000.0, max: 1000.0, whole: false },
                Column { name: "b", min: -1000.0, max: 1000.0, whole: false },
            ],
            default: &[
                &[1.0, 2.0, 0.012, 0.0],
                &[3.0, -1.0, 0.0, 0.008],
                &[4.0, 5.0, 0.003, 0.003],
                &[-7.0, 2.0, 0.0, 0.002],
            ],
            most: 1024,
        },
    }],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let terms = values.rows("terms");
    analytic::bumps(width, height, |u, v| {
        terms.iter().fold([0.0; 3], |sum, term| {
            let [k, l, a, b] = [term[0], term[1], term[2], term[3]];
            let (sin, cos) = libm::sincos(TAU * (k * u + l * v));
            let slope = TAU * (b * cos - a * sin);
            [sum[0] + a * cos + b * sin, sum[1] + k * slope, sum[2] + l * slope]
        })
    })
}
