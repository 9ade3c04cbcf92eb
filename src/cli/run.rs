//! `wrinkle run`: experiments to reports.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Exit;
use super::args::RunArgs;
use super::exit::Failure;
use super::experiments;
use super::progress::Bar;
use crate::experiment::results::Results;
use crate::experiment::runner::{self, Outcome, RunError};
use crate::experiment::spec::Spec;
use crate::report;
use crate::scene::Halt;

/// Runs the experiments asked for, one after the other.
pub(super) fn run(args: &RunArgs) -> Result<Exit, Failure> {
    // Every spec is read before any work is done.
    let (mut specs, mut wrong) = (Vec::new(), Vec::new());
    for name in &args.experiments {
        match experiments::load(name) {
            Ok(spec) => specs.push(spec),
            Err(failure) => wrong.push(failure),
        }
    }
    if let Some(last) = wrong.pop() {
        for failure in &wrong {
            anstream::eprintln!("{failure}");
        }
        return Err(last);
    }
    if let Some(threads) = args.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
        pool.build_global().map_err(Failure::failed)?;
    }
    let halt = halt_on_interrupt();
    let mut summaries = Vec::new();
    for spec in &specs {
        let folder = args.out.join(&spec.name);
        match run_one(spec, &folder, &halt)? {
            Some(summary) => {
                if !args.json {
                    summary.print();
                }
                summaries.push(summary);
            }
            None => {
                anstream::eprintln!(
                    "interrupted: what was finished is kept in {}; the same command goes on",
                    folder.display()
                );
                return Ok(Exit::Interrupted);
            }
        }
    }
    if args.json {
        let all: Vec<_> = summaries.iter().map(Summary::json).collect();
        println!("{:#}", serde_json::json!({ "experiments": all }));
    }
    Ok(Exit::Done)
}

/// Runs one experiment and writes its report; None if it was halted.
fn run_one(spec: &Spec, folder: &Path, halt: &Halt) -> Result<Option<Summary>, Failure> {
    let mut bar = Bar::new(&spec.name);
    let outcome = runner::run(spec, folder, halt, &mut |event| bar.take(&event));
    bar.clear();
    match outcome {
        Ok(Outcome::Finished(found)) => {
            let (results, costs) = *found;
            let files = report::write(&results, &costs, folder).map_err(Failure::failed)?;
            Ok(Some(Summary::new(&results, costs.total_secs, folder, files)))
        }
        Ok(Outcome::Halted) => Ok(None),
        Err(error @ RunError::Texture { .. }) => Err(Failure::wrong(error)),
        Err(error @ RunError::Store(_)) => Err(Failure::failed(error)),
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

    fn print(&self) {
        let bold = anstyle::Style::new().bold();
        anstream::println!(
            "{bold}{}{bold:#}: {} trials of {} scenes in {:.1} s",
            self.name,
            self.trials,
            self.scenes,
            self.secs
        );
        for sentence in &self.answer {
            anstream::println!("  {sentence}");
        }
        let report = self.files.iter().find(|file| file.ends_with("report.html"));
        anstream::println!("Report: {}", report.unwrap_or(&self.folder).display());
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

/// A halt that Ctrl-C (or SIGTERM) sets; the second one ends the program at once.
fn halt_on_interrupt() -> Halt {
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
