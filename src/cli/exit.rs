//! Exit codes, and messages that end the program.

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

/// How the program ends. These numbers are part of its interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: done.
    Done,
    /// 1: it ran, and something differs or failed.
    Differs,
    /// 2: the request is wrong.
    Wrong,
    /// 130: interrupted; the same command goes on where it stopped.
    Interrupted,
    /// A signal's exit code, 128 and its number: what was finished is kept.
    Signal(u8),
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::Differs => 1,
            Exit::Wrong => 2,
            Exit::Interrupted => 130,
            Exit::Signal(code) => code,
        })
    }
}

/// A message for standard error, and the exit that follows.
#[derive(Debug)]
pub(super) struct Failure {
    message: Option<String>,
    exit: Exit,
}

impl Failure {
    /// The request is wrong: what, and what to do.
    pub fn wrong(error: impl Display) -> Self {
        Self { message: Some(error.to_string()), exit: Exit::Wrong }
    }

    /// The request is right but could not be carried out.
    pub fn failed(error: impl Display) -> Self {
        Self { message: Some(error.to_string()), exit: Exit::Differs }
    }

    /// Says what went wrong; the exit that follows.
    pub fn tell(&self) -> Exit {
        if let Some(message) = &self.message {
            let red = anstyle::Style::new().fg_color(Some(anstyle::AnsiColor::Red.into())).bold();
            tell(format_args!("{red}error:{red:#} {message}"));
        }
        self.exit
    }
}

impl From<io::Error> for Failure {
    /// Standard output does not take what is written to it. Whoever closed it early, such as `head`,
    /// has read enough: that is no failure.
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self { message: None, exit: Exit::Done },
            _ => Self::failed(format!("cannot write to standard output: {error}")),
        }
    }
}

/// Writes a line to standard error. If even that cannot be written, there is nobody left to tell.
pub(super) fn tell(message: impl Display) {
    let _ = writeln!(anstream::stderr(), "{message}");
}
