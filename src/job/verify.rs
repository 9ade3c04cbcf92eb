//! Verifying reports: the experiment that stands in one is run again, and all files are compared.

mod difference;
mod image;
mod text;

use std::path::{Path, PathBuf};

use serde::Deserialize;

pub use difference::{Difference, differences};

use super::{Control, Ending, JobError, locate, run};
use crate::evidence;
use crate::experiment::runner::Watcher;
use crate::experiment::spec::{Experiment, SpecErrors};

/// What a report came to when its experiment was run again.
#[derive(Debug)]
pub struct Verified {
    /// The report's folder.
    pub folder: PathBuf,
    /// How the experiment's file is now, if it is not as it was.
    pub file: Option<FileNow>,
    /// How many files were compared: those of either.
    pub files: usize,
    /// Those that differ, in order of their names.
    pub differences: Vec<Difference>,
}

/// How the file of a verified experiment differs from what its report says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileNow {
    /// It is another text now: the report is of an earlier one.
    Changed(PathBuf),
    /// There is none of its name.
    Gone,
}

/// Why a report cannot be verified.
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// There is no report.
    #[error("there is no report in {}: it has neither metrics.json nor evidence.json", .0.display())]
    NoReport(PathBuf),
    /// The file that holds its experiment cannot be read.
    #[error("{}: {why}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        why: String,
    },
    /// This program does not understand its experiment, or does not find a file that it names.
    #[error("{}: the experiment in it cannot be run here:\n{errors}", path.display())]
    Spec {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        errors: SpecErrors,
    },
    /// There is no room for a second report.
    #[error("cannot make a temporary folder: {0}; choose another place for it with TMPDIR")]
    Temporary(std::io::Error),
    /// The run failed.
    #[error("its experiment cannot be run again: {0}")]
    Job(#[from] JobError),
}

/// What verification needs of `metrics.json` or `evidence.json`.
#[derive(Deserialize)]
struct Told {
    #[serde(default = "first")]
    format: u32,
    #[serde(alias = "name")]
    experiment: String,
    spec: String,
}

/// The format of files that say none.
fn first() -> u32 {
    1
}

/// Runs the experiment that stands in the report in `folder` again, in a temporary folder, with nothing taken up, and
/// compares all files but those of costs. Files that the experiment reads are looked for from the folder of
/// `file`, the experiment's file; where none is told, from where an experiment of its name would be. `None` if it
/// was halted.
///
/// # Errors
/// [`VerifyError`].
pub fn verify(
    folder: &Path,
    file: Option<&Path>,
    control: &Control,
    watch: &Watcher,
) -> Result<Option<Verified>, VerifyError> {
    let (source, told) = told(folder)?;
    let stem = Path::new(&told.experiment).file_name().unwrap_or_default().to_string_lossy();
    let usual = || Path::new(super::FOLDER).join(format!("{stem}.toml"));
    let found = file.map(Path::to_owned).or_else(|| locate(&stem).ok());
    let now = match found.as_ref().map(|path| (path, std::fs::read_to_string(path))) {
        Some((_, Ok(text))) if text == told.spec => None,
        Some((path, Ok(_))) => Some(FileNow::Changed(path.clone())),
        _ => Some(FileNow::Gone),
    };
    let path = found.unwrap_or_else(usual);
    let experiment = Experiment::parse(&told.spec, &path, &evidence::keys())
        .map_err(|errors| VerifyError::Spec { path: source, errors })?;
    let again = tempfile::tempdir().map_err(VerifyError::Temporary)?;
    match run(&experiment, again.path(), control, watch)? {
        Ending::Halted => Ok(None),
        Ending::Done(_) => {
            let (files, differences) = differences(folder, again.path());
            Ok(Some(Verified { folder: folder.to_owned(), file: now, files, differences }))
        }
    }
}

/// The file of a report that holds its experiment, and what it says.
fn told(folder: &Path) -> Result<(PathBuf, Told), VerifyError> {
    let files = ["evidence.json", "metrics.json"].map(|name| folder.join(name));
    let Some(path) = files.into_iter().find(|path| path.is_file()) else {
        return Err(VerifyError::NoReport(folder.to_owned()));
    };
    let wrong = |why: String| VerifyError::Unreadable { path: path.clone(), why };
    let text = std::fs::read(&path).map_err(|error| wrong(error.to_string()))?;
    let told: Told = serde_json::from_slice(&text)
        .map_err(|error| wrong(format!("it does not hold an experiment: {error}")))?;
    crate::report::check_format(told.format).map_err(|error| wrong(error.to_string()))?;
    Ok((path, told))
}

/// The reports in a folder: its folders that hold one, in order.
pub fn reports_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_one =
        |path: &PathBuf| ["metrics.json", "evidence.json"].iter().any(|n| path.join(n).is_file());
    let mut reports: Vec<_> = entries.map(|entry| entry.path()).filter(is_one).collect();
    reports.sort();
    reports
}
