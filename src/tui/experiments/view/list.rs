//! The list of experiments.

use std::time::SystemTime;

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::Span;

use crate::tui::experiments::{Experiments, Focus, progress};
use crate::tui::library::Listed;
use crate::tui::table::fitted;
use crate::tui::view::panel;

/// Draws the list.
pub fn draw(pane: &Experiments, now: SystemTime, area: Rect, frame: &mut Frame) {
    let focused = pane.focus == Focus::List;
    let block = panel("Experiments", focused);
    let inside = block.inner(area);
    frame.render_widget(block, area);
    let buffer = frame.buffer_mut();
    let Some(list) = &pane.list else {
        buffer.set_stringn(inside.x, inside.y, "reading …", inside.width.into(), Style::new());
        return;
    };
    let first = first_row(pane, inside);
    for ((place, one), y) in list.iter().enumerate().skip(first).zip(inside.top()..inside.bottom())
    {
        let line = Rect { y, height: 1, ..inside };
        let (sign, colour) = sign(pane, one);
        let mark = if place == pane.chosen { '▸' } else { ' ' };
        let style = Style::new().add_modifier(Modifier::BOLD);
        buffer.set_stringn(line.x, y, mark.to_string(), 1, style);
        buffer.set_stringn(line.x + 1, y, sign, 1, style.fg(colour));
        let age = age(pane, one, now);
        let long = Span::raw(age.as_str()).width() as u16;
        let room = line.width.saturating_sub(3 + long + u16::from(long > 0));
        let style = if place == pane.chosen { style } else { Style::new() };
        buffer.set_stringn(line.x + 3, y, fitted(&one.name, room), room.into(), style);
        buffer.set_string(line.right().saturating_sub(long), y, age, Style::new());
        if place == pane.chosen && focused {
            buffer.set_style(line, Style::new().add_modifier(Modifier::REVERSED));
        }
    }
}

/// The first experiment shown in a list with this area inside: the chosen one is seen.
pub fn first_row(pane: &Experiments, inside: Rect) -> usize {
    let (all, room) = (pane.list.as_ref().map_or(0, Vec::len), usize::from(inside.height));
    pane.chosen.saturating_sub(room / 2).min(all.saturating_sub(room))
}

/// How it stands, in a sign: of its run, its place among those that wait, whether something is wrong, whether there is
/// a report.
fn sign(pane: &Experiments, one: &Listed) -> (String, Color) {
    let run = pane.running().filter(|run| run.name == one.name);
    let waits = pane.queue.iter().position(|name| *name == one.name);
    let written = pane.report(&one.name).is_some_and(|report| report.written.is_some());
    match (run, waits) {
        (Some(run), _) => (run.state.sign().to_string(), Color::Cyan),
        (None, Some(place)) if place < 9 => ((place + 1).to_string(), Color::Cyan),
        (None, Some(_)) => ("…".into(), Color::Cyan),
        (None, None) if one.problem.is_some() => ("!".into(), Color::Red),
        (None, None) if written => ("✓".into(), Color::Green),
        _ => (" ".into(), Color::Reset),
    }
}

/// How far its run is, or how old its report.
fn age(pane: &Experiments, one: &Listed, now: SystemTime) -> String {
    if let Some(run) = pane.running().filter(|run| run.name == one.name) {
        return format!("{} %", (100.0 * run.progress.part()).floor());
    }
    let written = pane.report(&one.name).and_then(|report| report.written);
    written.map_or_else(String::new, |then| progress::age(then, now))
}
