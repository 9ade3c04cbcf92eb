//! Text as outlines: Noto Sans, filled like any other shape, so that it has the same pixels everywhere.

use std::sync::LazyLock;

use tiny_skia::PathBuilder;
use ttf_parser::{Face, OutlineBuilder};

static REGULAR: LazyLock<Face> = LazyLock::new(|| face(notosans::REGULAR_TTF));
static BOLD: LazyLock<Face> = LazyLock::new(|| face(notosans::BOLD_TTF));

/// A superscript is this much smaller and stands this much of the size above the line.
const SUPERSCRIPT: (f32, f32) = (0.7, 0.38);

fn face(bytes: &'static [u8]) -> Face<'static> {
    Face::parse(bytes, 0).expect("the font is compiled in; a test draws with it")
}

/// Adds the outlines of `text`, with its baseline starting at the origin, to `path`, and returns its
/// width. What stands in `^{…}` is a superscript.
pub fn outline(text: &str, size: f32, bold: bool, path: &mut PathBuilder) -> f32 {
    let face = if bold { &*BOLD } else { &*REGULAR };
    runs(text).fold(0.0, |x, (run, raised)| {
        let (scale, lift) = if raised { SUPERSCRIPT } else { (1.0, 0.0) };
        let unit = size * scale / f32::from(face.units_per_em());
        run.chars().fold(x, |x, c| {
            let glyph = face.glyph_index(c).unwrap_or_default();
            face.outline_glyph(glyph, &mut Pen { path, unit, x, y: -lift * size });
            x + f32::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * unit
        })
    })
}

/// The width of `text`.
pub fn width(text: &str, size: f32, bold: bool) -> f32 {
    outline(text, size, bold, &mut PathBuilder::new())
}

/// The start of `text` that fits into `room`, with an ellipsis if something is cut off.
pub fn fitted(text: &str, size: f32, bold: bool, room: f32) -> String {
    if width(text, size, bold) <= room {
        return text.to_owned();
    }
    let mut kept = text.to_owned();
    while kept.pop().is_some() {
        let shortened = format!("{}…", kept.trim_end());
        if width(&shortened, size, bold) <= room {
            return shortened;
        }
    }
    String::new()
}

/// Splits at `^{…}` into (text, whether raised).
fn runs(text: &str) -> impl Iterator<Item = (&str, bool)> {
    text.split("^{").enumerate().flat_map(|(i, part)| match part.split_once('}') {
        Some((raised, rest)) if i > 0 => [(raised, true), (rest, false)],
        _ => [(part, false), ("", false)],
    })
}

/// Turns a glyph's outline (font units, y up) into a path (y down).
struct Pen<'a> {
    path: &'a mut PathBuilder,
    unit: f32,
    x: f32,
    y: f32,
}

impl Pen<'_> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.unit, self.y - y * self.unit)
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn superscripts_are_narrower_and_marked_off() {
        assert_eq!(
            runs("10^{-3} s").collect::<Vec<_>>()[..3],
            [("10", false), ("", false), ("-3", true)]
        );
        assert!(width("10^{33}", 12.0, false) < width("1033", 12.0, false));
    }

    #[test]
    fn long_text_is_cut_to_its_room() {
        let long = "a name that nobody would give to a texture";
        let cut = fitted(long, 12.0, false, 80.0);
        assert!(cut.ends_with('…') && width(&cut, 12.0, false) <= 80.0);
        assert_eq!(fitted("short", 12.0, false, 80.0), "short");
    }

    #[test]
    fn every_sign_the_plots_use_is_in_the_font() {
        for c in "0123456789.,−–…×½√∫αωθσ·÷≥≤†+-|".chars() {
            assert!(REGULAR.glyph_index(c).is_some(), "{c}");
        }
    }
}
