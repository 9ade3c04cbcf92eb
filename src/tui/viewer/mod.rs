//! The viewer: images of one scene, looked at side against side. The lab and the results share it.
//!
//! It holds a *reference* and numbered images, and shows two of them, the sides A and B: one at a time, flipped by a
//! key, or both on either side of a split.

mod paint;
mod update;
mod values;

pub use paint::Sight;
pub use update::Look;
pub use values::values;

use std::sync::Arc;

use crate::render::Film;

/// An image that can be looked at.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Its name: a method's label, or `reference`.
    pub label: String,
    /// What it is, in a few words, such as `4 spp`; may be empty.
    pub remark: String,
    /// The image, once there is one.
    pub film: Option<Arc<Film>>,
}

/// One of the two images that are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Side {
    /// The first, left of the split.
    #[default]
    A,
    /// The second, right of the split.
    B,
}

/// What of an image is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tone {
    /// Itself.
    #[default]
    Image,
    /// |A − R| in false colour.
    Error,
    /// A − R: blue where it is too dark, orange where it is too bright.
    Difference,
}

/// How large an image is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Zoom {
    /// As large as there is room for; of an image larger than the room, its middle, a pixel a pixel: shrinking
    /// would average what filters are looked at for.
    #[default]
    Natural,
    /// All of it, shrunk if need be.
    Whole,
    /// This many pixels of the screen for one of the image.
    Times(f64),
}

/// Images, and how they are looked at.
#[derive(Clone, Debug)]
pub struct Viewer {
    /// The images; the first is the reference.
    pub shots: Vec<Shot>,
    /// Which of them the sides A and B are.
    pub sides: [usize; 2],
    /// The side that is shown, or, where both are, that keys change.
    pub on: Side,
    /// Where the split is, as a part of the width from the left; both sides are shown then.
    pub split: Option<f64>,
    /// What is shown of them.
    pub tone: Tone,
    /// Whether pixels are shown as numbers.
    pub numbers: bool,
    /// How large.
    pub zoom: Zoom,
    /// The pixel the cursor is at: across, down.
    pub cursor: [usize; 2],
    /// What radiances are multiplied by, in stops above the reference's white.
    pub stops: f64,
}

impl Default for Viewer {
    fn default() -> Self {
        Self::of(Vec::new())
    }
}

impl Viewer {
    /// A viewer of these images, the first the reference: the second on side A, the reference on side B.
    pub fn of(shots: Vec<Shot>) -> Self {
        let mut viewer = Self {
            sides: [1.min(shots.len().saturating_sub(1)), 0],
            shots,
            on: Side::A,
            split: None,
            tone: Tone::Image,
            numbers: false,
            zoom: Zoom::Natural,
            cursor: [0, 0],
            stops: 0.0,
        };
        viewer.centre();
        viewer
    }

    /// Takes other images in place of those there are, and goes on looking in the same way, as far as it can.
    pub fn replace(&mut self, shots: Vec<Shot>) {
        let before = self.size();
        let last = shots.len().saturating_sub(1);
        self.shots = shots;
        self.sides = self.sides.map(|side| side.min(last));
        match (before, self.size()) {
            (Some(old), Some(new)) if old == new => {}
            (_, None) => {}
            _ => self.centre(),
        }
    }

    /// Puts the cursor into the middle.
    pub fn centre(&mut self) {
        if let Some([width, height]) = self.size() {
            self.cursor = [width / 2, height / 2];
        }
    }

    /// Pixels across and down of its images, once there is one.
    pub fn size(&self) -> Option<[usize; 2]> {
        let film = self.shots.iter().find_map(|shot| shot.film.as_ref())?;
        Some([film.width(), film.height()])
    }

    /// The number of the image on a side.
    pub fn side(&self, side: Side) -> usize {
        self.sides[side as usize]
    }

    /// The image on a side, if there are any.
    pub fn shot(&self, side: Side) -> Option<&Shot> {
        self.shots.get(self.side(side))
    }

    /// The film on a side.
    pub fn film(&self, side: Side) -> Option<&Arc<Film>> {
        self.shot(side)?.film.as_ref()
    }

    /// The reference's film.
    pub fn reference(&self) -> Option<&Arc<Film>> {
        self.shots.first()?.film.as_ref()
    }

    /// The radiance that is shown as white: the reference's, or side A's, at this exposure.
    pub fn white(&self) -> f64 {
        let film = self.reference().or_else(|| self.film(Side::A)).or_else(|| self.film(Side::B));
        let white = film.map_or(1.0, |film| film.white());
        white * libm::exp2(-self.stops)
    }

