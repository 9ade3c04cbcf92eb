//! A program run on a terminal of our own: keys go in, the screen is read, signals and sizes are as a user's would be.
//!
//! The terminal answers what programs ask terminals, as one without pictures of its own.

#![allow(dead_code)] // Each user needs a part.

use std::io::{Read, Write};
use std::path::Path;
use std::process::Command;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, ExitStatus, MasterPty, PtySize, native_pty_system};

/// How long anything may take before a test gives up. Generous: a busy machine is no failure.
const DEADLINE: Duration = Duration::from_secs(180);

/// Pixels of a character cell of this terminal.
pub const CELL: [u16; 2] = [10, 20];

/// A program and the terminal it runs on.
pub struct Pty {
    master: Box<dyn MasterPty + Send>,
    child: Box<dyn Child + Send + Sync>,
    writer: Shared<Box<dyn Write + Send>>,
    heard: Arc<Heard>,
}

type Shared<T> = Arc<Mutex<T>>;

/// What the program wrote, as a screen; told of at every change.
struct Heard {
    state: Mutex<State>,
    changed: Condvar,
}

struct State {
    parser: vt100::Parser<Answers>,
    /// All that was written, to look for what leaves no mark on the screen.
    bytes: Vec<u8>,
    ended: bool,
}

/// The answers a terminal owes: device status, attributes, cell size.
#[derive(Default)]
struct Answers(Vec<u8>);

impl vt100::Callbacks for Answers {
    fn unhandled_csi(
        &mut self,
        screen: &mut vt100::Screen,
        i1: Option<u8>,
        _: Option<u8>,
        params: &[&[u16]],
        c: char,
    ) {
        let first = params.first().and_then(|p| p.first()).copied().unwrap_or(0);
        let answer = match (i1, c, first) {
            (None, 'n', 5) => "\x1b[0n".to_owned(),
            (None, 'n', 6) => {
                let (row, column) = screen.cursor_position();
                format!("\x1b[{};{}R", row + 1, column + 1)
            }
            (None, 'c', 0) => "\x1b[?62c".to_owned(),
            (None, 't', 16) => format!("\x1b[6;{};{}t", CELL[1], CELL[0]),
            _ => return,
        };
        self.0.extend(answer.bytes());
    }
}

/// A program to start: what it is called with, and its environment, empty but for what every terminal gives.
pub fn command(
    program: impl AsRef<std::ffi::OsStr>,
    args: &[&str],
    folder: &Path,
) -> CommandBuilder {
    let mut command = CommandBuilder::new(program);
    command.args(args);
    command.cwd(folder);
    command.env_clear();
    for (name, value) in
        [("TERM", "xterm-256color"), ("COLORTERM", "truecolor"), ("LANG", "C.UTF-8")]
    {
        command.env(name, value);
    }
    command.env("HOME", folder);
    if let Some(path) = std::env::var_os("PATH") {
        command.env("PATH", path);
    }
    command
}

fn size(columns: u16, rows: u16) -> PtySize {
    let (pixel_width, pixel_height) =
        (columns.saturating_mul(CELL[0]), rows.saturating_mul(CELL[1]));
    PtySize { rows, cols: columns, pixel_width, pixel_height }
}

impl Pty {
    /// Starts a program on a terminal of `columns` by `rows`.
    pub fn start(command: CommandBuilder, [columns, rows]: [u16; 2]) -> Self {
        let pair = native_pty_system().openpty(size(columns, rows)).expect("a pseudo-terminal");
        let mut reader = pair.master.try_clone_reader().expect("its output");
        let writer = Arc::new(Mutex::new(pair.master.take_writer().expect("its input")));
        let child = pair.slave.spawn_command(command).expect("the program starts");
        let parser = vt100::Parser::new_with_callbacks(rows, columns, 0, Answers::default());
        let state = Mutex::new(State { parser, bytes: Vec::new(), ended: false });
        let heard = Arc::new(Heard { state, changed: Condvar::new() });
        let (theirs, answers) = (Arc::clone(&heard), Arc::clone(&writer));
        thread::spawn(move || {
            let mut chunk = [0; 1 << 16];
            while let Ok(n @ 1..) = reader.read(&mut chunk) {
                let answer = theirs.take(&chunk[..n]);
                if !answer.is_empty() {
                    let _ = answers.lock().unwrap().write_all(&answer);
                }
            }
            theirs.state.lock().unwrap().ended = true;
            theirs.changed.notify_all();
        });
        Self { master: pair.master, child, writer, heard }
    }

