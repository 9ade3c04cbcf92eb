//! How the pane looks.

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::style::Color;

use super::fixture::{at, pane, scene};
use crate::experiment::runner::RunEvent;
use crate::tui::experiments::{Experiments, Told};
use crate::tui::keys::Action;
use crate::tui::model::Model;
use crate::tui::picture::{Depth, Gallery, Screen};
use crate::tui::view;

fn drawn(pane: Experiments, size: [u16; 2], depth: Depth) -> Buffer {
    let screen = Screen::plain(depth);
    let mut model = Model::new(size, screen, at(0));
    model.experiments = pane;
    let mut terminal = Terminal::new(TestBackend::new(size[0], size[1])).unwrap();
    let gallery = Gallery::new(screen);
    terminal.draw(|frame| view::draw(&model, &gallery, frame)).unwrap();
    terminal.backend().buffer().clone()
}

fn text(buffer: &Buffer) -> String {
    let row = |cells: &[ratatui::buffer::Cell]| {
        cells.iter().map(ratatui::buffer::Cell::symbol).collect::<String>().trim_end().to_owned()
    };
    buffer.content.chunks(buffer.area.width.into()).map(row).collect::<Vec<_>>().join("\n")
}

/// A pane in the midst of a run, in its second scene.
fn midst() -> Experiments {
    let mut pane = pane();
    pane.press(Action::Run, at(0));
    let started = RunEvent::Started { work: 100.0, scenes: 8, trials: 96 };
    let mut told = vec![started, RunEvent::Advanced { work: 10.0, kept: true }];
    told.push(RunEvent::Noted {
        text: "a prefiltered map on the shelf was damaged: built again".into(),
    });
    told.extend(scene(1, "twill-2-texels", 5));
    told.push(RunEvent::Advanced { work: 20.0, kept: false });
    told.extend(scene(2, "twill-16-texels", 3));
    told.push(RunEvent::Working { what: "rendering olano-north at 4 spp".into(), work: 10.0 });
    told.push(RunEvent::Partly { part: 0.6 });
    told.into_iter().for_each(|event| drop(pane.hear(Told::Ran(1, event), at(30))));
    pane.tick(at(42));
    pane
}

fn press(mut pane: Experiments, actions: &[Action]) -> Experiments {
    actions.iter().for_each(|action| drop(pane.press(*action, at(0))));
    pane
}

#[test]
fn at_rest() {
    insta::assert_snapshot!(text(&drawn(pane(), [80, 24], Depth::True)));
    insta::assert_snapshot!(text(&drawn(pane(), [120, 40], Depth::True)));
}

#[test]
fn in_the_midst_of_a_run() {
    insta::assert_snapshot!(text(&drawn(midst(), [80, 24], Depth::True)));
    insta::assert_snapshot!(text(&drawn(midst(), [120, 40], Depth::True)));
    insta::assert_snapshot!(text(&drawn(midst(), [300, 80], Depth::True)));
}

#[test]
fn without_colour_letters_and_marks_tell_all() {
    let buffer = drawn(midst(), [120, 40], Depth::None);
    assert!(buffer.content.iter().all(|cell| cell.fg == Color::Reset && cell.bg == Color::Reset));
    assert_eq!(text(&buffer), text(&drawn(midst(), [120, 40], Depth::True)));
    let table =
        press(midst(), &[Action::NextFocus, Action::SortNext, Action::SortNext, Action::SortNext]);
    insta::assert_snapshot!(text(&drawn(table, [80, 24], Depth::None)));
}

#[test]
fn other_charts_and_the_log() {
    let cost = press(pane(), &[Action::NextChart, Action::NextChart, Action::NextScene]);
    let normals = press(pane(), &[Action::NextChart, Action::NextChart, Action::NextChart]);
    let log = press(midst(), &[Action::PreviousFocus]);
    let wrong = press(pane(), &[Action::Up]);
    let all = [cost, normals, log, wrong].map(|pane| text(&drawn(pane, [80, 24], Depth::Ansi256)));
    insta::assert_snapshot!(all.join("\n\n"));
}

#[test]
fn no_size_and_no_state_panics() {
    for size in [[60, 16], [61, 17], [80, 24], [133, 27], [500, 17], [60, 200]] {
        for pane in [Experiments::default(), pane(), midst()] {
            drawn(pane, size, Depth::True);
        }
        let focus = [Action::NextFocus, Action::NextChart];
        for actions in (0..3).map(|n| focus.repeat(n)) {
            drawn(press(midst(), &actions), size, Depth::True);
        }
    }
}
