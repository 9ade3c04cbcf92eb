//! Scalar fields in false colour.

use crate::evidence::Field;
use crate::experiment::results::Picture;
use crate::report::bar;
use crate::report::canvas::{Canvas, Point, Type};
use crate::report::chart::{SMALL, TEXT};
use crate::report::colour::{GREY, magnitude, signed};
use crate::report::{axis::Axis, font};

/// Least and most units a field is wide; a cell is a whole number of dots, half a unit each.
const WIDE: [usize; 2] = [180, 720];
const GAP: f32 = 16.0;
const TITLE: f32 = 26.0;
/// Room for the colour bar.
const BAR: f32 = 84.0;
/// Room below for the note on cells without a value.
const FOOT: f32 = 16.0;
/// Most units all fields of a row are wide.
const ROW: f32 = 900.0;

/// Fields side by side on one colour scale, pixel by pixel.
pub fn draw(fields: &[Field]) -> Canvas {
    let scale = Scale::of(fields);
    let sizes: Vec<Point> = fields.iter().map(size).collect();
    let most = |axis: usize| sizes.iter().map(|s| s[axis]).fold(1.0, f32::max);
    let cell = [most(0) + GAP, most(1) + TITLE + GAP];
    let across = ((ROW / cell[0]) as usize).clamp(1, fields.len().max(1));
    let rows = fields.len().div_ceil(across);
    let none = fields.iter().flat_map(|f| &f.values).any(|v| !v.is_finite());
    let below = if none { FOOT } else { 0.0 };
    let height = rows as f32 * cell[1] + GAP + below;
    let mut canvas = Canvas::new(across as f32 * cell[0] + GAP + BAR, height);
    for (i, (field, size)) in fields.iter().zip(&sizes).enumerate() {
        let (row, column) = (i / across, i % across);
        let [x, y] = [GAP + column as f32 * cell[0], GAP + row as f32 * cell[1]];
        let label = font::fitted(&field.label, TEXT.size, true, cell[0] - 4.0);
        canvas.text([x, y + 12.0], &label, Type { bold: true, ..TEXT });
        canvas.picture([x, y + TITLE], *size, &picture(field, &scale));
        let [right, bottom] = [x + size[0], y + TITLE + size[1]];
        let corners = [[x, y + TITLE], [right, y + TITLE], [right, bottom], [x, bottom]];
        canvas.outline(&corners, GREY, 0.5);
    }
    if !fields.is_empty() {
        let corner = [across as f32 * cell[0] + GAP, GAP + TITLE];
        let height = sizes[0][1].clamp(60.0, 240.0);
        let labels = scale.axis.ticks.iter();
        let labels: Vec<_> =
            labels.map(|tick| (scale.axis.place(tick.value), tick.label.clone())).collect();
        bar::upright(&mut canvas, corner, [14.0, height], |share| scale.share(share), &labels);
        if none {
            canvas.text([corner[0], corner[1] + height + 22.0], "black: no value", SMALL);
        }
    }
    canvas
}

/// A colour scale: from the least to the greatest value, or as far below 0 as above it.
struct Scale {
    axis: Axis,
    two_hues: bool,
}

impl Scale {
    fn of(fields: &[Field]) -> Self {
        let values = || fields.iter().flat_map(|f| &f.values).copied().filter(|v| v.is_finite());
        let two_hues = values().any(|v| v < 0.0);
        let mirrored = values().map(|v| if two_hues { -v } else { v });
        Self { axis: Axis::linear(values().chain(mirrored)), two_hues }
    }

    fn share(&self, share: f64) -> [u8; 3] {
        if self.two_hues { signed(2.0 * share - 1.0) } else { magnitude(share) }
    }

    fn colour(&self, value: f64) -> [u8; 3] {
        if value.is_finite() { self.share(f64::from(self.axis.place(value))) } else { [0; 3] }
    }
}

/// Units across and down.
fn size(field: &Field) -> Point {
    let width = field.width.max(1);
    let (least, most) = (2 * WIDE[0], 2 * WIDE[1]);
    let dots = if width > most { 1 } else { least.div_ceil(width) };
    let rows = field.values.len().div_ceil(width).max(1);
    [width, rows].map(|cells| (cells * dots) as f32 / 2.0)
}

/// Row 0 of a field is its bottom; of a picture, its top.
fn picture(field: &Field, scale: &Scale) -> Picture {
    let width = field.width.max(1);
    let height = field.values.len().div_ceil(width).max(1);
    let at = |i: usize| {
        let (x, y) = (i % width, height - 1 - i / width);
        scale.colour(field.values.get(y * width + x).copied().unwrap_or(f64::NAN))
    };
    Picture { width, height, rgb: (0..width * height).map(at).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(width: usize, values: Vec<f64>) -> Field {
        Field { label: "slopes".into(), width, values }
    }

    #[test]
    fn the_first_value_is_at_the_bottom_left() {
        let field = field(2, vec![1.0, 0.0, 0.0, 0.0]);
        let scale = Scale::of(std::slice::from_ref(&field));
        let picture = picture(&field, &scale);
        assert_eq!((picture.width, picture.height), (2, 2));
        assert_eq!(picture.rgb[2], magnitude(1.0));
        assert_eq!(picture.rgb[0], magnitude(0.0));
    }

    #[test]
    fn a_zero_stays_between_the_hues() {
        let scale = Scale::of(&[field(1, vec![-0.3, 4.0])]);
        assert_eq!(scale.colour(0.0), [255; 3]);
    }

    #[test]
    fn odd_fields_are_drawn() {
        for values in [vec![], vec![f64::NAN], vec![1.0; 5], vec![f64::INFINITY, -1.0]] {
            assert!(draw(&[field(0, values.clone()), field(3, values)]).width() > 0);
        }
        assert!(draw(&[]).width() > 0);
    }
}
