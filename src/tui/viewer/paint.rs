//! From what is looked at to a picture of any size.

use std::hash::{Hash, Hasher};
use std::sync::{Arc, LazyLock};

use super::{Tone, Zoom};
use crate::experiment::results::Picture;
use crate::render::{Film, heat, srgb};
use crate::report::signed;
use crate::tui::picture::{Paint, SURROUND};

/// Images as they are looked at: everything a picture of them follows from.
#[derive(Clone, Debug)]
pub struct Sight {
    /// The image, or the one left of the split.
    pub left: Option<Arc<Film>>,
    /// The image right of the split, and where that is, as a part of the width.
    pub right: Option<(Option<Arc<Film>>, f64)>,
    /// The numbers of the images on the sides that are shown.
    pub names: [Option<usize>; 2],
    /// What errors are measured from.
    pub reference: Option<Arc<Film>>,
    /// What is shown.
    pub tone: Tone,
    /// How large.
    pub zoom: Zoom,
    /// The pixel in the middle, where not all fits.
    pub cursor: [usize; 2],
    /// The radiance, or error, of the last colour.
    pub white: f64,
}

/// The split.
const LINE: [u8; 3] = [255, 200, 0];
/// The cursor's corners.
const CURSOR: [u8; 3] = [255, 80, 80];

/// Where an image lies in a picture: screen pixels of it, and image pixels a screen pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Image coordinates of the picture's left upper corner.
    pub origin: [f64; 2],
    /// Image pixels for one pixel of the picture, across and down.
    pub step: [f64; 2],
}

impl Placing {
    /// Of an image of `image` pixels in a picture of `size` pixels, each `aspect` times as wide as high.
    pub fn of(
        image: [usize; 2],
        size: [usize; 2],
        aspect: f64,
        zoom: Zoom,
        cursor: [usize; 2],
    ) -> Self {
        let [image_w, image_h] = image.map(|side| side.max(1) as f64);
        // In units of a picture's pixel height.
        let [room_w, room_h] = [size[0].max(1) as f64 * aspect, size[1].max(1) as f64];
        let fit = (room_w / image_w).min(room_h / image_h);
        let scale = match zoom {
            Zoom::Whole => fit,
            // Of whole pixels only: halves of pixels would look like bumps.
            Zoom::Natural if fit >= 1.0 => fit.floor(),
            Zoom::Natural => 1.0,
            Zoom::Times(times) => times.max(1e-3),
        };
        let shown = [room_w / scale, room_h / scale];
        let origin = |axis: usize| {
            let (image, shown) = ([image_w, image_h][axis], shown[axis]);
            if shown >= image {
                return 0.5 * (image - shown);
            }
            (cursor[axis] as f64 + 0.5 - 0.5 * shown).clamp(0.0, image - shown)
        };
        Self { origin: [origin(0), origin(1)], step: [aspect / scale, 1.0 / scale] }
    }

    /// The image pixels under a pixel of the picture, as a rectangle: from, to.
    fn under(&self, x: usize, y: usize) -> [[f64; 2]; 2] {
        let at = |axis: usize, i: f64| self.origin[axis] + i * self.step[axis];
        let (x, y) = (x as f64, y as f64);
        [[at(0, x), at(1, y)], [at(0, x + 1.0), at(1, y + 1.0)]]
    }

    /// The image pixel in the middle of a pixel of the picture; None beside the image.
    pub fn pixel(&self, x: usize, y: usize, image: [usize; 2]) -> Option<[usize; 2]> {
        let at = [x, y].map(|i| i as f64 + 0.5);
        let at = [0, 1].map(|axis| self.origin[axis] + at[axis] * self.step[axis]);
        let within = |axis: usize| at[axis] >= 0.0 && at[axis] < image[axis] as f64;
        (within(0) && within(1)).then(|| at.map(|c| c as usize))
    }
}

impl Sight {
    /// Tells pictures apart but for their films: of the same, a former one may stand in while the next is drawn. Which
    /// images are shown belongs to it: one is no former version of another.
    pub fn look_stamp(&self) -> u64 {
        let mut hasher = std::hash::DefaultHasher::new();
        (self.names, self.tone, self.cursor).hash(&mut hasher);
        hasher.finish()
    }

    /// Tells pictures apart: of the same stamp, they are the same.
    pub fn stamp(&self) -> u64 {
        let mut hasher = std::hash::DefaultHasher::new();
        let place = |film: &Option<Arc<Film>>| film.as_ref().map(|film| Arc::as_ptr(film) as usize);
        place(&self.left).hash(&mut hasher);
        let right = self.right.as_ref().map(|(film, at)| (place(film), at.to_bits()));
        right.hash(&mut hasher);
        place(&self.reference).hash(&mut hasher);
        (self.tone, self.cursor, self.white.to_bits()).hash(&mut hasher);
        match self.zoom {
            Zoom::Natural => 0u64,
            Zoom::Whole => 1,
            Zoom::Times(times) => times.to_bits(),
        }
        .hash(&mut hasher);
        hasher.finish()
    }

