//! A photographer's studio.

use super::{Card, Entry, step};
use crate::geometry::Vec3;
use crate::parameter::{Domain, Parameter};

/// A soft box: where it hangs (azimuth, elevation, degrees), half its width and height as tangents of
/// angles, and its radiance.
type SoftBox = ([f64; 2], [f64; 2], f64);

const BOXES: [SoftBox; 3] = [
    // The key light to the right, the fill to the left, a strip overhead.
    ([50.0, 40.0], [0.45, 0.35], 8.0),
    ([150.0, 25.0], [0.35, 0.5], 2.5),
    ([90.0, 85.0], [1.2, 0.15], 4.0),
];

/// Soft boxes in a dim room: radiance falls smoothly over the last `softness` of their half sides.
pub(super) const ENTRY: Entry = Entry {
    card: Card {
        name: "studio",
        source: "ours",
        summary: "A key light, a fill light and a strip overhead in a dim room.",
    },
    parameters: &[
        Parameter {
            name: "room",
            meaning: "radiance of the room",
            domain: Domain::Real { default: 0.1, min: 0.0, max: 1000.0 },
        },
        Parameter {
            name: "softness",
            meaning: "part of a box's half sides over which its light falls off",
            domain: Domain::Real { default: 0.3, min: 0.01, max: 1.0 },
        },
    ],
    build: |values| {
        let (room, softness) = (values.number("room"), values.number("softness"));
        Box::new(move |direction| {
            let boxes = BOXES.iter().map(|soft_box| sent(soft_box, softness, direction));
            room + boxes.sum::<f64>()
        })
    },
};

fn sent(&([azimuth, elevation], half, radiance): &SoftBox, softness: f64, direction: &Vec3) -> f64 {
    let (sin_a, cos_a) = libm::sincos(azimuth.to_radians());
    let (sin_e, cos_e) = libm::sincos(elevation.to_radians());
    let towards = Vec3::new(cos_e * cos_a, cos_e * sin_a, sin_e);
    let across = Vec3::new(-sin_a, cos_a, 0.0);
    let ahead = direction.dot(&towards);
    if ahead <= 0.0 {
        return 0.0;
    }
    let places = [direction.dot(&across), direction.dot(&towards.cross(&across))];
    let inside = |axis: usize| {
        let part = (places[axis] / ahead).abs() / half[axis];
        1.0 - step(1.0 - softness, 1.0, part)
    };
    radiance * inside(0) * inside(1)
}
