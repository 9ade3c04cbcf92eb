//! `wrinkle merge`: shards to a report.

use std::io::Write;

use serde_json::json;

use super::Exit;
use super::args::MergeArgs;
use super::exit::Failure;
use super::run::{failed, halt_on_interrupt, interrupted, watched};
use super::summary::Summary;
use crate::job::{self, Control, Ending, MergeError};
use crate::report;

/// Puts the shards of an experiment together.
pub(super) fn merge(args: &MergeArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let experiment = job::load(&args.experiment).map_err(Failure::wrong)?;
    let folder = args.out.join(experiment.name());
    let control = Control::from(halt_on_interrupt());
    let here = [args.out.clone()];
    let places = if args.from.is_empty() { &here } else { args.from.as_slice() };
    let ending = watched(experiment.name(), |watch| {
        job::merge(&experiment, places, &folder, &control, watch)
    });
    let done = match ending {
        Ok(Ending::Done(done)) => done,
        Ok(Ending::Halted) => return Ok(interrupted(&folder)),
        Err(MergeError::Job(error)) => return Err(failed(error)),
        Err(error @ MergeError::None { .. }) => return Err(Failure::wrong(error)),
        Err(error) => return Err(Failure::failed(error)),
    };
    report::write_index(&args.out).map_err(Failure::failed)?;
    let summary = Summary::of(done, &folder);
    if args.json {
        writeln!(out, "{:#}", json!({ "experiments": [summary.json()] }))?;
    } else {
        summary.print(out)?;
    }
    Ok(Exit::Done)
}