    /// What is seen now, to be painted at any size.
    pub fn sight(&self) -> Sight {
        let of = |side| self.film(side).cloned();
        let (left, right) = match (self.split, self.on) {
            (Some(at), _) => (of(Side::A), Some((of(Side::B), at))),
            (None, on) => (of(on), None),
        };
        let names = match (self.split, self.on) {
            (Some(_), _) => self.sides.map(Some),
            (None, on) => [Some(self.side(on)), None],
        };
        Sight {
            names,
            left,
            right,
            reference: self.reference().cloned(),
            tone: self.tone,
            zoom: self.zoom,
            cursor: self.cursor,
            white: self.white(),
        }
    }

    /// What is shown, in words: the sides, what of them, how large, how bright.
    pub fn caption(&self) -> String {
        let name = |side: Side| {
            let shot = self.shot(side);
            shot.map_or_else(
                || "nothing".to_owned(),
                |shot| {
                    let waits = if shot.film.is_none() { " …" } else { "" };
                    let gap = if shot.remark.is_empty() { "" } else { " " };
                    format!("{}{gap}{}{waits}", shot.label, shot.remark)
                },
            )
        };
        let what = match (self.split, self.on) {
            (Some(_), on) => {
                let mark = |side| if side == on { "▸" } else { "" };
                let (a, b) = (mark(Side::A), mark(Side::B));
                format!("{a}A {} │ {b}B {}", name(Side::A), name(Side::B))
            }
            (None, Side::A) => format!("A {}", name(Side::A)),
            (None, Side::B) => format!("B {}", name(Side::B)),
        };
        let tone = match self.tone {
            Tone::Image => "",
            Tone::Error => "  |error|",
            Tone::Difference => "  signed error",
        };
        let stops =
            if self.stops == 0.0 { String::new() } else { format!("  {:+} stops", self.stops) };
        format!("{what}{tone}{stops}")
    }

    /// The values under the cursor, in words: of the reference, of both sides and how far they are off.
    pub fn under_cursor(&self) -> Option<String> {
        let [width, height] = self.size()?;
        let [x, y] = self.cursor;
        if x >= width || y >= height {
            return None;
        }
        let value = |film: &Film| film.pixels().get(y * film.width() + x).copied();
        let truth = self.reference().and_then(|film| value(film));
        let mut words = format!("({x}, {y})");
        if let Some(truth) = truth {
            words += &format!("  R {truth:.4}");
        }
        for (name, side) in [("A", Side::A), ("B", Side::B)] {
            let Some(value) = self.film(side).and_then(|film| value(film)) else { continue };
            if self.side(side) == 0 && truth.is_some() {
                continue;
            }
            words += &format!("  {name} {value:.4}");
            if let Some(truth) = truth {
                words += &format!(" ({:+.4})", value - truth);
            }
        }
        Some(words)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A reference of 4 × 2 and two images, one of them twice as bright, one still to come.
    pub fn viewer() -> Viewer {
        let film = |scale: f32| {
            let pixels = (0..8).map(|i| scale * i as f32 / 8.0).collect();
            Some(Arc::new(Film::new(4, 2, pixels)))
        };
        let shot = |label: &str, film| Shot { label: label.into(), remark: String::new(), film };
        Viewer::of(vec![
            shot("reference", film(1.0)),
            shot("bright", film(2.0)),
            shot("slow", None),
        ])
    }

    #[test]
    fn it_opens_on_the_first_image_against_the_reference() {
        let viewer = viewer();
        assert_eq!((viewer.sides, viewer.cursor), ([1, 0], [2, 1]));
        assert_eq!(viewer.caption(), "A bright");
        assert_eq!(viewer.under_cursor().unwrap(), "(2, 1)  R 0.7500  A 1.5000 (+0.7500)");
    }

    #[test]
    fn an_empty_viewer_shows_nothing_and_says_so() {
        let viewer = Viewer::default();
        assert_eq!(viewer.under_cursor(), None);
        assert_eq!(viewer.caption(), "A nothing");
        assert!(viewer.sight().left.is_none());
    }

    #[test]
    fn other_images_of_the_same_size_keep_the_cursor() {
        let mut viewer = viewer();
        viewer.cursor = [0, 1];
        let shots = viewer.shots[..2].to_vec();
        viewer.replace(shots);
        assert_eq!(viewer.cursor, [0, 1]);
        viewer.replace(Vec::new());
        assert_eq!(viewer.sides, [0, 0]);
    }
}
