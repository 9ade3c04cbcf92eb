//! No filter (Blinn 1978).

use std::sync::Arc;

use super::one_lobe::unfiltered_lobe;
use super::{Batch, Card, Entry, Lane, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::{BaseLobe, MultipleSurface, Shading, Spread};
use crate::texture::{Footprint, NormalMap};

/// One base lobe about the perturbed normal at the sample's centre, whatever the footprint holds.
///
/// With many samples a pixel this *is* the supersampled truth: the reference averages it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unfiltered;

const CARD: Card = Card {
    name: "unfiltered",
    source: "Blinn 1978, Simulation of Wrinkled Surfaces",
    summary: "Shades the perturbed normal at the sample's centre.",
    formula: "one base lobe about the interpolated normal",
    limits: "aliases: a pixel sees one normal of the many it covers",
    normalised: true,
    keeps_roughness: false,
    precision: 1e-3,
};

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry { card: CARD, parameters: &[], build: |_| Box::new(Unfiltered) }
}

impl Method for Unfiltered {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, _base: &BaseLobe) -> Result<f64, Refusal> {
        Ok(0.0)
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        Ok(Box::new(UnfilteredMap { map: Arc::clone(map), base: *base }))
    }
}

struct UnfilteredMap {
    map: Arc<NormalMap>,
    base: BaseLobe,
}

impl Prefiltered for UnfilteredMap {
    fn bytes(&self) -> usize {
        0
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let mut surface = MultipleSurface::new();
        surface.add(unfiltered_lobe(&self.map, &self.base, at.u, at.v), 1.0);
        surface
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        for i in 0..batch.len {
            let lobe = unfiltered_lobe(&self.map, &self.base, batch.u[i], batch.v[i]);
            let [half, light, view] = [&batch.half, &batch.light, &batch.view]
                .map(|axis| [axis[0][i], axis[1][i], axis[2][i]]);
            radiance[i] = batch.irradiance[i] * lobe.radiance(shading, half, light, view);
        }
    }
}
