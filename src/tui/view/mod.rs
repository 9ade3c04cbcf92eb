//! The view: from the model to a frame.
//!
//! ```text
//!  wrinkle  1 Experiments  2 Lab  3 Results                 titles
//!  ...                                                      the pane
//!  status                                                   what was last said
//!  key hint  key hint  key hint                             the footer
//! ```

pub mod help;
mod parts;
pub mod words;

pub use parts::{panel, share, title};

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Clear, Paragraph};

use super::keys;
use super::model::{LEAST, Model, Pane, Popup};
use super::picture::Gallery;
use super::{experiments, lab, results};

/// Draws everything, in the colours the terminal has.
pub fn draw(model: &Model, gallery: &Gallery, frame: &mut Frame) {
    if model.is_too_small() {
        too_small(model, frame);
    } else {
        gallery.cover(popup_area(model));
        titles(model, frame);
        let area = model.pane_area();
        match model.pane {
            Pane::Experiments => experiments::draw(model, gallery, area, frame),
            Pane::Lab => lab::draw(model, gallery, area, frame),
            Pane::Results => results::draw(model, gallery, area, frame),
        }
        status(model, frame);
        footer(model, frame);
        popup(model, frame);
    }
    model.screen.depth.limit(frame.buffer_mut());
}

fn too_small(model: &Model, frame: &mut Frame) {
    let [columns, rows] = model.size;
    let [wide, high] = LEAST;
    let text = format!(
        "The terminal is {columns} × {rows}: wrinkle needs {wide} × {high}. Make it larger; q quits."
    );
    let wrap = ratatui::widgets::Wrap { trim: true };
    frame.render_widget(Paragraph::new(text).wrap(wrap), frame.area());
}

/// The titles: a mark, then each pane's with the column it starts at.
fn tabs() -> Vec<(u16, Pane, String)> {
    let mut column = 10;
    let mut tabs = Vec::new();
    for pane in Pane::ALL {
        let initial = pane.title().chars().next().unwrap_or(' ');
        let text = format!(" {initial} {} ", pane.title());
        let width = text.chars().count() as u16;
        tabs.push((column, pane, text));
        column += width + 1;
    }
    tabs
}

/// The pane whose title stands in this column of the first line.
pub fn tab_at(column: u16) -> Option<Pane> {
    let tabs = tabs();
    let hit = |(from, _, text): &&(u16, Pane, String)| {
        (*from..*from + text.chars().count() as u16).contains(&column)
    };
    tabs.iter().find(hit).map(|(_, pane, _)| *pane)
}

fn titles(model: &Model, frame: &mut Frame) {
    let line = Rect::new(0, 0, model.size[0], 1);
    let buffer = frame.buffer_mut();
    buffer.set_string(1, 0, "wrinkle", Style::new().add_modifier(Modifier::BOLD));
    for (column, pane, text) in tabs() {
        let chosen = Style::new().add_modifier(Modifier::REVERSED | Modifier::BOLD);
        let style = if pane == model.pane { chosen } else { Style::new() };
        buffer.set_stringn(column, 0, text, usize::from(line.width.saturating_sub(column)), style);
    }
    if let Some(text) = model.experiments.headline() {
        let width = text.chars().count() as u16;
        let end = tabs().last().map_or(0, |(column, _, text)| column + text.chars().count() as u16);
        if end + width + 2 < line.width {
            buffer.set_string(line.width - width - 1, 0, text, Style::new());
        }
    }
}

fn status(model: &Model, frame: &mut Frame) {
    let area = Rect::new(0, model.size[1].saturating_sub(2), model.size[0], 1);
    let status = &model.status;
    if status.text.is_empty() {
        return;
    }
    let line = if status.problem {
        Line::from(vec![Span::styled(" ! ", parts::ALARM), Span::raw(" "), Span::raw(&status.text)])
    } else {
        Line::raw(format!(" {}", status.text))
    };
    frame.render_widget(Paragraph::new(line), area);
}

/// As many hints as there is room for; the keys of everything always.
fn footer(model: &Model, frame: &mut Frame) {
    let area = Rect::new(0, model.size[1].saturating_sub(1), model.size[0], 1);
    let hints = keys::hints(&model.contexts());
    let width =
        |(key, word): &(String, &str)| (key.chars().count() + word.chars().count() + 3) as u16;
    let (mut shown, mut rest): (Vec<_>, Vec<_>) = (Vec::new(), Vec::new());
    for hint in hints {
        if ["keys", "quit"].contains(&hint.1) { rest.push(hint) } else { shown.push(hint) }
    }
    let mut room = area.width.saturating_sub(rest.iter().map(width).sum());
    shown.retain(|hint| {
        let fits = width(hint) <= room;
        room = if fits { room - width(hint) } else { 0 };
        fits
    });
    let mut spans = vec![Span::raw(" ")];
    for (key, word) in shown.into_iter().chain(rest) {
        spans.push(Span::styled(key, Style::new().add_modifier(Modifier::BOLD)));
        spans.push(Span::raw(format!(" {word}  ")));
    }
    frame.render_widget(Paragraph::new(Line::from(spans)), area);
}

fn popup_area(model: &Model) -> Option<Rect> {
    match model.popup {
        Popup::None => None,
        Popup::Help(_) => Some(help::area(model)),
        Popup::Quit => Some(parts::middle(model, [52, 5])),
    }
}

fn popup(model: &Model, frame: &mut Frame) {
    let Some(area) = popup_area(model) else { return };
    frame.render_widget(Clear, area);
    match model.popup {
        Popup::Help(line) => help::draw(line, area, frame),
        _ => question(area, frame),
    }
}

fn question(area: Rect, frame: &mut Frame) {
    let text = vec![
        Line::raw("A run is under way. Halt it and quit?"),
        Line::raw("What is finished is kept; the next run goes on."),
        Line::raw("y quit   n stay"),
    ];
    frame.render_widget(Paragraph::new(text).block(panel("Quit", true)), area);
}

#[cfg(test)]
mod tests;
