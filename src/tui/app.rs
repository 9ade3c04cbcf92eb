//! The program around the model: the terminal, the threads, and the loop that takes messages and draws frames.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use crossterm::event::Event;
use ratatui::layout::Rect;

use super::message::{Effect, Message};
use super::model::{Model, Pane};
use super::picture::{Colours, Encoded, Encoder, Gallery, Pictures, probe};
use super::terminal::{self, Input, Notice, Session, SessionError, Signal, Tty};
use super::{experiments, lab, results, update, view};
use crate::job;

/// How often the time comes in.
const TICK: Duration = Duration::from_millis(250);
/// Least time between frames that no key asks for: findings that come fast are drawn together.
const FRAME: Duration = Duration::from_millis(33);
/// Messages taken in before a frame is drawn: findings that come fast do not keep the screen waiting.
const BATCH: usize = 64;
/// How long a run may take to halt when the program ends. What it has finished is kept whatever happens.
const PATIENCE: Duration = Duration::from_millis(1500);
/// Columns and rows of a terminal that does not tell, and the most that is believed.
const USUAL: [u16; 2] = [80, 24];
const MOST: [u16; 2] = [1000, 500];

/// What the runner is asked for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// An experiment to choose, or a normal map to open in the lab.
    pub what: Option<String>,
    /// The folder of reports.
    pub reports: std::path::PathBuf,
    /// How pictures are drawn.
    pub pictures: Pictures,
    /// Which colours are used.
    pub colours: Colours,
    /// Whether the mouse is left to the terminal.
    pub no_mouse: bool,
}

/// Why the runner ended, if not because it was asked to.
#[derive(Debug, thiserror::Error)]
pub enum TuiError {
    /// The terminal cannot be had.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// The terminal is gone.
    #[error("the terminal is gone: {0}")]
    Gone(#[from] io::Error),
}

/// What the loop hears.
enum Heard {
    Message(Message),
    Encoded(Encoded),
    Notice(Notice),
    Lost(io::Error),
}

impl Heard {
    /// Whether somebody did something and waits to see it.
    fn is_input(&self) -> bool {
        matches!(self, Self::Message(Message::Key(_) | Message::Mouse(_) | Message::Resized(..)))
    }
}

/// Opens the runner, and comes back when it is left: with the signal that asked for that, if one did.
///
/// # Errors
/// If there is no terminal, or it is lost.
pub fn run(options: &Options) -> Result<Option<Signal>, TuiError> {
    let mouse = !options.no_mouse;
    let session = Session::start(terminal::Options { title: "wrinkle".into(), mouse })?;
    let screen = probe(options.pictures, options.colours);
    let (sender, heard) = mpsc::channel();
    let tell = sender.clone();
    terminal::watch(move |notice| drop(tell.send(Heard::Notice(notice))))?;
    let tell = sender.clone();
    let input = Input::start(move |event| {
        let heard = match event {
            Ok(event) => message(event).map(Heard::Message),
            Err(error) => Some(Heard::Lost(error)),
        };
        if let Some(heard) = heard {
            // Nobody listens any more when the program ends.
            let _ = tell.send(heard);
        }
    });
    let tell = sender.clone();
    let encoder = Encoder::start(screen, move |encoded| drop(tell.send(Heard::Encoded(encoded))));
    let tty = session.terminal()?;
    let mut model = Model::new(USUAL, screen, SystemTime::now());
    model.mouse = mouse;
    let mut app = App {
        gallery: Gallery::new(screen),
        threads: Threads::start(&sender, options),
        session,
        input,
        encoder,
        tty,
        model,
    };
    app.begin(options);
    let ended = app.attend(&heard);
    app.threads.experiments.end(PATIENCE);
    app.farewell();
    ended
}

/// A terminal's event as a message.
fn message(event: Event) -> Option<Message> {
    match event {
        Event::Key(key) => Some(Message::Key(key)),
        Event::Mouse(mouse) => Some(Message::Mouse(mouse)),
        Event::Resize(columns, rows) => Some(Message::Resized(columns, rows)),
        _ => None,
    }
}

/// The threads that work.
struct Threads {
    experiments: experiments::Worker,
    lab: lab::Worker,
    results: results::Worker,
    sender: Sender<Heard>,
}

impl Threads {
    fn start(sender: &Sender<Heard>, options: &Options) -> Self {
        fn telling<T: 'static>(
            sender: &Sender<Heard>,
            of: fn(T) -> Message,
        ) -> Arc<dyn Fn(T) + Send + Sync> {
            let sender = sender.clone();
            // Nobody listens any more when the program ends.
            Arc::new(move |told| drop(sender.send(Heard::Message(of(told)))))
        }
        let reports = options.reports.clone();
        Self {
            experiments: experiments::Worker::start(
                telling(sender, Message::Experiments),
                reports.clone(),
            ),
            lab: lab::Worker::start(telling(sender, Message::Lab)),
            results: results::Worker::start(telling(sender, Message::Results), reports),
            sender: sender.clone(),
        }
    }

