//! `wrinkle run`: experiments to reports.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use serde_json::json;

use super::Exit;
use super::args::RunArgs;
use super::exit::{Failure, tell};
use super::progress::Bar;
use super::summary::{Summary, counted};
use crate::experiment::lock::LockError;
use crate::experiment::runner::{RunError, Watcher};
use crate::experiment::share::Share;
use crate::experiment::spec::Experiment;
use crate::job::{self, Control, Ending, JobError};
use crate::report;
use crate::scene::Halt;

/// Runs the experiments asked for, one after the other.
pub(super) fn run(args: &RunArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let experiments = read(&args.experiments)?;
    use_threads(args.threads)?;
    let control = Control::from(halt_on_interrupt());
    if let Some(share) = args.shard {
        return run_shards(args, share, &experiments, &control, out);
    }
    let mut summaries = Vec::new();
    for experiment in &experiments {
        let folder = args.out.join(experiment.name());
        let Some(summary) = run_one(experiment, &folder, &control)? else {
            return Ok(interrupted(&folder));
        };
        report::write_index(&args.out).map_err(Failure::failed)?;
        if !args.json {
            summary.print(out)?;
        }
        summaries.push(summary);
    }
    if args.json {
        let all: Vec<_> = summaries.iter().map(Summary::json).collect();
        writeln!(out, "{:#}", json!({ "experiments": all }))?;
    }
    Ok(Exit::Done)
}

/// Runs a share of each of the experiments, and says what to do next.
fn run_shards(
    args: &RunArgs,
    share: Share,
    experiments: &[Experiment],
    control: &Control,
    out: &mut dyn Write,
) -> Result<Exit, Failure> {
    let mut done = Vec::new();
    for (experiment, named) in experiments.iter().zip(&args.experiments) {
        let folder = args.out.join(experiment.name());
        let name = format!("{} {share}", experiment.name());
        let run = |watch: &Watcher| job::run_shard(experiment, share, &folder, control, watch);
        let Some(pieces) = watched(&name, run).map_err(failed)? else {
            return Ok(interrupted(&folder));
        };
        if !args.json {
            let bold = anstyle::Style::new().bold();
            let to = args.out.display();
            writeln!(out, "{bold}{name}{bold:#}: done, {}", counted(pieces, "scene"))?;
            writeln!(out, "  when all {} shards are: wrinkle merge {named} --out {to}", share.of)?;
        }
        let folder = job::shard_folder(&folder, share);
        let name = experiment.name();
        done.push(
            json!({ "name": name, "shard": share.to_string(), "folder": folder, "scenes": pieces }),
        );
    }
    if args.json {
        writeln!(out, "{:#}", json!({ "shards": done }))?;
    }
    Ok(Exit::Done)
}

/// Says that a run was interrupted.
pub(super) fn interrupted(folder: &Path) -> Exit {
    let folder = folder.display();
    tell(format_args!(
        "interrupted: what was finished is kept in {folder}; the same command goes on"
    ));
    Exit::Interrupted
}

/// Makes all work use this many threads.
pub(super) fn use_threads(threads: Option<u16>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
    pool.build_global().map_err(Failure::failed)
}

/// Does `work`, with a bar called `name` for the one who waits.
pub(super) fn watched<T>(name: &str, work: impl FnOnce(&Watcher) -> T) -> T {
    let bar = Arc::new(Bar::new(name));
    let watching = Arc::clone(&bar);
    let watcher: Watcher = Arc::new(move |event| watching.take(&event));
    let done = work(&watcher);
    bar.clear();
    done
}

/// The experiments of these names; every one is read before any work is done.
fn read(names: &[String]) -> Result<Vec<Experiment>, Failure> {
    let (mut read, mut wrong): (Vec<Experiment>, Vec<Failure>) = (Vec::new(), Vec::new());
    for name in names {
        match job::load(name) {
            Ok(new) if read.iter().any(|other| other.name() == new.name()) => {
                let message =
                    format!("two experiments are named `{}`: run one at a time", new.name());
                wrong.push(Failure::wrong(message));
            }
            Ok(new) => read.push(new),
            Err(error) => wrong.push(Failure::wrong(error)),
        }
    }
    match wrong.pop() {
        None => Ok(read),
        Some(last) => {
            for failure in &wrong {
                failure.tell();
            }
            Err(last)
        }
    }
}

/// Runs one experiment and writes its report; None if it was halted.
fn run_one(
    experiment: &Experiment,
    folder: &Path,
    control: &Control,
) -> Result<Option<Summary>, Failure> {
    let ending = watched(experiment.name(), |watch| job::run(experiment, folder, control, watch));
    Ok(match ending.map_err(failed)? {
        Ending::Done(done) => Some(Summary::of(done, folder)),
        Ending::Halted => None,
    })
}

/// A job's error, with what to do and the exit that follows.
pub(super) fn failed(error: JobError) -> Failure {
    match error {
        JobError::Folder(LockError::Store(_)) => {
            Failure::failed(format!("{error}; choose a folder with --out"))
        }
        JobError::Folder(LockError::Taken { .. }) | JobError::Report(_) => Failure::failed(error),
        JobError::Run(RunError::Store(_)) => Failure::failed(format!(
            "{error}; what was finished is kept: once there is room, the same command goes on"
        )),
        JobError::Run(_) => Failure::wrong(error),
    }
}

/// A halt that Ctrl-C (or SIGTERM) sets; the second one ends the program at once.
pub(super) fn halt_on_interrupt() -> Halt {
    let halt = Halt(Arc::new(AtomicBool::new(false)));
    let flag = Arc::clone(&halt.0);
    // Without a handler (there is one already) the program ends at once, and still loses nothing.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    halt
}
