//! A surface without a map: the same multiple surface everywhere.

use super::Prefiltered;
use crate::lobe::MultipleSurface;
use crate::texture::Footprint;

/// Answers every footprint with one multiple surface (Fournier 1992 §4: values for multiple surfaces need
/// not be extracted from bump maps). No filter, so not among the methods.
#[derive(Clone, Debug)]
pub struct Constant(pub MultipleSurface);

impl Prefiltered for Constant {
    fn bytes(&self) -> usize {
        size_of::<Self>()
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn needs_directions(&self) -> bool {
        self.0.has_horizons()
    }

    fn lobes_at(&self, _: &Footprint) -> MultipleSurface {
        self.0.clone()
    }
}
