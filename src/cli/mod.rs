//! Floor 10: the command line. One file a subcommand; they own arguments, standard output and exit codes.

mod args;
mod bake;
mod compare;
mod draft;
mod exit;
mod fit;
mod list;
mod lobes;
mod merge;
mod output;
mod progress;
mod render;
mod run;
mod summary;
mod surface;
mod tui;
mod verify;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use args::{Args, Command};
pub use exit::Exit;
use exit::Failure;

/// Reads the arguments and does what they ask.
pub fn main() -> ExitCode {
    let args = Args::parse();
    // Colour only where it is wanted: a terminal, and no NO_COLOR.
    let mut out = anstream::stdout().lock();
    let exit = obey(args, &mut out).and_then(|exit| Ok(out.flush().map(|()| exit)?));
    exit.unwrap_or_else(|failure| failure.tell()).into()
}

/// Does what the arguments ask; what they ask for goes to `out`, all else to standard error.
fn obey(args: Args, out: &mut dyn Write) -> Result<Exit, Failure> {
    match args.command {
        Some(Command::Run(args)) => run::run(&args, out),
        Some(Command::Merge(args)) => merge::merge(&args, out),
        Some(Command::Verify(args)) => verify::verify(&args, out),
        Some(Command::Tui(args)) => tui::tui(&args),
        Some(Command::List(args)) => list::list(&args, out),
        Some(Command::Render(args)) => render::render(&args, out),
        Some(Command::Lobes(args)) => lobes::lobes(&args, out),
        Some(Command::Compare(args)) => compare::compare(&args, out),
        Some(Command::Fit(args)) => fit::fit(&args, out),
        Some(Command::Bake(args)) => bake::bake(&args, out),
        None if tui::is_possible() => obey(Args::parse_from(["wrinkle", "tui"]), out),
        None => {
            // Nothing was asked, and nobody can watch: help, as a first answer.
            write!(out, "{}", Args::command().render_help().ansi())?;
            Ok(Exit::Done)
        }
    }
}
