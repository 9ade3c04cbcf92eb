//! No bumps at all.

use super::{Bumps, Card, Entry};
use crate::texture::{HeightMap, NormalMap, Wrap};

/// A map of normals straight up: what every filter must leave alone.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "flat",
        source: "defined here: n = (0, 0, 1), F = 0",
        summary: "No bumps: every normal points straight out.",
    },
    parameters: &[],
    build: |width, height, _, _| Bumps {
        normals: NormalMap::from_fn(width, height, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]),
        heights: Some(HeightMap::from_fn(width, height, Wrap::Repeat, |_, _| 0.0)),
        notes: vec![],
    },
};
