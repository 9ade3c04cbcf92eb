//! What messages do to the model.

use crossterm::event::{KeyEvent, KeyEventKind, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Position;

use super::experiments::Experiments;
use super::keys::{self, Action, Key, Pressed};
use super::lab;
use super::message::{Effect, Message};
use super::model::{Model, Pane, Popup, Status};
use super::results::Results;
use super::view;

/// Lines of a page of keys that a key for a page scrolls.
const PAGE: usize = 10;

/// Takes a message in; what is then to be done.
pub fn update(model: &mut Model, message: Message) -> Vec<Effect> {
    match message {
        Message::Key(event) => key(model, event),
        Message::Mouse(event) => mouse(model, event),
        Message::Resized(columns, rows) => {
            model.size = [columns, rows];
            vec![Effect::Clear]
        }
        Message::Tick(now) => {
            model.now = now;
            model.experiments.tick(now);
            Vec::new()
        }
        Message::Ending(signal) => vec![Effect::Quit(Some(signal))],
        Message::Experiments(told) => Experiments::take(model, told),
        Message::Lab(told) => lab::take(model, told),
        Message::Results(told) => Results::take(model, told),
        Message::Note(text) => {
            model.say(text, false);
            Vec::new()
        }
        Message::Problem(text) => {
            model.say(text, true);
            Vec::new()
        }
    }
}

fn key(model: &mut Model, event: KeyEvent) -> Vec<Effect> {
    if event.kind == KeyEventKind::Release {
        return Vec::new();
    }
    let Some(pressed) = keys::find(&model.contexts(), Key::from(event)) else { return Vec::new() };
    // What was said has been read.
    model.status = Status::default();
    act(model, pressed)
}

/// Does what a key asks.
fn act(model: &mut Model, pressed: Pressed) -> Vec<Effect> {
    match (model.popup, pressed.action) {
        (Popup::Quit, Action::Yes) => return vec![Effect::Quit(None)],
        (Popup::Quit, _) | (Popup::Help(_), Action::Close) => {
            model.popup = Popup::None;
            return Vec::new();
        }
        (Popup::Help(line), action) => {
            model.popup = Popup::Help(scrolled(model, line, action));
            return Vec::new();
        }
        (Popup::None, _) => {}
    }
    match pressed.action {
        Action::Quit if model.experiments.is_running() => model.popup = Popup::Quit,
        Action::Quit => return vec![Effect::Quit(None)],
        Action::Suspend => return vec![Effect::Suspend],
        Action::Redraw => return vec![Effect::Clear],
        Action::Help => model.popup = Popup::Help(0),
        Action::ToExperiments => return show(model, Pane::Experiments),
        Action::ToLab => return show(model, Pane::Lab),
        Action::ToResults => return show(model, Pane::Results),
        Action::Mouse => {
            model.mouse = !model.mouse;
            let whose =
                if model.mouse { "the mouse is ours again" } else { "the mouse is the terminal's" };
            model.say(whose, false);
            return vec![Effect::Mouse(model.mouse)];
        }
        _ => {
            return match model.pane {
                Pane::Experiments => Experiments::act(model, pressed),
                Pane::Lab => lab::act(model, pressed),
                Pane::Results => Results::act(model, pressed),
            };
        }
    }
    Vec::new()
}

/// Shows a pane. The lab renders only while it is looked at: what runs has the cores for itself otherwise.
pub(super) fn show(model: &mut Model, pane: Pane) -> Vec<Effect> {
    let from = std::mem::replace(&mut model.pane, pane);
    match (from, pane) {
        (Pane::Lab, Pane::Lab) => Vec::new(),
        (Pane::Lab, _) => vec![Effect::Lab(lab::Order::Rest)],
        (_, Pane::Lab) => {
            if model.experiments.is_running() {
                let shared =
                    "a run is under way: while both render, the times of neither tell much";
                model.say(shared, false);
            }
            lab::enter(model)
        }
        (_, Pane::Results) => Results::enter(model),
        _ => Vec::new(),
    }
}

fn scrolled(model: &Model, line: usize, action: Action) -> usize {
    let last = view::help::lines()
        .saturating_sub(usize::from(view::help::area(model).height).saturating_sub(2));
    match action {
        Action::Up => line.saturating_sub(1),
        Action::Down => line + 1,
        Action::PageUp => line.saturating_sub(PAGE),
        Action::PageDown => line + PAGE,
        _ => line,
    }
    .min(last)
}

fn mouse(model: &mut Model, event: MouseEvent) -> Vec<Effect> {
    let at = Position::new(event.column, event.row);
    if model.popup != Popup::None {
        return Vec::new();
    }
    match event.kind {
        MouseEventKind::Down(MouseButton::Left) | MouseEventKind::Drag(MouseButton::Left) => {
            if at.y == 0 {
                return view::tab_at(at.x).map_or_else(Vec::new, |pane| show(model, pane));
            }
            match model.pane {
                Pane::Lab => lab::click(model, at),
                Pane::Experiments => Experiments::click(model, at),
                Pane::Results => Results::click(model, at),
            }
        }
        MouseEventKind::ScrollUp => wheel(model, Action::ZoomIn, Action::Up),
        MouseEventKind::ScrollDown => wheel(model, Action::ZoomOut, Action::Down),
        _ => Vec::new(),
    }
}

/// The wheel zooms what is a picture and goes along what is a list.
fn wheel(model: &mut Model, zoom: Action, along: Action) -> Vec<Effect> {
    let contexts = model.contexts();
    let action = if contexts.contains(&keys::Context::Cursor) { zoom } else { along };
    act(model, Pressed { action, nth: 0 })
}
