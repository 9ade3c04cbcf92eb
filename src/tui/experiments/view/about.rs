//! What the chosen experiment is about, and how far the run is.

use crate::tui::view::words::{at_most, wrapped};
use std::time::SystemTime;

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Text};

use crate::tui::experiments::{End, Experiments, Run, State, progress};
use crate::tui::library::Listed;
use crate::tui::table::fitted;
use crate::tui::view::{panel, share};

/// Draws title, question, size and last result of the chosen experiment.
pub fn draw(pane: &Experiments, now: SystemTime, area: Rect, frame: &mut Frame) {
    let chosen = pane.chosen();
    let block = panel(chosen.map_or("", |one| one.name.as_str()), false);
    let inside = block.inner(area);
    frame.render_widget(block, area);
    let Some(one) = chosen else {
        if pane.list.is_some() {
            let text = "There are no experiments here: files experiments/*.toml. docs/experiments.md tells how to write one.";
            frame.render_widget(Text::from_iter(wrapped(text, inside.width)), inside);
        }
        return;
    };
    let bold = Style::new().add_modifier(Modifier::BOLD);
    let mut lines = vec![Line::styled(fitted(&one.title, inside.width), bold)];
    if let Some(problem) = &one.problem {
        let room = usize::from(inside.height).saturating_sub(1);
        let told = at_most(wrapped(problem, inside.width), room, inside.width);
        lines.extend(told.into_iter().map(Line::raw));
    } else {
        let question = wrapped(&one.question, inside.width);
        lines.extend(at_most(question, 2, inside.width).into_iter().map(Line::raw));
        let standing = format!("{} · {}", one.size, standing(pane, one, now));
        lines.push(Line::raw(fitted(&standing, inside.width)));
        let room = usize::from(inside.height).saturating_sub(lines.len());
        let found = wrapped(&result(pane, one), inside.width);
        lines.extend(at_most(found, room, inside.width).into_iter().map(Line::raw));
    }
    frame.render_widget(Text::from(lines), inside);
}

/// Its run's state, or the age of its report.
fn standing(pane: &Experiments, one: &Listed, now: SystemTime) -> String {
    if let Some(run) = pane.running().filter(|run| run.name == one.name) {
        return run.state.words().to_owned();
    }
    if pane.queue.contains(&one.name) {
        return "waits for its turn".to_owned();
    }
    let written = pane.report(&one.name).and_then(|report| report.written);
    let report = match written.map(|then| progress::age(then, now)) {
        Some(age) if age == "now" => "report written just now".to_owned(),
        Some(age) => format!("report {age} old"),
        None => "no report yet".to_owned(),
    };
    match pane.run.as_ref().filter(|run| run.name == one.name).map(|run| &run.state) {
        Some(state @ State::Ended(End::Halted | End::Failed(_))) => {
            format!("{}; {report}", state.words())
        }
        _ => report,
    }
}

/// What was found last, or why nothing was; empty if it was not run.
fn result(pane: &Experiments, one: &Listed) -> String {
    match pane.run.as_ref().filter(|run| run.name == one.name).map(|run| &run.state) {
        Some(State::Ended(End::Done { lead, .. })) => return lead.join(" "),
        Some(State::Ended(End::Failed(error))) => return crate::tui::model::plain(error),
        _ => {}
    }
    let Some(report) = pane.report(&one.name) else { return String::new() };
    let problems = report.problems.iter().map(|problem| format!("! {problem}."));
    problems.chain(report.lead.iter().cloned()).collect::<Vec<_>>().join(" ")
}

/// Draws how far the run is: all of it, then the piece under way.
pub fn draw_progress(run: &Run, area: Rect, frame: &mut Frame) {
    let progress = &run.progress;
    let part = progress.part();
    let left = match (&run.state, progress.left()) {
        (State::Running, Some(left)) => format!("{} left", progress::in_words(left)),
        (State::Running, None) => String::new(),
        (state, _) => state.words().to_owned(),
    };
    let head = format!("{} {} ", run.state.sign(), run.name);
    let tail = format!(" {:>3} %  {left}", (100.0 * part).floor());
    let width = usize::from(area.width);
    // A space, and the ends of the bar.
    let room = width.saturating_sub(head.chars().count() + tail.chars().count() + 4).min(60);
    let all = format!(" {head}▕{}▏{tail}", share(part, room));
    let place = match (progress.scenes, progress.trials) {
        ((_, 0), _) => "reading what it needs".to_owned(),
        ((number, of), (done, trials)) => {
            format!("scene {number} of {of}, trial {done} of {trials}: {}", progress.what)
        }
    };
    let piece =
        progress.part_of_piece().map_or_else(String::new, |part| format!(" ▕{}▏", share(part, 8)));
    let room = area.width.saturating_sub(1 + piece.chars().count() as u16);
    let words = format!(" {}{piece}", fitted(&place, room));
    let lines = vec![Line::styled(fitted(&all, area.width), Style::new()), Line::raw(words)];
    frame.render_widget(Text::from(lines), area);
}
