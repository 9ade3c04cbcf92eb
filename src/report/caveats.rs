//! What an answer must add: where filters do not help, break down or take no part, and how far the
//! reference can be trusted.

use super::answer::gains;
use super::contest::{Comparison, Contest, DECIDES, geometric_mean, unique};
use super::phrase::{self, count, list};
use crate::experiment::results::{RefusalInfo, Results};

/// An error this many times brute force's is a method breaking down, not a bad picture.
const BROKEN: f64 = 100.0;
/// Most scenes named in a sentence.
const NAMED: usize = 6;

/// Scenes by name, or their number if they are many.
fn named(contests: &[&Contest]) -> String {
    // Scenes of several settings share their names.
    let names = unique(contests.iter().map(|c| c.name()));
    if names.len() > NAMED { String::new() } else { format!(": {}", list(&names)) }
}

/// Where brute force itself was the closest, and what the lookup alone does there.
pub fn unhelped(comparison: &Comparison) -> Vec<String> {
    let Some(brute) = comparison.brute_force() else { return Vec::new() };
    let closest = |c: &&Contest| c.winners().any(|s| s.method.label == brute.label);
    let scenes: Vec<_> = comparison.contests().filter(closest).collect();
    let all = count(comparison.contests().count(), "scene");
    let first = match scenes.len() {
        0 => format!("In each of {all} some filter was closer than {}.", brute.label),
        n => {
            format!("In {n} of {all} no filter was closer than {}{}.", brute.label, named(&scenes))
        }
    };
    std::iter::once(first).chain(lookup(comparison, &brute.label)).collect()
}

/// What averaging normals alone does where a pixel covers about a texel.
fn lookup(comparison: &Comparison, brute: &str) -> Option<String> {
    const FINE: f64 = 1.5;
    let averaged = comparison.results.methods.iter().find(|m| m.name == "averaged")?;
    let fine = comparison.contests().filter(|c| c.scene.key.texels_per_pixel <= FINE);
    let pair = |c: &Contest| Some((c.standing(&averaged.label)?.error, c.standing(brute)?.error));
    let ratios: Vec<f64> = fine.filter_map(pair).map(|(own, brute)| own / brute).collect();
    let mean = geometric_mean(ratios.iter().copied()).filter(|mean| *mean > 1.0)?;
    Some(format!(
        "Where a pixel covers about a texel, {}, the pyramid’s lookup without a spread of normals, has {} times the \
         RMSE of {brute} (geometric mean over {}): there the lookup itself blurs away what a pixel still shows.",
        averaged.label,
        phrase::times(mean),
        count(ratios.len(), "scene"),
    ))
}

/// Methods whose images are not finite, or far beyond anything that brute force shows.
pub fn breakdowns(comparison: &Comparison) -> Vec<String> {
    let brute = comparison.brute_force().map(|b| b.label.as_str());
    let sentence = |label: &str| {
        let lost: Vec<_> =
            comparison.contests().filter(|c| not_finite(comparison, c, label)).collect();
        let wild = |c: &&Contest| {
            let limit = brute.and_then(|b| c.standing(b)).map(|s| BROKEN * s.error);
            c.standing(label).zip(limit).is_some_and(|(s, limit)| s.error > limit)
        };
        let wild: Vec<_> = comparison.contests().filter(wild).collect();
        let lost = (!lost.is_empty()).then(|| {
            format!(
                "{label} breaks down in {}{}; pixels are not finite there, and it has no error.",
                count(lost.len(), "scene"),
                named(&lost)
            )
        });
        let wild = (!wild.is_empty()).then(|| {
            format!(
                "{label} breaks down in {}{}; its RMSE is more than {BROKEN} times that of {} there, and spoils its means.",
                count(wild.len(), "scene"),
                named(&wild),
                brute.unwrap_or_default(),
            )
        });
        lost.into_iter().chain(wild)
    };
    comparison.results.methods.iter().flat_map(|m| sentence(&m.label)).collect()
}

/// Whether a method was rendered in a scene but has no finite error.
pub fn not_finite(comparison: &Comparison, contest: &Contest, label: &str) -> bool {
    let of_method = |t: &&crate::experiment::results::TrialResult| t.method == label;
    let mut trials = contest.scene.trials.iter().filter(of_method);
    trials.any(|t| t.spp == comparison.spp && !t.score(DECIDES).is_some_and(f64::is_finite))
}

/// How much closer a normalised form is than its printed one.
pub fn printed_over_normalised(
    comparison: &Comparison,
    printed: &str,
    normalised: &str,
) -> Option<f64> {
    geometric_mean(gains(comparison, normalised, printed).into_iter())
}

