//! A ripple that runs out (Blinn 1978 §3).

use std::f64::consts::TAU;

use super::{Bumps, Card, Entry, analytic};
use crate::parameter::{Domain, Parameter, Values};

/// Rings about the middle of the tile: F = h cos(2π n ρ) (1 − ρ²)², ρ the distance from the middle over half the
/// shorter side, nothing beyond ρ = 1. Slopes are continuous everywhere.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "ripple",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3 (a function in closed form)",
        summary: "Rings about the middle of the tile that run out towards its sides.",
    },
    parameters: &[
        Parameter {
            name: "rings",
            meaning: "crests from the middle to the side",
            domain: Domain::Real { default: 4.0, min: 0.0, max: 1000.0 },
        },
        Parameter {
            name: "rise",
            meaning: "height in the middle, widths of the tile",
            domain: Domain::Real { default: 0.012, min: -100.0, max: 100.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let [rings, h] = ["rings", "rise"].map(|name| values.number(name));
    let aspect = height as f64 / width as f64;
    let radius = 0.5 * aspect.min(1.0);
    analytic::bumps(width, height, |u, v| {
        let [x, y] = [(u - 0.5) / radius, (v - 0.5) * aspect / radius];
        let rho = (x * x + y * y).sqrt();
        if rho >= 1.0 {
            return [0.0; 3];
        }
        let inside = 1.0 - rho * rho;
        let (sin, cos) = libm::sincos(TAU * rings * rho);
        let falling = -TAU * rings * sin * inside * inside - 4.0 * rho * inside * cos;
        let outwards = h * falling / radius / rho.max(f64::MIN_POSITIVE);
        [h * cos * inside * inside, outwards * x, outwards * y * aspect]
    })
}
