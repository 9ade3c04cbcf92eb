//! What the numbers of images are, and how the images are looked at.

use super::pixelwise::data_range;
use crate::render::Film;

/// How two images are to be understood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    /// What their numbers are.
    pub values: Values,
    /// Pixels of the screen to a degree of the visual field; only FLIP asks.
    pub ppd: f64,
}

/// What the numbers of an image are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// Radiances: the data range L is the reference's greatest, and white is [`Film::white`] of the reference.
    Radiances,
    /// Codes of a display by the curve of sRGB, from 0 to 1: L is 1.
    Codes,
    /// Light of a display, from 0 to 1: L is 1.
    Light,
}

/// Pixels to a degree of FLIP's standard viewer: 0.7 m before a screen 0.7 m and 3840 pixels wide (Andersson et al.
/// 2020, §5), in the four digits it is quoted with.
pub const PPD: f64 = 67.02;

impl Default for Viewing {
    /// Radiances, looked at by FLIP's standard viewer.
    fn default() -> Self {
        Self { values: Values::Radiances, ppd: PPD }
    }
}

impl Viewing {
    /// Pixels to a degree before a screen `width` metres and `pixels` wide, from a `distance` in metres.
    pub fn ppd_of(distance: f64, width: f64, pixels: f64) -> f64 {
        distance * (pixels / width) * (std::f64::consts::PI / 180.0)
    }

    /// The data range L.
    pub(super) fn range(&self, reference: &[Film]) -> f64 {
        match self.values {
            Values::Radiances => data_range(reference),
            Values::Codes | Values::Light => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_standard_viewer() {
        assert!((Viewing::ppd_of(0.7, 0.7, 3840.0) - PPD).abs() < 0.005);
    }
}
