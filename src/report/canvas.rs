//! A small canvas on tiny-skia: lines, shapes, text and pictures, in units of a CSS pixel, y down.

use tiny_skia::{
    ColorU8, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash,
    Transform,
};

use super::colour::{Ink, WHITE};
use super::font;
use crate::experiment::results::Picture;

/// Dots of the picture to a unit of the canvas, so that type stays sharp on dense screens.
const DENSITY: f32 = 2.0;

/// A point, units from the left and the top.
pub type Point = [f32; 2];

/// Where text stands about its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// It begins there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// How text looks.
#[derive(Clone, Copy, Debug)]
pub struct Type {
    /// Size of the em, units.
    pub size: f32,
    /// Colour.
    pub ink: Ink,
    /// Whether it is bold.
    pub bold: bool,
    /// Where it stands.
    pub anchor: Anchor,
}

/// A drawing.
pub struct Canvas {
    pixmap: Pixmap,
}

impl Canvas {
    /// A white canvas, at least one unit each way.
    pub fn new(width: f32, height: f32) -> Self {
        let dots = |units: f32| (units * DENSITY).clamp(1.0, 16384.0) as u32;
        let mut pixmap =
            Pixmap::new(dots(width), dots(height)).expect("between 1 and 16384 dots each way");
        pixmap.fill(WHITE.colour());
        Self { pixmap }
    }

    /// Its width, units.
    pub fn width(&self) -> u32 {
        self.pixmap.width() / DENSITY as u32
    }

    /// Its height, units.
    pub fn height(&self) -> u32 {
        self.pixmap.height() / DENSITY as u32
    }

    /// Another canvas, dot by dot.
    pub fn paste(&mut self, corner: Point, other: &Self) {
        let size = [other.pixmap.width(), other.pixmap.height()].map(|dots| dots as f32 / DENSITY);
        self.picture(corner, size, &other.dots());
    }

    /// A line through points; `dash` gives the lengths of dash and gap.
    pub fn line(&mut self, points: &[Point], ink: Ink, width: f32, dash: Option<[f32; 2]>) {
        let dash = dash.and_then(|d| StrokeDash::new(d.to_vec(), 0.0));
        let (line_cap, line_join) = (LineCap::Butt, LineJoin::Round);
        let stroke = Stroke { width, dash, line_cap, line_join, ..Stroke::default() };
        self.stroke(through(points, false), ink, &stroke);
    }

    /// A filled polygon.
    pub fn polygon(&mut self, points: &[Point], ink: Ink) {
        self.fill(through(points, true), ink);
    }

    /// The outline of a polygon.
    pub fn outline(&mut self, points: &[Point], ink: Ink, width: f32) {
        self.stroke(through(points, true), ink, &Stroke { width, ..Stroke::default() });
    }

    /// A filled rectangle.
    pub fn rectangle(&mut self, [x, y]: Point, [width, height]: Point, ink: Ink) {
        self.polygon(&[[x, y], [x + width, y], [x + width, y + height], [x, y + height]], ink);
    }

    /// A filled circle.
    pub fn disc(&mut self, [x, y]: Point, radius: f32, ink: Ink) {
        self.fill(PathBuilder::from_circle(x, y, radius), ink);
    }

    /// The outline of a circle.
    pub fn ring(&mut self, [x, y]: Point, radius: f32, ink: Ink, width: f32) {
        let stroke = Stroke { width, ..Stroke::default() };
        self.stroke(PathBuilder::from_circle(x, y, radius), ink, &stroke);
    }

    /// Text with its baseline at a point.
    pub fn text(&mut self, at: Point, text: &str, look: Type) {
        self.set_text(at, text, look, 0.0);
    }

    /// Text that reads upwards, for the axis on the left.
    pub fn upright_text(&mut self, at: Point, text: &str, look: Type) {
        self.set_text(at, text, look, -90.0);
    }

