//! `flicker.csv`: one row a sequence, method, sample count and figure. docs/results.md is its manual.

use crate::experiment::results::Results;
use crate::experiment::sequence::{Sequence, TrialFlicker};
use crate::report::tidy::{round_trip, table};

/// The columns of `flicker.csv`, in order.
const COLUMNS: [&str; 13] = [
    "sequence",
    "texture",
    "surface",
    "light",
    "lobe",
    "parameter",
    "shading",
    "elevation",
    "frames",
    "method",
    "spp",
    "metric",
    "value",
];

/// `flicker.csv`.
pub fn csv(results: &Results) -> Vec<u8> {
    table(COLUMNS, results.sequences.iter().flat_map(|sequence| rows(results, sequence)))
}

/// The reference's rows, then the trials'.
fn rows(results: &Results, sequence: &Sequence) -> Vec<[String; 13]> {
    let first = &sequence.of(&results.scenes)[0];
    let key = &first.key;
    let row = |method: &str, spp: u32, metric: &str, value: f64| {
        [
            sequence.slug.clone(),
            key.texture.clone(),
            key.surface.clone(),
            key.light.clone(),
            key.lobe.clone(),
            round_trip(key.parameter),
            key.shading.clone(),
            round_trip(key.elevation),
            sequence.frames.len().to_string(),
            method.to_owned(),
            spp.to_string(),
            metric.to_owned(),
            round_trip(value),
        ]
    };
    let own = [("change", sequence.truth_change), ("noise", sequence.noise)];
    let own = own.map(|(metric, value)| row("reference", first.reference.spp, metric, value));
    let of_trial = |trial: &TrialFlicker| {
        let each = figures(trial).into_iter();
        each.map(|(metric, value)| row(&trial.method, trial.spp, metric, value)).collect::<Vec<_>>()
    };
    own.into_iter().chain(sequence.trials.iter().flat_map(of_trial)).collect()
}

/// The figures of a trial; ratios only where the reference moves.
pub fn figures(trial: &TrialFlicker) -> Vec<(&'static str, f64)> {
    let flicker = &trial.flicker;
    let ratios = [("flicker", flicker.ratio()), ("error_flicker", flicker.error_ratio())];
    let changes = [("change", flicker.mean.change), ("error_change", flicker.mean.error_change)];
    let ratios = ratios.into_iter().filter_map(|(metric, ratio)| Some((metric, ratio?)));
    changes.into_iter().chain(ratios).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_columns_are_those_of_the_manual() {
        let text = String::from_utf8(csv(&fixture::moving())).unwrap();
        assert_eq!(text.lines().next(), Some(COLUMNS.join(",").as_str()));
        let manual = include_str!("../../../docs/results.md");
        let (_, section) = manual.split_once("## `flicker.csv`").unwrap();
        for column in COLUMNS {
            assert!(section.contains(&format!("| `{column}` |")), "{column} is not in the manual");
        }
    }

    #[test]
    fn every_trial_has_its_figures_and_the_reference_its_noise() {
        let results = fixture::moving();
        let text = String::from_utf8(csv(&results)).unwrap();
        let trials: usize = results.sequences.iter().map(|s| s.trials.len()).sum();
        assert_eq!(text.matches(",error_flicker,").count(), trials);
        assert_eq!(text.matches(",reference,4096,noise,").count(), results.sequences.len());
    }
}
