//! Bars, one a method.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Span;
use ratatui::widgets::Widget;

use super::{Key, dim};
use crate::report::phrase;

/// A bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its name.
    pub name: String,
    /// How it is told from others.
    pub key: Key,
    /// Its length, at least 0.
    pub value: f64,
}

/// Bars below one another, from 0 to the greatest value, each with its value. Those that find no room are counted.
#[derive(Clone, Copy, Debug)]
pub struct Bars<'a> {
    /// What they show, with its unit.
    pub title: &'a str,
    /// The bars, from the top.
    pub bars: &'a [Bar],
}

impl Widget for Bars<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        if area.height < 2 || area.width < 12 {
            return;
        }
        buffer.set_stringn(area.x, area.y, self.title, area.width.into(), dim());
        if self.bars.is_empty() {
            buffer.set_stringn(
                area.x,
                area.y + 1,
                "nothing measured yet",
                area.width.into(),
                dim(),
            );
            return;
        }
        let names = self.bars.iter().map(|bar| Span::raw(bar.name.as_str()).width() as u16);
        let widest = names.max().unwrap_or(0).min(area.width / 3);
        let finite = self.bars.iter().map(|bar| bar.value).filter(|value| value.is_finite());
        let most = finite.fold(0.0, f64::max);
        let lines = usize::from(area.height - 1);
        let shown = if self.bars.len() > lines { lines - 1 } else { self.bars.len() };
        // Letter, name, bar, value.
        let from = area.x + 2 + widest + 1;
        let room = area.right().saturating_sub(from + 9);
        for (bar, y) in self.bars[..shown].iter().zip(area.y + 1..) {
            buffer.set_stringn(area.x, y, bar.key.letter.to_string(), 1, bar.key.style);
            buffer.set_stringn(area.x + 2, y, &bar.name, widest.into(), Style::new());
            let part = if most > 0.0 { (bar.value / most).clamp(0.0, 1.0) } else { 0.0 };
            let halves = (part * 2.0 * f64::from(room)).round() as u16;
            let (whole, half) = ("━".repeat(usize::from(halves / 2)), halves % 2 == 1);
            let line = if half { format!("{whole}╸") } else { whole };
            buffer.set_stringn(from, y, line, room.into(), bar.key.style);
            let value = phrase::number(bar.value);
            buffer.set_stringn(from + halves.div_ceil(2) + 1, y, value, 8, Style::new());
        }
        if shown < self.bars.len() {
            let more = format!("… and {} more", self.bars.len() - shown);
            buffer.set_stringn(area.x, area.y + 1 + shown as u16, more, area.width.into(), dim());
        }
    }
}
