//! Where a printed figure comes from: rows of `metrics.csv`.

use std::collections::BTreeMap;

use super::contest::{BRUTE_FORCE, Contest, DECIDES};
use super::tables::Table;
use super::tidy;
use crate::experiment::results::{Results, SceneResult};

/// A row of `metrics.csv`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source {
    scene: String,
    method: String,
    spp: Option<u32>,
    metric: String,
}

impl Source {
    /// The row of a method's score in a scene; `spp` is `None` for what has no samples.
    pub fn of(scene: &SceneResult, method: &str, spp: Option<u32>, metric: &str) -> Self {
        let scene = scene.slug.clone();
        Self { scene, method: method.to_owned(), spp, metric: metric.to_owned() }
    }

    /// The row of something that is known of a scene's reference.
    pub fn reference(scene: &SceneResult, metric: &str) -> Self {
        Self::of(scene, "reference", Some(scene.reference.spp), metric)
    }
}

/// The row of a method's error in a scene, at the fewest samples it was measured at: what methods are compared by.
pub fn error(scene: &SceneResult, method: &str) -> Option<Source> {
    let of_method = scene.trials.iter().filter(|trial| trial.method == method);
    let spp = of_method.map(|trial| trial.spp).min()?;
    Some(Source::of(scene, method, Some(spp), DECIDES))
}

/// The rows that an error relative to the reference's mean radiance follows from.
pub fn relative(scene: &SceneResult, method: &str) -> Vec<Source> {
    error(scene, method).into_iter().chain([Source::reference(scene, "mean_radiance")]).collect()
}

/// The rows that an error's worth in samples follows from: the error, and brute force's at every count.
pub fn worth(results: &Results, scene: &SceneResult, method: &str) -> Vec<Source> {
    let brute = results.methods.iter().find(|m| m.name == BRUTE_FORCE);
    let curve = scene.trials.iter().filter(|t| brute.is_some_and(|brute| brute.label == t.method));
    let curve = curve.map(|t| Source::of(scene, &t.method, Some(t.spp), DECIDES));
    error(scene, method).into_iter().chain(curve).collect()
}

/// The rows that a ratio of two methods' errors follows from, over the contests that both took part in.
pub fn ratio<'a>(
    contests: impl Iterator<Item = &'a Contest<'a>>,
    one: &str,
    other: &str,
) -> Vec<Source> {
    let both = contests.filter(|c| c.standing(one).is_some() && c.standing(other).is_some());
    both.flat_map(|c| [error(c.scene, one), error(c.scene, other)]).flatten().collect()
}

/// At which line of `metrics.csv` each row stands; its head is line 1.
pub struct Lines(BTreeMap<Source, usize>);

impl Lines {
    /// The lines of these results.
    pub fn of(results: &Results) -> Self {
        let rows = results.scenes.iter().flat_map(|scene| {
            tidy::scene_rows(scene).map(|row| Source::of(scene, row.method, row.spp, row.metric))
        });
        Self(rows.zip(2..).collect())
    }

    /// The line of a row, if it has one.
    pub fn line(&self, source: &Source) -> Option<usize> {
        self.0.get(source).copied()
    }

    /// Writes into each cell of a table the lines that its figures follow from, as `12 40 41`.
    pub fn trace(&self, table: &mut Table) {
        for cell in table.rows.iter_mut().flatten() {
            let mut lines: Vec<usize> = cell.sources.iter().filter_map(|s| self.line(s)).collect();
            lines.sort_unstable();
            lines.dedup();
            let lines: Vec<String> = lines.iter().map(usize::to_string).collect();
            cell.lines = lines.join(" ");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn a_line_holds_the_figure_it_is_given_for() {
        let results = fixture::results();
        let text = String::from_utf8(tidy::csv(&results)).unwrap();
        let written: Vec<&str> = text.lines().collect();
        let lines = Lines::of(&results);
        for scene in &results.scenes {
            for trial in &scene.trials {
                let source = Source::of(scene, &trial.method, Some(trial.spp), "rmse");
                let line = written[lines.line(&source).unwrap() - 1];
                let value = tidy::round_trip(trial.score("rmse").unwrap());
                let told = format!(",{},{},rmse,{value},", trial.method, trial.spp);
                assert!(line.starts_with(&scene.key.texture) && line.contains(&told), "{line}");
            }
            let own = lines.line(&Source::reference(scene, "rmse")).unwrap();
            assert!(written[own - 1].contains(",reference,4096,rmse,"));
        }
    }
}
