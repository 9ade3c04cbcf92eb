//! The names of the series with their keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::Span;

use super::{Chart, SEVERAL, Series, dim};

/// A chart this wide or wider has its legend at its side.
const WIDE: u16 = 56;

/// What stands beside the mark of several points.
const SEVERAL_WORDS: &str = "several points";

/// Where a legend stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// At the chart's right, a line a series.
    Beside(Rect),
    /// Below the chart, one series after the other.
    Below(Rect),
}

/// Room for the chart itself, and for the legend.
pub(super) fn split(chart: &Chart, area: Rect) -> (Rect, Place) {
    let names = chart.series.iter().map(|series| Span::raw(series.name.as_str()).width() as u16);
    let widest = names.max().unwrap_or(0);
    if area.width >= WIDE {
        let marks =
            if chart.series.len() > 1 { SEVERAL_WORDS.chars().count() as u16 + 3 } else { 0 };
        let width = (widest + 3).max(marks).min(area.width * 2 / 5);
        let plot = Rect { width: area.width - width, ..area };
        return (plot, Place::Beside(Rect { x: plot.right(), width, ..area }));
    }
    let height = lines(chart, area.width).min(area.height / 4);
    let plot = Rect { height: area.height - height, ..area };
    (plot, Place::Below(Rect { y: plot.bottom(), height, ..area }))
}

/// Width of an entry, the space after it included.
fn entry(series: &Series) -> u16 {
    Span::raw(series.name.as_str()).width() as u16 + 4
}

/// Lines that all entries take, one after the other.
fn lines(chart: &Chart, width: u16) -> u16 {
    let (mut lines, mut at) = (1, 0);
    for series in chart.series {
        let wide = entry(series).min(width);
        if at + wide > width {
            (lines, at) = (lines + 1, 0);
        }
        at += wide;
    }
    lines
}

/// Draws it; `several` tells whether some cell of the chart stands for several points.
pub(super) fn draw(chart: &Chart, place: Place, several: bool, buffer: &mut Buffer) {
    match place {
        Place::Beside(area) => beside(chart, area, several, buffer),
        Place::Below(area) => below(chart, area, several, buffer),
    }
}

fn beside(chart: &Chart, area: Rect, several: bool, buffer: &mut Buffer) {
    // Beside the plot, whose first line is its heading.
    let (from, room) = (area.x + 1, area.width.saturating_sub(1));
    let lines = usize::from(area.height.saturating_sub(1));
    let all = chart.series.len();
    let shown = if all > lines { lines.saturating_sub(1) } else { all };
    for (place, row) in (0..shown).zip(area.y + 1..) {
        name(chart, place, (from, row), room, buffer);
    }
    let row = area.y + 1 + shown as u16;
    if shown < all {
        let more = format!("… and {} more", all - shown);
        buffer.set_stringn(from, row, more, room.into(), dim());
    } else if row + 1 < area.bottom() && several {
        buffer.set_stringn(from, row + 1, format!("{SEVERAL} {SEVERAL_WORDS}"), room.into(), dim());
    }
}

fn below(chart: &Chart, area: Rect, several: bool, buffer: &mut Buffer) {
    let (mut column, mut row) = (area.x, area.y);
    for (place, series) in chart.series.iter().enumerate() {
        let wide = entry(series).min(area.width);
        if column + wide > area.right() {
            (column, row) = (area.x, row + 1);
        }
        if row >= area.bottom() {
            buffer.set_string(area.right() - 1, area.bottom() - 1, "…", dim());
            return;
        }
        name(chart, place, (column, row), wide, buffer);
        column += wide;
    }
    let words = format!("{SEVERAL} {SEVERAL_WORDS}");
    if several && usize::from(area.right().saturating_sub(column)) >= words.len() {
        buffer.set_string(column, row, words, dim());
    }
}

/// A series' letter and name.
fn name(chart: &Chart, place: usize, (x, y): (u16, u16), room: u16, buffer: &mut Buffer) {
    let (series, style) = (&chart.series[place], chart.style(place));
    let chosen = chart.chosen == Some(place);
    let style = if chosen { style.add_modifier(Modifier::REVERSED) } else { style };
    buffer.set_stringn(x, y, series.key.letter.to_string(), room.into(), style);
    let rest = room.saturating_sub(2).into();
    buffer.set_stringn(x + 2, y, &series.name, rest, Style::new());
}
