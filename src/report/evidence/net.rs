//! Tables of heights as nets of lines (Blinn 1978, figure 5).

use crate::evidence::Field;
use crate::report::canvas::{Canvas, Point, Type};
use crate::report::chart::TEXT;
use crate::report::colour::{BLACK, SHADE};
use crate::report::font;

/// Units from corner to corner of a table, and around it.
const ACROSS: f64 = 460.0;
const GAP: f32 = 16.0;
const TITLE: f32 = 26.0;
/// How much the depth of the table is foreshortened: the sine of the eye's elevation, 30°.
const SINE: f64 = 0.5;
/// The cosine of that: how much of a height is seen.
const COSINE: f64 = 0.866_025_403_784_438_6;

/// Nets side by side. Each table is seen from above its corner (0, 0), along the diagonal; cells are drawn from the
/// back to the front, so that what is in front hides what is behind.
pub fn draw(tables: &[Field]) -> Canvas {
    let nets: Vec<Net> = tables.iter().map(Net::of).collect();
    let size = |net: &Net| [net.size[0] as f32 + 2.0 * GAP, net.size[1] as f32 + TITLE + GAP];
    let width = nets.iter().map(|net| size(net)[0]).sum::<f32>().max(1.0);
    let height = nets.iter().map(|net| size(net)[1]).fold(1.0, f32::max);
    let mut canvas = Canvas::new(width, height);
    let mut left = GAP;
    for (net, table) in nets.iter().zip(tables) {
        let label = font::fitted(&table.label, TEXT.size, true, net.size[0] as f32);
        canvas.text([left, 18.0], &label, Type { bold: true, ..TEXT });
        net.draw(&mut canvas, [left, TITLE]);
        left += size(net)[0];
    }
    canvas
}

/// A table on its way to paper.
struct Net<'a> {
    table: &'a Field,
    rows: usize,
    /// Units a cell.
    scale: f64,
    /// The highest point of the paper, units above the place of entry (0, 0).
    top: f64,
    size: [f64; 2],
}

impl<'a> Net<'a> {
    fn of(table: &'a Field) -> Self {
        let width = table.width.max(1);
        let rows = table.values.len() / width;
        let diagonal = (width + rows).max(2) as f64 * std::f64::consts::FRAC_1_SQRT_2;
        let mut net = Self { table, rows, scale: ACROSS / diagonal, top: 0.0, size: [ACROSS, 1.0] };
        let places = (0..rows * width).map(|k| net.place(k % width, k / width)[1]);
        let (low, high) = places.fold((0.0f64, 0.0f64), |(low, high), y| (low.min(y), high.max(y)));
        net.top = high;
        net.size[1] = (high - low).clamp(1.0, 4.0 * ACROSS);
        net
    }

    /// Where entry (i, j) stands: units from the left corner, and upwards from the front one.
    fn place(&self, i: usize, j: usize) -> [f64; 2] {
        let value = self.table.values[j * self.table.width.max(1) + i];
        let value = if value.is_finite() { value } else { 0.0 };
        let half = std::f64::consts::FRAC_1_SQRT_2 * self.scale;
        let [x, y] = [i as f64, j as f64];
        let across = (x - y + self.rows.max(1) as f64) * half;
        [across, (x + y) * half * SINE + value * self.scale * COSINE]
    }

    fn draw(&self, canvas: &mut Canvas, [left, top]: Point) {
        let at = |i: usize, j: usize| {
            let [x, y] = self.place(i, j);
            [left + x as f32, top + (self.top - y) as f32]
        };
        let (columns, rows) = (self.table.width.saturating_sub(1), self.rows.saturating_sub(1));
        for j in (0..rows).rev() {
            for i in (0..columns).rev() {
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                canvas.polygon(&corners, SHADE);
                canvas.outline(&corners, BLACK, 0.4);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(width: usize, values: Vec<f64>) -> Field {
        Field { label: "table".into(), width, values }
    }

    #[test]
    fn higher_is_higher_and_further_is_higher() {
        let table = table(2, vec![0.0, 0.0, 0.0, 1.0]);
        let net = Net::of(&table);
        let [near, right, left, far] =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| net.place(i, j));
        assert!(left[0] < near[0] && near[0] < right[0] && (far[0] - near[0]).abs() < 1e-9);
        assert!((right[1] - left[1]).abs() < 1e-9 && far[1] > 2.0 * right[1]);
    }

    #[test]
    fn odd_tables_are_drawn() {
        for values in [vec![], vec![f64::NAN], vec![1e300; 6], vec![f64::INFINITY, -1.0, 0.0, 2.0]]
        {
            assert!(draw(&[table(0, values.clone()), table(2, values)]).width() > 0);
        }
        assert!(draw(&[]).width() > 0);
    }
}
