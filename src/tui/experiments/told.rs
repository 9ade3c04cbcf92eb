//! What the pane and its threads say to each other.

use std::path::PathBuf;

use super::board::Board;
use crate::experiment::runner::RunEvent;
use crate::tui::library::{Listed, Report};

/// What is asked of the threads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Order {
    /// To look which experiments and reports there are.
    List,
    /// To read an experiment in a file elsewhere.
    Look(PathBuf),
    /// To read the figures of an experiment's last report. It takes the place of what was asked before.
    Read {
        /// The experiment.
        name: String,
    },
    /// To run an experiment once the run before has ended.
    Run {
        /// The run's number: what is told of it carries it.
        number: u64,
        /// The experiment's file.
        path: PathBuf,
        /// The experiment's name.
        name: String,
    },
    /// To wait before the next piece of work (true), or to go on.
    Pause(bool),
    /// To halt the run under way.
    Cancel,
}

/// What the threads tell.
#[derive(Clone, Debug)]
pub enum Told {
    /// The experiments and the reports there are.
    Listed(Vec<Listed>, Vec<Report>),
    /// An experiment in a file elsewhere.
    Looked(Box<Listed>),
    /// The figures of an experiment's last report, and what is wrong with them.
    Read {
        /// The experiment.
        name: String,
        /// Its figures; none if there is no report.
        board: Box<Board>,
        /// What is wrong with the files, a sentence each.
        problems: Vec<String>,
    },
    /// What a run tells.
    Ran(u64, RunEvent),
    /// A run has ended.
    Ended(u64, End),
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// Its report is written.
    Done {
        /// Where the report is to be looked at.
        report: Option<PathBuf>,
        /// Wall-clock seconds.
        secs: f64,
        /// What was found, a short paragraph each.
        lead: Vec<String>,
    },
    /// It was halted; what was finished is kept.
    Halted,
    /// It could not go on: why.
    Failed(String),
}