/// One sentence for each method that took no part in some scenes.
pub fn refusals(results: &Results) -> Vec<String> {
    let all: Vec<_> = results
        .scenes
        .iter()
        .flat_map(|s| s.refusals.iter().map(move |r| (s.key.lobe.as_str(), r)))
        .collect();
    let sentence = |method: &str| {
        let of: Vec<_> = all.iter().filter(|(_, r)| r.method == method).collect();
        let lobes = unique(of.iter().map(|(lobe, _)| *lobe));
        let either = list(&lobes).replace(" and ", " or ");
        // Reasons that differ in the lobe's name alone are one reason.
        let reason = |(lobe, r): &&(&str, &RefusalInfo)| {
            r.reason.trim_end_matches('.').replace(&format!("a {lobe} "), &format!("a {either} "))
        };
        let reasons = unique(of.iter().map(reason));
        format!(
            "{method} takes no part in {} of {} (those with a {either} base lobe): {}.",
            of.len(),
            count(results.scenes.len(), "scene"),
            reasons.join("; "),
        )
    };
    unique(all.iter().map(|(_, r)| r.method.as_str())).into_iter().map(sentence).collect()
}

/// How far the reference itself can be trusted, and what it leaves undecided.
pub fn certainty(comparison: &Comparison) -> String {
    let contests = || comparison.contests();
    let references = contests().map(|c| &c.scene.reference);
    let worst = references.clone().map(|r| r.rmse).fold(0.0, f64::max);
    let mut spp: Vec<u32> = unique(references.clone().map(|r| r.spp));
    spp.sort_unstable();
    let spp: Vec<String> = spp.iter().map(u32::to_string).collect();
    let gaps: Vec<String> = unique(references.clone().map(|r| phrase::percent(r.gap)));
    let shown = unique(references.filter_map(|r| r.truth.meaning()).map(str::to_owned));
    let show = if shown.is_empty() { String::new() } else { format!(" and show {}", list(&shown)) };
    let ties = contests().filter(|c| c.winners().count() > 1).count();
    let open: Vec<_> = contests().filter(|c| c.undecided().next().is_some()).collect();
    let scenes = count(contests().count(), "scene");
    let opening = format!(
        "The references used {} samples a pixel{show}; their own RMSE is estimated at {} or less. Methods tie whose RMSE \
         lie within {} of each other, or no farther apart than a reference’s noise could put them, 95 times in 100: \
         {ties} of {scenes} ended in a tie.",
        list(&spp),
        phrase::number(worst),
        list(&gaps),
    );
    match open.as_slice() {
        [] => format!("{opening} No tie is for want of samples: every larger gap was resolved."),
        few if few.len() <= NAMED => {
            let told: Vec<_> = few.iter().map(|c| undecided(c)).collect();
            format!(
                "{opening} More samples of the reference could yet decide: {}.",
                told.join("; ")
            )
        }
        many => format!(
            "{opening} In {} of them the samples allowed to a reference were too few to say who is closest.",
            many.len()
        ),
    }
}

/// `gaussian at 64 texels a pixel, where olano-north may be as close as fournier`
fn undecided(contest: &Contest) -> String {
    let open: Vec<_> = contest.undecided().map(|s| s.method.label.as_str()).collect();
    let closest = contest.standings.iter().min_by(|a, b| a.error.total_cmp(&b.error));
    let closest = closest.map_or("", |s| s.method.label.as_str());
    format!("{}, where {} may be as close as {closest}", contest.name(), list(&open))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn a_refusal_is_one_sentence_a_method() {
        let mut results = fixture::results();
        let text = refusals(&results).join("\n");
        assert!(text.starts_with("kautz takes no part in 4 of 12 scenes (those with a"), "{text}");
        for (i, scene) in results.scenes.iter_mut().enumerate() {
            let lobe = ["ggx", "beckmann"][i % 2];
            scene.key.lobe = lobe.into();
            let reason = format!("a {lobe} lobe is none");
            scene.refusals = vec![RefusalInfo { method: "kautz".into(), reason }];
        }
        let text = refusals(&results).join("\n");
        assert!(
            text.ends_with(
                "(those with a ggx or beckmann base lobe): a ggx or beckmann lobe is none."
            ),
            "{text}"
        );
    }

    #[test]
    fn a_breakdown_is_told_with_its_scene() {
        let mut results = fixture::results();
        let trials = &mut results.scenes[0].trials;
        let of = |label: &str| trials.iter().position(|t| t.method == label).unwrap();
        let (lost, wild) = (of("averaged"), of("fournier"));
        trials[lost].scores.clear();
        trials[wild].scores[0].value = 1e17;
        let text = breakdowns(&Comparison::of(&results)).join("\n");
        assert!(
            text.contains(
                "averaged breaks down in 1 scene: bricks at 1 texel a pixel; pixels are not"
            ),
            "{text}"
        );
        assert!(
            text.contains("fournier breaks down in 1 scene: bricks at 1 texel a pixel; its RMSE"),
            "{text}"
        );
    }
}
