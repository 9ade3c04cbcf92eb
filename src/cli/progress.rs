//! Progress on standard error: a bar with the time left where someone watches, nothing elsewhere.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::experiment::runner::RunEvent;
use crate::method::Progress;

/// Times a second that what is shown is drawn anew.
const HERTZ: u8 = 10;
/// Bar positions are whole: one is this many units of work.
const STEP: f64 = 1000.0;

/// The bar of one experiment.
pub(super) struct Bar {
    bar: ProgressBar,
    state: Mutex<State>,
}

/// Where the run is.
#[derive(Default)]
struct State {
    scenes: usize,
    scene: usize,
    /// Work in all, without what earlier runs had done: that says nothing of this run's speed.
    all: f64,
    done: f64,
    /// Work of the piece under way.
    piece: f64,
}

impl Bar {
    /// A bar for the experiment `name`; drawn only if standard error is a terminal.
    pub fn new(name: &str) -> Self {
        let template = "{prefix:.bold} {wide_bar} {percent:>3} %, {eta} left\n  {msg}";
        let bar = drawn(template);
        bar.set_prefix(name.to_owned());
        Self { bar, state: Mutex::default() }
    }

    /// Takes in what the run tells.
    pub fn take(&self, event: &RunEvent) {
        // A thread that panicked while it held the state has done no harm: it is numbers.
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        match event {
            RunEvent::Started { work, scenes, .. } => {
                (state.scenes, state.all) = (*scenes, *work);
                self.show(&state, 0.0);
            }
            RunEvent::Scene { .. } => state.scene += 1,
            RunEvent::Working { what, work } => {
                state.piece = *work;
                let message = format!("{} of {}: {what}", state.scene, state.scenes);
                self.bar.set_message(message);
            }
            RunEvent::Partly { part } => self.show(&state, part * state.piece),
            RunEvent::Advanced { work, kept } => {
                if *kept {
                    state.all -= work;
                } else {
                    state.done += work;
                }
                self.show(&state, 0.0);
            }
            RunEvent::Noted { text } => self.bar.suspend(|| anstream::eprintln!("note: {text}")),
            RunEvent::Reporting => self.bar.set_message("writing the report"),
            RunEvent::Scored { .. }
            | RunEvent::Converged { .. }
            | RunEvent::Probed { .. }
            | RunEvent::Flickered { .. }
            | RunEvent::Paused
            | RunEvent::Resumed => {}
        }
    }

    fn show(&self, state: &State, partly: f64) {
        self.bar.set_length((state.all / STEP) as u64);
        self.bar.set_position(((state.done + partly) / STEP) as u64);
    }

    /// Removes the bar.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

/// What is shown while one image is made; gone when dropped.
pub(super) struct Spinner {
    bar: ProgressBar,
    method: String,
}

impl Spinner {
    /// A spinner for an image through this method; drawn only if standard error is a terminal.
    pub fn new(method: &str) -> Self {
        let bar = drawn("{spinner} {msg}");
        bar.set_message("rendering");
        Self { bar, method: method.to_owned() }
    }

    /// So many frames of all are rendered.
    pub fn rendered(&self, frames: u32, all: u32) {
        if self.bar.length() != Some(all.into()) {
            let style = ProgressStyle::with_template("{spinner} frame {pos} of {len}, {eta} left");
            self.bar.set_style(style.expect("a constant template"));
            self.bar.set_length(all.into());
            self.bar.reset_eta();
        }
        self.bar.set_position(frames.into());
    }
}

impl Progress for Spinner {
    fn advance(&self, done: usize, total: usize) {
        let message = if done < total {
            format!("prefiltering for {}: {} %", self.method, 100 * done / total)
        } else {
            "rendering".to_owned()
        };
        self.bar.set_message(message);
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A bar of this template that ticks by itself; hidden where standard error is no terminal.
fn drawn(template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::stderr_with_hz(HERTZ));
    let style = ProgressStyle::with_template(template).expect("a constant template");
    bar.set_style(style.progress_chars("━╸─"));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
