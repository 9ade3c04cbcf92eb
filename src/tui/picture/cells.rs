//! Pictures drawn in character cells: half blocks, or characters by lightness.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::screen::{Screen, Way};
use super::{Paint, SURROUND};
use crate::experiment::results::Picture;

/// Characters from dark to light, on a dark ground: each holds more ink than the one before.
pub const RAMP: [char; 10] = [' ', '.', '-', ':', '=', '+', 'x', 'o', '8', '#'];

/// Paints and draws at once; in half blocks where the terminal has a protocol, which needs an encoding.
pub fn show(paint: &dyn Paint, area: Rect, screen: &Screen, buf: &mut Buffer) {
    let screen = screen.in_cells();
    let area = area.intersection(buf.area);
    draw(&paint.paint(screen.pixels(area), screen.aspect()), area, screen.way, buf);
}

/// Draws a picture that was painted for `area` and this way of drawing; what is missing is left as it is.
pub fn draw(picture: &Picture, area: Rect, way: Way, buf: &mut Buffer) {
    let area = area.intersection(buf.area);
    for position in area.positions() {
        let [x, y] = [position.x - area.x, position.y - area.y].map(usize::from);
        let pixel = |y: usize| picture.rgb.get(y * picture.width + x).copied().unwrap_or(SURROUND);
        let cell = &mut buf[position];
        cell.reset();
        if way == Way::Characters {
            cell.set_char(character(pixel(y)));
        } else {
            let [upper, lower] =
                [pixel(2 * y), pixel(2 * y + 1)].map(|[r, g, b]| Color::Rgb(r, g, b));
            cell.set_char('▀').set_style(Style::new().fg(upper).bg(lower));
        }
    }
}

/// The character of a colour: by its lightness L* (CIE 1976), which sRGB codes follow nearly.
fn character([r, g, b]: [u8; 3]) -> char {
    // Luma of codes (Rec. 709 weights, in 10 000ths) stands for L*: for greys it is within 0.06 of L*/100.
    let luma = 2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b);
    RAMP[(luma as usize * RAMP.len() / (255 * 10_000 + 1)).min(RAMP.len() - 1)]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use font8x8::UnicodeFonts;

    use super::super::{Depth, Flat};
    use super::*;

    #[test]
    fn the_ramp_gains_ink_at_every_step() {
        let ink = |c: &char| -> u32 {
            font8x8::BASIC_FONTS.get(*c).unwrap().iter().map(|row| row.count_ones()).sum()
        };
        let inks: Vec<u32> = RAMP.iter().map(ink).collect();
        assert!(inks.is_sorted_by(|a, b| a < b), "{inks:?}");
    }

    #[test]
    fn lighter_is_never_emptier() {
        let rank = |code: u8| RAMP.iter().position(|c| *c == character([code; 3])).unwrap();
        let ranks: Vec<usize> = (0..=255).map(rank).collect();
        assert!(ranks.is_sorted() && ranks[0] == 0 && ranks[255] == RAMP.len() - 1);
    }

    fn gradient() -> Flat {
        let rgb = (0..16).map(|i| [i as u8 * 16, 0, 255]).collect();
        Flat(Arc::new(Picture { width: 4, height: 4, rgb }))
    }

    #[test]
    fn a_half_block_is_two_pixels() {
        let mut buf = Buffer::empty(Rect::new(0, 0, 6, 3));
        let screen = Screen::plain(Depth::True);
        show(&gradient(), Rect::new(1, 1, 4, 2), &screen, &mut buf);
        let cell = &buf[(2, 1)];
        assert_eq!(
            (cell.symbol(), cell.fg, cell.bg),
            ("▀", Color::Rgb(16, 0, 255), Color::Rgb(80, 0, 255))
        );
        assert_eq!(buf[(0, 0)].symbol(), " ");
    }

    #[test]
    fn nothing_is_drawn_outside_the_buffer() {
        let mut buf = Buffer::empty(Rect::new(0, 0, 3, 2));
        for area in [Rect::new(2, 1, 9, 9), Rect::new(9, 9, 1, 1), Rect::new(0, 0, 0, 4)] {
            show(&gradient(), area, &Screen::plain(Depth::None), &mut buf);
        }
    }
}
