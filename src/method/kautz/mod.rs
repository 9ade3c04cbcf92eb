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
use crate::lobe::{MultipleSurface, NdfImage, SampledLobe, Shading, Spread};
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

    /// Radiance of lane `i` of a batch from a microfacet.
    #[inline(always)]
    fn sent(&self, batch: &Batch, i: usize, frame: &MicroFrame, shading: Shading) -> f32 {
        let density = in_frame(&self.image, frame, batch.half(i));
        match shading {
            Shading::Ndf => density,
            Shading::Microfacet => {
                density * facet(*frame, self.spread).geometry(batch.light(i), batch.view(i))
            }
            _ => SampledLobe::new(Arc::clone(&self.image), *frame, 1.0, self.spread).radiance(
                shading,
                batch.half(i),
                batch.light(i),
                batch.view(i),
            ),
        }
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
                *out = batch.irradiance[i] * amplitude * self.sent(batch, i, &frame, shading);
            }
        }
    }
}
