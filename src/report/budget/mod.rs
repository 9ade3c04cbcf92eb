//! Budgets of errors: `budget.csv`, a table and a figure of each setting, and in words what is the biggest part.

pub mod csv;
mod plot;
mod tables;

use serde::Serialize;

use super::contest::{Comparison, Setting};
use super::figure::Figure;
use super::tables::Table;
use crate::experiment::results::SceneResult;
use crate::render::Part;
use crate::scene::Balance;

/// What a report says of budgets.
#[derive(Serialize)]
pub struct Section {
    /// How the figures come about.
    reading: Vec<String>,
    /// The parts and what each is replaced by.
    parts: Vec<PartMeaning>,
    /// The settings that have budgets.
    settings: Vec<SettingBudget>,
}

#[derive(Serialize)]
struct PartMeaning {
    name: &'static str,
    meaning: &'static str,
}

#[derive(Serialize)]
struct SettingBudget {
    name: String,
    /// A sentence a method.
    words: Vec<String>,
    table: Table,
    figure: Option<Figure>,
}

impl Section {
    /// The section, if any budget was drawn up.
    pub fn of(comparison: &Comparison) -> Option<Self> {
        let settings = comparison.settings.iter().enumerate().filter_map(|(number, setting)| {
            let totals = totals(comparison, setting);
            (!totals.is_empty()).then(|| SettingBudget {
                name: setting.name.clone(),
                words: tables::words(&totals),
                table: tables::table(&totals),
                figure: plot::figure(comparison, setting, number + 1),
            })
        });
        let settings: Vec<SettingBudget> = settings.collect();
        (!settings.is_empty()).then(|| Self { reading: reading(), parts: meanings(), settings })
    }

    /// Its figures.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.settings.iter().filter_map(|setting| setting.figure.as_ref())
    }
}

fn reading() -> Vec<String> {
    let text = [
        "A filter’s pixel at one sample is its lobes for the pixel’s footprint, shaded at the pixel’s centre; the truth \
         is the mean over the pixel. Part after part of the filter is replaced by what is true under the pixel, and \
         what that takes off the mean squared error is the part’s share. The shares, with the noise that remains, add \
         up to the whole error of the filter’s image. A share below 0 says that the part, wrong as it was, made up for \
         another.",
        "Mean, width and anisotropy are those of the slopes. Where one is replaced, the method’s own distribution is \
         moved, widened or sheared until its moment is the true one: what it has of form stays. A part’s share depends \
         on what was replaced before it; beside it stands what replacing it alone takes off.",
    ];
    text.map(str::to_owned).to_vec()
}

fn meanings() -> Vec<PartMeaning> {
    let meaning = |part| match part {
        Part::Lookup => {
            "replaced by the exact lookup: the normals of just the texels under the footprint"
        }
        Part::Energy => "how much light there is in all, ∫ D cosθ dω",
        Part::Direction => "the mean slope",
        Part::Width => "the trace of the slopes’ covariance",
        Part::Anisotropy => "the covariance in full",
        Part::Shape => "replaced by the true distribution itself, every base lobe under the pixel",
        Part::Centre => {
            "light and eye, which the filter takes at the pixel’s centre, as each point under the pixel has them"
        }
        Part::Shadowing => "the shadows of the reference, in place of the filter’s own or of none",
    };
    Part::ALL.map(|part| PartMeaning { name: part.name(), meaning: meaning(part) }).into()
}

/// A method's errors in the scenes of a setting, each over the scene's mean radiance squared, added up.
struct Total<'a> {
    /// Its label, as tables have it.
    label: String,
    balance: Balance,
    /// The balances that were added, with their scenes' names.
    scenes: Vec<&'a SceneResult>,
}

