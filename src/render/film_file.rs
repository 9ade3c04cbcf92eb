//! Films as OpenEXR files: one channel `Y` of 32-bit floats, losslessly compressed. What is read is what
//! was written, bit for bit, and equal films make equal files.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};

use super::image_file::read_image;
use super::{Film, FilmError};
use crate::file::write_whole;

impl Film {
    /// Writes the film as an EXR file, which appears whole or not at all.
    ///
    /// # Errors
    /// [`FilmError`] if the film has no pixels or the file cannot be written.
    pub fn write_exr(&self, path: &Path) -> Result<(), FilmError> {
        let bytes = exr_bytes(self).map_err(|error| FilmError::write(path, error))?;
        write_whole(path, &bytes).map_err(|error| FilmError::write(path, error))
    }

    /// Reads a film that [`Film::write_exr`] wrote, or any image file of one channel.
    ///
    /// # Errors
    /// [`FilmError`] if there is no such file, it is no image, or it has more than one channel.
    pub fn read_exr(path: &Path) -> Result<Self, FilmError> {
        let mut channels = read_image(path)?.channels;
        match (channels.pop(), channels.is_empty()) {
            (Some(film), true) => Ok(film),
            _ => Err(FilmError::NotOneChannel { path: PathBuf::from(path) }),
        }
    }
}

/// A film as the bytes of an EXR file.
fn exr_bytes(film: &Film) -> exr::error::Result<Vec<u8>> {
    let size = Vec2(film.width(), film.height());
    if size.area() == 0 {
        return Err(exr::error::Error::Invalid("the image has no pixels".into()));
    }
    let pixel = |at: Vec2<usize>| (film.pixels()[at.y() * film.width() + at.x()],);
    let channels = SpecificChannels::build().with_channel::<f32>("Y").with_pixel_fn(pixel);
    let attributes = LayerAttributes::default();
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn any_film_comes_back_bit_for_bit(width in 1usize..40, height in 1usize..40, seed in any::<u32>()) {
            // Any bits at all: subnormals, infinities and NaNs too.
            let bits = |i: usize| (i as u32).wrapping_add(seed).wrapping_mul(2_654_435_761);
            let pixels = (0..width * height).map(|i| f32::from_bits(bits(i))).collect();
            let film = Film::new(width, height, pixels);
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("film.exr");
            film.write_exr(&path).unwrap();
            let back = Film::read_exr(&path).unwrap();
            prop_assert_eq!((back.width(), back.height()), (width, height));
            let same = film.pixels().iter().zip(back.pixels()).all(|(a, b)| a.to_bits() == b.to_bits());
            prop_assert!(same);
        }
    }

    #[test]
    fn equal_films_make_equal_files_and_the_bytes_stay() {
        let film = Film::new(64, 48, (0..64 * 48).map(|i| (i % 97) as f32 / 7.0).collect());
        let bytes = exr_bytes(&film).unwrap();
        assert_eq!(bytes, exr_bytes(&film.clone()).unwrap());
        assert!(bytes.len() < 64 * 48 * 4, "compressed: {}", bytes.len());
    }

    #[test]
    fn errors_name_the_file_and_say_what_is_wrong() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing.exr");
        let error = Film::read_exr(&missing).unwrap_err().to_string();
        assert!(error.contains("missing.exr") && error.contains("No such file"), "{error}");
        let broken = folder.path().join("broken.exr");
        std::fs::write(&broken, b"not an image").unwrap();
        let error = Film::read_exr(&broken).unwrap_err().to_string();
        assert!(error.contains("broken.exr"), "{error}");
        let empty = Film::new(0, 3, Vec::new());
        let error = empty.write_exr(&missing).unwrap_err().to_string();
        assert!(error.contains("no pixels"), "{error}");
        assert!(!missing.exists());
    }
}
