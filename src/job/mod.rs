//! Floor 8: a job: one experiment, from its spec to its written report. Both faces of the program, the command line
//! and the terminal runner, do their runs through it.

mod control;
mod find;
mod leftovers;
mod shards;
mod verify;

#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

pub use control::{Control, Gate};
pub use find::{
    DEFAULT, FOLDER, FindError, draft, is_image, load, load_sweep, locate, names, names_in,
};
pub use shards::{MergeError, merge, run_shard, shard_folder};
pub use verify::{Difference, FileNow, Verified, VerifyError, differences, reports_in, verify};

use crate::evidence::{Evidence, Findings, Gathered, gather};
use crate::experiment::lock::{Lock, LockError};
use crate::experiment::manifest::Manifest;
use crate::experiment::results::Results;
use crate::experiment::runner::{self, Outcome, RunError, RunEvent, Watcher};
use crate::experiment::spec::{Experiment, PaperSpec, Spec};
use crate::report::{self, ReportError};

/// How a job ended, if not in an error.
#[derive(Debug)]
pub enum Ending {
    /// All of it is done, and its report is written.
    Done(Done),
    /// It was halted; what was finished is kept.
    Halted,
}

/// A finished job.
#[derive(Debug)]
pub struct Done {
    /// What was found.
    pub found: Found,
    /// Wall-clock seconds of this run, resumed pieces not counted.
    pub secs: f64,
    /// The files written, in the order they were.
    pub files: Vec<PathBuf>,
}

/// What a job found.
#[derive(Debug)]
pub enum Found {
    /// By a sweep.
    Sweep(Box<Results>),
    /// Of a paper.
    Paper(Box<Evidence>),
}

/// Why a job could not be done.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    /// The folder of its results cannot be had.
    #[error(transparent)]
    Folder(#[from] LockError),
    /// It could not go on.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Its report could not be written.
    #[error(transparent)]
    Report(#[from] ReportError),
}

/// Runs an experiment with its results in `folder`, made if it is missing, and writes its report, until it is done or
/// halted. While the control's gate is shut it waits before its next piece of work; `watch` hears of that, and of all
/// else, from the thread that calls this, apart from [`RunEvent::Partly`], which comes from any.
///
/// # Errors
/// [`JobError`]; what was finished before is kept.
pub fn run(
    experiment: &Experiment,
    folder: &Path,
    control: &Control,
    watch: &Watcher,
) -> Result<Ending, JobError> {
    let _lock = Lock::take(folder)?;
    let mut manifest = Manifest::begun(experiment, None)?;
    manifest.write(folder)?;
    let watch = control.gated(watch);
    let done = match experiment {
        Experiment::Sweep(spec) => sweep(spec, folder, control, &watch)?,
        Experiment::Paper(spec) => paper(spec, folder, control, &watch)?,
    };
    if let Some(done) = &done {
        leftovers::clear(folder, &done.files);
        manifest.finished = true;
        manifest.write(folder)?;
    }
    Ok(done.map_or(Ending::Halted, Ending::Done))
}

/// Runs a sweep; None if it was halted.
fn sweep(
    spec: &Spec,
    folder: &Path,
    control: &Control,
    watch: &Watcher,
) -> Result<Option<Done>, JobError> {
    let Outcome::Finished(found) = runner::run(spec, folder, &control.halt, watch)? else {
        return Ok(None);
    };
    let (results, costs) = *found;
    tell_of_report(watch);
    let files = report::write(&results, &costs, folder)?;
    Ok(Some(Done { found: Found::Sweep(Box::new(results)), secs: costs.total_secs, files }))
}

/// Gathers a paper's evidence; its sweeps have reports of their own in folders within. None if it was halted.
fn paper(
    spec: &PaperSpec,
    folder: &Path,
    control: &Control,
    watch: &Watcher,
) -> Result<Option<Done>, JobError> {
    let Gathered::Finished(found) = gather(spec, folder, &control.halt, watch)? else {
        return Ok(None);
    };
    let Findings { evidence, parts, row_secs, secs } = *found;
    tell_of_report(watch);
    let mut files = report::write_evidence(&evidence, &row_secs, folder)?;
    for part in &parts {
        let within = folder.join(&part.results.name);
        files.extend(report::write(&part.results, &part.costs, &within)?);
    }
    Ok(Some(Done { found: Found::Paper(Box::new(evidence)), secs, files }))
}

fn tell_of_report(watch: &Watcher) {
    watch(RunEvent::Reporting);
}
