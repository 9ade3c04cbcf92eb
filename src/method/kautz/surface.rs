//! The renderer's form: turbulence at every sample (Kautz et al. 2001 §5.1).

use std::sync::Arc;

use super::super::{Batch, Lane, Prefiltered};
use super::OwnNdf;
use crate::lobe::{MultipleSurface, NdfImage, Shading};
use crate::synthesis::{MicroFrame, Synthesis};
use crate::texture::Footprint;

/// A surface whose bumps are made as it is looked at: the nearer, the more octaves, to any scale.
#[derive(Clone, Debug)]
pub struct Synthesised {
    synthesis: Arc<Synthesis>,
    ndf: OwnNdf,
    octaves: f64,
}

impl Synthesised {
    /// Of this synthesis, with at most so many octaves; at most
    /// [`MOST_OCTAVES`](crate::geometry::noise::MOST_OCTAVES) count.
    pub fn new(synthesis: Arc<Synthesis>, octaves: f64) -> Self {
        let ndf = OwnNdf::new(Arc::clone(&synthesis.ndf));
        Self { synthesis, ndf, octaves }
    }

    /// The same bumps, shaded by another NDF than theirs: "these two parts can actually be used independently" (§1).
    pub fn shaded_by(self, ndf: Arc<NdfImage>) -> Self {
        Self { ndf: OwnNdf::new(ndf), ..self }
    }

    /// The microfacet's frame at a footprint, from the table L(r₁, r₂).
    fn microfacet(&self, at: &Footprint) -> MicroFrame {
        let length = |[u, v]: [f32; 2]| u * u + v * v;
        let along = length(at.along_x).max(length(at.along_y)).sqrt();
        let octaves = self.synthesis.octaves_seen(along.into(), self.octaves);
        let r = self.synthesis.indices(at.u.into(), at.v.into(), octaves);
        self.synthesis.table.smooth(r.map(|r| r as f32))
    }
}

impl Prefiltered for Synthesised {
    fn bytes(&self) -> usize {
        self.synthesis.table.bytes() + self.synthesis.ndf.bytes()
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        self.ndf.about(self.microfacet(at), 1.0)
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        self.ndf.shade(batch, shading, radiance, |i| (self.microfacet(&batch.footprint(i)), 1.0));
    }
}
