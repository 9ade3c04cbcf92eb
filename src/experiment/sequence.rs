//! Sequences: the frames of a scene in motion, and how methods flicker over them.

use std::ops::Range;

use super::results::SceneResult;
use crate::metric::Flicker;
use crate::render::Film;

/// A scene of the sweep in motion.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Its slug: what its frames' slugs begin with.
    pub slug: String,
    /// Places of its frames in [`super::results::Results::scenes`], in the order of time.
    pub frames: Range<usize>,
    /// Mean over consecutive frames and pixels of |change| of the reference, as it was measured.
    pub truth_change: f64,
    /// By how much at most the reference's noise makes that too large; see [`crate::metric::Flicker::noise`].
    pub noise: f64,
    /// One a method and sample count that all frames have, in the order of the first frame's trials.
    pub trials: Vec<TrialFlicker>,
}

/// How a method at one sample count flickers over a sequence.
#[derive(Clone, Debug)]
pub struct TrialFlicker {
    /// The method's label.
    pub method: String,
    /// Samples a pixel.
    pub spp: u32,
    /// Its changes beside the reference's.
    pub flicker: Flicker,
}

impl Sequence {
    /// Its frames among the scenes of the results.
    pub fn of<'a>(&self, scenes: &'a [SceneResult]) -> &'a [SceneResult] {
        &scenes[self.frames.clone()]
    }

    /// How a method at a sample count flickers.
    pub fn flicker(&self, method: &str, spp: u32) -> Option<&Flicker> {
        let found = self.trials.iter().find(|t| t.method == method && t.spp == spp);
        found.map(|trial| &trial.flicker)
    }
}

/// The films of a method at a sample count, frame by frame; `None` if some frame has none.
pub fn films<'a>(frames: &'a [SceneResult], method: &str, spp: u32) -> Option<Vec<&'a Film>> {
    let of = |frame: &'a SceneResult| {
        let trial = frame.trials.iter().find(|t| t.method == method && t.spp == spp)?;
        Some(&*trial.film)
    };
    frames.iter().map(of).collect()
}

/// The films of the reference, frame by frame.
pub fn references(frames: &[SceneResult]) -> Vec<&Film> {
    frames.iter().map(|frame| &*frame.reference.film).collect()
}

/// The sequences among scenes, whose frames follow one another; none of still scenes.
pub fn sequences(scenes: &[SceneResult]) -> Vec<Sequence> {
    let mut start = 0;
    let mut found = Vec::new();
    for frames in scenes.chunk_by(|a, b| a.sequence == b.sequence) {
        let range = start..start + frames.len();
        start = range.end;
        if frames[0].key.frame.is_some() {
            found.extend(sequence(frames, range));
        }
    }
    found
}

/// `None` of fewer than two frames.
fn sequence(frames: &[SceneResult], range: Range<usize>) -> Option<Sequence> {
    let references = references(frames);
    let errors: Vec<f64> = frames.iter().map(|frame| frame.reference.mean_error).collect();
    let truth = Flicker::of(&references, &references, &errors)?;
    let trials = frames[0].trials.iter().filter_map(|trial| {
        let films = films(frames, &trial.method, trial.spp)?;
        let flicker = Flicker::of(&films, &references, &errors)?;
        Some(TrialFlicker { method: trial.method.clone(), spp: trial.spp, flicker })
    });
    Some(Sequence {
        slug: frames[0].sequence.clone(),
        frames: range,
        truth_change: truth.mean.truth_change,
        noise: truth.noise,
        trials: trials.collect(),
    })
}
