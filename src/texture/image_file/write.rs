//! Normal maps to image files.

use std::io::{Cursor, Error};
use std::path::Path;

use ::exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use super::{Green, ImageError};
use crate::file::write_whole;
use crate::texture::NormalMap;

/// Writes a map's normals as a 16-bit RGB PNG, green up: see [`write_normal_map_png`].
///
/// # Errors
/// [`ImageError::Unwritable`].
pub fn write_normal_map_png16(path: impl AsRef<Path>, map: &NormalMap) -> Result<(), ImageError> {
    write_normal_map_png(path, map, Codes::Sixteen, Green::Up)
}

/// How finely a PNG stores a coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Codes {
    /// 8 bits.
    Eight,
    /// 16 bits.
    #[default]
    Sixteen,
}

/// Writes a map's normals as an RGB PNG, [`super::Zero::Middle`]: each sample is m·(c + 1)/2 rounded, m = 255 or
/// 65535. Weights are not stored. The same map gives the same bytes on every machine. The file appears whole or not
/// at all.
///
/// # Errors
/// [`ImageError::Unwritable`].
pub fn write_normal_map_png(
    path: impl AsRef<Path>,
    map: &NormalMap,
    codes: Codes,
    green: Green,
) -> Result<(), ImageError> {
    let most = if codes == Codes::Eight { 255.0 } else { 65_535.0 };
    let samples: Vec<u16> = top_down(map, green)
        .flatten()
        .map(|c| (0.5 * most * (f64::from(c) + 1.0) + 0.5) as u16)
        .collect();
    let eight: Vec<u8> = match codes {
        Codes::Eight => samples.iter().map(|s| *s as u8).collect(),
        Codes::Sixteen => Vec::new(),
    };
    let (pixels, colour): (&[u8], _) = match codes {
        Codes::Eight => (&eight, ExtendedColorType::Rgb8),
        Codes::Sixteen => (bytemuck::cast_slice(&samples), ExtendedColorType::Rgb16),
    };
    write_png(path.as_ref(), pixels, (map.width(), map.height()), colour)
}

/// Writes samples as a PNG file, whole or not at all; the same samples give the same bytes on every machine.
pub(super) fn write_png(
    path: &Path,
    samples: &[u8],
    (width, height): (usize, usize),
    colour: ExtendedColorType,
) -> Result<(), ImageError> {
    let mut bytes = Vec::new();
    // "Fast" is compressed by the PNG crate itself; other settings ask a library that may differ.
    let written =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive)
            .write_image(samples, width as u32, height as u32, colour);
    let unwritable = |source| ImageError::Unwritable { path: path.to_owned(), source };
    written.map_err(|e| unwritable(Error::other(e)))?;
    write_whole(path, &bytes).map_err(unwritable)
}

/// Writes a map's normals as an EXR file of 32-bit floats R, G and B: the coordinates themselves, from −1 to 1.
/// Weights are not stored. The file appears whole or not at all.
///
/// # Errors
/// [`ImageError::Unwritable`].
pub fn write_normal_map_exr(
    path: impl AsRef<Path>,
    map: &NormalMap,
    green: Green,
) -> Result<(), ImageError> {
    let samples: Vec<[f32; 3]> = top_down(map, green).collect();
    write_exr(path.as_ref(), &samples, (map.width(), map.height()))
}

/// Writes pixels as an EXR file of 32-bit floats R, G and B, whole or not at all.
pub(super) fn write_exr(
    path: &Path,
    samples: &[[f32; 3]],
    (width, height): (usize, usize),
) -> Result<(), ImageError> {
    let pixel = |at: Vec2<usize>| {
        let [x, y, z] = samples[at.y() * width + at.x()];
        (x, y, z)
    };
    let channels = SpecificChannels::rgb(pixel);
    let size = Vec2(width, height);
    let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes);
    let unwritable = |source| ImageError::Unwritable { path: path.to_owned(), source };
    written.map_err(|e| unwritable(Error::other(e)))?;
    write_whole(path, &bytes.into_inner()).map_err(unwritable)
}

/// The normals from the picture's top row on.
fn top_down(map: &NormalMap, green: Green) -> impl Iterator<Item = [f32; 3]> {
    let up = if green == Green::Up { 1.0 } else { -1.0 };
    map.texels().chunks(map.width()).rev().flatten().map(move |t| [t[0], up * t[1], t[2]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;
    use crate::texture::image_file::{NormalReading, read_normal_map};

    #[test]
    fn what_is_written_is_read_back() {
        let map = NormalMap::from_fn(7, 5, Wrap::Repeat, |u, v| [u - 0.4, 0.7 - v, 1.0, 1.0]);
        let folder = tempfile::tempdir().unwrap();
        for green in [Green::Up, Green::Down] {
            let reading = NormalReading { green, ..NormalReading::default() };
            let check = |name: &str, most: f32| {
                let back = read_normal_map(folder.path().join(name), &reading).unwrap().map;
                let pairs = map.texels().iter().zip(back.texels());
                let apart = pairs.flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs()));
                assert!(apart.fold(0.0, f32::max) <= most, "{name}");
            };
            write_normal_map_png(folder.path().join("8.png"), &map, Codes::Eight, green).unwrap();
            write_normal_map_png(folder.path().join("16.png"), &map, Codes::Sixteen, green)
                .unwrap();
            write_normal_map_exr(folder.path().join("n.exr"), &map, green).unwrap();
            check("8.png", 0.008);
            check("16.png", 4e-5);
            check("n.exr", 1e-6);
        }
    }
}
