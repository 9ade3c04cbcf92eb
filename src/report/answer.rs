//! The answer in words, computed from the results: who came closest, where, by how much, and what
//! that is worth in unfiltered samples.

use serde::Serialize;

use super::caveats::{certainty, printed_forms, refusals};
use super::contest::{Comparison, Contest, Setting, geometric_mean, median, rank, unique};
use super::phrase::{self, count, list, range};
use super::scale::Scale;
use crate::experiment::results::MethodInfo;
use crate::metric::Equivalent;

/// What a report opens with.
#[derive(Serialize)]
pub struct Answer {
    /// Sentences about the whole experiment, each a short paragraph.
    pub lead: Vec<String>,
    /// Sentences about each setting.
    pub findings: Vec<Finding>,
}

/// What was found in one setting, scale by scale.
#[derive(Serialize)]
pub struct Finding {
    /// The setting.
    pub setting: String,
    /// A sentence a scale.
    pub sentences: Vec<String>,
}

/// The answer to a comparison.
pub fn answer(comparison: &Comparison) -> Answer {
    if comparison.contests().next().is_none() {
        let nothing = "Nothing was measured: no scene of this experiment has a scored trial.";
        let lead = std::iter::once(nothing.to_owned()).chain(refusals(comparison.results));
        return Answer { lead: lead.collect(), findings: Vec::new() };
    }
    let lead = [Some(winner(comparison)), margin(comparison)];
    let lead = lead.into_iter().flatten().chain(std::iter::once(field(comparison)));
    let lead = lead.chain(printed_forms(comparison)).chain(refusals(comparison.results));
    let findings = comparison.settings.iter().map(|setting| Finding {
        setting: setting.name.clone(),
        sentences: setting.scales.iter().filter_map(|s| at_scale(setting, s)).collect(),
    });
    Answer {
        lead: lead.chain(certainty(comparison)).collect(),
        findings: findings.filter(|f| !f.sentences.is_empty()).collect(),
    }
}

/// What was compared.
fn field(comparison: &Comparison) -> String {
    let contests: Vec<_> = comparison.contests().collect();
    let methods = unique(contests.iter().flat_map(|c| &c.standings).map(|s| &s.method.label)).len();
    let textures = unique(contests.iter().map(|c| &c.scene.key.texture)).len();
    let scales = comparison.settings.iter().map(|s| s.scales.len()).max().unwrap_or(0);
    format!(
        "Compared: {}, {} a pixel, each against a converged reference, in {}: {} at {}.",
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

/// The methods that came closest most often, ties counted after wins.
fn leaders<'a>(comparison: &Comparison<'a>) -> Vec<&'a MethodInfo> {
    let methods = || comparison.results.methods.iter();
    let most = methods().map(|m| wins(comparison, &m.label)).max().unwrap_or_default();
    methods().filter(|m| wins(comparison, &m.label) == most).collect()
}

fn winner(comparison: &Comparison) -> String {
    let leaders = leaders(comparison);
    let names: Vec<_> = leaders.iter().map(|m| m.label.as_str()).collect();
    let (alone, shared) = wins(comparison, names[0]);
    let scenes = comparison.contests().count();
    let each = if names.len() > 1 { "each " } else { "" };
    let mut text = format!("{} came closest most often: ", list(&names));
    text += &match (alone, shared) {
        (0, shared) => format!("{each}among the closest in {shared} of {}", count(scenes, "scene")),
        (alone, 0) => format!("{each}alone in {alone} of {}", count(scenes, "scene")),
        (alone, shared) => format!(
            "{each}alone in {alone} of {}, and level with another in {shared} more",
            count(scenes, "scene")
        ),
    };
    text + "."
}

