//! Mounds: Gaussian bumps (Blinn 1978 §3).

use super::{Bumps, Card, Entry, analytic};
use crate::parameter::{Domain, Parameter, Values};

/// Gaussian bells in a square array, each with the tails of its eight neighbours: F = h exp(−r²/2σ²), F, r and σ
/// in widths of a cell.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "mound",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3 (a function in closed form)",
        summary: "Smooth mounds in a square array: Gaussian bells.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "mounds along each side of the tile",
            domain: Domain::Whole { default: 1, min: 1, max: 1024 },
        },
        Parameter {
            name: "rise",
            meaning: "height of a mound, widths of its cell",
            domain: Domain::Real { default: 0.1, min: -100.0, max: 100.0 },
        },
        Parameter {
            name: "spread",
            meaning: "standard deviation of its bell, widths of its cell",
            domain: Domain::Real { default: 0.15, min: 0.001, max: 0.25 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let [count, h, sigma] = ["count", "rise", "spread"].map(|name| values.number(name));
    // Cells are as wide as the tile's width says; r is measured in that unit along v too.
    let aspect = height as f64 / width as f64;
    analytic::bumps(width, height, |u, v| {
        let [x, y] = [u, v].map(|c| c * count - libm::floor(c * count) - 0.5);
        let mut sum = [0.0; 3];
        for (i, j) in (0..9).map(|k| (f64::from(k % 3 - 1), f64::from(k / 3 - 1))) {
            let (x, y) = (x - i, (y - j) * aspect);
            let bell = h * libm::exp(-(x * x + y * y) / (2.0 * sigma * sigma));
            let steep = -bell / (sigma * sigma);
            sum[0] += bell / count;
            sum[1] += steep * x;
            sum[2] += steep * y * aspect;
        }
        sum
    })
}
