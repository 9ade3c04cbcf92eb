//! The pane's threads: one runs experiments, one reads files.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use super::board::Board;
use super::told::{End, Order, Told};
use crate::evidence::Evidence;
use crate::experiment::runner::{RunEvent, Watcher};
use crate::experiment::spec::Experiment;
use crate::job::{self, Control, Done, Ending, Found};
use crate::report;
use crate::tui::library::{self, Kind};

/// Hears what the threads tell, from any of them.
pub type Tell = Arc<dyn Fn(Told) + Send + Sync>;

/// Progress within a piece of work is told at most this often.
const EVERY: Duration = Duration::from_millis(100);

/// The pane's threads.
pub struct Worker {
    runs: mpsc::Sender<Order>,
    files: mpsc::Sender<Order>,
    /// Of the run under way.
    control: Arc<Mutex<Control>>,
    busy: Arc<Busy>,
}

/// Whether a run is under way.
#[derive(Default)]
struct Busy {
    is: Mutex<bool>,
    over: Condvar,
}

impl Busy {
    fn set(&self, is: bool) {
        *lock(&self.is) = is;
        self.over.notify_all();
    }
}

/// What a thread that panicked held is taken as it is: a control is only ever replaced.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Worker {
    /// Starts the threads; reports are in the folder `out`.
    pub fn start(tell: Tell, out: PathBuf) -> Self {
        let (control, busy) = (Arc::new(Mutex::new(Control::default())), Arc::new(Busy::default()));
        let (runs, to_run) = mpsc::channel();
        let (files, to_read) = mpsc::channel();
        let (told, folder) = (Arc::clone(&tell), out.clone());
        let (at, working) = (Arc::clone(&control), Arc::clone(&busy));
        thread::spawn(move || run_all(&to_run, &folder, (&at, &working), &told));
        thread::spawn(move || read_all(&to_read, &out, &tell));
        Self { runs, files, control, busy }
    }

    /// Passes an order on; never waits.
    pub fn order(&self, order: Order) {
        // A thread that is gone has panicked, and the program is ending.
        match order {
            Order::Run { .. } => {
                // Told to halt before it began, a run would not notice: its control is made here.
                *lock(&self.control) = Control::default();
                self.busy.set(true);
                drop(self.runs.send(order));
            }
            Order::Pause(true) => lock(&self.control).gate.shut(),
            Order::Pause(false) => lock(&self.control).gate.open(),
            Order::Cancel => lock(&self.control).halt(),
            Order::List | Order::Look(_) | Order::Read { .. } => drop(self.files.send(order)),
        }
    }

    /// Halts the run under way and waits until it has let go of its folder, for so long at most.
    pub fn end(&self, patience: Duration) {
        lock(&self.control).halt();
        drop(self.busy.over.wait_timeout_while(lock(&self.busy.is), patience, |is| *is));
    }
}

/// Runs one experiment after the other.
fn run_all(
    orders: &mpsc::Receiver<Order>,
    out: &Path,
    (control, busy): (&Mutex<Control>, &Busy),
    tell: &Tell,
) {
    while let Ok(order) = orders.recv() {
        let Order::Run { number, path, name } = order else { continue };
        let control = lock(control).clone();
        let (folder, telling) = (out.join(&name), Arc::clone(tell));
        // On a thread of its own: if it panics, that is told as any other failure.
        let run = thread::spawn(move || run(number, &path, &folder, &control, &telling));
        let end = run.join().unwrap_or_else(|_| {
            End::Failed("the run ended in a fault of the program: please report it".to_owned())
        });
        busy.set(false);
        tell(Told::Ended(number, end));
    }
}

fn run(number: u64, path: &Path, folder: &Path, control: &Control, tell: &Tell) -> End {
    let experiment = match Experiment::load(path, &crate::evidence::keys()) {
        Ok(experiment) => experiment,
        Err(error) => return End::Failed(error.to_string()),
    };
    let watch = throttled(number, tell);
    match job::run(&experiment, folder, control, &watch) {
        Ok(Ending::Done(done)) => match folder.parent().map(report::write_index) {
            Some(Err(error)) => End::Failed(error.to_string()),
            _ => done_words(done),
        },
        Ok(Ending::Halted) => End::Halted,
        Err(error) => End::Failed(error.to_string()),
    }
}

fn done_words(done: Done) -> End {
    let lead = match &done.found {
        Found::Sweep(results) => report::lead(results),
        Found::Paper(evidence) => vec![tally(evidence)],
    };
    let report = done.files.iter().find(|file| file.ends_with("report.html")).cloned();
    End::Done { report, secs: done.secs, lead }
}

fn tally(evidence: &Evidence) -> String {
    let [reproduced, differ, not_applicable] = evidence.tally();
    format!(
        "{reproduced} reproduced, {differ} differ, {not_applicable} cannot be held against anything."
    )
}

/// Tells what a run tells, but of progress within a piece only now and then.
fn throttled(number: u64, tell: &Tell) -> Watcher {
    let (tell, last) = (Arc::clone(tell), Mutex::new(None::<Instant>));
    Arc::new(move |event| {
        if matches!(event, RunEvent::Partly { .. }) {
            let mut last = lock(&last);
            if last.is_some_and(|last| last.elapsed() < EVERY) {
                return;
            }
            *last = Some(Instant::now());
        }
        tell(Told::Ran(number, event));
    })
}

/// Reads what is on disk. Of figures only those last asked for are read.
fn read_all(orders: &mpsc::Receiver<Order>, out: &Path, tell: &Tell) {
    while let Ok(order) = orders.recv() {
        let (mut list, mut figures) = (false, None);
        for order in std::iter::once(order).chain(std::iter::from_fn(|| orders.try_recv().ok())) {
            match order {
                Order::Read { name } => figures = Some(name),
                Order::Look(path) => tell(Told::Looked(Box::new(library::listed(&path)))),
                _ => list = true,
            }
        }
        if list {
            tell(Told::Listed(library::experiments(), library::reports(out)));
        }
        if let Some(name) = figures {
            tell(read(name, out));
        }
    }
}

/// The figures of a report: a paper's are those of its parts.
fn read(name: String, out: &Path) -> Told {
    let (mut board, mut problems) = (Board::default(), Vec::new());
    let folder = out.join(&name);
    if folder.is_dir() {
        let opened = library::open(&folder);
        if opened.kind == Kind::Paper {
            problems.extend(opened.problems);
            for (part, path) in library::parts(&folder) {
                let opened = library::open(&path);
                board.add_rows(Some(&part), &opened.methods, &opened.rows);
                problems.extend(opened.problems.into_iter().map(|text| format!("{part}: {text}")));
            }
        } else {
            board.add_rows(None, &opened.methods, &opened.rows);
            problems.extend(opened.problems);
        }
    }
    Told::Read { name, board: Box::new(board), problems }
}