    /// Pixels across and down of its images.
    pub fn image_size(&self) -> Option<[usize; 2]> {
        let right = self.right.as_ref().and_then(|(film, _)| film.as_ref());
        let film = self.left.as_ref().or(right).or(self.reference.as_ref())?;
        Some([film.width(), film.height()])
    }

    /// The colour of an image's part.
    fn colour(&self, film: &Film, part: [[f64; 2]; 2]) -> [u8; 3] {
        let Some(value) = mean(film, part) else { return SURROUND };
        let off = || {
            let truth = self.reference.as_ref().and_then(|truth| mean_error(film, truth, part));
            truth.unwrap_or([0.0; 2])
        };
        match self.tone {
            Tone::Image => [code(value / self.white); 3],
            Tone::Error => heat(off()[0] / self.white),
            Tone::Difference => signed(off()[1] / self.white),
        }
    }
}

impl Paint for Sight {
    fn paint(&self, size: [usize; 2], aspect: f64) -> Picture {
        let [width, height] = size;
        let mut rgb = vec![SURROUND; width * height];
        if let Some(image) = self.image_size() {
            let placing = Placing::of(image, size, aspect, self.zoom, self.cursor);
            let split = self.right.as_ref().map(|(_, at)| (at * width as f64) as usize);
            for (i, colour) in rgb.iter_mut().enumerate() {
                let (x, y) = (i % width, i / width);
                let film = match (&self.right, split) {
                    (Some(_), Some(at)) if x == at => {
                        *colour = LINE;
                        continue;
                    }
                    (Some((right, _)), Some(at)) if x > at => right.as_ref(),
                    _ => self.left.as_ref(),
                };
                if let Some(film) = film {
                    *colour = self.colour(film, placing.under(x, y));
                }
            }
            mark(&mut rgb, size, &placing, self.cursor);
        }
        Picture { width, height, rgb }
    }
}

/// [`srgb`], looked up: a picture has many pixels, and a key waits for them.
fn code(linear: f64) -> u8 {
    /// The least linear value of each code above 0.
    static LEAST: LazyLock<[f64; 255]> = LazyLock::new(|| {
        std::array::from_fn(|below| {
            // Halves until the doubles on either side of the step are found.
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..64 {
                let middle: f64 = 0.5 * (low + high);
                if usize::from(srgb(middle)) > below { high = middle } else { low = middle }
            }
            high
        })
    });
    LEAST.partition_point(|least| *least <= linear) as u8
}

/// Marks the cursor: the corners of its pixel where that is large, else four dots about it.
fn mark(rgb: &mut [[u8; 3]], size: [usize; 2], placing: &Placing, cursor: [usize; 2]) {
    let screen = |axis: usize, at: f64| ((at - placing.origin[axis]) / placing.step[axis]).floor();
    let [left, top] = [0, 1].map(|axis| screen(axis, cursor[axis] as f64 + 1e-9) - 1.0);
    let [right, bottom] = [0, 1].map(|axis| {
        let end = (cursor[axis] as f64 + 1.0 - placing.origin[axis]) / placing.step[axis];
        end.ceil().max(screen(axis, cursor[axis] as f64 + 1e-9) + 1.0)
    });
    for [x, y] in [[left, top], [right, top], [left, bottom], [right, bottom]] {
        if x >= 0.0 && y >= 0.0 && x < size[0] as f64 && y < size[1] as f64 {
            rgb[y as usize * size[0] + x as usize] = CURSOR;
        }
    }
}

/// The whole pixels of an image that a rectangle covers: at least the one in its middle; None beside the image.
fn covered(film: &Film, [from, to]: [[f64; 2]; 2]) -> Option<[std::ops::Range<usize>; 2]> {
    let range = |axis: usize, side: usize| {
        let middle = 0.5 * (from[axis] + to[axis]);
        if !(middle >= 0.0 && middle < side as f64) {
            return None;
        }
        if to[axis] - from[axis] <= 1.0 {
            let at = middle as usize;
            return Some(at..at + 1);
        }
        let first = from[axis].max(0.0).round() as usize;
        let end = (to[axis].round() as usize).min(side);
        Some(first.min(end.saturating_sub(1))..end)
    };
    Some([range(0, film.width())?, range(1, film.height())?])
}

/// The mean radiance over a rectangle, so that a picture that is smaller than the image is its average.
fn mean(film: &Film, part: [[f64; 2]; 2]) -> Option<f64> {
    let [across, down] = covered(film, part)?;
    let count = (across.len() * down.len()) as f64;
    let rows = down.map(|y| &film.pixels()[y * film.width()..][across.clone()]);
    Some(rows.flatten().map(|p| f64::from(*p)).sum::<f64>() / count)
}

