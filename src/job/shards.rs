//! Sharing an experiment: shards that are run apart, on one machine or several, and merged into the report that one
//! run would have written.

use std::path::{Path, PathBuf};

use super::{Control, Ending, JobError, run};
use crate::evidence;
use crate::experiment::lock::Lock;
use crate::experiment::manifest::{Manifest, ManifestError};
use crate::experiment::runner::{self, RunError, Watcher};
use crate::experiment::share::{SHARDS, Share};
use crate::experiment::spec::Experiment;
use crate::experiment::store::{Store, StoreError, program};

/// The folder of a share of the experiment whose results go to `folder`.
pub fn shard_folder(folder: &Path, share: Share) -> PathBuf {
    folder.join(SHARDS).join(share.slug())
}

/// Runs one share of an experiment whose results go to `folder`, in [`shard_folder`]; no report is written. How many
/// scenes and rows it has; `None` if it was halted.
///
/// # Errors
/// [`JobError`]; what was finished before is kept.
pub fn run_shard(
    experiment: &Experiment,
    share: Share,
    folder: &Path,
    control: &Control,
    watch: &Watcher,
) -> Result<Option<usize>, JobError> {
    let folder = shard_folder(folder, share);
    let _lock = Lock::take(&folder)?;
    let mut manifest = Manifest::begun(experiment, Some(share)).map_err(RunError::Store)?;
    manifest.write(&folder).map_err(RunError::Store)?;
    let watch = control.gated(watch);
    let done = match experiment {
        Experiment::Sweep(spec) => {
            let mine = share.deal(&runner::units(spec)?);
            runner::run_units(spec, &mine, &folder, &control.halt, &watch)?
        }
        Experiment::Paper(spec) => {
            evidence::gather_share(spec, share, &folder, &control.halt, &watch)?
        }
    };
    if done.is_some() {
        manifest.finished = true;
        manifest.write(&folder).map_err(RunError::Store)?;
    }
    Ok(done)
}

/// Why shards cannot be merged.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// There are none.
    #[error(
        "there are no shards of `{name}` in {}: make them with `wrinkle run {name} --shard 1/2` and so on",
        listed(.places)
    )]
    None {
        /// The experiment.
        name: String,
        /// Where they were looked for.
        places: Vec<PathBuf>,
    },
    /// One cannot be told.
    #[error("{}: {source}; run this shard again, or delete its folder", folder.display())]
    Manifest {
        /// Its folder.
        folder: PathBuf,
        /// Why.
        source: ManifestError,
    },
    /// One is of another program, or of another experiment.
    #[error(
        "{} holds {what}: all shards and the merge must be of one program and one experiment file; run this shard again, or delete its folder",
        folder.display()
    )]
    Stranger {
        /// Its folder.
        folder: PathBuf,
        /// What it is.
        what: &'static str,
    },
    /// Shards that were not finished, or never begun.
    #[error("{}", unfinished(.name, .shares))]
    Unfinished {
        /// The experiment.
        name: String,
        /// Which.
        shares: Vec<Share>,
    },
    /// All shards are finished, but something of the experiment is in none of them.
    #[error(
        "no shard has {}: was a file that the experiment reads (a map, a model) another one where the shards were run? Or records were deleted or damaged: run the shards again",
        some(.0)
    )]
    Missing(Vec<String>),
    /// The shards' results could not be put into the folder.
    #[error(transparent)]
    Job(#[from] JobError),
}

fn unfinished(name: &str, shares: &[Share]) -> String {
    let commands: Vec<_> = shares
        .iter()
        .take(MANY)
        .map(|share| format!("  wrinkle run {name} --shard {share}"))
        .collect();
    let more = shares.len().saturating_sub(MANY);
    let more = if more > 0 { format!("\n  and {more} more") } else { String::new() };
    let (shards, are) = if shares.len() == 1 { ("shard", "is") } else { ("shards", "are") };
    let count = shares.len();
    format!("{count} {shards} of `{name}` {are} not finished; run\n{}{more}", commands.join("\n"))
}

/// The most that an error lists.
const MANY: usize = 8;

fn some(names: &[String]) -> String {
    let more = names.len().saturating_sub(MANY);
    let named = names[..names.len() - more].join(", ");
    if more > 0 { format!("{named} and {more} more") } else { named }
}

