//! A terminal's screen as a picture. Letters are filled outlines; boxes, blocks and braille are drawn as shapes, so that
//! they meet at the cells' edges.

use std::sync::LazyLock;

use tiny_skia::{Color, FillRule, Paint, PathBuilder, Pixmap, Rect, Stroke, Transform};
use ttf_parser::{Face, OutlineBuilder};
use wrinkle::tui::picture::entry_rgb;

/// Dots of a cell, across and down.
const CELL: [f32; 2] = [12.0, 24.0];
/// Dots of an em: the font's letters are 0.6 em wide.
const EM: f32 = 20.0;
/// The baseline, from the cell's top.
const BASE: f32 = 18.0;
/// Thickness of a line, and how far those of a double line are from its middle.
const LINE: f32 = 1.5;
const APART: f32 = 2.5;

const INK: [u8; 3] = [208, 208, 208];
const PAPER: [u8; 3] = [18, 18, 20];
/// The first sixteen colours.
const NAMED: [[u8; 3]; 16] = [
    [18, 18, 20],
    [205, 70, 70],
    [80, 170, 90],
    [200, 165, 60],
    [80, 130, 210],
    [170, 100, 190],
    [70, 170, 180],
    [208, 208, 208],
    [110, 110, 110],
    [240, 110, 110],
    [120, 210, 130],
    [240, 205, 100],
    [120, 170, 245],
    [205, 140, 225],
    [110, 210, 220],
    [245, 245, 245],
];

static FACE: LazyLock<Face> =
    LazyLock::new(|| Face::parse(truce_font::JETBRAINS_MONO, 0).expect("the font is compiled in"));

/// Draws a screen.
pub fn draw(screen: &vt100::Screen) -> Pixmap {
    let (rows, columns) = screen.size();
    let dots = |cells: u16, size: f32| (f32::from(cells) * size) as u32;
    let mut map = Pixmap::new(dots(columns, CELL[0]), dots(rows, CELL[1])).expect("some cells");
    let [r, g, b] = PAPER;
    map.fill(Color::from_rgba8(r, g, b, 255));
    for row in 0..rows {
        for column in 0..columns {
            if let Some(cell) = screen.cell(row, column) {
                let at = [f32::from(column) * CELL[0], f32::from(row) * CELL[1]];
                draw_cell(&mut map, at, cell);
            }
        }
    }
    map
}

fn rgb(colour: vt100::Color, default: [u8; 3]) -> [u8; 3] {
    match colour {
        vt100::Color::Default => default,
        vt100::Color::Idx(i @ 0..16) => NAMED[usize::from(i)],
        vt100::Color::Idx(i) => entry_rgb(i),
        vt100::Color::Rgb(r, g, b) => [r, g, b],
    }
}

fn draw_cell(map: &mut Pixmap, at: [f32; 2], cell: &vt100::Cell) {
    let (mut ink, mut paper) = (rgb(cell.fgcolor(), INK), rgb(cell.bgcolor(), PAPER));
    if cell.inverse() {
        (ink, paper) = (paper, ink);
    }
    fill(map, at, [0.0, 0.0, 1.0, 1.0], paper, 1.0);
    let Some(c) = cell.contents().chars().next() else { return };
    let drawn = block(map, at, c, ink) || braille(map, at, c, ink) || boxed(map, at, c, ink);
    if !drawn {
        letter(map, at, c, ink, cell.bold());
    }
    if cell.underline() {
        fill(map, at, [0.0, 0.92, 1.0, 0.06], ink, 1.0);
    }
}

fn paint([r, g, b]: [u8; 3], alpha: f32, smooth: bool) -> Paint<'static> {
    let mut paint = Paint { anti_alias: smooth, ..Paint::default() };
    let mut colour = Color::from_rgba8(r, g, b, 255);
    colour.set_alpha(alpha);
    paint.set_color(colour);
    paint
}

/// A rectangle of a cell: left, top, width and height as parts of it.
fn fill(map: &mut Pixmap, at: [f32; 2], part: [f32; 4], ink: [u8; 3], alpha: f32) {
    let [w, h] = CELL;
    let rect = Rect::from_xywh(at[0] + part[0] * w, at[1] + part[1] * h, part[2] * w, part[3] * h);
    if let Some(rect) = rect {
        map.fill_rect(rect, &paint(ink, alpha, false), Transform::identity(), None);
    }
}

/// Halves, eighths, quarters and shades; false for other characters.
fn block(map: &mut Pixmap, at: [f32; 2], c: char, ink: [u8; 3]) -> bool {
    let eighths = |from: char| (c as u32 - from as u32 + 1) as f32 / 8.0;
    let part = match c {
        '▀' => [0.0, 0.0, 1.0, 0.5],
        '▁'..='█' => [0.0, 1.0 - eighths('▁'), 1.0, eighths('▁')],
        '▉'..='▏' => {
            let width = 1.0 - (c as u32 - '▉' as u32 + 1) as f32 / 8.0;
            [0.0, 0.0, width, 1.0]
        }
        // The font has digits above the line, but no minus there.
        '⁻' => [0.2, 0.3, 0.6, 0.06],
        '▐' => [0.5, 0.0, 0.5, 1.0],
        '▖' => [0.0, 0.5, 0.5, 0.5],
        '▗' => [0.5, 0.5, 0.5, 0.5],
        '▘' => [0.0, 0.0, 0.5, 0.5],
        '▝' => [0.5, 0.0, 0.5, 0.5],
        '░' | '▒' | '▓' => {
            let alpha = (c as u32 - '░' as u32 + 1) as f32 / 4.0;
            fill(map, at, [0.0, 0.0, 1.0, 1.0], ink, alpha);
            return true;
        }
        _ => return false,
    };
    fill(map, at, part, ink, 1.0);
    true
}

