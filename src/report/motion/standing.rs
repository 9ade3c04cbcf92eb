//! Who moves most like the truth: sequences arranged for comparison.

use crate::experiment::results::{MethodInfo, Results, SceneResult};
use crate::experiment::sequence::Sequence;
use crate::metric::{Equivalent, Flicker, equivalent_samples};
use crate::report::contest::{BRUTE_FORCE, DECIDES};

/// One method over one sequence, at the fewest samples a pixel that the experiment used.
pub struct Standing<'a> {
    /// The method.
    pub method: &'a MethodInfo,
    /// Its changes.
    pub flicker: &'a Flicker,
    /// Its error's flicker; `None` where the reference may be still.
    pub wrong: Option<f64>,
    /// Unfiltered samples a pixel whose error flickers as little; `None` without a brute-force curve.
    pub worth: Option<Equivalent>,
    /// RMSE of every frame; NaN for one without a finite score.
    pub errors: Vec<f64>,
    /// Whether nothing moves more like the truth, by more than the reference's noise could explain.
    pub best: bool,
}

impl Standing<'_> {
    /// The mean RMSE over frames.
    pub fn error(&self) -> f64 {
        self.errors.iter().sum::<f64>() / self.errors.len() as f64
    }
}

/// All methods over one sequence.
pub struct Race<'a> {
    /// The sequence.
    pub sequence: &'a Sequence,
    /// Its frames.
    pub frames: &'a [SceneResult],
    /// Who was measured in every frame, in the order of the spec.
    pub standings: Vec<Standing<'a>>,
}

impl<'a> Race<'a> {
    /// Every sequence at `spp` samples a pixel.
    pub fn all(results: &'a Results, spp: u32) -> Vec<Self> {
        results.sequences.iter().map(|sequence| Self::of(results, sequence, spp)).collect()
    }

    fn of(results: &'a Results, sequence: &'a Sequence, spp: u32) -> Self {
        let frames = sequence.of(&results.scenes);
        let curve = brute_force_curve(results, sequence);
        let measured = results.methods.iter().filter_map(|method| {
            let flicker = sequence.flicker(&method.label, spp)?;
            let wrong = flicker.error_ratio().filter(|ratio| ratio.is_finite());
            Some(Standing {
                method,
                flicker,
                wrong,
                worth: wrong.and_then(|wrong| equivalent_samples(&curve, wrong)),
                errors: errors(frames, &method.label, spp),
                best: false,
            })
        });
        let mut standings: Vec<_> = measured.collect();
        let least = standings.iter().filter_map(|s| s.wrong).fold(f64::INFINITY, f64::min);
        let tied = sequence.noise / sequence.truth_change;
        for standing in &mut standings {
            let gap = standing.wrong.map(|wrong| wrong - least);
            standing.best = gap.is_some_and(|gap| gap == 0.0 || gap < tied);
        }
        Self { sequence, frames, standings }
    }

    /// Whether the reference may be still, so that nothing can be said of flicker.
    pub fn is_still(&self) -> bool {
        self.sequence.truth_change <= self.sequence.noise
    }

    /// The methods that move most like the truth: one, or all that tie, from the least flicker of their error.
    pub fn winners(&self) -> Vec<&Standing<'a>> {
        let mut best: Vec<_> = self.standings.iter().filter(|s| s.best).collect();
        best.sort_by(|a, b| a.wrong.unwrap_or(f64::NAN).total_cmp(&b.wrong.unwrap_or(f64::NAN)));
        best
    }

    /// The methods by the flicker of their image, from the least to the greatest.
    pub fn by_flicker(&self) -> Vec<(f64, &Standing<'a>)> {
        let ratio = |s: &'_ Standing<'a>| s.flicker.ratio().filter(|ratio| ratio.is_finite());
        let mut all: Vec<_> = self.standings.iter().filter_map(|s| Some((ratio(s)?, s))).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }
}

/// (samples a pixel, flicker of the error) of brute force, in rising order.
fn brute_force_curve(results: &Results, sequence: &Sequence) -> Vec<(u32, f64)> {
    let brute = results.methods.iter().find(|method| method.name == BRUTE_FORCE);
    let of = |label: &str| {
        let trials = sequence.trials.iter().filter(move |t| t.method == label);
        let mut curve: Vec<_> =
            trials.filter_map(|t| Some((t.spp, t.flicker.error_ratio()?))).collect();
        curve.sort_by_key(|&(spp, _)| spp);
        curve
    };
    brute.map_or_else(Vec::new, |brute| of(&brute.label))
}

/// A method's RMSE, frame by frame.
fn errors(frames: &[SceneResult], label: &str, spp: u32) -> Vec<f64> {
    let of = |frame: &SceneResult| {
        let trial = frame.trials.iter().find(|t| t.method == label && t.spp == spp);
        trial.and_then(|trial| trial.score(DECIDES)).unwrap_or(f64::NAN)
    };
    frames.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn noise_makes_ties() {
        let mut results = fixture::moving();
        let alone = Race::all(&results, 1).remove(0);
        assert!((1..alone.standings.len()).contains(&alone.winners().len()));
        assert!(!alone.is_still() && alone.standings[0].worth.is_some());
        results.sequences[0].noise = 0.9 * results.sequences[0].truth_change;
        assert!(Race::all(&results, 1)[0].winners().len() > 1);
    }

    #[test]
    fn beside_a_still_reference_nobody_stands() {
        let mut results = fixture::moving();
        let still = results.scenes[0].reference.film.clone();
        results.scenes.iter_mut().for_each(|scene| scene.reference.film = still.clone());
        results.sequences = crate::experiment::sequence::sequences(&results.scenes);
        let race = Race::all(&results, 1).remove(0);
        assert!(race.is_still() && race.winners().is_empty() && race.by_flicker().is_empty());
        assert!(!race.standings.is_empty());
    }
}