/// How far ahead of no filter the leader is, and what that is worth.
fn margin(comparison: &Comparison) -> Option<String> {
    let [leader] = leaders(comparison)[..] else { return None };
    let brute = comparison.brute_force().filter(|b| b.label != leader.label)?;
    let ratios = gains(comparison, &leader.label, &brute.label);
    let mean = geometric_mean(ratios.iter().copied())?;
    let (low, high) = extent(&ratios)?;
    let mut text = format!(
        "Against {} at the same number of samples its RMSE is {} times smaller ({}; geometric mean over {})",
        brute.label,
        phrase::times(mean),
        range(&phrase::times(low), &phrase::times(high)),
        count(ratios.len(), "scene"),
    );
    if let Some((middle, low, high)) = worth(comparison, &leader.label) {
        text += &format!(
            "; {} needs {} samples a pixel to come as close (median; {})",
            brute.label,
            phrase::samples(middle),
            range(&phrase::samples(low), &phrase::samples(high)),
        );
    }
    Some(text + ".")
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

fn extent(values: &[f64]) -> Option<(f64, f64)> {
    let low = values.iter().copied().reduce(f64::min)?;
    Some((low, values.iter().copied().reduce(f64::max)?))
}

/// Who came closest at one scale, texture by texture.
fn at_scale(setting: &Setting, scale: &Scale) -> Option<String> {
    let contests: Vec<_> = setting.at(scale).filter(|c| !c.standings.is_empty()).collect();
    let names = |c: &&Contest| c.winners().map(|s| s.method.label.clone()).collect::<Vec<_>>();
    let clauses = unique(contests.iter().map(names)).into_iter().map(|winners| {
        let won = contests.iter().filter(|c| names(c) == winners);
        let textures: Vec<_> = won.map(|c| on_texture(c)).collect();
        match winners.len() {
            1 => format!("{} came closest on {}", winners[0], list(&textures)),
            _ => format!("{} tied on {}", list(&winners), list(&textures)),
        }
    });
    let clauses: Vec<_> = clauses.collect();
    (!clauses.is_empty()).then(|| format!("At {}, {}.", scale.label, clauses.join("; ")))
}

/// `denim (1.8 times closer than schilling, worth 37 samples)`.
fn on_texture(contest: &Contest) -> String {
    let texture = &contest.scene.key.texture;
    let Some(first) = contest.winners().min_by(|a, b| a.error.total_cmp(&b.error)) else {
        return texture.clone();
    };
    let mut facts = vec![format!("RMSE {}", phrase::number(first.error))];
    if let Some(next) = contest.runner_up().filter(|_| first.error > 0.0) {
        let times = phrase::times(next.error / first.error);
        facts.push(format!("{times} times below {}", next.method.label));
    }
    if let Some(worth) = first.worth.filter(|_| first.method.name != "unfiltered") {
        facts.push(format!("worth {} samples", phrase::samples(worth)));
    }
    format!("{texture} ({})", facts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::results::Results;
    use crate::report::fixture;

    fn lead(results: &Results) -> String {
        answer(&Comparison::of(results)).lead.join("\n")
    }

    #[test]
    fn a_winner_is_named_with_its_margin_and_worth() {
        let results = fixture::results();
        let text = lead(&results);
        assert!(text.contains("fournier came closest most often"), "{text}");
        assert!(text.contains("unfiltered needs"), "{text}");
        let found = answer(&Comparison::of(&results));
        assert_eq!(found.findings.len(), 1);
        assert_eq!(found.findings[0].sentences.len(), fixture::SCALES.len());
        assert!(found.findings[0].sentences[0].starts_with("At 1 texel a pixel, "));
    }

    #[test]
    fn a_tie_is_called_a_tie() {
        let mut results = fixture::results();
        for scene in &mut results.scenes {
            scene.reference.rmse = 10.0;
        }
        let text = lead(&results);
        assert!(text.contains("among the closest in 12 of 12 scenes"), "{text}");
        assert!(text.contains("12 of 12 scenes ended in one"), "{text}");
        let found = answer(&Comparison::of(&results)).findings;
        assert!(found[0].sentences[0].contains(" tied on "), "{}", found[0].sentences[0]);
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
