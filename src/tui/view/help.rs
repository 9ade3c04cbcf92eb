//! The page of all keys, made from the table that dispatches them.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

use super::parts::{middle, panel};
use crate::tui::keys::{Action, BINDINGS, Binding, Context};
use crate::tui::model::Model;

/// Columns of the keys' names.
const KEYS: usize = 26;

/// Where it stands.
pub fn area(model: &Model) -> Rect {
    middle(model, [90, model.size[1].saturating_sub(2).min(50)])
}

/// How many lines it has.
pub fn lines() -> usize {
    page().len()
}

/// Draws it from a line on.
pub fn draw(from: usize, area: Rect, frame: &mut Frame) {
    let lines: Vec<Line> = page().into_iter().skip(from).collect();
    let more = lines.len() > usize::from(area.height.saturating_sub(2));
    let title = if more { "Keys: ↓ for more, Esc closes" } else { "Keys: Esc closes" };
    frame.render_widget(Paragraph::new(lines).block(panel(title, true)), area);
}

fn page() -> Vec<Line<'static>> {
    let mut lines = Vec::new();
    for context in Context::ALL {
        if !lines.is_empty() {
            lines.push(Line::raw(""));
        }
        lines.push(Line::styled(context.title(), Style::new().add_modifier(Modifier::BOLD)));
        let of = BINDINGS.iter().filter(|binding| binding.context == context);
        lines.extend(of.map(|binding| {
            let keys = format!("  {:<KEYS$}", keys(binding));
            Line::from(vec![Span::raw(keys), Span::raw(binding.words)])
        }));
    }
    lines
}

/// The names of a binding's keys.
fn keys(binding: &Binding) -> String {
    if binding.action == Action::Pick {
        return "0 … 9".to_owned();
    }
    binding.keys.iter().map(ToString::to_string).collect::<Vec<_>>().join("  ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_binding_has_a_line() {
        let page: Vec<String> = page().iter().map(ToString::to_string).collect();
        for binding in BINDINGS {
            let of =
                |line: &&String| line.ends_with(binding.words) && line.contains(&keys(binding));
            assert!(page.iter().any(|line| of(&line)), "{:?}", binding.action);
        }
    }

    #[test]
    fn names_leave_room() {
        assert!(BINDINGS.iter().all(|binding| keys(binding).chars().count() < KEYS));
    }
}
