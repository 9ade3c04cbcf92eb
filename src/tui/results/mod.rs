//! The pane of results: reports of earlier runs, their images and verdicts.

use ratatui::Frame;
use ratatui::layout::Rect;

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

    /// Takes in what was told.
    pub fn take(_model: &mut Model, told: Told) -> Vec<Effect> {
        match told {}
    }
}

/// Draws the pane.
pub fn draw(_model: &Model, _gallery: &Gallery, _area: Rect, _frame: &mut Frame) {}
