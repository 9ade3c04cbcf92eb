//! What keys, time, and what the threads tell, do to the pane.

use std::path::Path;
use std::time::SystemTime;

use ratatui::layout::{Margin, Position, Rect};

use super::log::Kind;
use super::progress::in_words;
use super::run::{Run, State};
use super::shown::{Which, shown};
use super::told::{End, Order, Told};
use super::view::{Layout, first_row};
use super::{Ask, Experiments, Focus};
use crate::experiment::runner::RunEvent;
use crate::job;
use crate::tui::keys::Action;
use crate::tui::library::{Listed, Report};
use crate::tui::table::Table;

/// To look at an experiment in the lab: by its name, or by its path where names do not lead to it.
fn to_lab(one: &Listed) -> Ask {
    let named = Path::new(job::FOLDER).join(format!("{}.toml", one.name));
    Ask::Lab(if one.path == named { one.name.clone() } else { one.path.display().to_string() })
}

/// Lines that a key for a page goes.
const PAGE: isize = 10;

impl Experiments {
    /// Does what a key asks.
    pub fn press(&mut self, action: Action, now: SystemTime) -> Vec<Ask> {
        match action {
            Action::NextFocus => self.turn_focus(1),
            Action::PreviousFocus => self.turn_focus(Focus::ALL.len() - 1),
            Action::Up => return self.go(-1),
            Action::Down => return self.go(1),
            Action::PageUp => return self.go(-PAGE),
            Action::PageDown => return self.go(PAGE),
            Action::First => return self.go(isize::MIN),
            Action::Last => return self.go(isize::MAX),
            Action::Run => return self.start_chosen(now),
            Action::Pause => return self.pause(),
            Action::Cancel => return self.cancel(),
            Action::OpenReport => return vec![self.open_report()],
            Action::ToLabWith => return self.chosen().map(to_lab).into_iter().collect(),
            Action::NextChart => self.plot = self.plot.next(),
            Action::NextScene => self.turn_scene(1),
            Action::PreviousScene => self.turn_scene(-1),
            Action::SortNext => self.table.sort_by_next(1),
            Action::SortTurn => self.table.turn_around(),
            _ => return Vec::new(),
        }
        self.show();
        Vec::new()
    }

    fn turn_focus(&mut self, steps: usize) {
        let place = Focus::ALL.iter().position(|focus| *focus == self.focus).unwrap_or(0);
        self.focus = Focus::ALL[(place + steps) % Focus::ALL.len()];
    }

    fn go(&mut self, steps: isize) -> Vec<Ask> {
        match self.focus {
            Focus::List => {
                let last = self.list.as_ref().map_or(0, |list| list.len().saturating_sub(1));
                let place = self.chosen.saturating_add_signed(steps).min(last);
                return self.choose(place);
            }
            Focus::Table => self.table.go(steps),
            Focus::Log => self.log.scroll(steps.saturating_neg()),
        }
        Vec::new()
    }

    /// Chooses the experiment in this place of the list.
    pub fn choose(&mut self, place: usize) -> Vec<Ask> {
        if place == self.chosen || self.list.as_ref().is_none_or(|list| place >= list.len()) {
            return Vec::new();
        }
        self.chosen = place;
        self.which = Which::default();
        self.show();
        self.read_chosen()
    }

    /// Asks for the figures of the chosen experiment, if they are not there.
    fn read_chosen(&mut self) -> Vec<Ask> {
        let Some(name) = self.chosen().map(|one| one.name.clone()) else { return Vec::new() };
        if self.board().is_some() || self.reading.as_ref() == Some(&name) {
            return Vec::new();
        }
        self.reading = Some(name.clone());
        vec![Ask::Order(Order::Read { name })]
    }

