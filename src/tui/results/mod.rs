//! The pane of results: reports of earlier runs, their images and verdicts.
//!
//! Reports are listed; one that is looked into (a [`Book`]) is a list of scenes and plots, or of a paper's rows and
//! their figures. What is chosen there is read by a thread and shown beside the list.

mod book;
mod layout;
mod text;
mod update;
mod view;
mod worker;

#[cfg(test)]
mod tests;

pub use book::{Book, Image, Item, Shown, Stack};
pub use layout::Layout;
pub use view::draw;
pub use worker::Worker;

use std::path::PathBuf;
use std::sync::Arc;

use super::keys::Context;
use super::library::{Opened, Report};
use crate::experiment::results::Picture;
use crate::render::Film;

/// What of the pane has the focus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Focus {
    /// A list.
    #[default]
    List,
    /// What is beside it: images, a plot, a row's claims.
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
    /// The reports; none before they have been looked for.
    pub reports: Option<Vec<Report>>,
    /// The one chosen.
    pub report: usize,
    /// The one being opened.
    pub opening: Option<PathBuf>,
    /// The one looked into.
    pub book: Option<Book>,
    /// Counts what was asked to be read, so that what comes late is known.
    pub ticket: u64,
}

/// What is asked of the thread.
#[derive(Clone, Debug)]
pub enum Order {
    /// To list the reports.
    List,
    /// To open the one in a folder.
    Open(PathBuf),
    /// To read images, each with its place among them.
    Films(u64, Vec<(usize, PathBuf)>),
    /// To read a plot.
    Plot(u64, PathBuf),
}

/// What the thread tells.
#[derive(Clone, Debug)]
pub enum Told {
    /// The reports there are.
    Listed(Vec<Report>),
    /// A report, opened.
    Opened(Box<Opened>),
    /// An image, or why it cannot be read.
    Film(u64, usize, Result<Arc<Film>, String>),
    /// A plot, or why it cannot be read.
    Plot(u64, Result<Arc<Picture>, String>),
}
