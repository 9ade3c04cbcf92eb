//! What an answer must add: printed forms, refusals, and how far the reference can be trusted.

use super::answer::gains;
use super::contest::{Comparison, geometric_mean, unique};
use super::phrase::{self, count, list};
use crate::experiment::results::{MethodInfo, RefusalInfo, Results};

/// One sentence for each method that appears both as printed and normalised.
pub fn printed_forms(comparison: &Comparison) -> Vec<String> {
    let methods = &comparison.results.methods;
    let printed = methods.iter().filter(|m| !m.normalised);
    let pairs = printed.flat_map(|p| {
        methods.iter().filter(|m| m.normalised && m.name == p.name).map(move |m| (p, m))
    });
    let sentence = |(printed, normalised): (&MethodInfo, &MethodInfo)| {
        let ratios = gains(comparison, &normalised.label, &printed.label);
        let mean = geometric_mean(ratios.iter().copied())?;
        Some(format!(
            "{}, the form as printed, without a normalisation, has {} times the RMSE of {}, its normalised form \
             (geometric mean over {}).",
            printed.label,
            phrase::times(mean),
            normalised.label,
            count(ratios.len(), "scene"),
        ))
    };
    pairs.filter_map(sentence).collect()
}

/// One sentence for each method and reason.
pub fn refusals(results: &Results) -> Vec<String> {
    let all = results.scenes.iter().flat_map(|s| s.refusals.iter().map(move |r| (s, r)));
    let all: Vec<_> = all.collect();
    let distinct = unique(all.iter().map(|(_, r)| (&r.method, &r.reason)));
    let sentence = |(method, reason): (&String, &String)| {
        let same = |r: &RefusalInfo| (&r.method, &r.reason) == (method, reason);
        let scenes = all.iter().filter(|(_, r)| same(r)).map(|(s, _)| s);
        let lobes = unique(scenes.clone().map(|s| s.key.lobe.as_str()));
        format!(
            "{method} took no part in {} with a {} base lobe: {}.",
            count(scenes.count(), "scene"),
            list(&lobes),
            reason.trim_end_matches('.'),
        )
    };
    distinct.into_iter().map(sentence).collect()
}

/// How far the reference itself can be trusted.
pub fn certainty(comparison: &Comparison) -> Option<String> {
    let references = comparison.contests().map(|c| &c.scene.reference);
    let worst = references.clone().map(|r| r.rmse).fold(0.0, f64::max);
    let spp = unique(references.map(|r| r.spp.to_string()));
    let ties = comparison.contests().filter(|c| c.winners().count() > 1).count();
    Some(format!(
        "The references used {} samples a pixel; their own RMSE is estimated at {} or less. A lead under \
         twice a reference’s own error counts as a tie: {} of {} ended in one.",
        list(&spp),
        phrase::number(worst),
        ties,
        count(comparison.contests().count(), "scene"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn a_refusal_gives_its_reason_once() {
        let text = refusals(&fixture::results()).join("\n");
        assert_eq!(text.matches("kautz took no part in 4 scenes").count(), 1, "{text}");
    }

    #[test]
    fn a_printed_form_is_set_against_the_normalised_one() {
        let results = fixture::results();
        let text = printed_forms(&Comparison::of(&results)).join("\n");
        assert!(text.contains("schilling-printed, the form as printed, without"), "{text}");
        assert!(text.contains("times the RMSE of schilling, its normalised form"), "{text}");
    }
}
