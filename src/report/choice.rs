//! Which filter to choose: at each scale of a setting, the one that comes closest over all textures.

use super::contest::{Comparison, Contest, Setting, geometric_mean, median, rank, unique};
use super::phrase::{self, list};
use super::scale::Scale;
use crate::experiment::results::MethodInfo;
use crate::metric::Equivalent;

/// A filter over the textures of one scale.
pub struct Candidate<'a> {
    /// The filter.
    pub method: &'a MethodInfo,
    /// Its RMSE over brute force's at the same samples a pixel, geometric mean over textures.
    pub left: f64,
    /// What its errors are worth in brute-force samples: the median.
    pub worth: Option<Equivalent>,
    /// Its RMSE over the reference's mean radiance: the median.
    pub relative: Option<f64>,
}

/// The filters at one scale.
pub struct Choice<'a> {
    /// The scale, in words.
    pub scale: String,
    /// Number of textures averaged over.
    pub textures: usize,
    /// Filters measured on every texture, closest first.
    pub candidates: Vec<Candidate<'a>>,
    /// Textures on which no filter was closer than brute force.
    pub unhelped: Vec<&'a str>,
}

/// The choices of a setting, from fine to coarse; none without brute force to compare with.
pub fn choices<'a>(comparison: &Comparison<'a>, setting: &Setting<'a>) -> Vec<Choice<'a>> {
    let Some(brute) = comparison.brute_force() else { return Vec::new() };
    setting.scales.iter().map(|scale| at(comparison, setting, scale, brute)).collect()
}

fn at<'a>(
    comparison: &Comparison<'a>,
    setting: &Setting<'a>,
    scale: &Scale,
    brute: &MethodInfo,
) -> Choice<'a> {
    let contests: Vec<&Contest<'a>> = scale.members.iter().map(|&i| &setting.contests[i]).collect();
    let contests: Vec<_> =
        contests.into_iter().filter(|c| c.standing(&brute.label).is_some()).collect();
    let filters = comparison.results.methods.iter().filter(|m| m.label != brute.label);
    let mut candidates: Vec<_> =
        filters.filter_map(|method| candidate(method, &contests, brute)).collect();
    candidates.sort_by(|a, b| a.left.total_cmp(&b.left));
    let unhelped = contests.iter().filter(|c| c.winners().any(|s| s.method.label == brute.label));
    Choice {
        scale: scale.label.clone(),
        textures: contests.len(),
        candidates,
        unhelped: unhelped.map(|c| texture(c)).collect(),
    }
}

fn texture<'a>(contest: &Contest<'a>) -> &'a str {
    &contest.scene.key.texture
}

/// A filter that was measured in all these contests.
fn candidate<'a>(
    method: &'a MethodInfo,
    contests: &[&Contest],
    brute: &MethodInfo,
) -> Option<Candidate<'a>> {
    let own: Option<Vec<_>> =
        contests.iter().map(|c| Some((*c, c.standing(&method.label)?))).collect();
    let own = own?;
    let ratio = |(c, s): &(&Contest, &super::contest::Standing)| {
        Some(s.error / c.standing(&brute.label)?.error)
    };
    Some(Candidate {
        method,
        left: geometric_mean(own.iter().filter_map(ratio))?,
        worth: median(own.iter().filter_map(|(_, s)| s.worth).collect(), rank),
        relative: median(own.iter().filter_map(|(c, s)| c.relative(s.error)).collect(), |v| v),
    })
}

/// A sentence or two a setting: what to choose where, and where no filter helps.
pub fn advice(comparison: &Comparison) -> Vec<String> {
    let Some(brute) = comparison.brute_force() else { return Vec::new() };
    let sentence = |setting: &Setting| {
        let found = choices(comparison, setting);
        let chosen: Vec<_> = found.iter().filter(|c| !c.candidates.is_empty()).collect();
        let helped = |c: &&&Choice| c.candidates[0].left < 1.0;
        let winners = chosen.iter().filter(helped).map(|c| c.candidates[0].method.label.as_str());
        let mut clauses: Vec<String> = unique(winners)
            .into_iter()
            .map(|label| {
                let of = chosen.iter().filter(helped);
                let of: Vec<_> =
                    of.filter(|c| c.candidates[0].method.label == label).copied().collect();
                choose(label, &of, &brute.label)
            })
            .collect();
        clauses.extend(chosen.iter().filter(|c| !helped(c)).map(|c| leave(c, &brute.label)));
        (!clauses.is_empty()).then(|| prefix(comparison, setting) + &clauses.join(" "))
    };
    comparison.settings.iter().filter_map(sentence).collect()
}

