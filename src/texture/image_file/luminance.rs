//! Luminance from image files of radiance: EXR and Radiance HDR.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use ::exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, Vec2, read};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::ImageError;
use super::samples::{check_exr, check_most, first_bytes};

/// Luminance as a grid, before anything is asked of it: infinite, negative and not-a-number samples are
/// as stored.
#[derive(Clone, Debug, PartialEq)]
pub struct Luminance {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Row by row from the *top* of the picture.
    pub values: Vec<f32>,
}

/// Reads an EXR file (channels R, G and B, or Y) or a Radiance HDR file; which it is, its first bytes tell.
/// Colours become luminance with the weights of linear Rec. 709 (ITU-R BT.709, 0.2126 R + 0.7152 G +
/// 0.0722 B).
///
/// # Errors
/// An [`ImageError`] that names the file.
pub fn read_luminance(path: impl AsRef<Path>) -> Result<Luminance, ImageError> {
    let path = path.as_ref();
    let mut file = BufReader::new(File::open(path).map_err(|e| ImageError::reading(path, e))?);
    let start = first_bytes(&mut file, 64).map_err(|e| ImageError::reading(path, e))?;
    match image::guess_format(&start) {
        _ if start.is_empty() => Err(ImageError::Empty { path: path.to_owned() }),
        Ok(ImageFormat::OpenExr) => {
            check_exr(path, &mut file)?;
            drop(file);
            read_exr(path)
        }
        Ok(ImageFormat::Hdr) => read_hdr(path, file),
        _ => Err(ImageError::UnknownFormat { path: path.to_owned() }),
    }
}

fn luminance(r: f32, g: f32, b: f32) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn empty(size: Vec2<usize>) -> Luminance {
    Luminance { width: size.x(), height: size.y(), values: vec![0.0; size.area()] }
}

/// The first layer with R, G and B, or else with Y.
fn read_exr(path: &Path) -> Result<Luminance, ImageError> {
    type Found = Result<Luminance, ::exr::error::Error>;
    let colours: Found = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("R")
        .required("G")
        .required("B")
        .collect_pixels(
            |size, _| empty(size),
            |image, at, (r, g, b): (f32, f32, f32)| {
                let value = luminance(r, g, b);
                if let Some(pixel) = image.values.get_mut(at.y() * image.width + at.x()) {
                    *pixel = value;
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_file(path)
        .map(|image| image.layer_data.channel_data.pixels);
    let missing =
        matches!(&colours, Err(::exr::error::Error::Invalid(what)) if what.contains("layer"));
    let found = if missing { read_grey(path) } else { colours };
    found.map_err(|error| ImageError::decoding_exr(path, error))
}

fn read_grey(path: &Path) -> Result<Luminance, ::exr::error::Error> {
    read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required("Y")
        .collect_pixels(
            |size, _| empty(size),
            |image, at, (y,): (f32,)| {
                if let Some(pixel) = image.values.get_mut(at.y() * image.width + at.x()) {
                    *pixel = y;
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_file(path)
        .map(|image| image.layer_data.channel_data.pixels)
}

fn read_hdr(path: &Path, file: BufReader<File>) -> Result<Luminance, ImageError> {
    let failed = |e| ImageError::decoding(path, e);
    let mut reader = ImageReader::with_format(file, ImageFormat::Hdr);
    reader.limits(Limits::default());
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        return Err(ImageError::Empty { path: path.to_owned() });
    }
    check_most(path, (width, height))?;
    let image = DynamicImage::from_decoder(decoder).map_err(failed)?.into_rgb32f();
    let values = image.pixels().map(|p| luminance(p[0], p[1], p[2])).collect();
    Ok(Luminance { width: width as usize, height: height as usize, values })
}
