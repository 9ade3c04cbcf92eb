//! The pane of experiments: what there is to run, and the run under way.

use ratatui::Frame;
use ratatui::layout::Rect;

use super::keys::Pressed;
use super::message::Effect;
use super::model::Model;
use super::picture::Gallery;

/// Runs of experiments.
#[derive(Debug, Default)]
pub struct Experiments {}

/// What is asked of the threads.
#[derive(Clone, Debug)]
pub enum Order {}

/// What the threads tell.
#[derive(Clone, Debug)]
pub enum Told {}

impl Experiments {
    /// Does what a key asks.
    pub fn act(_model: &mut Model, _pressed: Pressed) -> Vec<Effect> {
        Vec::new()
    }

    /// Takes in what was told.
    pub fn take(_model: &mut Model, told: Told) -> Vec<Effect> {
        match told {}
    }

    /// Whether a run is under way that quitting would halt.
    pub fn is_running(&self) -> bool {
        false
    }
}

/// Draws the pane.
pub fn draw(_model: &Model, _gallery: &Gallery, _area: Rect, _frame: &mut Frame) {}
