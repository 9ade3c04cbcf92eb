//! The pane of experiments: what there is to run, and the run under way.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use ratatui::Frame;
use ratatui::layout::{Position, Rect};

use super::keys::Pressed;
use super::message::Effect;
use super::model::Model;
use super::picture::Gallery;

/// Runs of experiments.
#[derive(Debug, Default)]
pub struct Experiments {}

/// What is asked of the threads.
#[derive(Clone, Debug)]
pub enum Order {
    /// To look again at which experiments there are.
    List,
}

/// What the threads tell.
#[derive(Clone, Debug)]
pub enum Told {}

impl Experiments {
    /// Does what a key asks.
    pub fn act(_model: &mut Model, _pressed: Pressed) -> Vec<Effect> {
        Vec::new()
    }

    /// Does what a click asks.
    pub fn click(_model: &mut Model, _at: Position) -> Vec<Effect> {
        Vec::new()
    }

    /// Takes in what was told.
    pub fn take(_model: &mut Model, told: Told) -> Vec<Effect> {
        match told {}
    }

    /// Chooses an experiment once the list is there.
    pub fn prefer(&mut self, _name: &str) {}

    /// What the line of titles tells of a run under way.
    pub fn headline(&self) -> Option<String> {
        None
    }

    /// Whether a run is under way that quitting would halt.
    pub fn is_running(&self) -> bool {
        false
    }
}

/// The threads of the experiments.
pub struct Worker {}

impl Worker {
    /// Starts them; reports are in `reports`.
    pub fn start(_tell: Arc<dyn Fn(Told) + Send + Sync>, _reports: PathBuf) -> Self {
        Self {}
    }

    /// Passes an order on; never waits.
    pub fn order(&self, _order: Order) {}

    /// Halts the run under way and waits until it has let go of its folder, for so long at most.
    pub fn end(&self, _patience: Duration) {}
}

/// Draws the pane.
pub fn draw(_model: &Model, _gallery: &Gallery, _area: Rect, _frame: &mut Frame) {}
