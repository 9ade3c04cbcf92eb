//! Any image file as a grid of samples.

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::{ImageError, exr};

/// Most pixels a side.
const MOST: u32 = 16_384;
/// Most pixels in all: a gigabyte of normals.
const MOST_PIXELS: u64 = 1 << 26;

/// How a channel is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Depth {
    /// Whole numbers from 0 to 255.
    Bits8,
    /// Whole numbers from 0 to 65535.
    Bits16,
    /// Real numbers, nominally from 0 to 1.
    Float,
}

impl Depth {
    /// The sample that stands for 1.
    pub fn full(self) -> f32 {
        match self {
            Self::Bits8 => 255.0,
            Self::Bits16 => 65_535.0,
            Self::Float => 1.0,
        }
    }
}

/// The samples of an image.
pub(super) struct Samples {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// How they are stored.
    pub depth: Depth,
    /// Whether the image has a single channel (then all three samples are alike).
    pub grey: bool,
    /// Red, green and blue as stored, row by row from the *bottom* of the picture; alpha is left out.
    pub pixels: Vec<[f32; 3]>,
    /// The file's format, channels and depth.
    pub note: String,
}

impl Samples {
    /// Reads a file; its format is told by its content, not its name.
    pub fn read(path: &Path) -> Result<Self, ImageError> {
        let mut file = BufReader::new(File::open(path).map_err(|e| ImageError::reading(path, e))?);
        let format = format_of(path, &mut file)?;
        if format == ImageFormat::OpenExr {
            check_exr(path, &mut file)?;
        }
        let mut reader = ImageReader::with_format(file, format);
        let mut limits = Limits::default();
        limits.max_alloc = Some(MOST_PIXELS * 40);
        reader.limits(limits);
        let decode_error = |e| ImageError::decoding(path, e);
        let decoder = reader.into_decoder().map_err(decode_error)?;
        check_size(path, decoder.dimensions())?;
        let image = DynamicImage::from_decoder(decoder).map_err(decode_error)?;
        let samples = Self::of_image(path, &image, format)?;
        samples.check_finite(path)?;
        Ok(samples)
    }

    fn of_image(
        path: &Path,
        image: &DynamicImage,
        format: ImageFormat,
    ) -> Result<Self, ImageError> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        let whole = |bytes: &[u8], channels| flipped(bytes, width, channels, f32::from);
        let words = |words: &[u16], channels| flipped(words, width, channels, f32::from);
        let reals = |reals: &[f32], channels| flipped(reals, width, channels, |x| x);
        let (depth, channels, pixels) = match image {
            DynamicImage::ImageLuma8(i) => (Depth::Bits8, "grey", whole(i, 1)),
            DynamicImage::ImageLumaA8(i) => (Depth::Bits8, "grey and alpha", whole(i, 2)),
            DynamicImage::ImageRgb8(i) => (Depth::Bits8, "RGB", whole(i, 3)),
            DynamicImage::ImageRgba8(i) => (Depth::Bits8, "RGBA", whole(i, 4)),
            DynamicImage::ImageLuma16(i) => (Depth::Bits16, "grey", words(i, 1)),
            DynamicImage::ImageLumaA16(i) => (Depth::Bits16, "grey and alpha", words(i, 2)),
            DynamicImage::ImageRgb16(i) => (Depth::Bits16, "RGB", words(i, 3)),
            DynamicImage::ImageRgba16(i) => (Depth::Bits16, "RGBA", words(i, 4)),
            DynamicImage::ImageRgb32F(i) => (Depth::Float, "RGB", reals(i, 3)),
            DynamicImage::ImageRgba32F(i) => (Depth::Float, "RGBA", reals(i, 4)),
            other => {
                let what = format!("the pixel type {:?}", other.color());
                return Err(ImageError::Unsupported { path: path.to_owned(), what });
            }
        };
        let bits = match depth {
            Depth::Bits8 => "8 bits a channel",
            Depth::Bits16 => "16 bits a channel",
            Depth::Float => "floating point",
        };
        let note = format!("{}, {channels}, {bits}", name_of(format));
        Ok(Self { width, height, depth, grey: channels.starts_with("grey"), pixels, note })
    }

    fn check_finite(&self, path: &Path) -> Result<(), ImageError> {
        let (width, height) = (self.width, self.height);
        let rows_from_top = self.pixels.chunks(width).rev().enumerate();
        for (y, row) in rows_from_top.take(height) {
            for (x, pixel) in row.iter().enumerate() {
                if let Some(&value) = pixel.iter().find(|c| !c.is_finite()) {
                    return Err(ImageError::NotFinite { path: path.to_owned(), x, y, value });
                }
            }
        }
        Ok(())
    }
}

