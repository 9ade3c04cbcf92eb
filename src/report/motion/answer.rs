//! The answer in words: which method moves most like the truth, which sparkles, and how sure that is.

use super::standing::{Race, Standing};
use crate::experiment::results::Results;
use crate::experiment::spec::{MotionKind, MotionSpec};
use crate::report::caveats::refusals;
use crate::report::contest::{BRUTE_FORCE, unique};
use crate::report::phrase::{count, list, percent, samples, scale, signed_scale, times};

/// The answer to an experiment in motion: sentences, each a short paragraph.
pub fn answer(results: &Results, races: &[Race], spp: u32) -> Vec<String> {
    let moving: Vec<&Race> = races.iter().filter(|race| !race.winners().is_empty()).collect();
    let mut sentences = Vec::new();
    match moving.as_slice() {
        [] => sentences.push(
            "Nothing can be said of flicker: no reference changes by more than its noise could explain."
                .to_owned(),
        ),
        [race] => sentences.push(alone(race)),
        _ => sentences.extend(several(&moving)),
    }
    sentences.extend(liveliness(&moving));
    sentences.extend(closest(&moving));
    sentences.push(field(results, races, spp));
    sentences.extend(refusals(results));
    sentences.push(certainty(races));
    sentences
}

/// `lean`, or `lean and toksvig` that tie.
fn names(standings: &[&Standing]) -> String {
    let labels: Vec<&str> = standings.iter().map(|s| s.method.label.as_str()).collect();
    list(&labels)
}

/// Verb and pronoun of one method or several.
fn flickers(methods: usize) -> (&'static str, &'static str) {
    if methods == 1 { ("flickers", "its") } else { ("flicker", "their") }
}

/// The answer of the one sequence there is.
fn alone(race: &Race) -> String {
    let winners = race.winners();
    let best = winners[0];
    let (verb, whose) = flickers(winners.len());
    let wrong = best.wrong.map_or_else(String::new, percent);
    let worth = match best.worth {
        Some(worth) if best.method.name != BRUTE_FORCE => {
            format!(", as little as with {} unfiltered samples a pixel", samples(worth))
        }
        _ => String::new(),
    };
    format!(
        "{} {verb} least beside the truth: from frame to frame {whose} error changes by {wrong} of what the truth changes{worth}.",
        names(&winners)
    )
}

/// Who moves most like the truth in how many sequences.
fn several(moving: &[&Race]) -> Vec<String> {
    let labels = unique(moving.iter().flat_map(|r| &r.standings).map(|s| s.method.label.as_str()));
    let wins = |label: &str| {
        moving.iter().filter(|r| r.winners().iter().any(|s| s.method.label == label)).count()
    };
    let most = labels.iter().map(|label| wins(label)).max().unwrap_or_default();
    let leaders: Vec<&str> = labels.into_iter().filter(|label| wins(label) == most).collect();
    let (verb, whose) = flickers(leaders.len());
    let each = if leaders.len() == 1 { "" } else { " each" };
    let first = format!(
        "{} {verb} least beside the truth: {whose} error changes least from frame to frame{each} in {most} of {}.",
        list(&leaders),
        count(moving.len(), "sequence")
    );
    let of_race = |race: &&Race| {
        let winners = race.winners();
        let wrong = winners[0].wrong.map_or_else(String::new, percent);
        format!("{}: {} ({wrong})", race.sequence.slug, names(&winners))
    };
    let each: Vec<String> = moving.iter().map(of_race).collect();
    let second = format!(
        "Change of the error, of what the truth changes, where it is least: {}.",
        each.join("; ")
    );
    vec![first, second]
}

/// Who sparkles most and who is stuck most, over all sequences.
fn liveliness(moving: &[&Race]) -> Option<String> {
    let all: Vec<(f64, &Standing, &Race)> = moving
        .iter()
        .flat_map(|race| race.by_flicker().into_iter().map(|(ratio, s)| (ratio, s, *race)))
        .collect();
    let by = |a: &&(f64, &Standing, &Race), b: &&(f64, &Standing, &Race)| a.0.total_cmp(&b.0);
    let (most, least) = (all.iter().max_by(by)?, all.iter().min_by(by)?);
    let place = |race: &Race| {
        if moving.len() > 1 { format!(" ({})", race.sequence.slug) } else { String::new() }
    };
    let lively = (most.0 > 1.0).then(|| {
        format!(
            "{} sparkles most: it changes {} times as much as the truth{}",
            most.1.method.label,
            times(most.0),
            place(most.2)
        )
    });
    let stuck = (least.0 < 1.0).then(|| {
        format!(
            "{} is the calmest: it changes {} times as much{}",
            least.1.method.label,
            scale((least.0 * 100.0).round() / 100.0),
            place(least.2)
        )
    });
    let parts: Vec<String> = lively.into_iter().chain(stuck).collect();
    (!parts.is_empty()).then(|| format!("{}.", parts.join("; ")))
}

/// Who is closest frame by frame.
fn closest(moving: &[&Race]) -> Option<String> {
    let best = |race: &&Race| {
        let finite = race.standings.iter().filter(|s| s.error().is_finite());
        let least = finite.min_by(|a, b| a.error().total_cmp(&b.error()))?;
        Some(least.method.label.clone())
    };
    let found: Vec<String> = unique(moving.iter().filter_map(best));
    (!found.is_empty())
        .then(|| format!("Frame by frame, the least mean RMSE is that of {}.", list(&found)))
}

/// What was compared.
fn field(results: &Results, races: &[Race], spp: u32) -> String {
    let methods =
        unique(races.iter().flat_map(|r| &r.standings).map(|s| s.method.label.as_str())).len();
    let frames = results.motion.map_or(0, |motion| motion.frames as usize);
    format!(
        "Compared: {} at {} a pixel in {} of {}, each frame against a converged reference of its own. {}",
        count(methods, "method"),
        count(spp as usize, "sample"),
        count(races.len(), "sequence"),
        count(frames, "frame"),
        results.motion.as_ref().map_or_else(String::new, moves),
    )
}

/// What moves, as a sentence.
pub fn moves(motion: &MotionSpec) -> String {
    match motion.kind {
        MotionKind::Rotate { degrees } => format!(
            "The object turns by {}° about the vertical; camera and light stay.",
            signed_scale(degrees)
        ),
        MotionKind::Light { degrees } => {
            format!("The light moves by {}° round the vertical.", signed_scale(degrees))
        }
        MotionKind::Drift { degrees } => {
            format!("The camera moves by {}° round the vertical.", signed_scale(degrees))
        }
        MotionKind::Distance { from, to } => {
            let how = if to < from { "comes nearer" } else { "goes away" };
            format!("The camera {how}, from distance {} to {}.", scale(from), scale(to))
        }
    }
}

/// How far the references' noise can be made responsible.
fn certainty(races: &[Race]) -> String {
    let share = |race: &Race| race.sequence.noise / race.sequence.truth_change;
    let worst = races.iter().map(share).filter(|s| s.is_finite()).fold(0.0, f64::max);
    let ties = races.iter().filter(|race| race.winners().len() > 1).count();
    let still: Vec<&str> =
        races.iter().filter(|r| r.is_still()).map(|r| r.sequence.slug.as_str()).collect();
    let still = if still.is_empty() {
        String::new()
    } else {
        format!(" Nothing can be said of {}, where the reference may be still.", list(&still))
    };
    format!(
        "The references’ own noise adds at most {} to their change and as much to that of any error; a lead under that \
         is a tie, and {ties} of {} ended in one.{still}",
        percent(worst),
        count(races.len(), "sequence"),
    )
}
