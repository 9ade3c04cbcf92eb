//! Films: images of radiance.

use std::sync::OnceLock;

/// A linear, single-channel image: one radiance a pixel.
///
/// Row 0 is the *top* of the picture, as a screen shows it.
#[derive(Clone, Debug)]
pub struct Film {
    width: usize,
    height: usize,
    pixels: Vec<f32>,
    /// [`Film::white`], once somebody asked: a screen asks at every frame.
    pub(super) white: OnceLock<f64>,
}

impl PartialEq for Film {
    fn eq(&self, other: &Self) -> bool {
        let shape = |film: &Self| (film.width, film.height);
        shape(self) == shape(other) && self.pixels == other.pixels
    }
}

impl Film {
    /// A film from `width · height` radiances, row by row from the top.
    ///
    /// # Panics
    /// If the number of pixels is not `width · height`: a programming error.
    pub fn new(width: usize, height: usize, pixels: Vec<f32>) -> Self {
        assert_eq!(pixels.len(), width * height, "shape of a film");
        Self { width, height, pixels, white: OnceLock::new() }
    }

    /// Pixels across.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> usize {
        self.height
    }

    /// All radiances, row by row from the top.
    pub fn pixels(&self) -> &[f32] {
        &self.pixels
    }

    /// A digest of its pixels: films of one size with the same digest are the same, bit by bit.
    pub fn digest(&self) -> String {
        blake3::hash(bytemuck::cast_slice(&self.pixels)).to_hex().to_string()
    }
}
