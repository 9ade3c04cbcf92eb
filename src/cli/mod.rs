//! Floor 8: the command line. One file a subcommand; they own arguments, standard output and exit codes.

mod args;
mod compare;

mod exit;
mod experiments;
mod list;
mod progress;
mod render;
mod run;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use args::{Args, Command};
pub use exit::Exit;

/// Reads the arguments and does what they ask.
pub fn main() -> ExitCode {
    let args = Args::parse();
    let Some(command) = args.command else {
        // Nothing was asked: help, as a first answer.
        let help = Args::command().render_help();
        anstream::print!("{}", help.ansi());
        return Exit::Done.into();
    };
    let exit = match command {
        Command::Run(args) => run::run(&args),
        Command::List(args) => list::list(&args),
        Command::Render(args) => render::render(&args),
        Command::Compare(args) => compare::compare(&args),
    };
    match exit {
        Ok(exit) => exit.into(),
        Err(failure) => {
            anstream::eprintln!("{failure}");
            failure.exit.into()
        }
    }
}
