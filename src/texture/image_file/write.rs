//! Normal maps to image files.

use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use super::ImageError;
use crate::file::write_whole;
use crate::texture::NormalMap;

/// Writes a map's normals as a 16-bit RGB PNG, green up, [`super::Zero::Middle`]: each sample is
/// 65535·(c + 1)/2 rounded. Weights are not stored. The same map gives the same bytes on every
/// machine. The file appears whole or not at all.
///
/// # Errors
/// [`ImageError::Unwritable`].
pub fn write_normal_map_png16(path: impl AsRef<Path>, map: &NormalMap) -> Result<(), ImageError> {
    let rows = map.texels().chunks(map.width()).rev();
    let samples: Vec<u16> = rows
        .flatten()
        .flat_map(|t| [t[0], t[1], t[2]])
        .map(|c| (32_767.5 * (f64::from(c) + 1.0) + 0.5) as u16)
        .collect();
    let path = path.as_ref();
    let unwritable = |source| ImageError::Unwritable { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    // "Fast" is compressed by the PNG crate itself; other settings ask a library that may differ.
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive)
        .write_image(
            bytemuck::cast_slice(&samples),
            map.width() as u32,
            map.height() as u32,
            ExtendedColorType::Rgb16,
        )
        .map_err(|e| unwritable(std::io::Error::other(e)))?;
    write_whole(path, &bytes).map_err(unwritable)
}
