//! The reference: the supersampled image that every other is held to.

use super::reader::Reader;
use crate::method::Truth;

/// How the reference is rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReferenceSpec {
    /// Samples a pixel in all, a power of two.
    pub spp: u32,
    /// Independent parts of equal size it is the mean of, a power of two; their spread tells its error.
    pub replicates: u32,
    /// What it shows of the bumps.
    pub truth: Truth,
}

impl ReferenceSpec {
    pub(super) fn read(reader: &Reader) -> Self {
        let spp = reader.item("spp").and_then(|item| item.power_of_two(2, 1 << 20)).unwrap_or(4096);
        // A power of two no greater than another divides it.
        let replicates = reader.item("replicates").and_then(|item| item.power_of_two(2, spp));
        let truth = reader.choice("truth", &Truth::ALL.map(|truth| (truth.name(), truth)));
        Self { spp, replicates: replicates.unwrap_or(4.min(spp)), truth }
    }
}
