//! The pane of experiments: what there is to run, the run under way, and what runs have found.

mod board;
mod log;
mod progress;
mod run;
mod shown;
mod told;
mod update;
mod view;
mod worker;

#[cfg(test)]
mod tests;

use std::path::PathBuf;

use ratatui::layout::Position;

pub use board::Board;
pub use log::{Entry, Log};
pub use progress::Progress;
pub use run::{Run, State};
pub use shown::{Plot, Shown, Which};
pub use told::{End, Order, Told};
pub use view::draw;
pub use worker::{Tell, Worker};

use super::keys::Pressed;
use super::lab;
use super::library::{Listed, Report};
use super::message::Effect;
use super::model::{Model, Pane};
use super::table::Table;
use view::Layout;

/// What of the pane has the focus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Focus {
    /// The list of experiments; the chart is seen.
    #[default]
    List,
    /// The table.
    Table,
    /// The log.
    Log,
}

impl Focus {
    /// All of them, in the order they take turns.
    pub const ALL: [Self; 3] = [Self::List, Self::Table, Self::Log];
}

/// Runs of experiments.
#[derive(Debug, Default)]
pub struct Experiments {
    /// What has the focus.
    pub focus: Focus,
    /// The experiments there are; None before they have been read.
    pub list: Option<Vec<Listed>>,
    /// The reports there are.
    pub reports: Vec<Report>,
    /// Experiments in files elsewhere that were asked for.
    pub elsewhere: Vec<Listed>,
    /// The place of the chosen experiment.
    pub chosen: usize,
    /// The experiment to choose once it is known, a name or a path.
    pub wanted: Option<String>,
    /// The run under way, or the last one.
    pub run: Option<Run>,
    /// The experiments that wait for the run to end, the next one first.
    pub queue: Vec<String>,
    /// The number of the last run.
    pub number: u64,
    /// The figures last read, with the name of the experiment.
    pub read: Option<(String, Board)>,
    /// Whose figures are being read.
    pub reading: Option<String>,
    /// Which chart is shown.
    pub plot: Plot,
    /// Which scenes chart and table are of.
    pub which: Which,
    /// What they show.
    pub shown: Shown,
    /// The table.
    pub table: Table,
    /// Whether there are figures that are not shown yet.
    pub stale: bool,
    /// What has happened.
    pub log: Log,
}

/// What the pane asks of the rest of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ask {
    /// Something of its threads.
    Order(Order),
    /// To open a file in the program the desktop has for it.
    Open(PathBuf),
    /// To look at an experiment in the lab.
    Lab(String),
    /// To say something in the line at the foot.
    Say(String),
    /// To say what is wrong there.
    Problem(String),
}

impl Experiments {
    /// Does what a key asks.
    pub fn act(model: &mut Model, pressed: Pressed) -> Vec<Effect> {
        let asks = model.experiments.press(pressed.action, model.now);
        carry_out(model, asks)
    }

    /// Does what a click asks.
    pub fn click(model: &mut Model, at: Position) -> Vec<Effect> {
        let (area, pane) = (model.pane_area(), &mut model.experiments);
        let asks = pane.point(Layout::of(area, pane.focus, pane.is_running()), at);
        carry_out(model, asks)
    }

    /// Takes in what was told.
    pub fn take(model: &mut Model, told: Told) -> Vec<Effect> {
        let asks = model.experiments.hear(told, model.now);
        carry_out(model, asks)
    }

    /// Chooses an experiment, by name or path, once the list is there.
    pub fn prefer(&mut self, name: &str) {
        self.wanted = Some(name.to_owned());
    }

    /// The chosen experiment.
    pub fn chosen(&self) -> Option<&Listed> {
        self.list.as_ref()?.get(self.chosen)
    }

    /// The report of an experiment.
    pub fn report(&self, name: &str) -> Option<&Report> {
        self.reports.iter().find(|report| report.name == name)
    }

    /// The run under way.
    pub fn running(&self) -> Option<&Run> {
        self.run.as_ref().filter(|run| run.state.is_under_way())
    }

    /// Whether a run is under way that quitting would halt.
    pub fn is_running(&self) -> bool {
        self.running().is_some()
    }

    /// Whether the chosen experiment is the one that runs.
    pub fn is_chosen_running(&self) -> bool {
        self.running()
            .is_some_and(|run| self.chosen().is_some_and(|chosen| chosen.name == run.name))
    }

    /// The figures of the chosen experiment: those of its run, or else of its last report.
    pub fn board(&self) -> Option<&Board> {
        let name = &self.chosen()?.name;
        let run = self.run.as_ref().filter(|run| run.name == *name);
        let fresh = run.filter(|run| run.state.is_under_way() || !run.board.is_empty());
        let read = || self.read.as_ref().filter(|(of, _)| of == name).map(|(_, board)| board);
        fresh.map(|run| &run.board).or_else(read)
    }

    /// What the line of titles tells of a run under way.
    pub fn headline(&self) -> Option<String> {
        let run = self.running()?;
        let left = run.progress.left().filter(|_| run.state == State::Running);
        let left =
            left.map_or_else(String::new, |left| format!(", {} left", progress::in_words(left)));
        let percent = (100.0 * run.progress.part()).floor();
        let state = if run.state == State::Running { "" } else { run.state.words() };
        let gap = if state.is_empty() { "" } else { " " };
        Some(format!("{} {} {state}{gap}{percent} %{left}", run.state.sign(), run.name))
    }
}

/// Passes on what the pane asks for.
fn carry_out(model: &mut Model, asks: Vec<Ask>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for ask in asks {
        match ask {
            Ask::Order(order) => effects.push(Effect::Experiments(order)),
            Ask::Open(path) => effects.push(Effect::Open(path)),
            Ask::Lab(name) => {
                effects.extend(lab::open(model, &name));
                effects.extend(super::update::show(model, Pane::Lab));
            }
            Ask::Say(text) => model.say(text, false),
            Ask::Problem(text) => model.say(text, true),
        }
    }
    effects
}
