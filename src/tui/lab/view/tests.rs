//! The lab on the screen.

use insta::assert_snapshot;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Position;
use ratatui::style::Color;

use super::super::fixture::{empty, full};
use super::super::{Focus, click};
use crate::tui::model::Model;
use crate::tui::picture::{Depth, Gallery};
use crate::tui::view;
use crate::tui::viewer::{Tone, Zoom};

/// The screen the model is drawn on.
pub fn drawn(model: &Model) -> Buffer {
    let [columns, rows] = model.size;
    let mut terminal = Terminal::new(TestBackend::new(columns, rows)).unwrap();
    let gallery = Gallery::new(model.screen);
    terminal.draw(|frame| view::draw(model, &gallery, frame)).unwrap();
    terminal.backend().buffer().clone()
}

fn text(model: &Model) -> String {
    let buffer = drawn(model);
    let line = |y| {
        let line: String = (0..buffer.area.width).map(|x| buffer[(x, y)].symbol()).collect();
        line.trim_end().to_owned()
    };
    (0..buffer.area.height).map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn at_the_usual_size() {
    assert_snapshot!(text(&full([80, 24], Depth::None)));
}

#[test]
fn with_settings_at_the_usual_size() {
    let mut model = full([80, 24], Depth::None);
    model.lab.focus = Focus::Settings;
    model.lab.setting = 4;
    assert_snapshot!(text(&model));
}

#[test]
fn with_distributions_at_the_usual_size() {
    let mut model = full([80, 24], Depth::None);
    model.lab.focus = Focus::Normals;
    assert_snapshot!(text(&model));
}

#[test]
fn larger() {
    assert_snapshot!(text(&full([120, 40], Depth::None)));
}

#[test]
fn very_large() {
    assert_snapshot!(text(&full([300, 80], Depth::None)));
}

#[test]
fn split_with_errors() {
    let mut model = full([100, 30], Depth::None);
    model.lab.viewer.split = Some(0.5);
    model.lab.viewer.sides = [4, 1];
    model.lab.viewer.tone = Tone::Error;
    model.lab.viewer.zoom = Zoom::Whole;
    assert_snapshot!(text(&model));
}

#[test]
fn pixels_as_numbers() {
    let mut model = full([80, 24], Depth::None);
    model.lab.viewer.numbers = true;
    assert_snapshot!(text(&model));
}

#[test]
fn nothing_open() {
    assert_snapshot!(text(&empty([80, 24], Depth::None)));
}

#[test]
fn colours_are_those_of_the_terminal() {
    let inked = |depth: Depth| {
        let buffer = drawn(&full([80, 24], depth));
        buffer.content().iter().flat_map(|cell| [cell.fg, cell.bg]).collect::<Vec<Color>>()
    };
    assert!(inked(Depth::True).iter().any(|c| matches!(c, Color::Rgb(..))));
    let indexed = inked(Depth::Ansi256);
    assert!(indexed.iter().any(|c| matches!(c, Color::Indexed(_))));
    assert!(!indexed.iter().any(|c| matches!(c, Color::Rgb(..))));
    assert!(inked(Depth::None).iter().all(|c| *c == Color::Reset));
}

/// Parts stay on the screen and apart, at every size.
#[test]
fn any_size_is_drawn() {
    for columns in [1, 20, 60, 61, 80, 133, 300] {
        for rows in [1, 5, 16, 17, 24, 50, 80] {
            for focus in Focus::ALL {
                let mut model = full([columns, rows], Depth::True);
                model.lab.focus = focus;
                drawn(&model);
                let layout = super::Layout::of(&model);
                if model.is_too_small() {
                    continue;
                }
                let parts = [Some(layout.picture), layout.methods, layout.settings, layout.normals];
                let parts: Vec<_> = parts.into_iter().flatten().collect();
                for (i, one) in parts.iter().enumerate() {
                    assert_eq!(one.intersection(model.pane_area()), *one, "{columns} × {rows}");
                    assert!(parts[..i].iter().all(|other| !one.intersects(*other)));
                }
            }
        }
    }
}

#[test]
fn the_mouse_finds_what_it_points_at() {
    let mut model = full([120, 40], Depth::True);
    let layout = super::Layout::of(&model);
    let methods = layout.methods.unwrap();
    click(&mut model, Position::new(methods.x + 3, methods.y + 5));
    assert_eq!((model.lab.row, model.lab.viewer.sides[0]), (4, 5));
    model.lab.viewer.zoom = Zoom::Whole;
    let picture = layout.picture;
    let middle = Position::new(picture.x + picture.width / 2, picture.y + picture.height / 2);
    click(&mut model, middle);
    assert_eq!(model.lab.focus, Focus::Picture);
    let [x, y] = model.lab.viewer.cursor;
    assert!((15..=17).contains(&x) && (11..=13).contains(&y), "{x} {y}");
}

/// At the least width, labels of all registered methods can be told apart.
#[test]
fn short_labels_differ() {
    let mut labels: Vec<String> =
        crate::method::entries().iter().map(|entry| super::short(entry.card.name, 16)).collect();
    assert!(labels.iter().all(|label| label.chars().count() <= 16));
    let count = labels.len();
    labels.sort();
    labels.dedup();
    assert_eq!(labels.len(), count);
}
