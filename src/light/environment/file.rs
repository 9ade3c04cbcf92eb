//! Environments from image files.

use std::path::{Path, PathBuf};

use super::{Environment, MOST_ACROSS};
use crate::texture::image_file::{ImageError, Luminance, read_luminance};

/// Why a file is no environment. Every message names the file and says what to do.
#[derive(Debug, thiserror::Error)]
pub enum EnvironmentError {
    /// The image cannot be read.
    #[error(transparent)]
    Image(ImageError),
    /// It is no file of radiance.
    #[error("{}: neither an EXR nor a Radiance HDR file; save the environment as one of them", path.display())]
    WrongKind {
        /// The file.
        path: PathBuf,
    },
    /// It is whole, but uses something the decoder does not know or refuses.
    #[error("{}: this kind of file is not supported ({what}); save it again as EXR with ZIP compression and \
             channels R, G and B, or Y, or as Radiance HDR", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is not known.
        what: String,
    },
    /// It is not twice as wide as high.
    #[error("{}: {width} × {height} pixels; an environment map is equirectangular, twice as wide as high", path.display())]
    NotTwoToOne {
        /// The file.
        path: PathBuf,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// It has more pixels than are taken.
    #[error("{}: {width} pixels across are too many; scale it down to at most {MOST_ACROSS}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Pixels across.
        width: usize,
    },
    /// Some pixels are no radiances.
    #[error("{}: {count} pixels are infinite or not a number, the first, {x} from the left and {y} from the \
             top (counted from 0), is {value}; replace them", path.display())]
    NoRadiance {
        /// The file.
        path: PathBuf,
        /// How many there are.
        count: usize,
        /// Of the first: pixels from the left.
        x: usize,
        /// Pixels from the top.
        y: usize,
        /// Its luminance.
        value: f32,
    },
}

impl From<ImageError> for EnvironmentError {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::UnknownFormat { path } => Self::WrongKind { path },
            ImageError::Unsupported { path, what } => Self::Unsupported { path, what },
            ImageError::TooLarge { path, width, .. } => {
                Self::TooLarge { path, width: width as usize }
            }
            other => Self::Image(other),
        }
    }
}

/// An environment from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// The environment.
    pub environment: Environment,
    /// What may surprise about the file, a sentence each.
    pub notes: Vec<String>,
}

/// Reads the environment in an EXR or Radiance HDR file, turned and multiplied as [`Environment::new`] says.
/// Pixels of negative luminance, which resampling leaves beside bright lights, are taken for black; a note
/// tells.
///
/// # Errors
/// An [`EnvironmentError`].
pub fn read(
    path: impl AsRef<Path>,
    rotation: f64,
    intensity: f64,
) -> Result<Read, EnvironmentError> {
    let path = path.as_ref();
    let image = inspect(path)?;
    let notes = negative(path, &image).into_iter().collect();
    let values: Vec<f32> = image.values.iter().map(|v| v.max(0.0)).collect();
    Ok(Read { environment: Environment::new(image.height, &values, rotation, intensity), notes })
}

/// How many pixels are negative, if any, and where the lowest is.
fn negative(path: &Path, image: &Luminance) -> Option<String> {
    let below = |value: &&f32| **value < 0.0;
    let count = image.values.iter().filter(below).count();
    let lowest = image.values.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
    let (place, value) = lowest.filter(|_| count > 0)?;
    Some(format!(
        "{}: {count} of {} pixels are negative and are taken for black; the lowest, {} from the left and {} \
         from the top (counted from 0), is {value}",
        path.display(),
        image.values.len(),
        place % image.width,
        place / image.width
    ))
}

/// The picture in such a file, once it is known to be an environment.
///
/// # Errors
/// An [`EnvironmentError`].
pub fn inspect(path: impl AsRef<Path>) -> Result<Luminance, EnvironmentError> {
    let image = read_luminance(path.as_ref())?;
    check(path.as_ref(), &image)?;
    Ok(image)
}

