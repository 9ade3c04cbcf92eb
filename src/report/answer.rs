//! The answer in words, computed from the results: which filter to choose where, what that is worth
//! in unfiltered samples, and how often each came closest.

use super::caveats::{breakdowns, certainty, refusals, unhelped};
use super::choice::advice;
use super::contest::{Comparison, Contest, median, rank, unique};
use super::phrase::{count, list};
use crate::experiment::results::MethodInfo;
use crate::metric::Equivalent;

/// The answer to a comparison: sentences, each a short paragraph.
pub fn answer(comparison: &Comparison) -> Vec<String> {
    if comparison.contests().next().is_none() {
        let nothing = "Nothing was measured: no scene of this experiment has a scored trial.";
        return std::iter::once(nothing.to_owned()).chain(refusals(comparison.results)).collect();
    }
    let mut sentences = advice(comparison);
    sentences.extend(unhelped(comparison));
    sentences.push(winner(comparison));
    sentences.push(field(comparison));
    sentences.extend(breakdowns(comparison));
    sentences.extend(refusals(comparison.results));
    sentences.push(certainty(comparison));
    sentences
}

/// What was compared.
fn field(comparison: &Comparison) -> String {
    let contests: Vec<_> = comparison.contests().collect();
    let methods = unique(contests.iter().flat_map(|c| &c.standings).map(|s| &s.method.label)).len();
    let textures = unique(contests.iter().map(|c| &c.scene.key.texture)).len();
    let scales = comparison.settings.iter().map(|s| s.scales.len()).max().unwrap_or(0);
    let settings = match comparison.settings.len() {
        0 | 1 => String::new(),
        more => format!(" in {}", count(more, "setting")),
    };
    format!(
        "Compared: {} at {} a pixel, each against a converged reference, in {}: {} at {}{settings}.",
        count(methods, "method"),
        count(comparison.spp as usize, "sample"),
        count(contests.len(), "scene"),
        count(textures, "texture"),
        count(scales, "scale"),
    )
}

/// How often a method came closest: alone, and together with others.
pub fn wins(comparison: &Comparison, label: &str) -> (usize, usize) {
    let mut wins = (0, 0);
    for contest in comparison.contests() {
        let winners: Vec<_> = contest.winners().map(|s| s.method.label.as_str()).collect();
        match winners.contains(&label) {
            true if winners.len() == 1 => wins.0 += 1,
            true => wins.1 += 1,
            false => {}
        }
    }
    wins
}

/// The methods that were among the closest most often; of those, the ones most often alone. Ties count
/// in full: two forms of one method tie wherever they are best, and neither is worse for it.
fn leaders<'a>(comparison: &Comparison<'a>) -> Vec<&'a MethodInfo> {
    let rank = |method: &&MethodInfo| {
        let (alone, shared) = wins(comparison, &method.label);
        (alone + shared, alone)
    };
    let methods = || comparison.results.methods.iter();
    let most = methods().map(|m| rank(&m)).max().unwrap_or_default();
    methods().filter(|m| rank(m) == most).collect()
}

fn winner(comparison: &Comparison) -> String {
    let leaders = leaders(comparison);
    let names: Vec<_> = leaders.iter().map(|m| m.label.as_str()).collect();
    let (alone, shared) = wins(comparison, names[0]);
    let scenes = count(comparison.contests().count(), "scene");
    let each = if names.len() > 1 { "each " } else { "" };
    let often = match (alone, shared) {
        (0, shared) => format!("{each}among the closest in {shared} of {scenes}"),
        (alone, 0) => format!("{each}alone in {alone} of {scenes}"),
        (alone, shared) => {
            format!("{each}alone in {alone} of {scenes}, and level with another in {shared} more")
        }
    };
    format!("Scene by scene, {} came closest most often: {often}.", list(&names))
}

/// Error of `other` over error of `label`, in every scene that has both.
pub fn gains(comparison: &Comparison, label: &str, other: &str) -> Vec<f64> {
    let pair = |c: &Contest| Some((c.standing(label)?.error, c.standing(other)?.error));
    let pairs = comparison.contests().filter_map(pair).filter(|(own, _)| *own > 0.0);
    pairs.map(|(own, other)| other / own).collect()
}

/// Median, least and greatest worth of a method in unfiltered samples.
pub fn worth(comparison: &Comparison, label: &str) -> Option<(Equivalent, Equivalent, Equivalent)> {
    let found: Vec<Equivalent> =
        comparison.contests().filter_map(|c| c.standing(label)?.worth).collect();
    let by_rank = |a: &&Equivalent, b: &&Equivalent| rank(**a).total_cmp(&rank(**b));
    let (low, high) = (*found.iter().min_by(by_rank)?, *found.iter().max_by(by_rank)?);
    Some((median(found, rank)?, low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::results::Results;
    use crate::report::fixture;

    fn lead(results: &Results) -> String {
        answer(&Comparison::of(results)).join("\n")
    }

    #[test]
    fn the_answer_begins_with_what_to_choose() {
        let text = lead(&fixture::results());
        assert!(text.starts_with("Choose fournier at "), "{text}");
        assert!(text.contains("which unfiltered reaches with"), "{text}");
        assert!(text.contains("fournier came closest most often"), "{text}");
    }

    #[test]
    fn a_tie_is_called_a_tie() {
        let mut results = fixture::results();
        for scene in &mut results.scenes {
            scene.reference.gap = 100.0;
        }
        let text = lead(&results);
        assert!(text.contains("among the closest in 12 of 12 scenes"), "{text}");
        assert!(text.contains("12 of 12 scenes ended in a tie. No tie is for want"), "{text}");
        for scene in &mut results.scenes {
            scene.reference.gap = 0.01;
            scene.reference.variance.fill(1e4);
        }
        let text = lead(&results);
        assert!(
            text.contains("12 of 12 scenes ended in a tie. In 12 of them the samples"),
            "{text}"
        );
    }

    #[test]
    fn nothing_measured_says_so() {
        let mut results = fixture::results();
        results.scenes.iter_mut().for_each(|s| s.trials.clear());
        assert!(lead(&results).starts_with("Nothing was measured"));
        results.scenes.clear();
        assert!(lead(&results).starts_with("Nothing was measured"));
    }

    #[test]
    fn a_perfect_method_divides_by_nothing() {
        let mut results = fixture::results();
        for trial in results.scenes.iter_mut().flat_map(|s| &mut s.trials) {
            trial.scores[0].value = 0.0;
        }
        let text = lead(&results);
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}