    /// Types: text as it is, escape sequences included.
    pub fn send(&self, keys: &str) {
        let mut writer = self.writer.lock().unwrap();
        writer.write_all(keys.as_bytes()).and_then(|()| writer.flush()).expect("keys are taken");
    }

    /// The screen's text, a line a row, blanks at ends cut off.
    pub fn text(&self) -> String {
        let state = self.heard.lock();
        let columns = state.parser.screen().size().1;
        let rows = state.parser.screen().rows(0, columns);
        rows.map(|row| row.trim_end().to_owned()).collect::<Vec<_>>().join("\n")
    }

    /// The screen, cells and colours and all.
    pub fn screen(&self) -> vt100::Screen {
        self.heard.lock().parser.screen().clone()
    }

    /// All bytes written so far.
    pub fn bytes(&self) -> Vec<u8> {
        self.heard.lock().bytes.clone()
    }

    /// Waits until the screen is as wished.
    ///
    /// # Panics
    /// If it is not within the deadline, showing what there was instead.
    pub fn wait(&self, what: &str, wished: impl Fn(&vt100::Screen) -> bool) {
        let unwished = |state: &mut State| !wished(state.parser.screen()) && !state.ended;
        let state = self.heard.state.lock().unwrap();
        let waited = self.heard.changed.wait_timeout_while(state, DEADLINE, unwished).unwrap();
        let met = wished(waited.0.parser.screen());
        drop(waited);
        assert!(met, "waited for {what} in vain:\n{}", self.text());
    }

    /// Waits until the screen holds a text.
    pub fn wait_for(&self, text: &str) {
        self.wait(&format!("`{text}`"), |screen| screen.contents().contains(text));
    }

    /// Waits until the screen no longer holds a text.
    pub fn wait_without(&self, text: &str) {
        self.wait(&format!("`{text}` to go"), |screen| !screen.contents().contains(text));
    }

    /// Waits until the screen has not changed for a while: an animation's end, for pictures of the screen only. Tests
    /// wait for what they want to see.
    pub fn settle(&self, quiet: Duration) {
        let end = Instant::now() + DEADLINE;
        let mut before = Vec::new();
        while Instant::now() < end {
            thread::sleep(quiet);
            let now = self.screen().contents_formatted();
            if now == before {
                return;
            }
            before = now;
        }
    }

    /// Gives the terminal another size, as a window that is dragged.
    pub fn resize(&self, columns: u16, rows: u16) {
        self.heard.lock().parser.screen_mut().set_size(rows, columns);
        self.master.resize(size(columns, rows)).expect("resized");
    }

    /// The terminal's modes (termios), to be compared.
    pub fn modes(&self) -> String {
        format!("{:?}", self.master.get_termios().expect("modes"))
    }

    /// The program's process.
    pub fn process(&self) -> u32 {
        self.child.process_id().expect("it was started")
    }

    /// Sends the program a signal by its name, such as `TERM`.
    pub fn signal(&self, name: &str) {
        signal(self.process(), name);
    }

    /// Waits for the program's end.
    ///
    /// # Panics
    /// If it does not end within the deadline.
    pub fn exit(&mut self) -> ExitStatus {
        let end = Instant::now() + DEADLINE;
        loop {
            if let Some(status) = self.child.try_wait().expect("the program's state") {
                return status;
            }
            assert!(Instant::now() < end, "the program does not end:\n{}", self.text());
            thread::sleep(Duration::from_millis(10));
        }
    }
}

impl Drop for Pty {
    /// A test that fails leaves no program behind.
    fn drop(&mut self) {
        if !matches!(self.child.try_wait(), Ok(Some(_))) {
            signal(self.process(), "KILL");
            let _ = self.child.wait();
        }
    }
}

/// Sends a process a signal by its name.
pub fn signal(process: u32, name: &str) {
    let _ = Command::new("kill").args(["-s", name, &process.to_string()]).status();
}

impl Heard {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap()
    }

    /// Draws what was written; the answers it asks for.
    fn take(&self, bytes: &[u8]) -> Vec<u8> {
        let mut state = self.lock();
        state.parser.process(bytes);
        state.bytes.extend_from_slice(bytes);
        let answers = std::mem::take(&mut state.parser.callbacks_mut().0);
        drop(state);
        self.changed.notify_all();
        answers
    }
}
