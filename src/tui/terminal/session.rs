//! The terminal taken and given back.

use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Stdout, Write};
use std::panic;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Once, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

use crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, disable_raw_mode, enable_raw_mode,
};
use ratatui::backend::CrosstermBackend;
use ratatui::layout::Rect;
use ratatui::{Frame, Terminal, TerminalOptions, Viewport};

use super::input::Input;
use super::{sequences, signals};

/// The terminal that frames are drawn on.
pub type Tty = Terminal<CrosstermBackend<BufWriter<Stdout>>>;

/// How the terminal is taken.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The window's title while it is ours.
    pub title: String,
    /// Whether the mouse is reported to us; selecting text then takes the Shift key.
    pub mouse: bool,
}

/// Why the terminal cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// There is none.
    #[error("{0} is not a terminal: the runner needs one. `wrinkle run` works without.")]
    NotATerminal(&'static str),
    /// It cannot place a cursor.
    #[error(
        "TERM is `dumb`: the runner needs a terminal that can place its cursor. `wrinkle run` works without."
    )]
    Dumb,
    /// The system refused.
    #[error("cannot set up the terminal: {0}")]
    Terminal(#[from] io::Error),
}

/// The terminal, ours until this is dropped: raw mode, the alternate screen, no cursor.
#[derive(Debug)]
pub struct Session {
    options: Options,
}

/// Whether the terminal is taken just now.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// Whether a frame is being written just now.
static DRAWING: AtomicBool = AtomicBool::new(false);

/// How long a frame may take to be written before the terminal is given back over it: a terminal that takes nothing any
/// more must not keep the program.
const PATIENCE: Duration = Duration::from_millis(200);

/// Standard output without its lock: whoever gives the terminal back must not wait for a thread that is writing.
static OUTPUT: OnceLock<File> = OnceLock::new();

impl Session {
    /// Takes the terminal. From here on a panic on any thread gives it back before it tells, and ends the program.
    ///
    /// # Errors
    /// [`SessionError`] if there is no terminal or it cannot be set up; it is then as it was.
    pub fn start(options: Options) -> Result<Self, SessionError> {
        if !io::stdin().is_terminal() {
            return Err(SessionError::NotATerminal("standard input"));
        }
        if !io::stdout().is_terminal() {
            return Err(SessionError::NotATerminal("standard output"));
        }
        if std::env::var_os("TERM").is_some_and(|term| term == "dumb") {
            return Err(SessionError::Dumb);
        }
        if OUTPUT.get().is_none() {
            let _ = OUTPUT.set(unlocked()?);
        }
        // NO_COLOR is heard where colours are chosen; kitty's pictures are told from each other by colours.
        crossterm::style::force_color_output(true);
        give_back_on_panic();
        let session = Self { options };
        session.take()?;
        Ok(session)
    }

    /// What frames are drawn on. It has no size until it is given one ([`Terminal::resize`]): what terminals tell is to
    /// be looked at first.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn terminal(&self) -> io::Result<Tty> {
        // A frame of half blocks in all colours takes up to a megabyte.
        let backend = CrosstermBackend::new(BufWriter::with_capacity(1 << 16, io::stdout()));
        let viewport = Viewport::Fixed(Rect::ZERO);
        Terminal::with_options(backend, TerminalOptions { viewport })
    }

    /// Takes the terminal again, whatever was done to it: after the program was stopped and continued. Draw everything
    /// anew afterwards ([`Terminal::clear`]).
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn retake(&self) -> io::Result<()> {
        // Raw mode is left first: crossterm would take it for given.
        disable_raw_mode()?;
        self.take()
    }

    /// Gives the terminal back, stops the program as Ctrl-Z does in a shell, and takes it again when it is continued.
    /// False if it cannot be stopped: nobody is there to continue it.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn suspend(&self, input: &Input) -> io::Result<bool> {
        if !signals::can_stop() {
            return Ok(false);
        }
        input.pause();
        give_back();
        let stopped = signals::stop();
        let taken = self.retake();
        input.go_on();
        stopped.and(taken).map(|()| true)
    }

    fn take(&self) -> io::Result<()> {
        enable_raw_mode()?;
        TAKEN.store(true, Ordering::SeqCst);
        let text = sequences::take(&self.options.title, self.options.mouse);
        send(&text).inspect_err(|_| {
            give_back();
        })
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        give_back();
    }
}

/// Gives the terminal back if it is taken, and tells whether it was. May be called from any thread, any number of times.
pub fn give_back() -> bool {
    if !TAKEN.swap(false, Ordering::SeqCst) {
        return false;
    }
    // A frame that is being written would take the cursor away again. No other begins: it would not find the terminal
    // taken.
    let start = Instant::now();
    while DRAWING.load(Ordering::SeqCst) && start.elapsed() < PATIENCE {
        thread::sleep(Duration::from_millis(1));
    }
    // If the terminal is gone there is nothing to give back.
    let _ = send(&sequences::give());
    let _ = disable_raw_mode();
    true
}

/// Draws a frame that the terminal shows at once, where it can: no half-drawn pictures. Nothing is drawn once the
/// terminal has been given back.
///
/// # Errors
/// If the terminal is gone.
pub fn draw(terminal: &mut Tty, render: impl FnOnce(&mut Frame)) -> io::Result<()> {
    DRAWING.store(true, Ordering::SeqCst);
    let drawn = match TAKEN.load(Ordering::SeqCst) {
        true => write_frame(terminal, render),
        false => Ok(()),
    };
    DRAWING.store(false, Ordering::SeqCst);
    drawn
}

fn write_frame(terminal: &mut Tty, render: impl FnOnce(&mut Frame)) -> io::Result<()> {
    crossterm::queue!(terminal.backend_mut(), BeginSynchronizedUpdate)?;
    terminal.draw(render)?;
    crossterm::execute!(terminal.backend_mut(), EndSynchronizedUpdate)
}

fn send(text: &str) -> io::Result<()> {
    match OUTPUT.get() {
        Some(mut output) => output.write_all(text.as_bytes()).and_then(|()| output.flush()),
        None => Ok(()),
    }
}

#[cfg(unix)]
fn unlocked() -> io::Result<File> {
    use std::os::fd::AsFd;
    io::stdout().as_fd().try_clone_to_owned().map(File::from)
}

#[cfg(windows)]
fn unlocked() -> io::Result<File> {
    use std::os::windows::io::AsHandle;
    io::stdout().as_handle().try_clone_to_owned().map(File::from)
}

/// A panic's message would be lost on the alternate screen, and a thread's panic would leave the program without it.
fn give_back_on_panic() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let main = thread::current().id();
        let tell = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let was_taken = give_back();
            tell(info);
            if was_taken && thread::current().id() != main {
                process::exit(101);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_terminal_there_is_one_clear_sentence() {
        let told = SessionError::NotATerminal("standard input").to_string();
        assert_eq!(
            told,
            "standard input is not a terminal: the runner needs one. `wrinkle run` works without."
        );
    }

    #[test]
    fn nothing_taken_is_not_given_back() {
        assert!(!give_back());
    }
}
