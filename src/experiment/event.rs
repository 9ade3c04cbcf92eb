//! What a run tells as it goes.

use std::sync::Arc;

use super::results::Score;

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
        /// Its slug; of a paper's row, the row's name.
        slug: String,
        /// The part it is of, where a paper's evidence is gathered; `None` of a row there, and of a single sweep.
        part: Option<String>,
        /// Its number among all scenes (and rows) of the run, from 1.
        number: usize,
        /// How many there are.
        of: usize,
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
    /// A trial of the current scene has its scores.
    Scored {
        /// The scene's slug.
        scene: String,
        /// The method's label.
        method: String,
        /// Samples a pixel.
        spp: u32,
        /// Its scores against the reference, in the order of the metrics.
        scores: Vec<Score>,
        /// CPU nanoseconds a pixel: wall-clock time × threads ÷ pixels.
        ns_per_pixel: f64,
        /// Whether an earlier run had made it.
        kept: bool,
    },
    /// The current scene's reference has converged.
    Converged {
        /// The scene's slug.
        scene: String,
        /// Its own root mean square error, as estimated.
        rmse: f64,
    },
    /// The distributions of normals at the current scene's probes are known.
    Probed {
        /// The scene's slug.
        scene: String,
        /// By method label, the mean distance `ndf_l1` over the probes.
        distances: Vec<(String, f64)>,
    },
    /// The last frame of a sequence is done, and it is known how a trial flickers over its frames.
    Flickered {
        /// The sequence's slug.
        sequence: String,
        /// The method's label.
        method: String,
        /// Samples a pixel.
        spp: u32,
        /// The image's change over the reference's; `None` if the reference may be still.
        flicker: Option<f64>,
        /// The change of the image's error over the reference's change; `None` if the reference may be still.
        error_flicker: Option<f64>,
    },
    /// The run waits before its next piece of work until it is let go on.
    Paused,
    /// It goes on.
    Resumed,
    /// All work is done; the report is being written.
    Reporting,
}

/// Hears of a run's events, from any thread, as they come.
pub type Watcher = Arc<dyn Fn(RunEvent) + Send + Sync>;

/// Watched by nobody.
pub fn unwatched() -> Watcher {
    Arc::new(|_| ())
}
