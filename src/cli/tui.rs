//! `wrinkle tui`, and `wrinkle` alone on a terminal: the terminal runner.

use std::io::IsTerminal;
use std::path::Path;

use super::Exit;
use super::args::TuiArgs;
use super::exit::Failure;
use crate::job;
use crate::tui::{self, Options};

/// Whether somebody could watch: both ends are a terminal that can place a cursor.
pub(super) fn is_possible() -> bool {
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    std::io::stdin().is_terminal() && std::io::stdout().is_terminal() && !dumb
}

/// Opens the runner. What cannot be opened is told before the terminal is taken.
pub(super) fn tui(args: &TuiArgs) -> Result<Exit, Failure> {
    if let Some(what) = &args.what {
        check(what)?;
    }
    // As many threads as cores if none are given; the keys go before all of them.
    let threads = args.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.start_handler(|_| tui::terminal::give_way()).build_global().map_err(Failure::failed)?;
    let options = Options {
        what: args.what.clone(),
        reports: args.out.clone(),
        pictures: args.pictures,
        colours: args.colour,
        no_mouse: args.no_mouse,
    };
    let ended = tui::run(&options).map_err(Failure::failed)?;
    Ok(ended.map_or(Exit::Done, |signal| Exit::Signal(signal.exit_code())))
}

/// Whether an image file, or an experiment, is there to be opened.
fn check(what: &str) -> Result<(), Failure> {
    let path = Path::new(what);
    if job::is_image(path) {
        return match path.is_file() {
            true => Ok(()),
            false => Err(Failure::wrong(format!("there is no file {}", path.display()))),
        };
    }
    job::load(what).map(|_| ()).map_err(Failure::wrong)
}