    /// Opens a file in the program that the desktop has for it.
    fn open(&self, path: std::path::PathBuf) {
        let sender = self.sender.clone();
        thread::spawn(move || {
            let shown = path.display();
            let message = match open::that_detached(&path) {
                Ok(()) => Message::Note(format!("opened {shown}")),
                Err(error) => Message::Problem(format!("cannot open {shown}: {error}")),
            };
            drop(sender.send(Heard::Message(message)));
        });
    }
}

/// Everything there is one of.
struct App {
    model: Model,
    gallery: Gallery,
    encoder: Encoder,
    threads: Threads,
    input: Input,
    tty: Tty,
    session: Session,
}

impl App {
    /// Begins as asked: the experiments are listed, a map is opened.
    fn begin(&mut self, options: &Options) {
        self.fit();
        self.perform(vec![Effect::Experiments(experiments::Order::List)]);
        if let Some(what) = &options.what {
            if job::is_image(std::path::Path::new(what)) {
                self.model.pane = Pane::Lab;
                let effects = lab::open(&mut self.model, what);
                self.perform(effects);
            } else {
                self.model.experiments.prefer(what);
            }
        }
    }

    /// Takes messages and draws frames until it is time to go. What a key does is drawn at once, all else soon.
    fn attend(&mut self, heard: &Receiver<Heard>) -> Result<Option<Signal>, TuiError> {
        let (mut next_tick, mut next_frame) = (Instant::now(), Instant::now());
        let mut fresh = true;
        loop {
            let now = Instant::now();
            if now >= next_tick {
                next_tick = now + TICK;
                update(&mut self.model, Message::Tick(SystemTime::now()));
                fresh = true;
            }
            if fresh && now >= next_frame {
                self.draw()?;
                next_frame = Instant::now() + FRAME;
                fresh = false;
            }
            let until = if fresh { next_frame.min(next_tick) } else { next_tick };
            let mut waiting = heard.recv_timeout(until.saturating_duration_since(Instant::now()));
            for _ in 0..BATCH {
                match waiting {
                    Ok(one) => {
                        fresh = true;
                        if one.is_input() {
                            next_frame = now;
                        }
                        if let Some(end) = self.hear(one)? {
                            return Ok(end);
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => break,
                    Err(RecvTimeoutError::Disconnected) => return Ok(None),
                }
                waiting = heard.recv_timeout(Duration::ZERO);
            }
        }
    }

    /// Takes one thing in; tells if that ends the program.
    fn hear(&mut self, heard: Heard) -> Result<Option<Option<Signal>>, TuiError> {
        match heard {
            Heard::Message(message) => {
                let effects = update(&mut self.model, message);
                return Ok(self.perform(effects));
            }
            Heard::Encoded(encoded) => self.gallery.hang(encoded),
            Heard::Notice(Notice::Quit(signal)) => return Ok(Some(Some(signal))),
            Heard::Notice(Notice::Suspend) => drop(self.perform(vec![Effect::Suspend])),
            Heard::Notice(Notice::Continued) => {
                self.session.retake()?;
                self.clear();
            }
            Heard::Lost(error) => return Err(error.into()),
        }
        Ok(None)
    }

    /// Does what is to be done; tells if that ends the program.
    fn perform(&mut self, effects: Vec<Effect>) -> Option<Option<Signal>> {
        for effect in effects {
            match effect {
                Effect::Quit(signal) => return Some(signal),
                Effect::Suspend => self.suspend(),
                Effect::Clear => self.clear(),
                Effect::Mouse(ours) => self.take_mouse(ours),
                Effect::Open(path) => self.threads.open(path),
                Effect::Experiments(order) => self.threads.experiments.order(order),
                Effect::Lab(order) => self.threads.lab.order(order),
                Effect::Results(order) => self.threads.results.order(order),
            }
        }
        None
    }

    fn draw(&mut self) -> io::Result<()> {
        let (model, gallery) = (&self.model, &self.gallery);
        terminal::draw(&mut self.tty, |frame| view::draw(model, gallery, frame))?;
        self.gallery.take_wishes().into_iter().for_each(|wish| self.encoder.request(wish));
        Ok(())
    }

    fn suspend(&mut self) {
        self.say_farewell();
        match self.session.suspend(&self.input) {
            Ok(true) => {}
            Ok(false) => {
                self.model.say("there is no shell to come back from: not suspended", false)
            }
            Err(error) => self.model.say(format!("cannot suspend: {error}"), true),
        }
        self.clear();
    }

    /// Draws everything anew, on a terminal whose size and pictures are no longer known.
    fn clear(&mut self) {
        self.fit();
        self.gallery.forget();
        // A terminal that is gone is told of by the next frame.
        let _ = self.tty.clear();
    }

    /// Fits the frame to the terminal, as far as it can be believed.
    fn fit(&mut self) {
        let told = crossterm::terminal::size().unwrap_or((0, 0));
        let (size, doubt) = believed(told);
        self.model.size = size;
        if let Some(doubt) = doubt {
            self.model.say(doubt, true);
        }
        let _ = self.tty.resize(Rect::new(0, 0, size[0], size[1]));
    }

    fn take_mouse(&mut self, ours: bool) {
        use crossterm::event::{DisableMouseCapture, EnableMouseCapture};
        let done = match ours {
            true => crossterm::execute!(io::stdout(), EnableMouseCapture),
            false => crossterm::execute!(io::stdout(), DisableMouseCapture),
        };
        if let Err(error) = done {
            self.model.say(format!("the mouse: {error}"), true);
        }
    }

    fn say_farewell(&self) {
        let mut out = io::stdout();
        let _ = out.write_all(self.gallery.farewell().as_bytes()).and_then(|()| out.flush());
    }

    fn farewell(self) {
        self.say_farewell();
    }
}

/// The size to draw at, and what is to be said if it is not the one the terminal told.
fn believed((columns, rows): (u16, u16)) -> ([u16; 2], Option<String>) {
    let size = match [columns, rows] {
        told if told.contains(&0) => USUAL,
        [columns, rows] => [columns.min(MOST[0]), rows.min(MOST[1])],
    };
    let doubt = (size != [columns, rows]).then(|| {
        let [width, height] = size;
        format!("the terminal says it is {columns} × {rows}: drawing {width} × {height}")
    });
    (size, doubt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_believed_within_reason() {
        assert_eq!(believed((120, 40)), ([120, 40], None));
        for told in [(0, 0), (80, 0), (65535, 65535)] {
            let (size, doubt) = believed(told);
            assert!(size[0] >= 80 && size[0] <= 1000, "{size:?}");
            assert!(doubt.unwrap().contains(&told.0.to_string()));
        }
    }
}
