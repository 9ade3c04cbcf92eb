//! Colour bars: the keys to false colours.

use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{HALF_CAPITAL, SMALL};
use super::colour::GREY;
use crate::experiment::results::Picture;

/// An upright bar of the colours of 0 (bottom) to 1 (top), with labels at some of these.
pub fn upright(
    canvas: &mut Canvas,
    [x, y]: Point,
    [width, height]: Point,
    colour: impl Fn(f64) -> [u8; 3],
    labels: &[(f32, String)],
) {
    const STEPS: usize = 128;
    let rgb = (0..STEPS).map(|i| colour(1.0 - (i as f64 + 0.5) / STEPS as f64)).collect();
    canvas.picture([x, y], [width, height], &Picture { width: 1, height: STEPS, rgb });
    frame(canvas, [x, y], [width, height], 1.0);
    for (share, label) in labels {
        let at = y + height * (1.0 - share);
        canvas.line(&[[x + width, at], [x + width + 4.0, at]], GREY, 1.0, None);
        canvas.text([x + width + 7.0, at + HALF_CAPITAL * SMALL.size], label, SMALL);
    }
}

/// A lying bar of the colours of 0 (left) to 1 (right), with labels below its ends and its middle.
pub fn lying(
    canvas: &mut Canvas,
    [x, y]: Point,
    [width, height]: Point,
    colour: impl Fn(f64) -> [u8; 3],
    [low, middle, high]: [&str; 3],
) {
    const STEPS: usize = 64;
    let rgb = (0..STEPS).map(|i| colour((i as f64 + 0.5) / STEPS as f64)).collect();
    canvas.picture([x, y], [width, height], &Picture { width: STEPS, height: 1, rgb });
    frame(canvas, [x, y], [width, height], 0.5);
    let below = y + height + 14.0;
    canvas.text([x, below], low, SMALL);
    canvas.text([x + 0.5 * width, below], middle, Type { anchor: Anchor::Middle, ..SMALL });
    canvas.text([x + width, below], high, Type { anchor: Anchor::End, ..SMALL });
}

fn frame(canvas: &mut Canvas, [x, y]: Point, [width, height]: Point, line: f32) {
    let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
    canvas.outline(&corners, GREY, line);
}
