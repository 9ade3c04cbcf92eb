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
    share_of(paper(spec), spec, share, folder, halt, watch)
}

fn share_of(
    paper: &Paper,
    spec: &PaperSpec,
    share: Share,
    folder: &Path,
    halt: &Halt,
    watch: &Watcher,
) -> Result<Option<usize>, RunError> {
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
    missing_of(paper(spec), spec, folder)
}

fn missing_of(paper: &Paper, spec: &PaperSpec, folder: &Path) -> Result<Vec<String>, RunError> {
    let mut missing = Vec::new();
    for part in &spec.parts {
        let scenes = runner::missing(part, &folder.join(&part.name))?;
        missing.extend(scenes.iter().map(|scene| format!("{}/{scene}", part.name)));
    }
    let (store, halt, watch) = (store(spec, folder)?, Halt::default(), runner::unwatched());
    for (row, told) in free(paper, spec) {
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
fn free<'a>(paper: &'a Paper, spec: &'a PaperSpec) -> Vec<(&'a Row, &'a RowSpec)> {
    let rows = paper.rows.iter().zip(&spec.rows);
    rows.filter(|(row, _)| row.parts.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{QUIET, part, spec};
    use super::super::{Gathered, gather_rows};
    use super::*;
    use crate::experiment::store::Store;

    #[test]
    fn shares_of_a_paper_make_the_whole() {
        let spec = PaperSpec { parts: vec![part("one"), part("two")], ..spec() };
        let (halt, watch) = (Halt::default(), runner::unwatched());
        let whole = tempfile::tempdir().unwrap();
        let mut done = 0;
        for number in [3, 1, 2] {
            let shard = tempfile::tempdir().unwrap();
            let share = Share { of: 3, number };
            done += share_of(&QUIET, &spec, share, shard.path(), &halt, &watch).unwrap().unwrap();
            assert!(!missing_of(&QUIET, &spec, whole.path()).unwrap().is_empty());
            for within in ["", "one", "two"] {
                Store::take_in(&whole.path().join(within), &shard.path().join(within)).unwrap();
            }
        }
        assert_eq!(done, 5, "two scenes of each part, and a row");
        assert_eq!(missing_of(&QUIET, &spec, whole.path()).unwrap(), Vec::<String>::new());
        let found = gather_rows(&QUIET, &spec, whole.path(), &halt, &watch).unwrap();
        let Gathered::Finished(found) = found else { panic!("nothing halts it") };
        assert_eq!(found.parts.iter().map(|part| part.results.scenes.len()).sum::<usize>(), 4);
    }
}
