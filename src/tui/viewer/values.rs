//! Pixels as numbers.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

use super::{Tone, Viewer};
use crate::render::{heat, srgb};
use crate::report::signed;

/// Columns a number takes, a gap included.
const WIDTH: u16 = 8;

/// Draws the pixels about the cursor as numbers, each on its colour, the cursor's in brackets.
pub fn values(viewer: &Viewer, area: Rect, buffer: &mut Buffer) {
    let (Some([width, height]), Some(film)) = (viewer.size(), viewer.film(viewer.on)) else {
        return;
    };
    let [columns, rows] = [(area.width / WIDTH).max(1), area.height.max(1)].map(usize::from);
    let start = |cursor: usize, shown: usize, side: usize| {
        cursor.saturating_sub(shown / 2).min(side.saturating_sub(shown))
    };
    let from = [start(viewer.cursor[0], columns, width), start(viewer.cursor[1], rows, height)];
    let white = viewer.white();
    for row in 0..rows.min(height) {
        for column in 0..columns.min(width) {
            let [x, y] = [from[0] + column, from[1] + row];
            let at = y * width + x;
            let value = f64::from(film.pixels()[at]);
            let truth = viewer.reference().map(|truth| f64::from(truth.pixels()[at]));
            let off = truth.map_or(0.0, |truth| value - truth);
            let (number, colour) = match viewer.tone {
                Tone::Image => (value, [srgb(value / white); 3]),
                Tone::Error => (off.abs(), heat(off.abs() / white)),
                Tone::Difference => (off, signed(off / white)),
            };
            let here = [x, y] == viewer.cursor;
            let text = if here { format!("[{}]", short(number)) } else { short(number) };
            let light = colour.iter().map(|c| u32::from(*c)).sum::<u32>() > 380;
            let ink = if light { Color::Rgb(0, 0, 0) } else { Color::Rgb(255, 255, 255) };
            let [r, g, b] = colour;
            let mut style = Style::new().fg(ink).bg(Color::Rgb(r, g, b));
            if here {
                style = style.add_modifier(Modifier::BOLD | Modifier::REVERSED);
            }
            let left = area.x + column as u16 * WIDTH;
            let room = usize::from(WIDTH.min(area.right().saturating_sub(left)));
            buffer.set_stringn(left, area.y + row as u16, format!("{text:^8}"), room, style);
        }
    }
}

/// A number in at most six characters.
fn short(value: f64) -> String {
    let size = value.abs();
    let text = match size {
        _ if !value.is_finite() => format!("{value}"),
        0.0..1e-3 if size > 0.0 => format!("{value:.0e}"),
        0.0..10.0 => format!("{value:.3}"),
        10.0..100.0 => format!("{value:.2}"),
        100.0..1000.0 => format!("{value:.1}"),
        1000.0..1e5 => format!("{value:.0}"),
        _ => format!("{value:.0e}"),
    };
    text.chars().take(6).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::viewer;
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1.0, -0.5, 12.345, 123.45, 54321.0, 1e9, 2e-5, f64::NAN, -1234.0];
        let texts = numbers.map(short);
        let wanted =
            ["0.000", "1.000", "-0.500", "12.35", "123.5", "54321", "1e9", "2e-5", "NaN", "-1234"];
        assert_eq!(texts, wanted);
        assert!(numbers.iter().all(|n| short(*n).len() <= 6));
    }

    #[test]
    fn the_cursors_pixel_stands_in_brackets() {
        let area = Rect::new(0, 0, 32, 2);
        let mut buffer = Buffer::empty(area);
        values(&viewer(), area, &mut buffer);
        let line = |y: u16| (0..32).map(|x| buffer[(x, y)].symbol()).collect::<String>();
        assert_eq!(line(0), " 0.000   0.250   0.500   0.750  ");
        assert_eq!(line(1), " 1.000   1.250  [1.500]  1.750  ");
    }

    #[test]
    fn any_area_will_do() {
        for (width, height) in [(0, 0), (1, 1), (7, 1), (200, 50)] {
            let area = Rect::new(0, 0, width, height);
            values(&viewer(), area, &mut Buffer::empty(area));
        }
    }
}
