//! Exit codes, and messages that end the program.

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
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::Differs => 1,
            Exit::Wrong => 2,
            Exit::Interrupted => 130,
        })
    }
}

/// A message for standard error, and the exit that follows.
#[derive(Debug)]
pub(super) struct Failure {
    message: String,
    pub exit: Exit,
}

impl Failure {
    /// The request is wrong: what, and what to do.
    pub fn wrong(error: impl std::fmt::Display) -> Self {
        Self { message: error.to_string(), exit: Exit::Wrong }
    }

    /// The request is right but could not be carried out.
    pub fn failed(error: impl std::fmt::Display) -> Self {
        Self { message: error.to_string(), exit: Exit::Differs }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let red = anstyle::Style::new().fg_color(Some(anstyle::AnsiColor::Red.into())).bold();
        let message = self.message.strip_prefix("error: ").unwrap_or(&self.message);
        write!(f, "{red}error:{red:#} {message}")
    }
}
