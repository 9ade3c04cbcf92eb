//! Markers and legends.

use super::canvas::{Canvas, Point};
use super::chart::{HALF_CAPITAL, TEXT};
use super::colour::{Style, WHITE};
use super::font;

/// A method's marker.
pub fn mark(canvas: &mut Canvas, [x, y]: Point, style: Style) {
    const R: f32 = 4.2;
    let shape = |corners: &[Point]| -> Vec<Point> {
        corners.iter().map(|[dx, dy]| [x + R * dx, y + R * dy]).collect()
    };
    let corners: &[Point] = match style.marker % 7 {
        0 => &[],
        1 => &[[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]],
        2 => &[[0.0, -1.15], [1.05, 0.8], [-1.05, 0.8]],
        3 => &[[0.0, -1.25], [1.1, 0.0], [0.0, 1.25], [-1.1, 0.0]],
        4 => &[[0.0, 1.15], [1.05, -0.8], [-1.05, -0.8]],
        5 => &[[0.0, -1.2], [1.15, -0.35], [0.7, 1.0], [-0.7, 1.0], [-1.15, -0.35]],
        _ => &[
            [-0.4, -1.1],
            [0.4, -1.1],
            [0.4, -0.4],
            [1.1, -0.4],
            [1.1, 0.4],
            [0.4, 0.4],
            [0.4, 1.1],
            [-0.4, 1.1],
            [-0.4, 0.4],
            [-1.1, 0.4],
            [-1.1, -0.4],
            [-0.4, -0.4],
        ],
    };
    let inside = if style.hollow { WHITE } else { style.ink };
    if corners.is_empty() {
        canvas.disc([x, y], R, inside);
        canvas.ring([x, y], R, style.ink, 1.4);
    } else {
        canvas.polygon(&shape(corners), inside);
        canvas.outline(&shape(corners), style.ink, 1.4);
    }
}

/// Draws a legend in lines no wider than `width`, from a corner, and returns its height.
pub fn legend(canvas: &mut Canvas, corner: Point, width: f32, names: &[(String, Style)]) -> f32 {
    const LINE: f32 = 20.0;
    let mut at = [corner[0], corner[1] + 0.5 * LINE];
    for (name, style) in names {
        let item = 16.0 + font::width(name, TEXT.size, false) + 22.0;
        if at[0] > corner[0] && at[0] + item > corner[0] + width {
            at = [corner[0], at[1] + LINE];
        }
        mark(canvas, [at[0] + 6.0, at[1]], *style);
        canvas.text([at[0] + 16.0, at[1] + HALF_CAPITAL * TEXT.size], name, TEXT);
        at[0] += item;
    }
    at[1] + 0.5 * LINE - corner[1]
}
