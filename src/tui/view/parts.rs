//! Parts that panes share.

use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::widgets::{Block, BorderType};

use crate::tui::model::Model;

/// What is wrong.
pub const ALARM: Style = Style::new()
    .fg(Color::White)
    .bg(Color::Red)
    .add_modifier(Modifier::BOLD.union(Modifier::REVERSED));

/// The frame of a part of a pane; that of the part with the focus is double, and its title bold.
pub fn panel(text: &str, focus: bool) -> Block<'_> {
    let style = if focus { Style::new().add_modifier(Modifier::BOLD) } else { Style::new() };
    let border = if focus { BorderType::Double } else { BorderType::Plain };
    Block::bordered().border_type(border).title(title(text)).title_style(style)
}

/// A title with room at its ends.
pub fn title(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!(" {text} ") }
}

/// A part of a whole as a bar of this many characters, in eighths.
pub fn share(part: f64, width: usize) -> String {
    const EIGHTHS: [char; 8] = [' ', '▏', '▎', '▍', '▌', '▋', '▊', '▉'];
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 };
    let eighths = (part * (8 * width) as f64).round() as usize;
    let mut bar = "█".repeat(eighths / 8);
    if bar.chars().count() < width {
        bar.push(EIGHTHS[eighths % 8]);
    }
    let filled = bar.chars().count();
    bar + &" ".repeat(width - filled)
}

/// An area of this size, or as much of it as there is room for, in the middle of the screen.
pub fn middle(model: &Model, [width, height]: [u16; 2]) -> Rect {
    let [columns, rows] = model.size;
    let (width, height) = (width.min(columns), height.min(rows));
    Rect::new((columns - width) / 2, (rows - height) / 2, width, height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_long_as_they_should_be() {
        assert_eq!(share(0.0, 4), "    ");
        assert_eq!(share(0.5, 4), "██  ");
        assert_eq!(share(1.0, 4), "████");
        assert_eq!(share(0.3, 4), "█▎  ");
        assert_eq!(share(f64::NAN, 2), "  ");
    }
}
