//! `wrinkle run`: experiments to reports.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Exit;
use super::args::RunArgs;
use super::exit::{Failure, tell};
use super::progress::Bar;
use super::summary::Summary;
use crate::experiment::lock::LockError;
use crate::experiment::runner::{RunError, Watcher};
use crate::experiment::spec::Experiment;
use crate::job::{self, Control, Ending, JobError};
use crate::scene::Halt;

/// Runs the experiments asked for, one after the other.
pub(super) fn run(args: &RunArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let experiments = read(&args.experiments)?;
    if let Some(threads) = args.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
        pool.build_global().map_err(Failure::failed)?;
    }
    let control = Control::from(halt_on_interrupt());
    let mut summaries = Vec::new();
    for experiment in &experiments {
        let folder = args.out.join(experiment.name());
        let Some(summary) = run_one(experiment, &folder, &control)? else {
            tell(format_args!(
                "interrupted: what was finished is kept in {}; the same command goes on",
                folder.display()
            ));
            return Ok(Exit::Interrupted);
        };
        if !args.json {
            summary.print(out)?;
        }
        summaries.push(summary);
    }
    if args.json {
        let all: Vec<_> = summaries.iter().map(Summary::json).collect();
        writeln!(out, "{:#}", serde_json::json!({ "experiments": all }))?;
    }
    Ok(Exit::Done)
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
    let bar = Arc::new(Bar::new(experiment.name()));
    let watching = Arc::clone(&bar);
    let watcher: Watcher = Arc::new(move |event| watching.take(&event));
    let ending = job::run(experiment, folder, control, &watcher);
    bar.clear();
    Ok(match ending.map_err(failed)? {
        Ending::Done(done) => Some(Summary::of(done, folder)),
        Ending::Halted => None,
    })
}

fn failed(error: JobError) -> Failure {
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
