//! What keys do to a viewer.

use super::paint::Placing;
use super::{Side, Tone, Viewer, Zoom};
use crate::tui::keys::{Action, Pressed};

/// Stops a key changes the exposure by.
const STOP: f64 = 0.5;
/// Most stops up or down.
const MOST_STOPS: f64 = 12.0;
/// Most pixels of the screen for one of the image.
const MOST_ZOOM: f64 = 64.0;
/// A step of the split, as a part of the width.
const STEP: f64 = 0.05;

/// The room a viewer has on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Width of a pixel over its height.
    pub aspect: f64,
}

impl Viewer {
    /// Does what a key of [`crate::tui::keys::Context::Picture`] asks; false if it is none of those.
    pub fn act(&mut self, pressed: Pressed, look: Look) -> bool {
        match pressed.action {
            Action::Pick => self.pick(pressed.nth),
            Action::Flip => self.on = if self.on == Side::A { Side::B } else { Side::A },
            Action::Split => self.split = if self.split.is_none() { Some(0.5) } else { None },
            Action::SplitLeft => self.slide(-STEP),
            Action::SplitRight => self.slide(STEP),
            Action::Tone => {
                self.tone = match self.tone {
                    Tone::Image => Tone::Error,
                    Tone::Error => Tone::Difference,
                    Tone::Difference => Tone::Image,
                }
            }
            Action::Values => self.numbers = !self.numbers,
            Action::ZoomIn => self.zoom_by(look, 2.0),
            Action::ZoomOut => self.zoom_by(look, 0.5),
            Action::Whole => {
                self.zoom = if self.zoom == Zoom::Whole { Zoom::Natural } else { Zoom::Whole }
            }
            Action::Brighter => self.expose(STOP),
            Action::Darker => self.expose(-STOP),
            Action::CursorUp => self.step(0, -1),
            Action::CursorDown => self.step(0, 1),
            Action::CursorLeft => self.step(-1, 0),
            Action::CursorRight => self.step(1, 0),
            _ => return false,
        }
        true
    }

    /// Puts the image of this number on the side that is shown.
    pub fn pick(&mut self, number: usize) {
        if number < self.shots.len() {
            self.sides[self.on as usize] = number;
        }
    }

    /// Puts the cursor on the image's pixel under a pixel of the picture.
    pub fn point(&mut self, x: usize, y: usize, look: Look) {
        let Some(image) = self.size() else { return };
        let placing = Placing::of(image, look.size, look.aspect, self.zoom, self.cursor);
        if let Some(pixel) = placing.pixel(x, y, image) {
            self.cursor = pixel;
        }
    }

    fn slide(&mut self, by: f64) {
        self.split = Some((self.split.unwrap_or(0.5) + by).clamp(STEP, 1.0 - STEP));
    }

    fn expose(&mut self, by: f64) {
        self.stops = (self.stops + by).clamp(-MOST_STOPS, MOST_STOPS);
    }

    fn step(&mut self, across: isize, down: isize) {
        let Some([width, height]) = self.size() else { return };
        let moved = |at: usize, by: isize, side: usize| {
            at.saturating_add_signed(by).min(side.saturating_sub(1))
        };
        self.cursor = [moved(self.cursor[0], across, width), moved(self.cursor[1], down, height)];
    }

    fn zoom_by(&mut self, look: Look, factor: f64) {
        let Some(image) = self.size() else { return };
        let placing = Placing::of(image, look.size, look.aspect, self.zoom, self.cursor);
        let now = 1.0 / placing.step[1];
        // From any scale to the next power of two: pixels of the image stay of one size.
        let power = libm::log2(now);
        let next = if factor > 1.0 { power.floor() + 1.0 } else { power.ceil() - 1.0 };
        let least = 1.0 / 16.0;
        self.zoom = Zoom::Times(libm::exp2(next).clamp(least, MOST_ZOOM));
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::viewer;
    use super::*;

    const LOOK: Look = Look { size: [40, 20], aspect: 1.0 };

    fn press(viewer: &mut Viewer, action: Action, nth: usize) {
        assert!(viewer.act(Pressed { action, nth }, LOOK), "{action:?}");
    }

    #[test]
    fn flipping_twice_changes_nothing() {
        let mut viewer = viewer();
        press(&mut viewer, Action::Flip, 0);
        assert_eq!(viewer.caption(), "B reference");
        press(&mut viewer, Action::Flip, 0);
        assert_eq!(viewer.caption(), "A bright");
    }

    #[test]
    fn digits_choose_for_the_side_shown() {
        let mut viewer = viewer();
        press(&mut viewer, Action::Flip, 0);
        press(&mut viewer, Action::Pick, 2);
        assert_eq!(viewer.sides, [1, 2]);
        press(&mut viewer, Action::Pick, 9);
        assert_eq!(viewer.sides, [1, 2], "there is no ninth");
        assert_eq!(viewer.caption(), "B slow …");
    }

    #[test]
    fn the_split_stays_within() {
        let mut viewer = viewer();
        press(&mut viewer, Action::Split, 0);
        (0..30).for_each(|_| press(&mut viewer, Action::SplitRight, 0));
        assert_eq!(viewer.split, Some(0.95));
        press(&mut viewer, Action::Split, 0);
        assert_eq!(viewer.split, None);
    }

    #[test]
    fn zooming_goes_by_powers_of_two_and_stops() {
        let mut viewer = viewer();
        // 4 × 2 fits 40 × 20 ten times.
        press(&mut viewer, Action::ZoomIn, 0);
        assert_eq!(viewer.zoom, Zoom::Times(16.0));
        (0..9).for_each(|_| press(&mut viewer, Action::ZoomIn, 0));
        assert_eq!(viewer.zoom, Zoom::Times(64.0));
        (0..99).for_each(|_| press(&mut viewer, Action::ZoomOut, 0));
        assert_eq!(viewer.zoom, Zoom::Times(1.0 / 16.0));
        press(&mut viewer, Action::Whole, 0);
        assert_eq!(viewer.zoom, Zoom::Whole);
    }

    #[test]
    fn the_cursor_stays_within_the_image() {
        let mut viewer = viewer();
        (0..9).for_each(|_| press(&mut viewer, Action::CursorLeft, 0));
        (0..9).for_each(|_| press(&mut viewer, Action::CursorDown, 0));
        assert_eq!(viewer.cursor, [0, 1]);
        viewer.point(39, 0, LOOK);
        assert_eq!(viewer.cursor, [3, 0]);
        viewer.zoom = Zoom::Times(1.0);
        viewer.point(0, 0, LOOK);
        assert_eq!(viewer.cursor, [3, 0], "beside the image");
    }

    #[test]
    fn an_empty_viewer_takes_every_key() {
        let mut viewer = Viewer::default();
        for action in [Action::ZoomIn, Action::CursorUp, Action::Pick, Action::Whole, Action::Tone]
        {
            press(&mut viewer, action, 0);
        }
        viewer.point(3, 3, LOOK);
        assert_eq!(viewer.cursor, [0, 0]);
    }
}
