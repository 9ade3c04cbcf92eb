//! The furnace.

use super::{Card, Entry};

/// Radiance 1 from everywhere. What keeps its energy is invisible in it.
pub(super) const ENTRY: Entry = Entry {
    card: Card {
        name: "white",
        source: "the furnace test of rendering",
        summary: "Radiance 1 from everywhere: what keeps its energy vanishes before it.",
    },
    parameters: &[],
    build: |_| Box::new(|_| 1.0),
};
