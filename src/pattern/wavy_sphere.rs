//! The normals of a rippled sphere (Olano and North 1997, figures 1 and 2).

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Bumps, Card, Entry};
use crate::geometry::{Ripples, spherical_frame};
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{NormalMap, Wrap};

/// The exact normals of a sphere whose radius ripples, in the frames of the sphere without ripples: u once
/// round the equator, v from pole to pole. On the surface `wavy-sphere` with `frame = "sphere"` and the same
/// ripples it makes a mesh of any number of cells shade as the smooth surface.
///
/// The map repeats, so at the very poles, half a texel wide, the two poles' rows are blended.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "wavy-sphere",
        source: "Olano and North 1997, Normal Distribution Mapping, figures 1 and 2",
        summary: "The normals of a whole sphere whose radius ripples, longitude by latitude.",
    },
    parameters: &[
        Parameter {
            name: "ripples",
            meaning: "crests on a great circle through the ripples' axis",
            domain: Domain::Whole { default: 12, min: 0, max: 64 },
        },
        Parameter {
            name: "amplitude",
            meaning: "half the difference between crests and troughs, radii",
            domain: Domain::Real { default: 0.03, min: 0.0, max: 0.5 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let ripples =
        Ripples { count: values.whole("ripples") as u32, amplitude: values.number("amplitude") };
    let normals = NormalMap::from_fn(width, height, Wrap::Repeat, |u, v| {
        let frame = spherical_frame(TAU * u, PI * v - FRAC_PI_2);
        let local = frame.local_from_world(ripples.normal(frame.normal));
        [local.x, local.y, local.z, 1.0]
    });
    Bumps { normals, heights: None, notes: vec![] }
}