/// What sets a setting apart from the others, with a colon; nothing if there is but one.
fn prefix(comparison: &Comparison, setting: &Setting) -> String {
    let parts: Vec<&str> = setting.name.split(", ").collect();
    let differs = |(i, part): &(usize, &&str)| {
        comparison.settings.iter().any(|other| other.name.split(", ").nth(*i) != Some(**part))
    };
    let apart: Vec<&str> = parts.iter().enumerate().filter(differs).map(|(_, p)| *p).collect();
    if apart.is_empty() { String::new() } else { format!("With a {}: ", apart.join(", ")) }
}

/// `Choose fournier at 4 and 16 texels a pixel: it leaves …`
fn choose(label: &str, at: &[&Choice], brute: &str) -> String {
    let best = || at.iter().map(|c| &c.candidates[0]);
    let left: Vec<_> = best().map(|c| phrase::percent(c.left)).collect();
    let worth: Option<Vec<_>> = best().map(|c| c.worth.map(phrase::samples)).collect();
    let worth = worth.map_or_else(String::new, |worth| {
        format!(
            ", which {brute} reaches with {} samples a pixel (median over textures)",
            list(&worth)
        )
    });
    let textures = at.iter().map(|c| c.textures).max().unwrap_or(0);
    format!(
        "Choose {label} at {}: it leaves {} of the RMSE of {brute} (geometric mean over {}){worth}.",
        scales(at),
        list(&left),
        phrase::count(textures, "texture"),
    )
}

/// `1, 4 and 16 texels a pixel`.
fn scales(at: &[&Choice]) -> String {
    const UNITS: [&str; 2] = [" texel a pixel", " texels a pixel"];
    let bare = |scale: &'_ str| {
        UNITS.iter().find_map(|unit| scale.strip_suffix(unit)).unwrap_or(scale).to_owned()
    };
    match at {
        [one] => one.scale.clone(),
        _ => list(&at.iter().map(|c| bare(&c.scale)).collect::<Vec<_>>()) + UNITS[1],
    }
}

/// `At 1 texel a pixel no filter helps: …`
fn leave(choice: &Choice, brute: &str) -> String {
    let best = &choice.candidates[0];
    format!(
        "At {} filtering does not pay: the best filter over all textures, {}, has {} of the RMSE of {brute}.",
        choice.scale,
        best.method.label,
        phrase::percent(best.left),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_closest_over_all_textures_is_chosen() {
        let results = fixture::results();
        let comparison = Comparison::of(&results);
        let found = choices(&comparison, &comparison.settings[0]);
        assert_eq!(found.len(), fixture::SCALES.len());
        // Measured on all three textures; kautz refuses waves.
        assert!(found.iter().all(|c| c.candidates.len() == 4 && c.textures == 3));
        assert_eq!(found[3].candidates[0].method.label, "fournier");
        assert!(advice(&comparison)[0].starts_with("Choose fournier at 1, 4, 16 and 64 texels"));
    }

    #[test]
    fn a_scale_where_no_filter_helps_says_so() {
        let mut results = fixture::results();
        for scene in &mut results.scenes {
            for trial in scene.trials.iter_mut().filter(|t| t.method == "unfiltered") {
                trial.scores[0].value *= 1e-3;
            }
        }
        let comparison = Comparison::of(&results);
        let text = advice(&comparison).join("\n");
        assert!(text.contains("At 1 texel a pixel filtering does not pay"), "{text}");
        let found = choices(&comparison, &comparison.settings[0]);
        assert_eq!(found[0].unhelped, fixture::TEXTURES);
    }
}
