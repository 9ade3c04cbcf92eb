//! Shares of a paper's evidence: the scenes of its sweeps, and the rows that need no sweep. Rows that need one are
//! made when all scenes are there.

use std::path::Path;

use super::super::{Paper, Row};
use super::{Gathering, Halt, PaperSpec, RunError, RunEvent, UNITS, Watcher, runner, store};
use crate::experiment::share::Share;
use crate::experiment::spec::RowSpec;

/// Does one share of the work of gathering, with what is finished kept in `folder`, as [`super::gather`] does it. How
/// many scenes and rows these are; `None` if it was halted.
///
/// # Errors
/// Those of [`runner::run`].
///
/// # Panics
/// If the spec names no paper there is: a programming error, as specs are checked.
pub fn gather_share(
    spec: &PaperSpec,
    share: Share,
    folder: &Path,
    halt: &Halt,
    watch: &Watcher,
) -> Result<Option<usize>, RunError> {
    let paper = paper(spec);
    let parts: Vec<Vec<f64>> = spec.parts.iter().map(runner::units).collect::<Result<_, _>>()?;
    let rows = free(paper, spec);
    let weights =
        parts.iter().flatten().copied().chain(rows.iter().map(|(row, _)| row.secs * UNITS));
    let mine = share.deal(&weights.collect::<Vec<_>>());
    let (mut mine, mut done) = (mine.as_slice(), 0);
    for (part, units) in spec.parts.iter().zip(&parts) {
        let (of_part, rest) = mine.split_at(units.len());
        mine = rest;
        if !of_part.contains(&true) {
            continue;
        }
        let within = folder.join(&part.name);
        let Some(scenes) = runner::run_units(part, of_part, &within, halt, watch)? else {
            return Ok(None);
        };
        done += scenes;
    }
    let store = store(spec, folder)?;
    for ((row, told), _) in rows.into_iter().zip(mine).filter(|(_, mine)| **mine) {
        watch(RunEvent::Started { work: row.secs * UNITS, scenes: 1, trials: 0 });
        let gathering = Gathering { spec, row, told, parts: &[], store: &store, halt, watch };
        if gathering.exhibit()?.is_none() {
            return Ok(None);
        }
        done += 1;
    }
    Ok(Some(done))
}

/// What [`gather_share`] would have kept in `folder` and is not there: scenes as `PART/SLUG`, and rows.
///
/// # Errors
/// Those of [`runner::run`].
///
/// # Panics
/// If the spec names no paper there is: a programming error, as specs are checked.
pub fn missing(spec: &PaperSpec, folder: &Path) -> Result<Vec<String>, RunError> {
    let mut missing = Vec::new();
    for part in &spec.parts {
        let scenes = runner::missing(part, &folder.join(&part.name))?;
        missing.extend(scenes.iter().map(|scene| format!("{}/{scene}", part.name)));
    }
    let (store, halt, watch) = (store(spec, folder)?, Halt::default(), runner::unwatched());
    for (row, told) in free(paper(spec), spec) {
        let gathering =
            Gathering { spec, row, told, parts: &[], store: &store, halt: &halt, watch: &watch };
        if gathering.take_up().is_none() {
            missing.push(row.name.to_owned());
        }
    }
    Ok(missing)
}

fn paper(spec: &PaperSpec) -> &'static Paper {
    super::super::find(spec.paper).expect("specs name papers there are")
}

/// The rows that need no part.
fn free<'a>(paper: &'static Paper, spec: &'a PaperSpec) -> Vec<(&'static Row, &'a RowSpec)> {
    let rows = paper.rows.iter().zip(&spec.rows);
    rows.filter(|(row, _)| row.parts.is_empty()).collect()
}
