//! Progress on standard error: a bar with the time left where someone watches, nothing elsewhere.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::experiment::runner::RunEvent;

/// The bar of one experiment.
pub(super) struct Bar {
    bar: ProgressBar,
    scenes: usize,
    scene: usize,
    /// Work that earlier runs had done: it says nothing of this run's speed.
    kept: f64,
}

/// Bar positions are whole: one is this many units of work.
const STEP: f64 = 1000.0;

impl Bar {
    /// A bar for the experiment `name`; drawn only if standard error is a terminal.
    pub fn new(name: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::stderr_with_hz(10));
        let template = "{prefix:.bold} {wide_bar} {percent:>3} %, {eta} left\n  {msg}";
        let style = ProgressStyle::with_template(template).expect("a constant template");
        bar.set_style(style.progress_chars("━╸─"));
        bar.set_prefix(name.to_owned());
        bar.enable_steady_tick(std::time::Duration::from_millis(200));
        Self { bar, scenes: 0, scene: 0, kept: 0.0 }
    }

    /// Takes in what the run tells.
    pub fn take(&mut self, event: &RunEvent) {
        match event {
            RunEvent::Started { work, scenes, .. } => {
                self.scenes = *scenes;
                self.bar.set_length((work / STEP) as u64);
            }
            RunEvent::Scene { .. } => self.scene += 1,
            RunEvent::Working { what } => {
                self.bar.set_message(format!("scene {} of {}: {what}", self.scene, self.scenes));
            }
            RunEvent::Advanced { work, kept: true } => {
                // Shorten the way instead of advancing, so that the time left stays true.
                self.kept += work;
                self.bar.dec_length((work / STEP) as u64);
            }
            RunEvent::Advanced { work, kept: false } => self.bar.inc((work / STEP) as u64),
            RunEvent::Scored { .. } => {}
        }
    }

    /// Removes the bar.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
