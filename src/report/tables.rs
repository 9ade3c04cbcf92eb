//! Tables: built once, written by the templates of both reports.

use serde::Serialize;

use super::caveats::not_finite;
use super::contest::{Comparison, Contest, DECIDES, Setting, median, rank, unique};
use super::phrase;
use super::scale::Scale;
use super::source::{self, Source};
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
    /// The rows of `metrics.csv` that it follows from.
    #[serde(skip)]
    pub sources: Vec<Source>,
    /// Their lines, as `12 40 41`; filled in by [`super::source::Lines::trace`].
    pub lines: String,
}

impl Cell {
    /// The same cell, which follows from these rows of `metrics.csv`.
    pub fn of_rows(self, rows: impl IntoIterator<Item = Source>) -> Self {
        Self { sources: rows.into_iter().collect(), ..self }
    }
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
    any.then(|| {
        "† keeps its lobes as printed, without normalising them: wrong brightness counts as error."
            .into()
    })
}

/// Who came closest: scale by texture. All that tie are named.
pub fn winners(setting: &Setting) -> Table {
    let textures = setting.textures();
    let rows = setting.scales.iter().map(|scale| {
        let contest_of =
            |texture: &&str| setting.at(scale).find(|c| c.scene.key.texture == *texture);
        let cells = textures.iter().map(|t| contest_of(t).map_or_else(Cell::default, closest));
        std::iter::once(scale.label.as_str().into()).chain(cells).collect()
    });
    let head = std::iter::once("Closest").chain(textures.iter().copied()).map(str::to_owned);
    Table {
        title: "Closest on each texture".into(),
        head: head.collect(),
        rows: rows.collect(),
        notes: vec![
            "In small type: its RMSE over the reference’s mean radiance; how many unfiltered samples a pixel reach the \
             same. = joins methods that tie."
                .into(),
        ],
    }
}

/// The methods that came closest, their relative error and its worth.
fn closest(contest: &Contest) -> Cell {
    let names: Vec<_> = contest.winners().map(|s| label(s.method)).collect();
    let least = contest.winners().map(|s| s.error).reduce(f64::min);
    let relative = least.and_then(|e| contest.relative(e)).map(phrase::percent);
    let worths = contest.winners().filter_map(|s| s.worth);
    let worth = worths.max_by(|a, b| rank(*a).total_cmp(&rank(*b))).map(phrase::samples_short);
    let aside: Vec<_> = relative.into_iter().chain(worth).collect();
    Cell { text: names.join(" = "), aside: aside.join("; "), ..Cell::default() }
        .of_rows(contest.winners().flat_map(|s| source::relative(contest.scene, &s.method.label)))
}

/// Method by texture at one scale of a setting.
pub fn at_scale(comparison: &Comparison, setting: &Setting, scale: &Scale) -> Table {
    let textures = setting.textures();
    let contest_of = |texture: &str| setting.at(scale).find(|c| c.scene.key.texture == texture);
    let contests: Vec<_> = textures.iter().map(|t| contest_of(t)).collect();
    let methods = &comparison.results.methods;
    let cell = |c: &Option<&Contest>, method| {
        c.map_or_else(Cell::default, |c| error(comparison, c, method))
    };
    let rows = methods.iter().map(|method| {
        let errors = contests.iter().map(|c| cell(c, method));
        std::iter::once(label(method).into()).chain(errors).collect()
    });
    let foot = |name: &str, metric: &str, figure: fn(&Contest) -> f64| -> Vec<Cell> {
        let text = |c: &Option<&Contest>| {
            c.map_or_else(Cell::default, |c| {
                let row = Source::reference(c.scene, metric);
                Cell::from(phrase::number(figure(c))).of_rows([row])
            })
        };
        std::iter::once(name.into()).chain(contests.iter().map(text)).collect()
    };
    let feet = [
        foot("the reference’s own", DECIDES, |c| c.scene.reference.rmse),
        foot("its mean radiance", "mean_radiance", |c| c.mean),
    ];
    let head = std::iter::once("RMSE").chain(textures.iter().copied()).map(str::to_owned);
    Table {
        title: scale.label.clone(),
        head: head.collect(),
        rows: rows.chain(feet).collect(),
        notes: Vec::new(),
    }
}

/// A method's error in a scene and what it is worth; empty if it took no part.
fn error(comparison: &Comparison, contest: &Contest, method: &MethodInfo) -> Cell {
    match contest.standing(&method.label) {
        Some(standing) => Cell {
            text: phrase::number_within(standing.error, standing.interval),
            aside: standing.worth.map_or_else(String::new, phrase::samples_short),
            best: standing.best(),
            ..Cell::default()
        }
        .of_rows(source::worth(comparison.results, contest.scene, &method.label)),
        None if not_finite(comparison, contest, &method.label) => "not finite".into(),
        None => Cell::default(),
    }
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
        title: format!(
            "Other measures at {} a pixel, median over scenes",
            phrase::count(comparison.spp as usize, "sample")
        ),
        head: head.collect(),
        rows: rows.collect(),
        notes: vec![directions(&metrics)],
    })
}

/// Which way each metric is better, in one line.
fn directions(metrics: &[&str]) -> String {
    let found: Vec<_> =
        metrics.iter().filter_map(|m| Some(format!("{m}: {}", better(m)?))).collect();
    found.join("; ") + "."
}

fn median_score(comparison: &Comparison, label: &str, metric: &str) -> Cell {
    let spp = comparison.spp;
    let value = |c: &Contest| {
        let trial = c.scene.trials.iter().find(|t| t.method == label && t.spp == spp)?;
        let value = trial.score(metric).filter(|v| v.is_finite())?;
        Some((value, Source::of(c.scene, label, Some(spp), metric)))
    };
    let (values, rows): (Vec<f64>, Vec<Source>) = comparison.contests().filter_map(value).unzip();
    let middle = median(values, |v| v).map(|v| Cell::from(phrase::number(v)));
    middle.unwrap_or_default().of_rows(rows)
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
        let mut tables = vec![winners(setting), other_metrics(&comparison).unwrap()];
        tables.extend(setting.scales.iter().map(|s| at_scale(&comparison, setting, s)));
        for table in tables {
            assert!(table.rows.iter().all(|row| row.len() == table.head.len()), "{}", table.title);
        }
    }

    #[test]
    fn a_refused_cell_is_empty_and_a_broken_one_says_so() {
        let mut results = fixture::results();
        results.scenes[1]
            .trials
            .iter_mut()
            .filter(|t| t.method == "averaged")
            .for_each(|t| t.scores.clear());
        let comparison = Comparison::of(&results);
        let setting = &comparison.settings[0];
        let table = at_scale(&comparison, setting, &setting.scales[1]);
        assert!(table.rows[5][3].text.is_empty());
        assert_eq!(table.rows[1][1].text, "not finite");
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
