//! Image files of any kind as floats: what `compare` reads.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use exr::prelude::{AnyChannels, FlatSamples, Image, Layer, ReadChannels, ReadLayers};
use image::{DynamicImage, ImageReader};

use super::Film;

/// An image read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredImage {
    /// One channel, or red, green and blue. Opacity is left out.
    pub channels: Vec<Film>,
    /// Names of the channels that the file has beside these.
    pub left_out: Vec<String>,
    /// What its numbers are.
    pub coding: Coding,
}

/// What the numbers of an image file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// Radiances: EXR, Radiance HDR.
    Linear,
    /// Codes for a display, each divided by the greatest: PNG, WebP, 8- and 16-bit TIFF. They are as
    /// stored; no curve has been undone.
    Display,
}

/// Why an image file could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// It could not be read.
    #[error("{}: cannot read the image: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why, and what to do.
        reason: String,
    },
    /// It could not be written.
    #[error("{}: cannot write the image: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// It has several channels where one was asked for.
    #[error("{}: this image has colours; one channel is needed here", path.display())]
    NotOneChannel {
        /// The file.
        path: PathBuf,
    },
}

impl FilmError {
    pub(super) fn read(path: &Path, reason: impl Display) -> Self {
        Self::Read { path: path.to_owned(), reason: reason.to_string() }
    }

    pub(super) fn write(path: &Path, reason: impl Display) -> Self {
        Self::Write { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// Reads an EXR, HDR, PNG, WebP or TIFF file; its kind is found from its first bytes.
///
/// # Errors
/// [`FilmError::Read`] if there is no such file, it is of another kind, or it is damaged.
pub fn read_image(path: &Path) -> Result<StoredImage, FilmError> {
    let bytes = std::fs::read(path).map_err(|error| FilmError::read(path, error))?;
    if bytes.starts_with(&EXR_MAGIC) {
        read_exr(path, &bytes)
    } else {
        let reader = ImageReader::new(std::io::Cursor::new(bytes)).with_guessed_format();
        let reader = reader.map_err(|error| FilmError::read(path, error))?;
        if reader.format().is_none() {
            return Err(FilmError::read(path, "it is no EXR, HDR, PNG, WebP or TIFF file"));
        }
        let image = reader.decode().map_err(|error| FilmError::read(path, error))?;
        Ok(from_dynamic(&image))
    }
}

const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The first layer with channels `Y`, or `R`, `G` and `B`, or with a single channel of any name.
fn read_exr(path: &Path, bytes: &[u8]) -> Result<StoredImage, FilmError> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(std::io::Cursor::new(bytes))
        .map_err(|error| FilmError::read(path, exr_reason(&error)))?;
    let channels = exr_channels(&image).ok_or_else(|| {
        FilmError::read(path, "it has neither a channel Y nor channels R, G and B")
    })?;
    let left_out = left_out(&image, channels.len());
    Ok(StoredImage { channels, left_out, coding: Coding::Linear })
}

/// The names of the channels beside the one or three that were taken.
fn left_out(image: &Image<Layer<AnyChannels<FlatSamples>>>, taken: usize) -> Vec<String> {
    let names: Vec<String> =
        image.layer_data.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    let colours = ["R", "G", "B"];
    let known =
        |name: &String| if taken == 3 { colours.contains(&name.as_str()) } else { name == "Y" };
    if names.len() == 1 { Vec::new() } else { names.into_iter().filter(|n| !known(n)).collect() }
}

fn exr_channels(image: &Image<Layer<AnyChannels<FlatSamples>>>) -> Option<Vec<Film>> {
    let layer = &image.layer_data;
    let list = &layer.channel_data.list;
    let film = |samples: &FlatSamples| {
        let pixels: Vec<f32> = match samples {
            // As they are: a conversion might quiet a NaN.
            FlatSamples::F32(values) => values.clone(),
            other => other.values_as_f32().collect(),
        };
        let (width, height) = (layer.size.x(), layer.size.y());
        (pixels.len() == width * height).then(|| Film::new(width, height, pixels))
    };
    let named = |name: &str| {
        list.iter().find(|channel| channel.name.eq(name)).and_then(|c| film(&c.sample_data))
    };
    let single = || match list.as_slice() {
        [only] => film(&only.sample_data),
        _ => None,
    };
    match (named("R"), named("G"), named("B")) {
        (Some(r), Some(g), Some(b)) => Some(vec![r, g, b]),
        _ => named("Y").or_else(single).map(|film| vec![film]),
    }
}

fn exr_reason(error: &exr::error::Error) -> String {
    match error {
        exr::error::Error::NotSupported(what) => {
            format!("this kind of EXR is not supported ({what}); save it with ZIP compression")
        }
        other => other.to_string(),
    }
}

fn from_dynamic(image: &DynamicImage) -> StoredImage {
    use image::ColorType::{Rgb32F, Rgba32F};
    let floats = matches!(image.color(), Rgb32F | Rgba32F);
    let (width, height) = (image.width() as usize, image.height() as usize);
    let grey = !image.color().has_color();
    // 8-bit codes become 16-bit ones exactly: c / 255 = 257 c / 65535.
    let channels: [Vec<f32>; 3] = if floats {
        let rgb = image.to_rgb32f();
        std::array::from_fn(|c| rgb.pixels().map(|pixel| pixel[c]).collect())
    } else {
        let rgb = image.to_rgb16();
        let value = |code: u16| (f64::from(code) / 65535.0) as f32;
        std::array::from_fn(|c| rgb.pixels().map(|pixel| value(pixel[c])).collect())
    };
    let films = channels.map(|pixels| Film::new(width, height, pixels));
    StoredImage {
        channels: films.into_iter().take(if grey { 1 } else { 3 }).collect(),
        left_out: if image.color().has_alpha() { vec!["A".into()] } else { Vec::new() },
        coding: if floats { Coding::Linear } else { Coding::Display },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn display_codes_are_divided_by_the_greatest() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grey.png");
        image::GrayImage::from_raw(3, 1, vec![0, 51, 255]).unwrap().save(&path).unwrap();
        let grey = read_image(&path).unwrap();
        assert_eq!(grey.coding, Coding::Display);
        assert_eq!(grey.channels, [Film::new(3, 1, vec![0.0, 0.2, 1.0])]);
        let path = folder.path().join("colour.png");
        image::RgbaImage::from_raw(1, 1, vec![255, 0, 51, 7]).unwrap().save(&path).unwrap();
        let pixels: Vec<f32> =
            read_image(&path).unwrap().channels.iter().map(|film| film.pixels()[0]).collect();
        assert_eq!(pixels, [1.0, 0.0, 0.2]);
    }

    #[test]
    fn exr_of_colours_has_them_in_order() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("colour.exr");
        exr::prelude::write_rgb_file(&path, 2, 1, |x, _| (1.0 + x as f32, 10.0, 0.5)).unwrap();
        let image = read_image(&path).unwrap();
        assert_eq!(image.coding, Coding::Linear);
        let channels: Vec<&[f32]> = image.channels.iter().map(Film::pixels).collect();
        assert_eq!(channels, [[1.0, 2.0], [10.0, 10.0], [0.5, 0.5]]);
    }
}
