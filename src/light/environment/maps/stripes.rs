//! Stripes in place of zebras.

use super::{Card, Entry};
use crate::geometry::elementary::{atan2_64, floor64};
use crate::parameter::{Domain, Parameter};

/// Stripes of equal width, bright (1) and dark (0.05) in turn: upright ones between meridians, or level
/// ones between circles of latitude, `count` pairs in a turn.
pub(super) const ENTRY: Entry = Entry {
    card: Card {
        name: "stripes",
        source: "in place of the zebras of Schilling 1997, Antialiasing of Bump-Maps, figures 10 and 11",
        summary: "Bright and dark stripes, upright or level.",
    },
    parameters: &[
        Parameter {
            name: "count",
            meaning: "pairs of stripes in a whole turn",
            domain: Domain::Whole { default: 24, min: 1, max: 256 },
        },
        Parameter {
            name: "run",
            meaning: "upright: from zenith to nadir; level: around the horizon",
            domain: Domain::Choice { words: &["upright", "level"] },
        },
    ],
    build: |values| {
        let count = values.number("count");
        let level = values.word("run") == "level";
        Box::new(move |d| {
            let angle = if level {
                atan2_64(d.z, (d.x * d.x + d.y * d.y).sqrt())
            } else {
                atan2_64(d.y, d.x)
            };
            let pairs = angle / std::f64::consts::TAU * count;
            if pairs - floor64(pairs) < 0.5 { 1.0 } else { 0.05 }
        })
    },
};
