//! The chart, the table and the log.

use crate::tui::view::words::wrapped;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span, Text};

use crate::tui::chart::{Bars, Chart, Scale};
use crate::tui::experiments::{Entry, Experiments, Focus, Plot, log, progress};
use crate::tui::table::{Cell, TableView};
use crate::tui::view::panel;

/// Draws the chart. The method of the table's chosen row stands out while the table has the focus.
pub fn draw_chart(pane: &Experiments, area: Rect, frame: &mut Frame) {
    let shown = &pane.shown;
    let title = of(pane.plot.title(), pane);
    let block = panel(&title, false);
    let inside = block.inner(area);
    frame.render_widget(&block, area);
    if pane.plot == Plot::Normals {
        let title = "½ ∫ |D − D_true| cos θ dω: 0 equal, 1 disjoint";
        frame.render_widget(Bars { title, bars: &shown.bars }, inside);
        return;
    }
    let (across, up) = match pane.plot {
        Plot::Cost => (("CPU time a pixel, ns", Scale::Decades), ("RMSE", Scale::Decades)),
        Plot::Flicker => (
            ("samples a pixel", Scale::Counts),
            ("error’s change ÷ the truth’s: 0 moves as the truth does", Scale::Linear),
        ),
        Plot::Error | Plot::Normals => {
            (("samples a pixel", Scale::Counts), ("RMSE", Scale::Decades))
        }
    };
    let method = match pane.table.chosen_row().and_then(|row| row.first()) {
        Some(Cell::Text(method)) if pane.focus == Focus::Table => Some(method),
        _ => None,
    };
    let chosen = shown.series.iter().position(|series| Some(&series.name) == method);
    let floor = shown.floor.map(|floor| (floor, "the reference’s own error"));
    let nothing = match pane.plot {
        Plot::Flicker => "nothing moves, or a last frame is still to come",
        _ => "nothing measured yet",
    };
    let chart = Chart { across, up, series: &shown.series, floor, nothing, chosen };
    frame.render_widget(&chart, inside);
}

/// A title with the scenes that are shown.
fn of(title: &str, pane: &Experiments) -> String {
    match pane.shown.of.as_str() {
        "" => title.to_owned(),
        scenes => format!("{title} · {scenes}"),
    }
}

/// Draws the table.
pub fn draw_table(pane: &Experiments, area: Rect, frame: &mut Frame) {
    let focused = pane.focus == Focus::Table;
    let place = if pane.table.is_empty() {
        String::new()
    } else {
        format!(", {} of {}", pane.table.chosen() + 1, pane.table.len())
    };
    let title = format!("{}{place}", of("Trials", pane));
    let block = panel(&title, focused);
    let inside = block.inner(area);
    frame.render_widget(&block, area);
    if pane.table.is_empty() {
        frame.render_widget(Text::raw("nothing measured yet"), inside);
    } else {
        frame.render_widget(TableView { table: &pane.table, focused }, inside);
    }
}

/// Draws the end of the log, or what is above it where it is scrolled up.
pub fn draw_log(pane: &Experiments, area: Rect, frame: &mut Frame) {
    let title = if pane.log.up > 0 {
        format!("Log (UTC), {} below", pane.log.up)
    } else {
        "Log (UTC)".into()
    };
    let block = panel(&title, pane.focus == Focus::Log);
    let inside = block.inner(area);
    frame.render_widget(&block, area);
    let room = usize::from(inside.height);
    let lines: Vec<Line> =
        pane.log.shown(room).flat_map(|entry| lines(entry, inside.width)).collect();
    let skip = lines.len().saturating_sub(room);
    frame.render_widget(Text::from_iter(lines.into_iter().skip(skip)), inside);
}

/// An entry as lines: the time and a sign, then its text.
fn lines(entry: &Entry, width: u16) -> Vec<Line<'static>> {
    /// `17:05:09 ✓ `.
    const MARGIN: u16 = 11;
    let colour = match entry.kind {
        log::Kind::Problem => Color::Red,
        log::Kind::Done => Color::Green,
        log::Kind::Begun | log::Kind::Note => Color::Reset,
    };
    let sign = Style::new().fg(colour).add_modifier(Modifier::BOLD);
    let line = |(place, text): (usize, String)| {
        if place > 0 {
            return Line::raw(format!("{}{text}", " ".repeat(MARGIN.into())));
        }
        let time = Span::styled(
            progress::time_of_day(entry.time),
            Style::new().add_modifier(Modifier::DIM),
        );
        Line::from(vec![
            time,
            Span::styled(format!(" {} ", entry.kind.sign()), sign),
            Span::raw(text),
        ])
    };
    wrapped(&entry.text, width.saturating_sub(MARGIN)).into_iter().enumerate().map(line).collect()
}