/// Pixels of `channels` interleaved samples, the last row first, as red, green and blue.
fn flipped<T: Copy>(
    samples: &[T],
    width: usize,
    channels: usize,
    real: impl Fn(T) -> f32,
) -> Vec<[f32; 3]> {
    let [green, blue] = if channels < 3 { [0, 0] } else { [1, 2] };
    let rows = samples.chunks_exact(width * channels).rev();
    let pixels = rows.flat_map(|row| row.chunks_exact(channels));
    pixels.map(|p| [0, green, blue].map(|c| real(p[c]))).collect()
}

fn format_of(path: &Path, file: &mut BufReader<File>) -> Result<ImageFormat, ImageError> {
    use ImageFormat::{OpenExr, Png, Tiff, WebP};
    let start = first_bytes(file, 64).map_err(|e| ImageError::reading(path, e))?;
    let length = file.get_ref().metadata().map_err(|e| ImageError::reading(path, e))?.len();
    let path = path.to_owned();
    match image::guess_format(&start) {
        _ if start.is_empty() => Err(ImageError::Empty { path }),
        // A decoder takes the missing part of a WebP for damage; its first bytes tell its length.
        Ok(WebP) if riff_length(&start).is_some_and(|whole| length < whole) => {
            Err(ImageError::Truncated { path })
        }
        Ok(format @ (Png | Tiff | WebP | OpenExr)) => Ok(format),
        _ => Err(ImageError::UnknownFormat { path }),
    }
}

/// At most `count` bytes from the start, where the file is left.
pub(super) fn first_bytes(file: &mut BufReader<File>, count: u64) -> std::io::Result<Vec<u8>> {
    let mut start = Vec::new();
    file.by_ref().take(count).read_to_end(&mut start)?;
    file.rewind()?;
    Ok(start)
}

pub(super) fn check_exr(path: &Path, file: &mut BufReader<File>) -> Result<(), ImageError> {
    let start = first_bytes(file, exr::HEADER).map_err(|e| ImageError::reading(path, e))?;
    if let Some(what) = exr::refused_compression(&start) {
        return Err(ImageError::Unsupported { path: path.to_owned(), what: what.into() });
    }
    let [width, height] = exr::data_window(&start);
    check_most(path, (width, height))
}

/// The length a RIFF file says it has, bytes.
fn riff_length(start: &[u8]) -> Option<u64> {
    let field = start.get(4..8)?.try_into().ok()?;
    Some(8 + u64::from(u32::from_le_bytes(field)))
}

fn name_of(format: ImageFormat) -> &'static str {
    match format {
        ImageFormat::Png => "PNG",
        ImageFormat::Tiff => "TIFF",
        ImageFormat::WebP => "WebP",
        _ => "EXR",
    }
}

fn check_size(path: &Path, (width, height): (u32, u32)) -> Result<(), ImageError> {
    if width == 0 || height == 0 {
        return Err(ImageError::Empty { path: path.to_owned() });
    }
    check_most(path, (width, height))
}

pub(super) fn check_most(path: &Path, (width, height): (u32, u32)) -> Result<(), ImageError> {
    // A square of 8192 is the largest in all.
    let limit = if width > MOST || height > MOST { MOST } else { 1 << 13 };
    if limit == MOST || u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(ImageError::TooLarge { path: path.to_owned(), width, height, limit });
    }
    Ok(())
}