/// Dots of braille: bits 0 to 2 and 6 are the left column from the top, 3 to 5 and 7 the right.
fn braille(map: &mut Pixmap, at: [f32; 2], c: char, ink: [u8; 3]) -> bool {
    let Some(bits) = (c as u32).checked_sub(0x2800).filter(|bits| *bits < 256) else {
        return false;
    };
    for (bit, [x, y]) in
        [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2], [0, 3], [1, 3]].iter().enumerate()
    {
        if bits & (1 << bit) != 0 {
            let x = at[0] + CELL[0] * (*x as f32 + 0.5) / 2.0;
            let y = at[1] + CELL[1] * (*y as f32 + 0.5) / 4.0;
            if let Some(dot) = PathBuilder::from_circle(x, y, CELL[0] / 6.5) {
                let paint = paint(ink, 1.0, true);
                map.fill_path(&dot, &paint, FillRule::Winding, Transform::identity(), None);
            }
        }
    }
    true
}

/// How thick the arms of a box character are to the left, right, top and bottom: 0, 1, or 2 for a double line.
fn arms(c: char) -> Option<[u8; 4]> {
    Some(match c {
        '─' | '╌' | '┄' => [1, 1, 0, 0],
        '│' | '╎' | '┆' => [0, 0, 1, 1],
        '┌' | '╭' => [0, 1, 0, 1],
        '┐' | '╮' => [1, 0, 0, 1],
        '└' | '╰' => [0, 1, 1, 0],
        '┘' | '╯' => [1, 0, 1, 0],
        '├' => [0, 1, 1, 1],
        '┤' => [1, 0, 1, 1],
        '┬' => [1, 1, 0, 1],
        '┴' => [1, 1, 1, 0],
        '┼' => [1, 1, 1, 1],
        '═' => [2, 2, 0, 0],
        '║' => [0, 0, 2, 2],
        '╔' => [0, 2, 0, 2],
        '╗' => [2, 0, 0, 2],
        '╚' => [0, 2, 2, 0],
        '╝' => [2, 0, 2, 0],
        '╠' => [0, 2, 2, 2],
        '╣' => [2, 0, 2, 2],
        '╦' => [2, 2, 0, 2],
        '╩' => [2, 2, 2, 0],
        '╬' => [2, 2, 2, 2],
        '╴' => [1, 0, 0, 0],
        '╵' => [0, 0, 1, 0],
        '╶' => [0, 1, 0, 0],
        '╷' => [0, 0, 0, 1],
        _ => return None,
    })
}

fn boxed(map: &mut Pixmap, at: [f32; 2], c: char, ink: [u8; 3]) -> bool {
    let Some([left, right, up, down]) = arms(c) else { return false };
    let mut path = PathBuilder::new();
    let (half, middle) =
        ([CELL[0] / 2.0, CELL[1] / 2.0], [at[0] + CELL[0] / 2.0, at[1] + CELL[1] / 2.0]);
    // Each arm goes from the middle along an axis with a sign; those across it tell where its lines begin.
    for (arm, axis, sign, before, after) in [
        (left, 0, -1.0, up, down),
        (right, 0, 1.0, up, down),
        (up, 1, -1.0, left, right),
        (down, 1, 1.0, left, right),
    ] {
        let offsets: &[f32] = match arm {
            0 => continue,
            1 => &[0.0],
            _ => &[-APART, APART],
        };
        for offset in offsets {
            let (near, far) = if *offset < 0.0 { (before, after) } else { (after, before) };
            let begin = match (*offset == 0.0, near, far) {
                (true, ..) | (_, 0 | 1, 0 | 1) => 0.0,
                (_, 2.., _) => APART,
                _ => -APART,
            };
            let point = |along: f32| {
                let mut point = middle;
                point[axis] += sign * along;
                point[1 - axis] += offset;
                point
            };
            let ([x, y], [to_x, to_y]) = (point(begin - 0.5 * LINE), point(half[axis]));
            path.move_to(x, y);
            path.line_to(to_x, to_y);
        }
    }
    if let Some(path) = path.finish() {
        let stroke = Stroke { width: LINE, ..Stroke::default() };
        map.stroke_path(&path, &paint(ink, 1.0, true), &stroke, Transform::identity(), None);
    }
    true
}

fn letter(map: &mut Pixmap, at: [f32; 2], c: char, ink: [u8; 3], bold: bool) {
    let Some(glyph) = FACE.glyph_index(c) else {
        if c != ' ' {
            eprintln!("the font has no `{c}`");
        }
        return;
    };
    let unit = EM / f32::from(FACE.units_per_em());
    let mut pen = Pen { path: PathBuilder::new(), unit, x: at[0], y: at[1] + BASE };
    FACE.outline_glyph(glyph, &mut pen);
    let Some(path) = pen.path.finish() else { return };
    let paint = paint(ink, 1.0, true);
    map.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
    if bold {
        let stroke = Stroke { width: 0.9, ..Stroke::default() };
        map.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
    }
}

/// Turns a glyph's outline (font units, y up) into a path (y down).
struct Pen {
    path: PathBuilder,
    unit: f32,
    x: f32,
    y: f32,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.unit, self.y - y * self.unit)
    }
}

impl OutlineBuilder for Pen {
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
