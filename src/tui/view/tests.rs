//! What stands on the screen whatever the pane.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use insta::assert_snapshot;
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::*;
use crate::tui::lab::fixture::{empty, full};
use crate::tui::message::{Effect, Message};
use crate::tui::picture::Depth;
use crate::tui::update;

fn text(model: &Model) -> String {
    let [columns, rows] = model.size;
    let mut terminal = Terminal::new(TestBackend::new(columns, rows)).unwrap();
    let gallery = Gallery::new(model.screen);
    terminal.draw(|frame| draw(model, &gallery, frame)).unwrap();
    let buffer = terminal.backend().buffer();
    let line = |y| {
        let line: String = (0..columns).map(|x| buffer[(x, y)].symbol()).collect();
        line.trim_end().to_owned()
    };
    (0..rows).map(line).collect::<Vec<_>>().join("\n")
}

fn press(model: &mut Model, key: KeyCode) -> Vec<Effect> {
    update(model, Message::Key(KeyEvent::new(key, KeyModifiers::NONE)))
}

#[test]
fn help_is_the_table() {
    let mut model = full([80, 24], Depth::None);
    press(&mut model, KeyCode::Char('?'));
    assert_snapshot!(text(&model));
}

#[test]
fn help_scrolls_to_its_end_and_no_further() {
    let mut model = full([80, 24], Depth::None);
    press(&mut model, KeyCode::Char('?'));
    (0..500).for_each(|_| drop(press(&mut model, KeyCode::Down)));
    let last = text(&model);
    assert!(last.contains("Keys: Esc closes"), "{last}");
    press(&mut model, KeyCode::Esc);
    assert_eq!(model.popup, Popup::None);
}

#[test]
fn a_small_terminal_says_so() {
    assert_snapshot!(text(&full([40, 8], Depth::None)));
}

#[test]
fn problems_are_marked_without_colour_too() {
    let mut model = empty([80, 24], Depth::None);
    update(&mut model, Message::Problem("map.png: truncated\n\u{1b}[2J".into()));
    let screen = text(&model);
    assert!(screen.contains(" !  map.png: truncated [2J"), "{screen}");
}

#[test]
fn titles_are_where_they_are_clicked() {
    let model = empty([80, 24], Depth::None);
    let line: Vec<char> = text(&model).lines().next().unwrap().chars().collect();
    for pane in Pane::ALL {
        let at = (0..line.len())
            .find(|i| line[*i..].starts_with(&pane.title().chars().collect::<Vec<_>>()));
        assert_eq!(tab_at(at.unwrap() as u16), Some(pane));
    }
    assert_eq!(tab_at(0), None);
}

#[test]
fn the_footer_fits_and_ends_with_help_and_quit() {
    for columns in [60, 80, 120, 300] {
        let screen = text(&full([columns, 24], Depth::None));
        let footer = screen.lines().last().unwrap().to_owned();
        assert!(footer.ends_with("? keys  q quit"), "{footer}");
        assert!(footer.chars().count() <= usize::from(columns));
    }
}