fn listed(places: &[PathBuf]) -> String {
    let places: Vec<_> = places.iter().map(|place| place.display().to_string()).collect();
    places.join(", ")
}

/// A shard on disk.
struct Shard {
    folder: PathBuf,
    manifest: Manifest,
}

/// Merges the shards of an experiment that are in `places` (folders of reports, of the experiment's results, of its
/// shards, or of one) into `folder`, and writes its report there: the same bytes as of a run that was not shared,
/// but for the costs. Merging again does no harm.
///
/// # Errors
/// [`MergeError`]; nothing is written but what [`MergeError::Missing`] and [`MergeError::Job`] leave in `.state`.
pub fn merge(
    experiment: &Experiment,
    places: &[PathBuf],
    folder: &Path,
    control: &Control,
    watch: &Watcher,
) -> Result<Ending, MergeError> {
    let name = experiment.name();
    let shards = find(name, places)?;
    if shards.is_empty() {
        return Err(MergeError::None { name: name.to_owned(), places: places.to_vec() });
    }
    for shard in &shards {
        check(experiment, shard)?;
    }
    let shares = pending(&shards);
    if !shares.is_empty() {
        return Err(MergeError::Unfinished { name: name.to_owned(), shares });
    }
    {
        let _lock = Lock::take(folder).map_err(JobError::from)?;
        for shard in &shards {
            take_in(experiment, folder, &shard.folder).map_err(JobError::from)?;
        }
    }
    let missing = match experiment {
        Experiment::Sweep(spec) => runner::missing(spec, folder),
        Experiment::Paper(spec) => evidence::missing(spec, folder),
    };
    let missing = missing.map_err(JobError::from)?;
    if !missing.is_empty() {
        return Err(MergeError::Missing(missing));
    }
    Ok(run(experiment, folder, control, watch)?)
}

/// The shards of an experiment in these places, each once, in order.
fn find(name: &str, places: &[PathBuf]) -> Result<Vec<Shard>, MergeError> {
    let mut folders = Vec::new();
    for place in places {
        let around = [place.join(name).join(SHARDS), place.join(SHARDS), place.clone()];
        let within = around.iter().flat_map(|folder| folders_in(folder));
        folders.extend(within.chain([place.clone()]));
    }
    folders.sort();
    folders.dedup();
    let mut shards = Vec::new();
    for folder in folders {
        match Manifest::read(&folder) {
            Ok(manifest) if manifest.share.is_some() && manifest.experiment == name => {
                shards.push(Shard { folder, manifest });
            }
            Ok(_) | Err(ManifestError::Unreadable(_)) => {}
            Err(source) => return Err(MergeError::Manifest { folder, source }),
        }
    }
    Ok(shards)
}

fn folders_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).filter(|path| path.is_dir()).collect()
}

/// Whether a shard is of this program and this experiment.
fn check(experiment: &Experiment, shard: &Shard) -> Result<(), MergeError> {
    let ours = program().map_err(|error| JobError::from(RunError::Store(error)))?;
    let what = if shard.manifest.program != ours.to_hex().as_str() {
        "results of another build of wrinkle"
    } else if shard.manifest.spec != experiment.text() {
        "results of another version of the experiment's file"
    } else {
        return Ok(());
    };
    Err(MergeError::Stranger { folder: shard.folder.clone(), what })
}

/// Which shares are missing, of the division that the fewest are missing of.
fn pending(shards: &[Shard]) -> Vec<Share> {
    let done = |share: Share| {
        shards.iter().any(|s| s.manifest.share == Some(share) && s.manifest.finished)
    };
    let divisions = shards.iter().filter_map(|shard| shard.manifest.share).map(|share| share.of);
    let open = |of: u32| -> Vec<Share> {
        (1..=of).map(|number| Share { of, number }).filter(|&share| !done(share)).collect()
    };
    divisions.map(open).min_by_key(Vec::len).unwrap_or_default()
}

/// Takes in what a shard has kept; of a paper, part by part.
fn take_in(experiment: &Experiment, folder: &Path, shard: &Path) -> Result<(), RunError> {
    Store::take_in(folder, shard)?;
    if let Experiment::Paper(spec) = experiment {
        for part in &spec.parts {
            Store::take_in(&folder.join(&part.name), &shard.join(&part.name))?;
        }
    }
    Ok(())
}

impl From<StoreError> for JobError {
    fn from(error: StoreError) -> Self {
        Self::Run(RunError::Store(error))
    }
}
