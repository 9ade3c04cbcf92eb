//! What a run tells as it goes.

use std::sync::Arc;

/// What a run tells those who watch it.
#[derive(Clone, Debug, PartialEq)]
pub enum RunEvent {
    /// The run starts.
    Started {
        /// Units of work in all.
        work: f64,
        /// Scenes in all.
        scenes: usize,
        /// Trials in all.
        trials: usize,
    },
    /// A scene's turn has come.
    Scene {
        /// Its slug.
        slug: String,
    },
    /// Something is being worked at, in a few words.
    Working {
        /// What.
        what: String,
        /// Its units of work.
        work: f64,
    },
    /// The piece being worked at is partly done.
    Partly {
        /// Which part of it, from 0 to 1.
        part: f64,
    },
    /// A piece of work is done.
    Advanced {
        /// Its units of work.
        work: f64,
        /// Whether an earlier run had done it.
        kept: bool,
    },
    /// Something worth knowing that stops nothing, in a sentence.
    Noted {
        /// The sentence.
        text: String,
    },
    /// A trial has its scores.
    Scored {
        /// The scene's slug.
        scene: String,
        /// The method's label.
        method: String,
        /// Samples a pixel.
        spp: u32,
        /// The root mean square error.
        rmse: f64,
    },
}

/// Hears of a run's events, from any thread, as they come.
pub type Watcher = Arc<dyn Fn(RunEvent) + Send + Sync>;

/// Watched by nobody.
pub fn unwatched() -> Watcher {
    Arc::new(|_| ())
}
