//! Tables: built once, written by the templates of both reports.

use serde::Serialize;

use super::answer::{gains, wins, worth};
use super::contest::{Comparison, Contest, DECIDES, Setting, geometric_mean, median, rank, unique};
use super::phrase;
use super::scale::Scale;
use super::words::better;
use crate::experiment::results::MethodInfo;

/// A table of text.
#[derive(Clone, Debug, Serialize)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// Column headings; the first column names the row.
    pub head: Vec<String>,
    /// Rows as long as `head`.
    pub rows: Vec<Vec<Cell>>,
    /// Remarks below it.
    pub notes: Vec<String>,
}

/// A cell of a [`Table`].
#[derive(Clone, Debug, Default, Serialize)]
pub struct Cell {
    /// What it says; empty if there is nothing to say.
    pub text: String,
    /// A second figure, in small type.
    pub aside: String,
    /// Whether it is the best of its column.
    pub best: bool,
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self { text, ..Self::default() }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

/// What a method is called in tables: a dagger marks a form printed without a normalisation.
pub fn label(method: &MethodInfo) -> String {
    if method.normalised { method.label.clone() } else { format!("{} †", method.label) }
}

/// What the dagger of [`label`] means, if it is used.
pub fn dagger(methods: &[MethodInfo]) -> Option<String> {
    let any = methods.iter().any(|m| !m.normalised);
    any.then(|| "† as printed, without a normalisation: wrong brightness counts as error.".into())
}

/// How each method did over all scenes.
pub fn ranking(comparison: &Comparison) -> Table {
    let brute = comparison.brute_force();
    let mut head =
        vec!["Method".to_owned(), "Scenes".into(), "Closest alone".into(), "Tied".into()];
    if let Some(brute) = brute {
        head.push(format!("RMSE of {} ÷ its own", brute.label));
        head.push("Worth, unfiltered samples a pixel".into());
    }
    let best = comparison.results.methods.iter().map(|m| wins(comparison, &m.label)).max();
    let rows = comparison.results.methods.iter().map(|method| {
        let (alone, tied) = wins(comparison, &method.label);
        let scenes = comparison.contests().filter(|c| c.standing(&method.label).is_some()).count();
        let mut row = vec![
            Cell::from(label(method)),
            scenes.to_string().into(),
            Cell { best: Some((alone, tied)) == best, ..alone.to_string().into() },
            tied.to_string().into(),
        ];
        if let Some(brute) = brute {
            row.push(gain_cell(comparison, &method.label, &brute.label));
            row.push(worth_cell(comparison, &method.label));
        }
        row
    });
    Table {
        title: "All scenes".into(),
        head,
        rows: rows.collect(),
        notes: dagger(&comparison.results.methods).into_iter().collect(),
    }
}

fn gain_cell(comparison: &Comparison, label: &str, brute: &str) -> Cell {
    let mean = geometric_mean(gains(comparison, label, brute).into_iter());
    mean.map_or_else(Cell::default, |mean| phrase::times(mean).into())
}

fn worth_cell(comparison: &Comparison, label: &str) -> Cell {
    worth(comparison, label).map_or_else(Cell::default, |(middle, low, high)| Cell {
        text: phrase::samples_short(middle),
        aside: format!("{} … {}", phrase::samples_short(low), phrase::samples_short(high)),
        best: false,
    })
}

/// Who came closest: scale by texture. All that tie are named.
pub fn winners(setting: &Setting) -> Table {
    let textures = setting.textures();
    let cell = |scale: &Scale, texture: &str| {
        let contest = setting.at(scale).find(|c| c.scene.key.texture == texture);
        let winners = || contest.into_iter().flat_map(Contest::winners);
        let worth = winners().filter_map(|s| s.worth).max_by(|a, b| rank(*a).total_cmp(&rank(*b)));
        Cell {
            text: winners().map(|s| label(s.method)).collect::<Vec<_>>().join(" = "),
            aside: worth.map_or_else(String::new, phrase::samples_short),
            best: false,
        }
    };
    let rows = setting.scales.iter().map(|scale| {
        let cells = textures.iter().map(|texture| cell(scale, texture));
        std::iter::once(scale.label.as_str().into()).chain(cells).collect()
    });
    let head = std::iter::once("Closest").chain(textures.iter().copied()).map(str::to_owned);
    Table {
        title: "Closest to the reference, and its worth in unfiltered samples a pixel".into(),
        head: head.collect(),
        rows: rows.collect(),
        notes: Vec::new(),
    }
}

/// Method by texture at one scale of a setting.
pub fn at_scale(comparison: &Comparison, setting: &Setting, scale: &Scale) -> Table {
    let textures = setting.textures();
    let contest_of = |texture: &str| setting.at(scale).find(|c| c.scene.key.texture == texture);
    let contests: Vec<_> = textures.iter().map(|t| contest_of(t)).collect();
    let methods = &comparison.results.methods;
    let rows = methods.iter().map(|method| {
        let errors = contests.iter().map(|c| c.map_or_else(Cell::default, |c| error(c, method)));
        std::iter::once(label(method).into()).chain(errors).collect()
    });
    let floor = contests
        .iter()
        .map(|c| c.map_or_else(Cell::default, |c| phrase::number(c.scene.reference.rmse).into()));
    let floor = std::iter::once("the reference’s own".into()).chain(floor).collect();
    let head = std::iter::once("RMSE").chain(textures.iter().copied()).map(str::to_owned);
    Table {
        title: scale.label.clone(),
        head: head.collect(),
        rows: rows.chain(std::iter::once(floor)).collect(),
        notes: reasons(&contests),
    }
}

/// A method's error in a scene and what it is worth; empty if it was not measured.
fn error(contest: &Contest, method: &MethodInfo) -> Cell {
    contest.standing(&method.label).map_or_else(Cell::default, |standing| Cell {
        text: phrase::number(standing.error),
        aside: standing.worth.map_or_else(String::new, phrase::samples_short),
        best: standing.best,
    })
}

/// Why cells are empty.
fn reasons(contests: &[Option<&Contest>]) -> Vec<String> {
    let refusals = contests.iter().flatten().flat_map(|c| &c.scene.refusals);
    unique(refusals.map(|r| format!("{}: {}.", r.method, r.reason.trim_end_matches('.'))))
}

/// The other metrics, if any: the median over all scenes, a column a metric.
pub fn other_metrics(comparison: &Comparison) -> Option<Table> {
    let scores = comparison.contests().flat_map(|c| &c.scene.trials).flat_map(|t| &t.scores);
    let metrics = unique(scores.map(|s| s.metric.as_str()).filter(|m| *m != DECIDES));
    let rows = comparison.results.methods.iter().map(|method| {
        let cells = metrics.iter().map(|metric| median_score(comparison, &method.label, metric));
        std::iter::once(label(method).into()).chain(cells).collect()
    });
    let head = std::iter::once("Method").chain(metrics.iter().copied()).map(str::to_owned);
    (!metrics.is_empty()).then(|| Table {
        title: "Other measures, median over all scenes".into(),
        head: head.collect(),
        rows: rows.collect(),
        notes: metrics.iter().filter_map(|m| Some(format!("{m}: {}.", better(m)?))).collect(),
    })
}

fn median_score(comparison: &Comparison, label: &str, metric: &str) -> Cell {
    let trials = comparison.contests().flat_map(|c| &c.scene.trials);
    let trials = trials.filter(|t| t.method == label && t.spp == comparison.spp);
    let values: Vec<f64> =
        trials.filter_map(|t| t.score(metric)).filter(|v| v.is_finite()).collect();
    median(values, |v| v).map_or_else(Cell::default, |v| phrase::number(v).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn every_row_is_as_long_as_the_head() {
        let results = fixture::results();
        let comparison = Comparison::of(&results);
        let setting = &comparison.settings[0];
        let mut tables = vec![ranking(&comparison), other_metrics(&comparison).unwrap()];
        tables.extend(setting.scales.iter().map(|s| at_scale(&comparison, setting, s)));
        for table in tables {
            assert!(table.rows.iter().all(|row| row.len() == table.head.len()), "{}", table.title);
        }
    }

    #[test]
    fn a_refused_cell_is_empty_with_its_reason_below() {
        let results = fixture::results();
        let comparison = Comparison::of(&results);
        let table =
            at_scale(&comparison, &comparison.settings[0], &comparison.settings[0].scales[1]);
        let waves = &table.rows[5][3];
        assert!(waves.text.is_empty());
        assert!(table.notes[0].starts_with("kautz: its table"), "{:?}", table.notes);
    }

    #[test]
    fn each_texture_has_one_best_method_unless_tied() {
        let results = fixture::results();
        let comparison = Comparison::of(&results);
        let table =
            at_scale(&comparison, &comparison.settings[0], &comparison.settings[0].scales[2]);
        for column in 1..table.head.len() {
            assert_eq!(table.rows.iter().filter(|row| row[column].best).count(), 1);
        }
    }
}