/// The totals of a setting's methods, in their order; those without an error are left out.
fn totals<'a>(comparison: &Comparison<'a>, setting: &Setting<'a>) -> Vec<Total<'a>> {
    let of = |method: &crate::experiment::results::MethodInfo| {
        let found = setting.contests.iter().filter_map(|contest| {
            let balance = balance(contest.scene, &method.label)?;
            let relative = 1.0 / (contest.mean * contest.mean);
            (balance.whole.is_finite() && relative.is_finite()).then_some((
                contest.scene,
                balance,
                relative,
            ))
        });
        let found: Vec<(&SceneResult, &Balance, f64)> = found.collect();
        let (_, first, _) = found.first()?;
        let mut sum = Balance { whole: 0.0, ..(*first).clone() };
        sum.entries.iter_mut().for_each(|entry| (entry.left, entry.alone) = (0.0, 0.0));
        for (_, balance, relative) in &found {
            sum.whole += relative * balance.whole;
            for (total, entry) in sum.entries.iter_mut().zip(&balance.entries) {
                total.left += relative * entry.left;
                total.alone += relative * entry.alone;
                if entry.nothing.is_none() {
                    total.nothing = None;
                }
            }
        }
        let scenes = found.into_iter().map(|(scene, ..)| scene).collect();
        let label = super::tables::label(method);
        (sum.whole > 0.0).then_some(Total { label, balance: sum, scenes })
    };
    comparison.results.methods.iter().filter_map(of).collect()
}

/// A method's balance in a scene.
fn balance<'a>(scene: &'a SceneResult, label: &str) -> Option<&'a Balance> {
    scene.budgets.iter().find(|budget| budget.method == label).map(|budget| &budget.balance)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::experiment::results::{Budget, Results};
    use crate::report::fixture;
    use crate::scene::Entry;

    /// The made-up experiment with made-up budgets: of the averaged method mostly width, of others shape.
    pub fn with_budgets() -> Results {
        let mut results = fixture::results();
        for scene in &mut results.scenes {
            let budget = |trial: &crate::experiment::results::TrialResult| {
                let whole = trial.score("rmse")?.powi(2);
                let left = match trial.method.as_str() {
                    "averaged" => [0.95, 0.95, 0.9, 0.2, 0.1, 0.02, 0.01, 0.01],
                    _ => [0.7, 0.7, 0.6, 0.7, 0.5, 0.02, 0.01, 0.01],
                };
                let entry = |(&part, left): (&Part, f64)| Entry {
                    part,
                    left: whole * left,
                    alone: whole * (0.5 + 0.5 * left),
                    nothing: (part == Part::Shadowing).then(|| "nothing has shadows".into()),
                };
                let entries = Part::ALL.iter().zip(left).map(entry).collect();
                let balance = Balance { whole, entries };
                Some(Budget { method: trial.method.clone(), balance })
            };
            let first = scene.trials.iter().filter(|trial| trial.spp == 1);
            scene.budgets = first.filter_map(budget).collect();
        }
        results
    }

    #[test]
    fn no_budgets_no_section() {
        let results = fixture::results();
        assert!(Section::of(&Comparison::of(&results)).is_none());
    }

    #[test]
    fn every_method_has_a_row_and_a_sentence() {
        let results = with_budgets();
        let section = Section::of(&Comparison::of(&results)).unwrap();
        let setting = &section.settings[0];
        assert_eq!(setting.table.rows.len(), results.methods.len());
        assert_eq!(setting.words.len(), results.methods.len());
        assert!(setting.table.rows.iter().all(|row| row.len() == setting.table.head.len()));
        assert!(setting.words[1].starts_with("averaged: width 70"), "{}", setting.words[1]);
        assert_eq!(section.figures().count(), section.settings.len());
    }

    #[test]
    fn what_is_not_finite_is_left_out() {
        let mut results = with_budgets();
        for scene in &mut results.scenes {
            scene.budgets[0].balance.whole = f64::NAN;
            scene.budgets[1].balance.whole = 0.0;
        }
        let section = Section::of(&Comparison::of(&results)).unwrap();
        assert_eq!(section.settings[0].table.rows.len(), results.methods.len() - 2);
    }
}
