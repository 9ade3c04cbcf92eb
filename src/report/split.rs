//! An error split in two: the lookup's part and the lobe's.
//!
//! A method by the exact lookup makes its lobes of just the normals under each footprint: what is still wrong is
//! the lobe's doing. What another lookup changes about that image is the lookup's doing.

use super::contest::{Comparison, DECIDES, Setting, geometric_mean, mean_radiance};
use super::phrase;
use super::scale::Scale;
use super::tables::{Cell, Table, label};
use crate::experiment::results::{MethodInfo, SceneResult, TrialResult};
use crate::metric;
use crate::texture::Lookup;

/// The RMSE of a method in a scene, and its parts.
struct Split {
    all: f64,
    lobe: f64,
    lookup: f64,
}

/// The split errors of a setting, scale by scale. `None` if no method was used by the exact lookup.
pub fn split(comparison: &Comparison, setting: &Setting) -> Option<Table> {
    let methods = &comparison.results.methods;
    let pairs: Vec<(&MethodInfo, &MethodInfo)> = methods
        .iter()
        .filter(|method| method.lookup.is_some_and(|lookup| lookup != Lookup::Exact))
        .filter_map(|method| Some((method, methods.iter().find(|m| is_exact(m, method))?)))
        .collect();
    let row = |&(method, exact): &(&MethodInfo, &MethodInfo)| {
        let cells =
            setting.scales.iter().map(|scale| cell(comparison, setting, scale, method, exact));
        std::iter::once(Cell::from(label(method))).chain(cells).collect()
    };
    let rows: Vec<Vec<Cell>> = pairs.iter().map(row).collect();
    let head =
        std::iter::once("Method".to_owned()).chain(setting.scales.iter().map(|s| s.label.clone()));
    let note = "RMSE over the mean radiance of the reference, geometric mean over textures; beside it its parts. Lobe: \
                RMSE of the same method by the exact lookup, which makes its lobes of just the normals under each \
                footprint. Lookup: RMSE between the images by this and by the exact lookup. Where the two err in \
                different pixels, their squares add up to that of the whole.";
    let (title, notes) =
        ("What of an error is the lookup’s, what the lobe’s".into(), vec![note.into()]);
    (!rows.is_empty()).then(|| Table { title, head: head.collect(), rows, notes })
}

/// Whether a method is another by the exact lookup.
fn is_exact(exact: &MethodInfo, of: &MethodInfo) -> bool {
    let plain = |m: &MethodInfo| -> Vec<String> {
        m.options.iter().filter(|option| !option.starts_with("lookup = ")).cloned().collect()
    };
    exact.lookup == Some(Lookup::Exact) && exact.name == of.name && plain(exact) == plain(of)
}

fn cell(
    comparison: &Comparison,
    setting: &Setting,
    scale: &Scale,
    method: &MethodInfo,
    exact: &MethodInfo,
) -> Cell {
    let found: Vec<Split> = setting
        .at(scale)
        .filter_map(|contest| of_scene(contest.scene, comparison.spp, method, exact))
        .collect();
    let mean = |part: fn(&Split) -> f64| {
        let value = geometric_mean(found.iter().map(part));
        value.map_or_else(String::new, phrase::percent)
    };
    if found.is_empty() {
        return Cell::default();
    }
    let aside = format!("lobe {}, lookup {}", mean(|s| s.lobe), mean(|s| s.lookup));
    Cell { text: mean(|s| s.all), aside, ..Cell::default() }
}

fn of_scene(
    scene: &SceneResult,
    spp: u32,
    method: &MethodInfo,
    exact: &MethodInfo,
) -> Option<Split> {
    let trial = |of: &MethodInfo| -> Option<&TrialResult> {
        scene.trials.iter().find(|trial| trial.method == of.label && trial.spp == spp)
    };
    let (own, exact) = (trial(method)?, trial(exact)?);
    let between = metric::score(DECIDES, &own.film, &exact.film)?;
    let mean = mean_radiance(scene);
    let split = Split { all: own.score(DECIDES)?, lobe: exact.score(DECIDES)?, lookup: between };
    let parts = [split.all, split.lobe, split.lookup].map(|part| part / mean);
    let [all, lobe, lookup] = parts;
    parts.iter().all(|part| part.is_finite()).then_some(Split { all, lobe, lookup })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn only_what_has_an_exact_twin_is_split() {
        let mut results = fixture::results();
        let of = |results: &_| {
            let comparison = Comparison::of(results);
            comparison.settings.iter().find_map(|setting| split(&comparison, setting))
        };
        assert!(of(&results).is_none());
        // The second method, once more, as an exact twin of the third.
        let twin = results.methods[2].clone();
        results.methods[1].lookup = Some(Lookup::Exact);
        results.methods[1].name = twin.name.clone();
        results.methods[1].options = [twin.options.clone(), vec!["lookup = exact".into()]].concat();
        let table = of(&results).unwrap();
        assert_eq!(table.rows.len(), 1);
        let cell = &table.rows[0][1];
        assert!(cell.text.contains('%') && cell.aside.starts_with("lobe "), "{}", cell.aside);
    }
}
