//! The moon over a dim horizon.

use std::f64::consts::TAU;

use super::{Card, Entry, step};
use crate::geometry::Vec3;
use crate::geometry::elementary::exp64;
use crate::parameter::{Domain, Parameter};

/// A disc straight ahead (+y) in a night sky.
///
/// The disc is even, its irradiance on a plane facing it 1: L = 1 / (2π (1 − cos r)). The sky's radiance
/// is `glow` at the horizon and falls by e each 15° upwards, to a tenth of it; below the horizon it is a
/// twentieth.
pub(super) const ENTRY: Entry = Entry {
    card: Card {
        name: "moon",
        source: "Schilling 1997, Antialiasing of Bump-Maps, figures 8 and 9 (no numbers are printed)",
        summary: "A moon straight ahead over a dim horizon; its irradiance is 1.",
    },
    parameters: &[
        Parameter {
            name: "elevation",
            meaning: "the moon's height above the horizon, degrees",
            domain: Domain::Real { default: 25.0, min: -90.0, max: 90.0 },
        },
        Parameter {
            name: "diameter",
            meaning: "the moon's diameter, degrees (the real one has half a degree)",
            domain: Domain::Real { default: 5.0, min: 0.5, max: 60.0 },
        },
        Parameter {
            name: "glow",
            meaning: "radiance of the sky at the horizon",
            domain: Domain::Real { default: 0.3, min: 0.0, max: 1000.0 },
        },
    ],
    build: |values| {
        let (sin, cos) = libm::sincos(values.number("elevation").to_radians());
        let moon = Vec3::new(0.0, cos, sin);
        let edge = libm::cos(0.5 * values.number("diameter").to_radians());
        let (disc, glow) = (1.0 / (TAU * (1.0 - edge)), values.number("glow"));
        Box::new(move |direction| {
            let up = libm::asin(direction.z.clamp(-1.0, 1.0)).to_degrees();
            let sky = 0.1 + 0.9 * exp64(-up.max(0.0) / 15.0);
            let shore = step(-0.5, 0.5, up);
            let night = glow * (0.05 + (sky - 0.05) * shore);
            if direction.dot(&moon) > edge { night + disc } else { night }
        })
    },
};
