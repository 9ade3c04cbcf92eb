//! Small multiples: many panels with the same axes and one legend.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{Panel, SMALL};
use super::colour::{BLACK, Style};
use super::font;
use super::mark::legend;
use crate::experiment::results::MethodInfo;

/// A panel's title.
const TITLE: Type = Type { size: 13.0, ink: BLACK, bold: true, anchor: Anchor::Start };
/// A remark centred on its point.
pub const MIDDLE: Type = Type { anchor: Anchor::Middle, ..SMALL };

/// A method's curve: (samples or texels a pixel, error).
pub struct Curve<'a> {
    /// Whose it is.
    pub method: &'a MethodInfo,
    /// How it is drawn.
    pub style: Style,
    /// Its points, from left to right.
    pub points: Vec<(f64, f64)>,
}

/// Panels in rows, with the same axes and one legend.
pub struct Grid<'a> {
    /// Row by row.
    pub panels: Vec<Cell<'a>>,
    /// Panels in a row.
    pub across: usize,
    /// What the horizontal axis is.
    pub x_title: &'static str,
}

/// A panel of a [`Grid`].
pub struct Cell<'a> {
    /// Its title.
    pub title: String,
    /// Its curves.
    pub curves: Vec<Curve<'a>>,
    /// The reference's own error.
    pub floor: f64,
}

const CELL: Point = [216.0, 168.0];
const GAP: Point = [14.0, 32.0];
/// Room left of the panels, and to the right of them.
const MARGIN: Point = [62.0, 12.0];

impl Grid<'_> {
    /// Draws all panels; `None` if no curve has a point.
    pub fn draw(&self, names: &[(String, Style)]) -> Option<Canvas> {
        let points = || self.panels.iter().flat_map(|p| &p.curves).flat_map(|c| &c.points);
        points().next()?;
        let x = Axis::at_values(points().map(|p| p.0).collect());
        let curves = self.panels.iter().flat_map(|p| &p.curves);
        let floors = self.panels.iter().map(|p| p.floor);
        let y = error_axis(curves, floors);
        let rows = self.panels.len().div_ceil(self.across);
        let inner = self.across as f32 * (CELL[0] + GAP[0]) - GAP[0];
        let width = MARGIN[0] + inner + MARGIN[1];
        let key = legend(&mut Canvas::new(1.0, 1.0), [0.0, 0.0], inner, names);
        let height = key + rows as f32 * (CELL[1] + GAP[1]) + 50.0;
        let mut canvas = Canvas::new(width, height);
        legend(&mut canvas, [MARGIN[0] - 6.0, 4.0], inner, names);
        for (i, cell) in self.panels.iter().enumerate() {
            let (row, column) = (i / self.across, i % self.across);
            let corner = [
                MARGIN[0] + column as f32 * (CELL[0] + GAP[0]),
                key + GAP[1] + row as f32 * (CELL[1] + GAP[1]),
            ];
            let panel = Panel { corner, size: CELL, x: x.clone(), y: y.clone() };
            let lowest = i + self.across >= self.panels.len();
            cell.draw(&mut canvas, &panel, (lowest, column == 0));
        }
        let black = Type { ink: BLACK, ..MIDDLE };
        canvas.text([MARGIN[0] + 0.5 * inner, height - 8.0], self.x_title, black);
        canvas.upright_text([14.0, 0.5 * (height + key) - 10.0], "RMSE", black);
        Some(canvas)
    }
}

/// An axis for errors. What exceeds brute force beyond reason (a method that broke down) does not
/// stretch it.
pub fn error_axis<'a>(
    curves: impl Iterator<Item = &'a Curve<'a>> + Clone,
    floors: impl Iterator<Item = f64>,
) -> Axis {
    const REASON: f64 = 100.0;
    let errors = |c: &'a Curve<'a>| c.points.iter().map(|p| p.1);
    let brute = curves.clone().filter(|c| c.style.heavy).flat_map(errors).reduce(f64::max);
    let most = brute.filter(|b| *b > 0.0).map_or(f64::INFINITY, |b| REASON * b);
    Axis::decades(curves.flat_map(errors).filter(|e| *e <= most).chain(floors))
}

/// Draws curves, the yardstick last.
pub fn draw_curves(canvas: &mut Canvas, panel: &Panel, curves: &[Curve]) {
    for heavy in [false, true] {
        for curve in curves.iter().filter(|c| c.style.heavy == heavy) {
            panel.curve(canvas, &curve.points, curve.style, !heavy);
        }
    }
}

impl Cell<'_> {
    fn draw(&self, canvas: &mut Canvas, panel: &Panel, labels: (bool, bool)) {
        panel.floor(canvas, self.floor);
        panel.draw(canvas, labels);
        draw_curves(canvas, panel, &self.curves);
        let title = font::fitted(&self.title, TITLE.size, true, panel.size[0]);
        canvas.text([panel.corner[0], panel.corner[1] - 8.0], &title, TITLE);
    }
}