    fn start_chosen(&mut self, now: SystemTime) -> Vec<Ask> {
        let Some(one) = self.chosen().cloned() else {
            return vec![Ask::Problem(
                "there is no experiment to run: the folder experiments/ has none".into(),
            )];
        };
        if let Some(problem) = &one.problem {
            return vec![Ask::Problem(problem.clone())];
        }
        match self.running().map(|run| (run.name == one.name, run.state.clone())) {
            None => self.start(&one, now),
            Some((true, State::Pausing | State::Paused)) => self.pause(),
            Some((true, State::Halting)) => {
                vec![Ask::Say(format!("{} is halting: run it once it has", one.name))]
            }
            Some((true, _)) => vec![Ask::Say(format!("{} is running already", one.name))],
            Some((false, _)) if self.queue.contains(&one.name) => {
                vec![Ask::Say(format!("{} waits for its turn already", one.name))]
            }
            Some((false, _)) => {
                self.queue.push(one.name.clone());
                vec![Ask::Say(format!("{} runs next", one.name))]
            }
        }
    }

    fn start(&mut self, one: &Listed, now: SystemTime) -> Vec<Ask> {
        self.number += 1;
        self.run = Some(Run::new(self.number, one));
        self.which = Which::default();
        self.log.add(now, Kind::Begun, format!("{} runs", one.name));
        self.show();
        let (number, name, path) = (self.number, one.name.clone(), one.path.clone());
        vec![Ask::Order(Order::Run { number, path, name })]
    }

    fn pause(&mut self) -> Vec<Ask> {
        let Some(run) = self.run.as_mut().filter(|run| run.state.is_under_way()) else {
            return vec![Ask::Say("no run is under way".into())];
        };
        let (state, shut, text) = match run.state {
            State::Running => (
                State::Pausing,
                true,
                format!("{} waits once the piece under way is done", run.name),
            ),
            State::Pausing | State::Paused => {
                (State::Running, false, format!("{} goes on", run.name))
            }
            State::Halting | State::Ended(_) => {
                return vec![Ask::Say(format!("{} is halting", run.name))];
            }
        };
        run.state = state;
        vec![Ask::Order(Order::Pause(shut)), Ask::Say(text)]
    }

    /// Takes the chosen experiment out of those that wait, or halts the run.
    fn cancel(&mut self) -> Vec<Ask> {
        let chosen = self.chosen().map(|one| one.name.clone());
        if let Some(place) = self.queue.iter().position(|name| Some(name) == chosen.as_ref()) {
            return vec![Ask::Say(format!("{} does not run next", self.queue.remove(place)))];
        }
        let Some(run) = self.run.as_mut().filter(|run| run.state.is_under_way()) else {
            return vec![Ask::Say("no run is under way".into())];
        };
        run.state = State::Halting;
        let text = format!("{} halts; what is finished is kept", run.name);
        vec![Ask::Order(Order::Cancel), Ask::Say(text)]
    }

    fn open_report(&self) -> Ask {
        let Some(one) = self.chosen() else { return Ask::Say("no experiment is chosen".into()) };
        match self.report(&one.name).filter(|report| report.written.is_some()) {
            Some(report) => Ask::Open(report.folder.join("report.html")),
            None => Ask::Problem(format!("{} has no report yet: run it", one.name)),
        }
    }

    fn turn_scene(&mut self, steps: isize) {
        let Some(board) = self.board() else { return };
        let mut all = if self.is_chosen_running() { vec![Which::Current] } else { Vec::new() };
        let parts = board.parts();
        if parts.is_empty() {
            all.push(Which::All);
        }
        all.extend(parts.into_iter().map(|part| Which::Part(part.to_owned())));
        all.extend(board.scenes.iter().map(|scene| Which::One(scene.slug.clone())));
        let place = all.iter().position(|which| *which == self.which).unwrap_or(0) as isize;
        let next = (place + steps).rem_euclid(all.len() as isize) as usize;
        self.which = all.swap_remove(next);
    }

