//! The reference: the supersampled image that every other is held to.

use super::limits::Limits;
use super::reader::Reader;
use crate::method::Truth;

/// The most samples a pixel that a reference may have.
const LIMIT: u32 = 1 << 20;
/// How many times more samples than asked for a reference takes by itself to tell methods apart.
const FURTHER: u32 = 4;
/// The relative difference of errors that it is to tell apart, if nothing is said.
const GAP: f64 = 0.01;

/// How the reference is rendered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceSpec {
    /// Samples a pixel in all, a power of two.
    pub spp: u32,
    /// Independent parts of equal size it is the mean of, a power of two; their spread tells its error.
    pub replicates: u32,
    /// The most samples a pixel it may take to tell methods apart, a power of two, at least `spp`.
    pub most: u32,
    /// The least relative difference of two methods' root mean square errors worth reporting, in (0, 1]: the
    /// reference is sampled further until it tells such differences from its own noise.
    pub gap: f64,
    /// What it shows of the bumps.
    pub truth: Truth,
}

impl ReferenceSpec {
    pub(super) fn read(reader: &Reader) -> Self {
        let spp = reader.item("spp").and_then(|item| item.power_of_two(2, LIMIT)).unwrap_or(4096);
        // A power of two no greater than another divides it.
        let replicates = reader.item("replicates").and_then(|item| item.power_of_two(2, spp));
        let most = reader.item("most").and_then(|item| item.power_of_two(spp, LIMIT));
        let gap = reader.item("gap").and_then(|item| item.real(Limits::above(0.0, 1.0)));
        let truth = reader.choice("truth", &Truth::ALL.map(|truth| (truth.name(), truth)));
        Self {
            spp,
            replicates: replicates.unwrap_or(4.min(spp)),
            most: most.unwrap_or(spp.saturating_mul(FURTHER).min(LIMIT)),
            gap: gap.unwrap_or(GAP),
            truth,
        }
    }

    /// Samples a pixel of each replicate.
    pub fn replicate_spp(&self) -> u32 {
        self.spp / self.replicates
    }

    /// The most replicates it may take.
    pub fn most_replicates(&self) -> u32 {
        self.most / self.replicate_spp()
    }
}