    fn set_text(&mut self, [x, y]: Point, text: &str, look: Type, degrees: f32) {
        let mut path = PathBuilder::new();
        let width = font::outline(text, look.size, look.bold, &mut path);
        let back = match look.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * width,
            Anchor::End => -width,
        };
        // Quarter turns only, written out: a rotation by tiny-skia would call the platform's sine.
        let place = if degrees == 0.0 {
            Transform::from_translate(x + back, y)
        } else {
            Transform::from_row(0.0, -1.0, 1.0, 0.0, x, y - back)
        };
        self.fill(path.finish().and_then(|path| path.transform(place)), look.ink);
    }

    /// A picture, each of its pixels a rectangle of equal size.
    pub fn picture(&mut self, corner: Point, size: Point, picture: &Picture) {
        let [left, top] = corner.map(|units| (units * DENSITY + 0.5) as usize);
        let [across, down] = size.map(|units| (units * DENSITY + 0.5) as usize);
        let stride = self.pixmap.width() as usize;
        let rows = self.pixmap.pixels_mut().chunks_exact_mut(stride).skip(top).take(down);
        for (y, row) in rows.enumerate() {
            let source = &picture.rgb[y * picture.height / down * picture.width..];
            for (x, dot) in row.iter_mut().skip(left).take(across).enumerate() {
                let [r, g, b] = source[x * picture.width / across];
                *dot = ColorU8::from_rgba(r, g, b, 255).premultiply();
            }
        }
    }

    /// The drawing, dot by dot.
    pub fn dots(&self) -> Picture {
        let (width, height) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        let rgb = self.pixmap.pixels().iter().map(|dot| [dot.red(), dot.green(), dot.blue()]);
        Picture { width, height, rgb: rgb.collect() }
    }

    fn fill(&mut self, path: Option<Path>, ink: Ink) {
        let Some(path) = path else { return };
        let scale = Transform::from_scale(DENSITY, DENSITY);
        self.pixmap.fill_path(&path, &paint(ink), FillRule::Winding, scale, None);
    }

    fn stroke(&mut self, path: Option<Path>, ink: Ink, stroke: &Stroke) {
        let Some(path) = path else { return };
        let scale = Transform::from_scale(DENSITY, DENSITY);
        self.pixmap.stroke_path(&path, &paint(ink), stroke, scale, None);
    }
}

fn paint(ink: Ink) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(ink.colour());
    paint
}

fn through(points: &[Point], closed: bool) -> Option<Path> {
    let (&[x, y], rest) = points.split_first()?;
    let mut path = PathBuilder::new();
    path.move_to(x, y);
    rest.iter().for_each(|&[x, y]| path.line_to(x, y));
    if closed {
        path.close();
    }
    path.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::colour::BLACK;

    #[test]
    fn shapes_land_where_they_should() {
        let mut canvas = Canvas::new(10.0, 10.0);
        canvas.rectangle([2.0, 2.0], [4.0, 4.0], BLACK);
        let at = |x, y| canvas.pixmap.pixel(x, y).unwrap().red();
        assert_eq!([at(8, 8), at(1, 1), at(13, 13)], [BLACK.rgb[0], 255, 255]);
    }

    #[test]
    fn pictures_keep_their_pixels() {
        let picture = Picture { width: 2, height: 1, rgb: vec![[255, 0, 0], [0, 0, 255]] };
        let mut canvas = Canvas::new(4.0, 2.0);
        canvas.picture([0.0, 0.0], [4.0, 2.0], &picture);
        assert_eq!(canvas.pixmap.pixel(3, 3).unwrap().red(), 255);
        assert_eq!(canvas.pixmap.pixel(4, 0).unwrap().blue(), 255);
    }

    #[test]
    fn nothing_drawn_is_no_trouble() {
        let mut canvas = Canvas::new(0.0, -3.0);
        canvas.line(&[], BLACK, 1.0, None);
        canvas.text(
            [0.0, 0.0],
            "",
            Type { size: 10.0, ink: BLACK, bold: false, anchor: Anchor::End },
        );
        assert_eq!(canvas.dots().rgb.len(), 1);
    }
}