/// The mean absolute and the mean signed error over a rectangle.
fn mean_error(film: &Film, truth: &Film, part: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    if (film.width(), film.height()) != (truth.width(), truth.height()) {
        return None;
    }
    let [across, down] = covered(film, part)?;
    let count = (across.len() * down.len()) as f64;
    let mut sums = [0.0; 2];
    for y in down {
        for x in across.clone() {
            let at = y * film.width() + x;
            let off = f64::from(film.pixels()[at]) - f64::from(truth.pixels()[at]);
            sums[0] += off.abs();
            sums[1] += off;
        }
    }
    Some(sums.map(|sum| sum / count))
}

#[cfg(test)]
mod tests {
    use super::super::Side;
    use super::super::tests::viewer;
    use super::*;

    #[test]
    fn an_image_keeps_its_proportions_whatever_the_pixels() {
        // 40 × 30 in 80 × 80 pixels half as wide as high: a screen pixel down is an image pixel.
        let placing = Placing::of([40, 30], [80, 80], 0.5, Zoom::Whole, [20, 15]);
        assert_eq!(placing.step, [0.5, 1.0]);
        assert_eq!(placing.origin, [0.0, -25.0]);
        let [from, to] = placing.under(79, 54);
        assert_eq!((from, to), ([39.5, 29.0], [40.0, 30.0]));
    }

    #[test]
    fn what_is_too_large_is_shown_pixel_by_pixel_about_the_cursor() {
        let at = |cursor| Placing::of([100, 100], [10, 10], 1.0, Zoom::Natural, cursor);
        assert_eq!((at([50, 50]).step, at([50, 50]).origin), ([1.0, 1.0], [45.5, 45.5]));
        assert_eq!(at([0, 99]).origin, [0.0, 90.0]);
        assert_eq!(at([0, 99]).pixel(9, 9, [100, 100]), Some([9, 99]));
    }

    #[test]
    fn a_smaller_picture_is_the_average() {
        let film = Film::new(4, 2, vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        assert_eq!(mean(&film, [[0.0, 0.0], [4.0, 2.0]]), Some(3.5));
        assert_eq!(mean(&film, [[2.0, 0.0], [4.0, 2.0]]), Some(4.5));
        assert_eq!(mean(&film, [[3.2, 1.2], [3.4, 1.4]]), Some(7.0));
        assert_eq!(mean(&film, [[-1.0, 0.0], [-0.2, 1.0]]), None);
    }

    #[test]
    fn codes_are_those_of_srgb() {
        for i in 0..=40_000 {
            let linear = f64::from(i) / 32_768.0 - 0.1;
            assert_eq!(code(linear), srgb(linear), "{linear}");
        }
        assert_eq!(code(f64::NAN), srgb(f64::NAN));
    }

    #[test]
    fn a_split_has_a_side_each() {
        let mut viewer = viewer();
        viewer.split = Some(0.5);
        viewer.zoom = Zoom::Whole;
        let picture = viewer.sight().paint([40, 20], 1.0);
        let at = |x: usize, y: usize| picture.rgb[y * 40 + x];
        assert_eq!(at(20, 3), LINE);
        // Image pixel (0, 1): A is twice as bright as the reference, B is the reference.
        let white = viewer.white();
        assert_eq!(at(3, 15), [srgb(1.0 / white); 3]);
        assert_eq!(at(37, 15), [srgb(0.875 / white); 3]);
    }

    #[test]
    fn errors_are_of_the_reference() {
        let mut viewer = viewer();
        viewer.zoom = Zoom::Whole;
        viewer.tone = Tone::Difference;
        let picture = viewer.sight().paint([4, 2], 1.0);
        // The cursor's marks stand in the corners of pixel (2, 1).
        assert_eq!(picture.rgb[4], signed(0.5 / viewer.white()));
        viewer.on = Side::B;
        let picture = viewer.sight().paint([4, 2], 1.0);
        assert_eq!(picture.rgb[4], signed(0.0));
    }

    #[test]
    fn stamps_follow_what_is_seen() {
        let mut viewer = viewer();
        let first = viewer.sight().stamp();
        assert_eq!(viewer.sight().stamp(), first);
        viewer.cursor = [0, 0];
        assert_ne!(viewer.sight().stamp(), first);
    }

    #[test]
    fn any_size_is_painted() {
        for size in [[0, 0], [1, 1], [3, 200]] {
            for zoom in [Zoom::Natural, Zoom::Whole, Zoom::Times(64.0)] {
                let sight = Sight { zoom, ..viewer().sight() };
                assert_eq!(sight.paint(size, 0.5).rgb.len(), size[0] * size[1]);
            }
        }
    }
}
