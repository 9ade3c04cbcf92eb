//! Bumps from an image file.

use std::path::Path;

use super::Bumps;
use crate::texture::NormalMap;
use crate::texture::image_file::{
    HeightReading, ImageError, NormalReading, read_height_map, read_normal_map,
};

/// What an image file holds, and how it is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Normals, as colours.
    Normals(NormalReading),
    /// Heights, as grey; normals are found by central differences (Blinn 1978 §3).
    Heights(HeightReading),
}

/// Reads bumps from an image file.
///
/// # Errors
/// An [`ImageError`] that names the file.
pub fn read(path: impl AsRef<Path>, reading: &Reading) -> Result<Bumps, ImageError> {
    match reading {
        Reading::Normals(reading) => {
            let loaded = read_normal_map(path, reading)?;
            Ok(Bumps { normals: loaded.map, heights: None, notes: loaded.notes })
        }
        Reading::Heights(reading) => {
            let loaded = read_height_map(path, reading)?;
            let normals = NormalMap::from_heights(&loaded.map, 1.0);
            Ok(Bumps { normals, heights: Some(loaded.map), notes: loaded.notes })
        }
    }
}
