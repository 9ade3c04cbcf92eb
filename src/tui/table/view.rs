//! How a table is drawn.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::Span;
use ratatui::widgets::Widget;

use super::{Cell, Table};

/// A table to be drawn: a line of headings, then as many rows around the chosen one as there is room for.
#[derive(Clone, Copy, Debug)]
pub struct TableView<'a> {
    /// The table.
    pub table: &'a Table,
    /// Whether keys go to it: the chosen row stands out more.
    pub focused: bool,
}

/// Columns between columns.
const GAP: u16 = 2;
/// Widest column.
const WIDEST: u16 = 40;
/// Where the sign of the chosen row stands.
const MARGIN: u16 = 2;

impl Widget for TableView<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        if area.width <= MARGIN || area.height == 0 {
            return;
        }
        let columns = self.columns(area.width - MARGIN);
        let bold = Style::new().add_modifier(Modifier::BOLD);
        let mut at = area.x + MARGIN;
        for &(column, width) in &columns {
            let head = self.head(column);
            self.put((at, area.y), width, column, &head, bold, buffer);
            at += width + GAP;
        }
        let rows = area.height - 1;
        let first = first_row(self.table.chosen, self.table.len(), rows.into());
        let shown = self.table.shown().enumerate().skip(first).take(rows.into());
        for ((place, cells), y) in shown.zip(area.y + 1..) {
            self.row(place, cells, &columns, Rect { y, height: 1, ..area }, buffer);
        }
    }
}

impl TableView<'_> {
    fn row(
        &self,
        place: usize,
        cells: &[Cell],
        columns: &[(usize, u16)],
        line: Rect,
        buffer: &mut Buffer,
    ) {
        let chosen = place == self.table.chosen;
        if chosen {
            buffer.set_string(line.x, line.y, "▸", Style::new().add_modifier(Modifier::BOLD));
        }
        let mut at = line.x + MARGIN;
        for &(column, width) in columns {
            let text = cells[column].shown();
            self.put((at, line.y), width, column, text, Style::new(), buffer);
            at += width + GAP;
        }
        if chosen && self.focused {
            buffer.set_style(line, Style::new().add_modifier(Modifier::REVERSED));
        }
    }

    /// A heading, with the sign of the order if it is sorted by it.
    fn head(&self, column: usize) -> String {
        let title = &self.table.columns[column].title;
        match self.table.by {
            Some((by, descending)) if by == column => {
                format!("{title} {}", if descending { '▼' } else { '▲' })
            }
            _ => title.clone(),
        }
    }

    fn put(
        &self,
        (x, y): (u16, u16),
        width: u16,
        column: usize,
        text: &str,
        style: Style,
        buffer: &mut Buffer,
    ) {
        let text = fitted(text, width);
        let long = wide(&text);
        let right = self.table.columns[column].numbers;
        let from = if right { x + width.saturating_sub(long) } else { x };
        buffer.set_stringn(from, y, text, width.into(), style);
    }

    /// The columns there is room for, with their widths: those of the least rank, and the one it is sorted by.
    fn columns(&self, room: u16) -> Vec<(usize, u16)> {
        let by = self.table.by.map(|(by, _)| by);
        let natural = |column: usize| {
            let cells = self.table.shown().map(|cells| wide(cells[column].shown()));
            // Room for the sign of the order, so that sorting moves nothing.
            let head = wide(&self.table.columns[column].title) + 2;
            cells.max().unwrap_or(0).max(head).min(WIDEST)
        };
        let mut kept: Vec<(usize, u16)> =
            (0..self.table.columns.len()).map(|column| (column, natural(column))).collect();
        let needed = |kept: &[(usize, u16)]| {
            kept.iter().map(|(_, width)| width + GAP).sum::<u16>().saturating_sub(GAP)
        };
        while needed(&kept) > room && kept.len() > 1 {
            let rank = |column: usize| match self.table.columns[column].rank {
                _ if Some(column) == by => 0,
                rank => rank,
            };
            let last = kept.iter().enumerate().max_by_key(|(place, (c, _))| (rank(*c), *place));
            match last {
                Some((place, _)) if place > 0 => kept.remove(place),
                _ => kept.pop().expect("there is more than one"),
            };
        }
        if let [(_, width)] = kept.as_mut_slice() {
            *width = (*width).min(room);
        }
        kept
    }
}

/// The first row to be shown, so that the chosen one is seen, in the middle where it can be.
fn first_row(chosen: usize, all: usize, room: usize) -> usize {
    chosen.saturating_sub(room / 2).min(all.saturating_sub(room))
}

/// A text cut to a width, with a sign that it was.
pub fn fitted(text: &str, width: u16) -> String {
    if wide(text) <= width {
        return text.to_owned();
    }
    let mut cut = String::new();
    for c in text.chars() {
        cut.push(c);
        if wide(&cut) + 1 > width {
            cut.pop();
            break;
        }
    }
    if width > 0 {
        cut.push('…');
    }
    cut
}

fn wide(text: &str) -> u16 {
    Span::raw(text).width().try_into().unwrap_or(u16::MAX)
}
