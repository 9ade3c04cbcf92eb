//! Shading by the surface's own NDF (Kautz et al. 2001).
//!
//! | | indices from | file |
//! |---|---|---|
//! | in software | turbulence, as many octaves as can be seen | `surface.rs` |
//! | in a single pass | a mipmapped texture of turbulence | `single_pass.rs` |
//! | for a map that is there already (§7) | the map's normals, averaged | `measured.rs` |

mod measured;
mod single_pass;
mod surface;

pub use measured::{Kautz, entry};
pub use single_pass::{RadialNdf, SinglePass};
pub use surface::Synthesised;

use std::sync::Arc;

use super::{Batch, Lane};
use crate::lobe::sampled::{facet, in_frame};
use crate::lobe::vector::V3;
use crate::lobe::{Facet, MultipleSurface, NdfImage, SampledLobe, Shading, Spread};
use crate::synthesis::MicroFrame;

/// What every form shades by: the NDF, and its slope covariance for shadowing and masking.
#[derive(Clone, Debug)]
struct OwnNdf {
    image: Arc<NdfImage>,
    spread: [f32; 3],
}

impl OwnNdf {
    fn new(image: Arc<NdfImage>) -> Self {
        let spread = image.slope_covariance();
        Self { image, spread }
    }

    /// The multiple surface of a microfacet: the NDF in its frame.
    fn about(&self, frame: MicroFrame, amplitude: f32) -> MultipleSurface {
        let lobe = SampledLobe::new(Arc::clone(&self.image), frame, 1.0, self.spread);
        let mut surface = MultipleSurface::new();
        surface.add(lobe, amplitude);
        surface
    }

    /// Shades a batch whose lanes have these microfacets and amplitudes.
    #[inline(always)]
    fn shade(
        &self,
        batch: &Batch,
        shading: Shading,
        radiance: &mut Lane,
        microfacet: impl Fn(usize) -> (MicroFrame, f32),
    ) {
        for (i, out) in radiance.iter_mut().enumerate().take(batch.len) {
            *out = 0.0;
            if batch.irradiance[i] > 0.0 {
                let (frame, amplitude) = microfacet(i);
                let lobe = Microfacet { ndf: self, frame };
                let (half, light, view) = (batch.half(i), batch.light(i), batch.view(i));
                let sent = lobe.radiance(shading, half, light, view);
                *out = batch.irradiance[i] * amplitude * sent;
            }
        }
    }
}

/// A [`SampledLobe`] of amplitude 1 that borrows its NDF.
struct Microfacet<'a> {
    ndf: &'a OwnNdf,
    frame: MicroFrame,
}

impl Spread for Microfacet<'_> {
    #[inline(always)]
    fn density(&self, h: V3) -> f32 {
        in_frame(&self.ndf.image, &self.frame, h)
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        facet(self.frame, self.ndf.spread)
    }
}