fn check(path: &Path, image: &Luminance) -> Result<(), EnvironmentError> {
    let Luminance { width, height, ref values } = *image;
    let path = path.to_owned();
    if width != 2 * height || height == 0 {
        return Err(EnvironmentError::NotTwoToOne { path, width, height });
    }
    if width > MOST_ACROSS {
        return Err(EnvironmentError::TooLarge { path, width });
    }
    let wrong = |value: &f32| !value.is_finite();
    let Some(first) = values.iter().position(wrong) else { return Ok(()) };
    let count = values.iter().filter(|v| wrong(v)).count();
    let (x, y, value) = (first % width, first / width, values[first]);
    Err(EnvironmentError::NoRadiance { path, count, x, y, value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{WritableImage, write_rgb_file};

    fn complaint(path: &Path) -> String {
        let error = read(path, 0.0, 1.0).map(|_| ()).unwrap_err().to_string();
        error.replace(&format!("{}/", path.parent().unwrap().display()), "")
    }

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().unwrap()
    }

    fn exr(folder: &Path, name: &str, width: usize, height: usize, special: f32) -> PathBuf {
        let path = folder.join(name);
        let value = |x: usize, y: usize| if (x, y) == (2, 1) { special } else { 1.0 };
        write_rgb_file(&path, width, height, |x, y| (value(x, y), value(x, y), value(x, y)))
            .unwrap();
        path
    }

    #[test]
    fn exr_and_hdr_files_are_environments() {
        let folder = folder();
        let path = exr(folder.path(), "a.exr", 8, 4, 3.0);
        let read_back = read(&path, 0.0, 2.0).unwrap().environment;
        assert_eq!(read_back.height(), 4);
        // Pixel (2, 1): 2.5/8 across, 1.5/4 down.
        let bright = super::super::Spot { across: 2.5 / 8.0, down: 1.5 / 4.0 }.direction();
        assert!((read_back.radiance(&bright) - 6.0).abs() < 1e-5);
        assert!((read_back.radiance(&-bright) - 2.0).abs() < 1e-5);
        let path = folder.path().join("a.hdr");
        let pixels = vec![image::Rgb([0.5f32, 0.5, 0.5]); 8];
        let file = std::fs::File::create(&path).unwrap();
        image::codecs::hdr::HdrEncoder::new(file).encode(&pixels, 4, 2).unwrap();
        assert!((read(&path, 0.0, 1.0).unwrap().environment.mean() - 0.5).abs() < 1e-2);
    }

    #[test]
    fn negative_pixels_are_black_and_told_of() {
        let folder = folder();
        let found = read(exr(folder.path(), "dark.exr", 4, 2, -2.0), 0.0, 1.0).unwrap();
        assert!(found.environment.mean() > 0.8 && found.environment.mean() < 0.9);
        let [note] = found.notes.as_slice() else { panic!("{:?}", found.notes) };
        let says = "1 of 8 pixels are negative and are taken for black; the lowest, 2 from the left and 1 from the \
                    top (counted from 0), is -2";
        assert!(note.ends_with(says), "{note}");
        assert!(
            read(exr(folder.path(), "fine.exr", 4, 2, 2.0), 0.0, 1.0).unwrap().notes.is_empty()
        );
    }

    #[test]
    fn one_channel_is_luminance_itself() {
        let folder = folder();
        let path = folder.path().join("grey.exr");
        let pixel = |at: exr::prelude::Vec2<usize>| (at.x() as f32,);
        let channels =
            exr::prelude::SpecificChannels::build().with_channel::<f32>("Y").with_pixel_fn(pixel);
        exr::prelude::Image::from_channels((4, 2), channels).write().to_file(&path).unwrap();
        assert!((read(&path, 0.0, 1.0).unwrap().environment.mean() - 1.5).abs() < 1e-6);
    }

    #[test]
    fn errors_name_the_file_and_say_what_to_do() {
        let folder = folder();
        let at = folder.path();
        let square = complaint(&exr(at, "square.exr", 4, 4, 1.0));
        assert_eq!(
            square,
            "square.exr: 4 × 4 pixels; an environment map is equirectangular, twice as wide as high"
        );
        let odd = complaint(&exr(at, "odd.exr", 4, 2, f32::NAN));
        assert_eq!(
            odd,
            "odd.exr: 1 pixels are infinite or not a number, the first, 2 from the left and \
                         1 from the top (counted from 0), is NaN; replace them"
        );
        assert!(complaint(&at.join("none.exr")).starts_with("none.exr: there is no such file"));
        let whole = std::fs::read(exr(at, "a.exr", 64, 32, 1.0)).unwrap();
        let stored = |name: &str, bytes: &[u8], says: &str| {
            std::fs::write(at.join(name), bytes).unwrap();
            let complaint = complaint(&at.join(name));
            assert!(complaint.starts_with(&format!("{name}: {says}")), "{complaint}");
        };
        stored("cut.exr", &whole[..whole.len() / 2], "the file is cut short");
        stored("empty.hdr", &[], "the image is empty");
        stored("text.hdr", b"hello, this is no picture", "neither an EXR nor a Radiance HDR file");
        let head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
        stored("cut.hdr", head, "the file is cut short");
        let mut lossy = whole.clone();
        let key = b"compression\0compression\0\x01\0\0\0";
        let place = lossy.windows(key.len()).position(|w| w == key).unwrap() + key.len();
        lossy[place] = 9;
        stored("lossy.exr", &lossy, "this kind of file is not supported (DWAB compression)");
        let mut huge = whole.clone();
        let key = b"dataWindow\0box2i\0\x10\0\0\0";
        let place = huge.windows(key.len()).position(|w| w == key).unwrap() + key.len();
        huge[place + 8..place + 12].copy_from_slice(&65_535i32.to_le_bytes());
        stored(
            "huge.exr",
            &huge,
            "65536 pixels across are too many; scale it down to at most 8192",
        );
    }

    #[test]
    fn damage_anywhere_is_an_error_or_a_picture_but_no_panic() {
        let folder = folder();
        let whole = std::fs::read(exr(folder.path(), "a.exr", 16, 8, 1.0)).unwrap();
        let path = folder.path().join("bad.exr");
        for at in 0..whole.len() {
            for flip in [0x01, 0x80] {
                let mut bad = whole.clone();
                bad[at] ^= flip;
                std::fs::write(&path, &bad).unwrap();
                let _ = read_luminance(&path);
            }
        }
    }
}
