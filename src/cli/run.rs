//! `wrinkle run`: experiments to reports.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Exit;
use super::args::RunArgs;
use super::exit::{Failure, tell};
use super::experiments;
use super::progress::Bar;
use super::summary::Summary;
use crate::evidence::{Findings, Gathered, gather};
use crate::experiment::lock::{Lock, LockError};
use crate::experiment::runner::{self, Outcome, RunError, Watcher};
use crate::experiment::spec::{Experiment, PaperSpec, Spec};
use crate::report;
use crate::scene::Halt;

/// Runs the experiments asked for, one after the other.
pub(super) fn run(args: &RunArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let experiments = read(&args.experiments)?;
    if let Some(threads) = args.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
        pool.build_global().map_err(Failure::failed)?;
    }
    let halt = halt_on_interrupt();
    let mut summaries = Vec::new();
    for experiment in &experiments {
        let folder = args.out.join(experiment.name());
        let Some(summary) = run_one(experiment, &folder, &halt)? else {
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
        match experiments::load(name) {
            Ok(new) if read.iter().any(|other| other.name() == new.name()) => {
                let message =
                    format!("two experiments are named `{}`: run one at a time", new.name());
                wrong.push(Failure::wrong(message));
            }
            Ok(new) => read.push(new),
            Err(failure) => wrong.push(failure),
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
    halt: &Halt,
) -> Result<Option<Summary>, Failure> {
    let _lock = Lock::take(folder).map_err(|error| match error {
        LockError::Taken { .. } => Failure::failed(error),
        LockError::Store(_) => Failure::failed(format!("{error}; choose a folder with --out")),
    })?;
    let bar = Arc::new(Bar::new(experiment.name()));
    let watching = Arc::clone(&bar);
    let watcher: Watcher = Arc::new(move |event| watching.take(&event));
    let done = match experiment {
        Experiment::Sweep(spec) => sweep(spec, folder, halt, &watcher),
        Experiment::Paper(spec) => paper(spec, folder, halt, &watcher),
    };
    bar.clear();
    done
}

/// Runs a sweep.
fn sweep(
    spec: &Spec,
    folder: &Path,
    halt: &Halt,
    watcher: &Watcher,
) -> Result<Option<Summary>, Failure> {
    match runner::run(spec, folder, halt, watcher).map_err(failed)? {
        Outcome::Finished(found) => {
            let (results, costs) = *found;
            let files = report::write(&results, &costs, folder).map_err(Failure::failed)?;
            Ok(Some(Summary::of_sweep(&results, costs.total_secs, folder, files)))
        }
        Outcome::Halted => Ok(None),
    }
}

/// Gathers a paper's evidence; its sweeps have reports of their own in folders within.
fn paper(
    spec: &PaperSpec,
    folder: &Path,
    halt: &Halt,
    watcher: &Watcher,
) -> Result<Option<Summary>, Failure> {
    let Gathered::Finished(found) = gather(spec, folder, halt, watcher).map_err(failed)? else {
        return Ok(None);
    };
    let Findings { evidence, parts, row_secs, secs } = *found;
    let mut files =
        report::write_evidence(&evidence, &row_secs, folder).map_err(Failure::failed)?;
    for part in &parts {
        let within = folder.join(&part.results.name);
        files.extend(report::write(&part.results, &part.costs, &within).map_err(Failure::failed)?);
    }
    Ok(Some(Summary::of_evidence(&evidence, secs, folder, files)))
}

fn failed(error: RunError) -> Failure {
    match error {
        RunError::Texture { .. } | RunError::Surface(_) | RunError::Light(_) => {
            Failure::wrong(error)
        }
        RunError::Store(_) => Failure::failed(format!(
            "{error}; what was finished is kept: once there is room, the same command goes on"
        )),
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