    /// Takes in what was told.
    pub fn hear(&mut self, told: Told, now: SystemTime) -> Vec<Ask> {
        match told {
            Told::Listed(list, reports) => self.listed(list, reports),
            Told::Read { name, board, problems } => {
                if self.reading.as_ref() == Some(&name) {
                    self.reading = None;
                }
                // That a run of ours which was halted has written no report yet is no news.
                let known = self.report(&name).is_none_or(|report| report.written.is_none())
                    && self.run.as_ref().is_some_and(|run| run.name == name);
                let problems = if known { Vec::new() } else { problems };
                let mut asks = Vec::new();
                if let Some(first) = problems.first() {
                    asks.push(Ask::Problem(format!("{name}: {first}")));
                }
                for problem in problems {
                    self.log.add(now, Kind::Problem, format!("{name}: {problem}"));
                }
                self.read = Some((name, *board));
                self.show();
                asks
            }
            Told::Looked(one) => self.looked(*one),
            Told::Ran(number, event) => {
                self.ran(number, &event, now);
                Vec::new()
            }
            Told::Ended(number, end) => self.ended(number, end, now),
        }
    }

    fn listed(&mut self, mut list: Vec<Listed>, reports: Vec<Report>) -> Vec<Ask> {
        let chosen = self.chosen().map(|one| one.name.clone());
        let new = |one: &&Listed| list.iter().all(|other| other.name != one.name);
        let elsewhere: Vec<Listed> = self.elsewhere.iter().filter(new).cloned().collect();
        list.extend(elsewhere);
        let place = list.iter().position(|one| Some(&one.name) == chosen.as_ref());
        let usual = || list.iter().position(|one| one.name == job::DEFAULT);
        let place = if chosen.is_none() { usual() } else { place };
        self.chosen = place.unwrap_or(self.chosen.min(list.len().saturating_sub(1)));
        let empty = list.is_empty();
        (self.list, self.reports) = (Some(list), reports);
        let mut asks = self.find_wanted();
        self.show();
        if empty && asks.is_empty() {
            let text = "there are no experiments here: no files experiments/*.toml";
            asks.push(Ask::Problem(text.into()));
        }
        asks.extend(self.read_chosen());
        asks
    }

    /// Chooses the experiment that is wanted, or has its file looked at.
    fn find_wanted(&mut self) -> Vec<Ask> {
        let Some(wanted) = self.wanted.take() else { return Vec::new() };
        let path = Path::new(&wanted);
        // Of a part, `NAME/PART`, the experiment it is of.
        let named = |one: &Listed| {
            one.name == wanted
                || one.path == path
                || wanted.strip_prefix(&one.name).is_some_and(|r| r.starts_with('/'))
        };
        match self.list.iter().flatten().position(named) {
            Some(place) => {
                self.chosen = place;
                self.which = Which::default();
                Vec::new()
            }
            None if path.extension().is_some_and(|e| e == "toml") => {
                vec![Ask::Order(Order::Look(path.to_owned()))]
            }
            None => vec![Ask::Problem(format!("there is no experiment `{wanted}`"))],
        }
    }

    /// Adds an experiment in a file elsewhere, and chooses it.
    fn looked(&mut self, one: Listed) -> Vec<Ask> {
        if let Some(problem) = one.problem {
            return vec![Ask::Problem(problem)];
        }
        self.elsewhere.retain(|other| other.name != one.name);
        self.elsewhere.push(one.clone());
        let list = self.list.get_or_insert_default();
        list.retain(|other| other.name != one.name);
        list.push(one);
        let last = list.len() - 1;
        self.chosen = usize::MAX;
        self.choose(last)
    }

