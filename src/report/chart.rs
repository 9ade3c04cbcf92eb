//! Panels with grid, curves, and names that keep clear of each other.

use super::axis::{Axis, Tick};
use super::canvas::{Anchor, Canvas, Point, Type};
use super::colour::{BLACK, GREY, PALE, SHADE, Style};
use super::mark::mark;
use super::phrase;

/// Ordinary text.
pub const TEXT: Type = Type { size: 12.0, ink: BLACK, bold: false, anchor: Anchor::Start };
/// Ticks and remarks.
pub const SMALL: Type = Type { size: 11.0, ink: GREY, bold: false, anchor: Anchor::Start };
/// Half the height of a capital, to centre text on a line.
pub const HALF_CAPITAL: f32 = 0.36;

/// A rectangle with two axes.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Left and top.
    pub corner: Point,
    /// Width and height.
    pub size: Point,
    /// Across.
    pub x: Axis,
    /// Up.
    pub y: Axis,
}

impl Panel {
    /// The point of a pair of values; one beyond the axis stands at its edge.
    pub fn at(&self, x: f64, y: f64) -> Point {
        let [left, top] = self.corner;
        let [width, height] = self.size;
        let up = self.y.place(y).clamp(0.0, 1.0);
        [left + width * self.x.place(x), top + height * (1.0 - up)]
    }

    /// Its right edge.
    pub fn right(&self) -> f32 {
        self.corner[0] + self.size[0]
    }

    /// Its bottom edge.
    pub fn bottom(&self) -> f32 {
        self.corner[1] + self.size[1]
    }

    /// Draws grid and ticks, and labels them if `labels` says so (across, up).
    pub fn draw(&self, canvas: &mut Canvas, labels: (bool, bool)) {
        let [left, top] = self.corner;
        for tick in &self.y.ticks {
            let y = self.at(self.x.low, tick.value)[1];
            self.grid(canvas, &[[left, y], [self.right(), y]], tick);
            if labels.1 {
                let at = [left - 6.0, y + HALF_CAPITAL * SMALL.size];
                canvas.text(at, &tick.label, Type { anchor: Anchor::End, ..SMALL });
            }
        }
        for tick in &self.x.ticks {
            let x = self.at(tick.value, self.y.low)[0];
            self.grid(canvas, &[[x, top], [x, self.bottom()]], tick);
            if labels.0 {
                let at = [x, self.bottom() + 15.0];
                canvas.text(at, &tick.label, Type { anchor: Anchor::Middle, ..SMALL });
            }
        }
        let [right, bottom] = [self.right(), self.bottom()];
        let frame = [[left, top], [left, bottom], [right, bottom]];
        canvas.line(&frame, GREY, 1.0, None);
    }

    fn grid(&self, canvas: &mut Canvas, line: &[Point], tick: &Tick) {
        let width = if tick.label.is_empty() { 0.4 } else { 0.9 };
        canvas.line(line, PALE, width, None);
    }

    /// Shades everything below a value: errors that the reference cannot tell from its own.
    pub fn floor(&self, canvas: &mut Canvas, value: f64) {
        if value > self.y.low {
            let y = self.at(self.x.low, value.min(self.y.high))[1];
            let [left, bottom] = [self.corner[0], self.bottom()];
            canvas.rectangle([left, y], [self.size[0], bottom - y], SHADE);
            canvas.line(&[[left, y], [self.right(), y]], GREY, 0.8, Some([2.0, 2.0]));
        }
    }

    /// Draws a curve with its markers. One that was measured at a single count is carried across,
    /// dashed, if `carried` says so. Errors above the axis stand at its upper edge with their value.
    pub fn curve(&self, canvas: &mut Canvas, curve: &[(f64, f64)], style: Style, carried: bool) {
        let shown = curve.iter().filter(|(x, y)| self.x.shows(*x) && self.y.shows(*y));
        let points: Vec<Point> = shown.clone().map(|&(x, y)| self.at(x, y)).collect();
        if let ([[_, y]], true) = (points.as_slice(), carried) {
            let line = [points[0], [self.right(), *y]];
            canvas.line(&line, style.ink, 1.1, Some([4.0, 3.0]));
        }
        let dash = style.hollow.then_some([6.0, 3.0]);
        canvas.line(&points, style.ink, if style.heavy { 2.8 } else { 1.6 }, dash);
        points.iter().for_each(|point| mark(canvas, *point, style));
        for ((_, error), [x, y]) in shown.zip(&points).filter(|((_, y), _)| *y > self.y.high) {
            let at = [x + 7.0, y + HALF_CAPITAL * SMALL.size];
            canvas.text(
                at,
                &format!("↑ {}", phrase::number(*error)),
                Type { ink: style.ink, ..SMALL },
            );
        }
    }

    /// Names curves at the right edge, where they end, pushed apart so that none overlap.
    pub fn name_curves(&self, canvas: &mut Canvas, mut names: Vec<(f64, String, Style)>) {
        const APART: f32 = 16.0;
        names.sort_by(|a, b| b.0.total_cmp(&a.0));
        let wanted: Vec<f32> = names.iter().map(|n| self.at(self.x.low, n.0)[1]).collect();
        let placed = push_apart(&wanted, APART, self.bottom());
        for (((_, name, style), from), to) in names.iter().zip(&wanted).zip(&placed) {
            let right = self.right();
            canvas.line(&[[right + 2.0, *from], [right + 14.0, *to]], style.ink, 0.8, None);
            mark(canvas, [right + 20.0, *to], *style);
            canvas.text([right + 29.0, to + HALF_CAPITAL * TEXT.size], name, TEXT);
        }
    }
}

/// Places at least `apart` from each other, in order, near the wanted ones and above `bottom` if
/// there is room.
fn push_apart(wanted: &[f32], apart: f32, bottom: f32) -> Vec<f32> {
    let mut placed: Vec<f32> = Vec::with_capacity(wanted.len());
    for &y in wanted {
        placed.push(placed.last().map_or(y, |last| y.max(last + apart)));
    }
    let mut limit = bottom;
    for y in placed.iter_mut().rev() {
        *y = y.min(limit);
        limit = *y - apart;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_apart_and_in_order() {
        let placed = push_apart(&[10.0, 11.0, 12.0, 95.0, 99.0], 16.0, 100.0);
        assert!(placed.windows(2).all(|w| w[1] - w[0] >= 16.0 - 1e-4), "{placed:?}");
        assert!(placed[4] <= 100.0);
    }
}
