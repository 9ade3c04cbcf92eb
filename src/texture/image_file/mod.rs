//! Normal maps and height maps from and to image files, PNG, TIFF, WebP and EXR; luminance from EXR and
//! Radiance HDR.
//!
//! Image files start with the top row; maps here with the bottom one (v = 0). Reading and writing flip.
//! Samples are taken as stored: a map is data, so gamma and colour profiles are not looked at.

mod error;
mod exr;
mod heights;
mod luminance;
mod normals;
mod preview;
mod samples;
mod values;
mod write;

pub use error::ImageError;
pub use heights::{HeightReading, read_height_map};
pub use luminance::{Luminance, read_luminance};
pub use normals::{Green, NormalReading, Zero, read_normal_map};
pub use preview::{Preview, preview};
pub use values::{read_values, write_values_exr, write_values_png};
pub use write::{Codes, write_normal_map_exr, write_normal_map_png, write_normal_map_png16};

/// A map from a file, and what is worth knowing about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<T> {
    /// The map.
    pub map: T,
    /// How the file stores it, and anything about it that may surprise, a sentence each.
    pub notes: Vec<String>,
}
