//! The system's signals as messages, so that a run is halted and its folder let go before the program ends.

use std::io;
#[cfg(unix)]
use std::{process, thread, time::Duration};

#[cfg(unix)]
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGTERM, SIGTSTP};

#[cfg(unix)]
use super::session::give_back;

/// What the system tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notice {
    /// End, in order, and with this signal's exit code.
    Quit(Signal),
    /// Stop, as Ctrl-Z does.
    Suspend,
    /// The program was continued; the terminal may have been used by others.
    Continued,
}

/// A signal that asks a program to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// SIGINT.
    Interrupt,
    /// SIGTERM.
    Terminate,
    /// SIGHUP: the terminal is gone.
    HangUp,
}

impl Signal {
    /// The exit code that tells of it: 128 and its number.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::HangUp => 129,
            Self::Interrupt => 130,
            Self::Terminate => 143,
        }
    }
}

/// How long the program has to end in order.
#[cfg(unix)]
const PATIENCE: Duration = Duration::from_secs(2);

/// Tells of signals from a thread of its own. A second request to end, or two seconds without an end, give the terminal
/// back and end the program with the signal's exit code.
///
/// # Errors
/// If the system refuses.
#[cfg(unix)]
pub fn watch(tell: impl Fn(Notice) + Send + 'static) -> io::Result<()> {
    let all = [SIGINT, SIGTERM, SIGHUP, SIGTSTP, SIGCONT];
    let mut signals = signal_hook::iterator::Signals::new(all)?;
    thread::spawn(move || {
        let mut asked = false;
        for number in signals.forever() {
            match notice(number) {
                // A terminal that closes hangs up more than once: from the system, and from its shell.
                Notice::Quit(signal) if asked && signal != Signal::HangUp => end(signal),
                Notice::Quit(signal) => {
                    tell(Notice::Quit(signal));
                    if !asked {
                        thread::spawn(move || {
                            thread::sleep(PATIENCE);
                            end(signal)
                        });
                    }
                    asked = true;
                }
                other => tell(other),
            }
        }
    });
    Ok(())
}

/// Elsewhere Ctrl-C is a key like any other.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub fn watch(_: impl Fn(Notice) + Send + 'static) -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
fn notice(number: i32) -> Notice {
    match number {
        SIGINT => Notice::Quit(Signal::Interrupt),
        SIGHUP => Notice::Quit(Signal::HangUp),
        SIGTSTP => Notice::Suspend,
        SIGCONT => Notice::Continued,
        _ => Notice::Quit(Signal::Terminate),
    }
}

#[cfg(unix)]
fn end(signal: Signal) -> ! {
    give_back();
    process::exit(signal.exit_code().into())
}

/// Whether somebody could continue us: not if we lead a session, as under `xterm -e`. Known on Linux; taken for granted
/// on other systems with signals.
pub(super) fn can_stop() -> bool {
    cfg!(unix) && !std::fs::read_to_string("/proc/self/stat").is_ok_and(|stat| leads(&stat))
}

/// Whether the process of this line of /proc leads its session: its number is the session's (proc(5): fields 1 and 6;
/// the name in field 2 stands in brackets and may hold anything).
fn leads(stat: &str) -> bool {
    let number = stat.split(' ').next();
    let after_name = stat.rsplit_once(") ").map_or("", |(_, rest)| rest);
    number.is_some() && after_name.split(' ').nth(3) == number
}

/// Stops the program; comes back when it is continued.
#[cfg(unix)]
pub(super) fn stop() -> io::Result<()> {
    signal_hook::low_level::emulate_default_handler(SIGTSTP)
}

#[cfg(not(unix))]
pub(super) fn stop() -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_those_of_shells() {
        let codes = [Signal::HangUp, Signal::Interrupt, Signal::Terminate].map(Signal::exit_code);
        assert_eq!(codes, [129, 130, 143]);
    }

    #[test]
    fn a_leader_is_known_by_its_session() {
        assert!(leads("77 (a) b (c) S 1 77 77 34816 77 4194304"));
        assert!(!leads("78 (wrinkle) S 77 78 77 34816 78 4194304"));
        assert!(!leads(""));
    }
}
