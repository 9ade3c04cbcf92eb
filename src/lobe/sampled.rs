//! A lobe whose density is an image.

use std::sync::Arc;

use super::vector::{V3, dot};
use super::{Facet, NdfImage, Spread};

/// A surface's own NDF in the frame of a microfacet (Kautz et al. 2001 §5.1): D(h) = amplitude · p(h_m), where h_m is
/// the half vector in that frame.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledLobe {
    ndf: Arc<NdfImage>,
    /// Tangent, bitangent, normal of the microfacet, in tangent space.
    frame: [V3; 3],
    amplitude: f32,
    /// Slope covariance of the NDF in its frame.
    spread: [f32; 3],
}

impl SampledLobe {
    /// The NDF about an orthonormal frame [tangent, bitangent, normal] given in tangent space. `spread` is its
    /// [`NdfImage::slope_covariance`], which whoever makes many lobes has at hand.
    pub fn new(ndf: Arc<NdfImage>, frame: [V3; 3], amplitude: f32, spread: [f32; 3]) -> Self {
        Self { ndf, frame, amplitude, spread }
    }

    /// The same lobe with its density multiplied by `factor`.
    pub fn faded(self, factor: f32) -> Self {
        Self { amplitude: self.amplitude * factor, ..self }
    }
}

/// p(h_m) of a half vector of any length; 0 below the microfacet's horizon.
#[inline(always)]
pub fn in_frame(ndf: &NdfImage, frame: &[V3; 3], h: V3) -> f32 {
    let [x, y, z] = frame.map(|axis| dot(axis, h));
    let per_length = 1.0 / (x * x + y * y + z * z).sqrt().max(f32::MIN_POSITIVE);
    let density = ndf.at(x * per_length, y * per_length);
    if z > 0.0 { density } else { 0.0 }
}

/// The facet about such a frame: roughness α² is twice the slope covariance.
pub fn facet([tangent, bitangent, axis]: [V3; 3], spread: [f32; 3]) -> Facet {
    Facet { axis, tangent, bitangent, alpha_squared: spread.map(|c| 2.0 * c), ggx: false }
}

impl Spread for SampledLobe {
    fn density(&self, h: V3) -> f32 {
        self.amplitude * in_frame(&self.ndf, &self.frame, h)
    }

    fn facet(&self) -> Facet {
        facet(self.frame, self.spread)
    }
}
