//! The papers and their rows: what evidence there is to gather, and how.

use crate::experiment::results::{Costs, Results};
use crate::experiment::spec::{PaperKeys, RowKeys, Spec};
use crate::method::Progress;
use crate::parameter::{Parameter, Values};

use super::{Exhibit, blinn_1978, fournier_1992, kautz_2001, olano_north_1997, schilling_1997};

/// A paper whose figures, tables and numbers are made again.
#[derive(Debug)]
pub struct Paper {
    /// Its name in specs.
    pub name: &'static str,
    /// Author, year, title, where it appeared.
    pub citation: &'static str,
    /// Its rows, in the paper's order.
    pub rows: &'static [Row],
}

/// A figure, table or number of a paper.
#[derive(Debug)]
pub struct Row {
    /// Its name, such as `fournier-f3`.
    pub name: &'static str,
    /// What it shows, a line.
    pub title: &'static str,
    /// The sweeps of the spec that it draws on.
    pub parts: &'static [&'static str],
    /// Its options.
    pub parameters: &'static [Parameter],
    /// A guess of how long it takes, seconds on two cores: it tells how much of a run is done.
    pub secs: f64,
    /// Makes it.
    pub make: fn(&Task) -> Result<Exhibit, Halted>,
}

/// The work was told to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("halted")]
pub struct Halted;

/// What a row is made from.
pub struct Task<'a> {
    /// Its options, complete and within their domains.
    pub values: &'a Values,
    /// The seed of every random choice.
    pub seed: u64,
    /// The sweeps of the spec, finished.
    pub parts: &'a [FinishedPart],
    /// Told how far the row is; says when to stop.
    pub progress: &'a dyn Progress,
}

/// A finished sweep.
#[derive(Clone, Debug)]
pub struct FinishedPart {
    /// What was asked.
    pub spec: Spec,
    /// What it found.
    pub results: Results,
    /// What it cost.
    pub costs: Costs,
}

impl<'a> Task<'a> {
    /// The finished sweep of this name.
    ///
    /// # Panics
    /// If the row has not said that it draws on it: a programming error, as the spec was checked for
    /// what rows have said.
    pub fn part(&self, name: &str) -> &'a FinishedPart {
        let found = self.parts.iter().find(|part| part.results.name == name);
        found.unwrap_or_else(|| panic!("no part {name}: the row does not say that it needs it"))
    }

    /// # Errors
    /// [`Halted`] if the work should stop.
    pub fn go_on(&self) -> Result<(), Halted> {
        if self.progress.cancelled() { Err(Halted) } else { Ok(()) }
    }
}

impl Row {
    /// An exhibit of this row with nothing in it yet.
    pub fn exhibit(&self) -> Exhibit {
        Exhibit {
            row: self.name.into(),
            title: self.title.into(),
            parts: self.parts.iter().map(|&part| part.into()).collect(),
            ..Exhibit::default()
        }
    }
}

/// The papers whose evidence can be gathered.
pub fn papers() -> &'static [Paper] {
    const PAPERS: &[Paper] = &[
        blinn_1978::PAPER,
        fournier_1992::PAPER,
        schilling_1997::PAPER,
        olano_north_1997::PAPER,
        kautz_2001::PAPER,
    ];
    PAPERS
}

/// The paper of this name.
pub fn find(name: &str) -> Option<&'static Paper> {
    papers().iter().find(|paper| paper.name == name)
}

/// What specs may say of each paper.
pub fn keys() -> Vec<PaperKeys> {
    let row = |row: &Row| RowKeys { name: row.name, parameters: row.parameters, parts: row.parts };
    let paper =
        |paper: &Paper| PaperKeys { name: paper.name, rows: paper.rows.iter().map(row).collect() };
    papers().iter().map(paper).collect()
}

impl From<crate::render::Cancelled> for Halted {
    fn from(_: crate::render::Cancelled) -> Self {
        Self
    }
}