    /// Does what a click asks.
    pub fn point(&mut self, layout: Layout, at: Position) -> Vec<Ask> {
        let within = |area: Option<Rect>| area.filter(|area| area.contains(at));
        if let Some(area) = within(Some(layout.list)) {
            self.focus = Focus::List;
            let inside = area.inner(Margin::new(1, 1));
            if inside.contains(at) {
                let first = first_row(self, inside);
                return self.choose(first + usize::from(at.y - inside.y));
            }
        } else if within(layout.table).is_some() {
            self.focus = Focus::Table;
        } else if within(layout.log).is_some() {
            self.focus = Focus::Log;
        }
        Vec::new()
    }

    fn ran(&mut self, number: u64, event: &RunEvent, now: SystemTime) {
        let Some(run) = self.run.as_mut().filter(|run| run.number == number) else { return };
        run.take(event, now);
        let name = &run.name;
        let (kind, text) = match event {
            RunEvent::Started { scenes, trials, .. } => {
                (Kind::Begun, format!("{name}: {scenes} scenes, {trials} trials"))
            }
            RunEvent::Noted { text } => (Kind::Note, format!("{name}: {text}")),
            RunEvent::Paused => (Kind::Note, format!("{name} is paused")),
            RunEvent::Resumed => (Kind::Note, format!("{name} goes on")),
            RunEvent::Reporting => (Kind::Note, format!("{name}: writing the report")),
            RunEvent::Probed { .. } => {
                (Kind::Done, format!("{name}: {} is measured", run.progress.scene_name()))
            }
            _ => {
                self.stale = true;
                return;
            }
        };
        self.log.add(now, kind, crate::tui::model::plain(&text));
        self.stale = true;
    }

    fn ended(&mut self, number: u64, end: End, now: SystemTime) -> Vec<Ask> {
        let Some(run) = self.run.as_mut().filter(|run| run.number == number) else {
            return Vec::new();
        };
        let name = run.name.clone();
        let (kind, text) = match &end {
            End::Done { secs, .. } => {
                let time = std::time::Duration::try_from_secs_f64(*secs).unwrap_or_default();
                (Kind::Done, format!("{name} is done in {}", in_words(time)))
            }
            End::Halted => (Kind::Note, format!("{name} was halted; what was finished is kept")),
            End::Failed(error) => (Kind::Problem, format!("{name}: {error}")),
        };
        run.state = State::Ended(end);
        let text = crate::tui::model::plain(&text);
        self.log.add(now, kind, text.clone());
        // What was halted or has failed may have an older report: it is read anew.
        self.read = None;
        self.show();
        let say = if kind == Kind::Problem { Ask::Problem(text) } else { Ask::Say(text) };
        let mut asks = vec![say, Ask::Order(Order::List)];
        asks.extend(self.start_next(now));
        asks
    }

    /// Starts the experiment that waits for its turn.
    fn start_next(&mut self, now: SystemTime) -> Vec<Ask> {
        while !self.queue.is_empty() {
            let name = self.queue.remove(0);
            let found = self.list.iter().flatten().find(|one| one.name == name);
            if let Some(one) = found.filter(|one| one.problem.is_none()).cloned() {
                return self.start(&one, now);
            }
        }
        Vec::new()
    }

    /// Counts time, and shows what has come in since.
    pub fn tick(&mut self, now: SystemTime) {
        if let Some(run) = self.run.as_mut().filter(|run| run.state.is_under_way()) {
            run.progress.tick(now);
        }
        if self.stale {
            self.show();
        }
    }

    /// Brings chart and table up to date.
    fn show(&mut self) {
        self.stale = false;
        let running = self.is_chosen_running();
        let new = self.board().map(|board| shown(board, self.plot, &self.which, running));
        let new = new.unwrap_or_default();
        if !new.columns.is_empty() && self.table.columns() != new.columns {
            let by = self
                .table
                .sorted_by()
                .map(|(by, down)| (self.table.columns()[by].title.clone(), down));
            self.table = Table::new(new.columns.clone());
            self.table.sort_by_title(by);
        }
        self.table.set_rows(new.rows.clone());
        self.shown = new;
    }
}
