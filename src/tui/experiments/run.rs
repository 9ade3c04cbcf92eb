//! A run as the pane sees it.

use std::time::SystemTime;

use super::board::Board;
use super::progress::Progress;
use super::told::End;
use crate::experiment::runner::RunEvent;
use crate::tui::library::Listed;

/// What a run is doing.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    /// It works.
    Running,
    /// It will wait after the piece under way.
    Pausing,
    /// It waits.
    Paused,
    /// It was told to halt.
    Halting,
    /// It has ended.
    Ended(End),
}

impl State {
    /// Whether it has not ended.
    pub fn is_under_way(&self) -> bool {
        !matches!(self, Self::Ended(_))
    }

    /// Its sign in lists.
    pub fn sign(&self) -> char {
        match self {
            Self::Running => '▶',
            Self::Pausing | Self::Paused => '‖',
            Self::Halting | Self::Ended(End::Halted) => '■',
            Self::Ended(End::Done { .. }) => '✓',
            Self::Ended(End::Failed(_)) => '!',
        }
    }

    /// It in a word.
    pub fn words(&self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Pausing => "pausing",
            Self::Paused => "paused",
            Self::Halting => "halting",
            Self::Ended(End::Done { .. }) => "done",
            Self::Ended(End::Halted) => "halted",
            Self::Ended(End::Failed(_)) => "failed",
        }
    }
}

/// A run, under way or ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Its number: what is told of it carries it.
    pub number: u64,
    /// The experiment's name.
    pub name: String,
    /// What it is doing.
    pub state: State,
    /// How far it is.
    pub progress: Progress,
    /// What it has found.
    pub board: Board,
}

impl Run {
    /// A run that begins.
    pub fn new(number: u64, of: &Listed) -> Self {
        Self {
            number,
            name: of.name.clone(),
            state: State::Running,
            progress: Progress::default(),
            board: Board::new(&of.methods),
        }
    }

    /// Takes in what it tells.
    pub fn take(&mut self, event: &RunEvent, now: SystemTime) {
        self.progress.take(event, now);
        let part = self.progress.scene.as_ref().and_then(|(part, _)| part.as_deref());
        self.board.take(part, event);
        match (event, &self.state) {
            (RunEvent::Paused, State::Pausing | State::Running) => self.state = State::Paused,
            (RunEvent::Resumed, State::Pausing | State::Paused) => self.state = State::Running,
            _ => {}
        }
    }
}
