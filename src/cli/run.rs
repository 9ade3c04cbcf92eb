//! `wrinkle run`: experiments to reports.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Exit;
use super::args::RunArgs;
use super::exit::{Failure, tell};
use super::experiments;
use super::progress::Bar;
use crate::experiment::lock::{Lock, LockError};
use crate::experiment::results::Results;
use crate::experiment::runner::{self, Outcome, RunError, Watcher};
use crate::experiment::spec::Spec;
use crate::report;
use crate::scene::Halt;

/// Runs the experiments asked for, one after the other.
pub(super) fn run(args: &RunArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let specs = specs(&args.experiments)?;
    if let Some(threads) = args.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
        pool.build_global().map_err(Failure::failed)?;
    }
    let halt = halt_on_interrupt();
    let mut summaries = Vec::new();
    for spec in &specs {
        let folder = args.out.join(&spec.name);
        let Some(summary) = run_one(spec, &folder, &halt)? else {
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

/// The specs of these names; every one is read before any work is done.
fn specs(names: &[String]) -> Result<Vec<Spec>, Failure> {
    let (mut specs, mut wrong): (Vec<Spec>, Vec<Failure>) = (Vec::new(), Vec::new());
    for name in names {
        match experiments::load(name) {
            Ok(spec) if specs.iter().any(|other| other.name == spec.name) => {
                let message =
                    format!("two experiments are named `{}`: run one at a time", spec.name);
                wrong.push(Failure::wrong(message));
            }
            Ok(spec) => specs.push(spec),
            Err(failure) => wrong.push(failure),
        }
    }
    match wrong.pop() {
        None => Ok(specs),
        Some(last) => {
            for failure in &wrong {
                failure.tell();
            }
            Err(last)
        }
    }
}

/// Runs one experiment and writes its report; None if it was halted.
fn run_one(spec: &Spec, folder: &Path, halt: &Halt) -> Result<Option<Summary>, Failure> {
    let _lock = Lock::take(folder).map_err(|error| match error {
        LockError::Taken { .. } => Failure::failed(error),
        LockError::Store(_) => Failure::failed(format!("{error}; choose a folder with --out")),
    })?;
    let bar = Arc::new(Bar::new(&spec.name));
    let watching = Arc::clone(&bar);
    let watcher: Watcher = Arc::new(move |event| watching.take(&event));
    let outcome = runner::run(spec, folder, halt, &watcher);
    bar.clear();
    match outcome {
        Ok(Outcome::Finished(found)) => {
            let (results, costs) = *found;
            let files = report::write(&results, &costs, folder).map_err(Failure::failed)?;
            Ok(Some(Summary::new(&results, costs.total_secs, folder, files)))
        }
        Ok(Outcome::Halted) => Ok(None),
        Err(error @ RunError::Texture { .. }) => Err(Failure::wrong(error)),
        Err(error @ RunError::Store(_)) => Err(Failure::failed(format!(
            "{error}; what was finished is kept: once there is room, the same command goes on"
        ))),
    }
}

/// What a finished run tells on standard output.
struct Summary {
    name: String,
    answer: Vec<String>,
    folder: PathBuf,
    files: Vec<PathBuf>,
    scenes: usize,
    trials: usize,
    secs: f64,
}

impl Summary {
    fn new(results: &Results, secs: f64, folder: &Path, files: Vec<PathBuf>) -> Self {
        Self {
            name: results.name.clone(),
            answer: report::lead(results),
            folder: folder.to_owned(),
            files,
            scenes: results.scenes.len(),
            trials: results.scenes.iter().map(|scene| scene.trials.len()).sum(),
            secs,
        }
    }

    fn print(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let bold = anstyle::Style::new().bold();
        writeln!(
            out,
            "{bold}{}{bold:#}: {} of {} in {:.1} s",
            self.name,
            counted(self.trials, "trial"),
            counted(self.scenes, "scene"),
            self.secs
        )?;
        for sentence in &self.answer {
            writeln!(out, "  {sentence}")?;
        }
        let report = self.files.iter().find(|file| file.ends_with("report.html"));
        writeln!(out, "Report: {}", report.unwrap_or(&self.folder).display())
    }

    fn json(&self) -> serde_json::Value {
        serde_json::json!({
            "name": self.name,
            "answer": self.answer,
            "folder": self.folder,
            "files": self.files,
            "scenes": self.scenes,
            "trials": self.trials,
            "seconds": self.secs,
        })
    }
}

/// "1 scene", "2 scenes".
fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
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
