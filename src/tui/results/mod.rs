//! The pane of results: reports of earlier runs, their images and verdicts.

use std::path::PathBuf;
use std::sync::Arc;

use ratatui::Frame;
use ratatui::layout::{Position, Rect};

use super::keys::{Context, Pressed};
use super::message::Effect;
use super::model::Model;
use super::picture::Gallery;

/// What of the pane has the focus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Focus {
    /// A list.
    #[default]
    List,
    /// The picture.
    Picture,
}

impl Focus {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::List, Self::Picture];

    /// Where its keys are looked for.
    pub fn contexts(self) -> &'static [Context] {
        match self {
            Self::List => &[Context::Reports, Context::Results, Context::Picture],
            Self::Picture => &[Context::Cursor, Context::Results, Context::Picture],
        }
    }
}

/// Reports of earlier runs.
#[derive(Debug, Default)]
pub struct Results {
    /// What has the focus.
    pub focus: Focus,
}

/// What is asked of the threads.
#[derive(Clone, Debug)]
pub enum Order {}

/// What the threads tell.
#[derive(Clone, Debug)]
pub enum Told {}

impl Results {
    /// Does what a key asks.
    pub fn act(_model: &mut Model, _pressed: Pressed) -> Vec<Effect> {
        Vec::new()
    }

    /// The pane is shown.
    pub fn enter(_model: &mut Model) -> Vec<Effect> {
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
}

/// The threads of the results.
pub struct Worker {}

impl Worker {
    /// Starts them; reports are in `reports`.
    pub fn start(_tell: Arc<dyn Fn(Told) + Send + Sync>, _reports: PathBuf) -> Self {
        Self {}
    }

    /// Passes an order on; never waits.
    pub fn order(&self, _order: Order) {}
}

/// Draws the pane.
pub fn draw(_model: &Model, _gallery: &Gallery, _area: Rect, _frame: &mut Frame) {}
