//! Pictures on a terminal: in its own protocol if it has one, in half blocks of two pixels each, or in characters.
//!
//! The view names what it wants drawn ([`Paint`]) and where; a [`Gallery`] draws it. Half blocks and characters are
//! drawn at once. For a protocol (kitty, iTerm2, sixel) the gallery wishes for an encoding, which an [`Encoder`] makes
//! on its own thread; half blocks stand in its place until it comes.

pub mod cells;
mod choice;
mod depth;
mod encoder;
mod flat;
mod gallery;
mod probe;
mod screen;

pub use choice::{Colours, Pictures};
pub use depth::{Depth, entry_rgb, environment};
pub use encoder::{Encoded, Encoder, Wish};
pub use flat::Flat;
pub use gallery::Gallery;
pub use probe::probe;
pub use screen::{Screen, Way};

use crate::experiment::results::Picture;

/// Something that can be drawn at any size.
pub trait Paint: Send + Sync {
    /// Draws it whole.
    ///
    /// `size` is pixels across and down; the picture has exactly these. `aspect` is the width of such a pixel over its
    /// height, as they stand on the screen. Whatever does not fill the size is centred, [`SURROUND`] about it.
    fn paint(&self, size: [usize; 2], aspect: f64) -> Picture;
}

/// The colour about a picture that does not fill its place, sRGB.
pub const SURROUND: [u8; 3] = [0, 0, 0];

/// A place on the screen that shows one picture at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Slot(pub u8);

/// What a slot shows, so that a drawing made for it can be told from one made for something else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// The picture: another number is another picture.
    pub picture: u64,
    /// Its version: of one picture that improves, a former version may stand in until the next is drawn.
    pub version: u64,
}

/// Where a picture of `source` pixels, each square, stands centred within `size` pixels of this aspect, as large as
/// fits: [left, top] and [across, down], at least a pixel each way.
pub fn fitted(source: [usize; 2], size: [usize; 2], aspect: f64) -> ([usize; 2], [usize; 2]) {
    let [width, height] = source.map(|side| side.max(1) as f64);
    let [across, down] = size.map(|side| side as f64);
    // Screen height of a pixel is 1, its width `aspect`.
    let scale = (across * aspect / width).min(down / height);
    let side = |length: f64, most: usize| (length.round() as usize).clamp(1, most.max(1));
    let fit = [side(width * scale / aspect, size[0]), side(height * scale, size[1])];
    ([0, 1].map(|i| size[i].saturating_sub(fit[i]) / 2), fit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_stays_square_on_the_screen() {
        // Pixels twice as high as wide: as many again across.
        assert_eq!(fitted([64, 64], [100, 20], 0.5), ([30, 0], [40, 20]));
        assert_eq!(fitted([64, 64], [10, 40], 1.0), ([0, 15], [10, 10]));
        assert_eq!(fitted([1000, 1], [10, 10], 1.0), ([0, 4], [10, 1]));
    }

    #[test]
    fn nothing_fits_into_nothing_without_trouble() {
        assert_eq!(fitted([0, 0], [0, 0], 1.0).1, [1, 1]);
    }
}
