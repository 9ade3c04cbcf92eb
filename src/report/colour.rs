//! Colours that keep apart for every kind of colour vision, and the style of each method.

use serde::Serialize;

use crate::experiment::results::MethodInfo;

use super::contest::{BRUTE_FORCE, family, unique};

/// A colour with its opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// sRGB.
    pub rgb: [u8; 3],
    /// From 0, clear, to 255, opaque.
    pub opacity: u8,
}

impl Ink {
    /// An opaque colour.
    pub const fn new(rgb: [u8; 3]) -> Self {
        Self { rgb, opacity: 255 }
    }

    /// The same colour for the rasteriser.
    pub fn colour(self) -> tiny_skia::Color {
        let [r, g, b] = self.rgb;
        tiny_skia::Color::from_rgba8(r, g, b, self.opacity)
    }
}

/// Paper.
pub const WHITE: Ink = Ink::new([255, 255, 255]);
/// Ink.
pub const BLACK: Ink = Ink::new([0x22, 0x22, 0x22]);
/// Second-rank text.
pub const GREY: Ink = Ink::new([0x66, 0x66, 0x66]);
/// Grid lines.
pub const PALE: Ink = Ink::new([0xe4, 0xe4, 0xe4]);
/// Areas.
pub const SHADE: Ink = Ink::new([0xf1, 0xf1, 0xf1]);

/// The colours of Okabe and Ito (2008), its yellow darkened to be legible on white.
pub(crate) const OKABE_ITO: [[u8; 3]; 7] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
    [0xa8, 0x98, 0x00],
];

/// How a method is drawn: one colour and marker for all forms of one method, hollow if the form is
/// printed without a normalisation. The unfiltered method is black and heavy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Colour.
    pub ink: Ink,
    /// Number of the marker.
    pub marker: usize,
    /// Whether the marker is an outline.
    pub hollow: bool,
    /// Whether it is the yardstick, brute force: drawn heavier than the rest.
    pub heavy: bool,
}

/// The styles of all methods, in their order.
pub fn styles(methods: &[MethodInfo]) -> Vec<Style> {
    let filters = unique(methods.iter().map(family).filter(|name| *name != BRUTE_FORCE));
    let mut drawn: Vec<Style> = Vec::with_capacity(methods.len());
    for method in methods {
        let place = filters.iter().position(|name| *name == family(method));
        let ink = place.map_or(BLACK, |i| Ink::new(OKABE_ITO[i % OKABE_ITO.len()]));
        let (hollow, heavy) = (!method.normalised, place.is_none());
        let mut style = Style { ink, marker: place.map_or(0, |i| i + 1), hollow, heavy };
        // Two forms of one method that are alike in all else differ in their markers.
        while drawn.contains(&style) {
            style.marker += 1;
        }
        drawn.push(style);
    }
    drawn
}

/// The style of the `i`-th of several series that are no methods.
pub fn series(i: usize) -> Style {
    let ink = Ink::new(OKABE_ITO[i % OKABE_ITO.len()]);
    Style { ink, marker: i, hollow: false, heavy: false }
}

/// The anchors of viridis (van der Walt and Smith 2015), from 0 to 1.
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x4a, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6d, 0xcd, 0x59],
    [0xb4, 0xde, 0x2c],
    [0xfd, 0xe7, 0x25],
];

/// The anchors of magma (van der Walt and Smith 2015), from 0 to 1: the colours that FLIP's maps are shown in.
const MAGMA: [[u8; 3]; 10] = [
    [0, 0, 4],
    [24, 15, 61],
    [69, 16, 119],
    [114, 31, 129],
    [158, 47, 127],
    [205, 64, 113],
    [241, 96, 93],
    [253, 148, 103],
    [254, 202, 141],
    [252, 253, 191],
];

/// Blue for too dark, white for right, vermillion for too bright.
const SIGNED: [[u8; 3]; 5] = [
    [0x0a, 0x3d, 0x6b],
    [0x4f, 0xa3, 0xd9],
    [0xff, 0xff, 0xff],
    [0xee, 0x8a, 0x4a],
    [0x8f, 0x2d, 0x00],
];

/// The anchors of both scales of values, for pages that colour them themselves.
#[derive(Serialize)]
pub struct Scales {
    magnitude: &'static [[u8; 3]],
    signed: &'static [[u8; 3]],
}

/// The scales of [`magnitude`] and [`signed`].
pub fn scales() -> Scales {
    Scales { magnitude: &VIRIDIS, signed: &SIGNED }
}

/// A magnitude from 0 to 1 as a colour.
pub fn magnitude(value: f64) -> [u8; 3] {
    between(&VIRIDIS, step(value, 128.0))
}

/// A perceived difference from 0 to 1 as a colour.
pub fn perceived(value: f64) -> [u8; 3] {
    between(&MAGMA, value)
}

/// A signed value from −1 to 1 as a colour; 0 is white, what is not a number black.
pub fn signed(value: f64) -> [u8; 3] {
    if value.is_nan() { [0; 3] } else { between(&SIGNED, step(0.5 + 0.5 * value, 254.0)) }
}

/// The nearest of `steps` + 1 values: scales of few colours make small files.
fn step(value: f64, steps: f64) -> f64 {
    (value.clamp(0.0, 1.0) * steps).round() / steps
}

fn between(anchors: &[[u8; 3]], value: f64) -> [u8; 3] {
    let last = anchors.len() - 1;
    let at = value.clamp(0.0, 1.0) * last as f64;
    let low = (at as usize).min(last - 1);
    let along = at - low as f64;
    let mix = |a: u8, b: u8| (f64::from(a) * (1.0 - along) + f64::from(b) * along + 0.5) as u8;
    std::array::from_fn(|c| mix(anchors[low][c], anchors[low + 1][c]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn scales_meet_their_anchors() {
        assert_eq!(magnitude(0.0), VIRIDIS[0]);
        assert_eq!(magnitude(7.0), VIRIDIS[9]);
        assert_eq!(signed(0.0), [255, 255, 255]);
        assert_eq!(magnitude(f64::NAN), between(&VIRIDIS, f64::NAN));
    }

    #[test]
    fn two_forms_of_a_method_share_a_colour_and_nothing_else() {
        let methods = fixture::results().methods;
        let styles = styles(&methods);
        assert_eq!(styles[3].ink, styles[4].ink);
        assert_ne!(styles[3].hollow, styles[4].hollow);
        assert_ne!(styles[2].ink, styles[3].ink);
    }
}
