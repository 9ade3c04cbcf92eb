//! Tables of flicker.

use super::standing::{Race, Standing};
use crate::report::contest::BRUTE_FORCE;
use crate::report::phrase::{number, percent, samples_short};
use crate::report::tables::{Cell, Table, label};

/// How every method flickers over a sequence, in the order of the spec.
pub fn flicker(race: &Race) -> Table {
    let finite = race.standings.iter().map(Standing::error).filter(|error| error.is_finite());
    let least = finite.fold(f64::INFINITY, f64::min);
    let rows = race.standings.iter().map(|standing| {
        let worth = standing.worth.filter(|_| standing.method.name != BRUTE_FORCE);
        vec![
            Cell::from(label(standing.method)),
            Cell {
                text: standing.wrong.map_or_else(String::new, percent),
                aside: worth.map_or_else(String::new, samples_short),
                best: standing.best,
                ..Cell::default()
            },
            ratio(standing.flicker.ratio()),
            figure(standing.flicker.mean.change),
            Cell { best: standing.error() == least, ..figure(standing.error()) },
            figure(standing.errors.iter().copied().fold(f64::NAN, f64::max)),
        ]
    });
    let head = [
        "Method",
        "Change of its error, of the truth’s change",
        "Flicker",
        "Change",
        "RMSE, mean over frames",
        "RMSE, worst frame",
    ];
    let (truth, noise) = (race.sequence.truth_change, race.sequence.noise);
    let upwards = match truth - noise {
        rest if rest > 0.0 => format!(", or in truth up to {} more", percent(noise / rest)),
        _ => String::new(),
    };
    let own: f64 = race.frames.iter().map(|frame| frame.reference.rmse).sum();
    Table {
        title: "Flicker".into(),
        head: head.map(str::to_owned).to_vec(),
        rows: rows.collect(),
        notes: vec![
            "Changes are means over pixels and from each frame to the next. Change of its error, or wrong change: 0 % moves as the truth \
             does, whatever constant it is off by; 100 % is as wrong as an image that stands still. In small type: \
             unfiltered samples a pixel whose error changes as little. Flicker: its change over the truth’s, 1 as lively, \
             above it sparkles, below it is stuck or smeared. Bold: the least, and what ties with it."
                .into(),
            format!(
                "The truth’s change is {}; the references’ own noise makes it too large by {} at most, so flicker is as \
                 told{upwards}. The references’ own RMSE: {}, mean over frames.",
                number(truth),
                number(noise),
                number(own / race.frames.len() as f64),
            ),
        ],
    }
}

fn figure(value: f64) -> Cell {
    if value.is_finite() { number(value).into() } else { "not finite".into() }
}

fn ratio(value: Option<f64>) -> Cell {
    value.map_or_else(Cell::default, figure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn every_row_is_as_long_as_the_head_and_some_method_is_best() {
        let results = fixture::moving();
        let table = flicker(&Race::all(&results, 1)[0]);
        assert_eq!(table.rows.len(), 6);
        assert!(table.rows.iter().all(|row| row.len() == table.head.len()));
        assert!(
            table.rows.iter().any(|row| row[1].best) && table.rows.iter().any(|row| row[4].best)
        );
    }

    #[test]
    fn a_broken_frame_is_told_of() {
        let mut results = fixture::moving();
        results.scenes[2].trials.iter_mut().for_each(|trial| trial.scores.clear());
        let table = flicker(&Race::all(&results, 1)[0]);
        assert!(table.rows.iter().all(|row| row[4].text == "not finite"));
    }
}
