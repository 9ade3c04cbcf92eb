//! Costs, kept apart from everything reproducible: `costs.csv` and `costs.md`.

use minijinja::context;
use minijinja::value::Serde;
use serde::Serialize;

use super::contest::{Comparison, brute_force_curve, geometric_mean, median};
use super::equal_cost;
use super::figure::Figure;
use super::page;
use super::pareto;
use super::phrase;
use super::tables::{Cell, Table, label};
use super::template::render;
use super::tidy::{round_trip, table};
use crate::experiment::results::{Costs, Results, SceneResult};
use crate::metric::{SpeedUp, equivalent_samples};

const COLUMNS: [&str; 8] =
    ["kind", "scene", "method", "lobe", "parameter", "spp", "measure", "value"];

/// `costs.csv`: one row a measure.
pub fn csv(costs: &Costs) -> Vec<u8> {
    let prefilters = costs.prefilters.iter().flat_map(|p| {
        [("seconds", p.secs), ("bytes_per_texel", p.bytes_per_texel)].map(|(measure, value)| {
            let parameter = round_trip(p.parameter);
            [
                "prefilter".to_owned(),
                p.texture.clone(),
                p.method.clone(),
                p.lobe.clone(),
                parameter,
                String::new(),
                measure.to_owned(),
                round_trip(value),
            ]
        })
    });
    let trials = costs.trials.iter().map(|t| {
        [
            "trial".to_owned(),
            t.scene.clone(),
            t.method.clone(),
            String::new(),
            String::new(),
            t.spp.to_string(),
            "ns_per_pixel".to_owned(),
            round_trip(t.ns_per_pixel),
        ]
    });
    table(COLUMNS, prefilters.chain(trials))
}

/// What each method costs and what it saves, before it is set.
#[derive(Serialize)]
pub struct CostPage {
    title: String,
    question: String,
    intro: String,
    /// Error against time.
    pub plot: Option<Figure>,
    tables: Vec<Table>,
}

impl CostPage {
    /// The costs of these results.
    pub fn of(results: &Results, costs: &Costs) -> Self {
        let comparison = Comparison::of(results);
        let caption = "RMSE against CPU time, at every number of samples measured: geometric mean of the one, median of \
                       the other, over the scenes that every method took part in. Prefiltering is not counted.";
        let plot = pareto::time(&comparison, costs);
        Self {
            title: format!("{}: costs", results.title),
            question: "What does each filter cost, on the machine that ran it?".into(),
            intro: format!(
                "The whole run took {} s on {}. These figures vary from run to run and machine to machine; everything \
                 else in this folder does not, so they stand apart.",
                phrase::number(costs.total_secs),
                phrase::count(costs.threads, "thread"),
            ),
            plot: plot.map(|plot| Figure::drawing("costs.png".into(), caption.into(), &plot)),
            tables: std::iter::once(summary(&comparison, costs))
                .chain(equal_cost::table(&comparison, costs))
                .collect(),
        }
    }
}

/// `costs.md`.
pub fn markdown(page: &CostPage) -> String {
    page::costs(&page.title, &page.intro, page.plot.as_ref(), &page.tables)
}

/// `costs.html`: the same as a page.
pub fn html(page: &CostPage) -> String {
    render("costs.html", context! { page => Serde(page) })
}

fn summary(comparison: &Comparison, costs: &Costs) -> Table {
    let head = [
        "Method",
        "Prefilter, s a map",
        "Memory, bytes a texel",
        "Render, ns a pixel",
        "Speed-up at equal error",
    ];
    let rows = comparison.results.methods.iter().map(|method| {
        let prefilters = || costs.prefilters.iter().filter(|p| p.method == method.label);
        let trials = costs.trials.iter();
        let trials = trials.filter(|t| t.method == method.label && t.spp == comparison.spp);
        vec![
            label(method).into(),
            middle(prefilters().map(|p| p.secs)),
            middle(prefilters().map(|p| p.bytes_per_texel)),
            middle(trials.map(|t| t.ns_per_pixel)),
            speed_up(comparison.results, costs, &method.label, comparison.spp),
        ]
    });
    Table {
        title: format!("Median costs at {} a pixel", phrase::count(comparison.spp as usize, "sample")),
        head: head.map(str::to_owned).to_vec(),
        rows: rows.collect(),
        notes: vec![
            "Speed-up: CPU time that unfiltered supersampling needs to reach the method’s RMSE, divided by the \
             method’s own; geometric mean over scenes. With > it is a bound: in some scene no measured \
             number of samples was enough. Prefiltering is not counted."
                .into(),
        ],
    }
}

fn middle(values: impl Iterator<Item = f64>) -> Cell {
    let found = median(values.collect(), |v| v);
    found.map_or_else(Cell::default, |v| phrase::number(v).into())
}

/// Geometric mean over scenes of brute force's time at equal error over the method's time.
fn speed_up(results: &Results, costs: &Costs, label: &str, spp: u32) -> Cell {
    let found: Vec<(f64, bool)> = results
        .scenes
        .iter()
        .filter_map(|s| scene_speed_up(results, costs, s, label, spp))
        .collect();
    let bound = if found.iter().any(|(_, bound)| *bound) { "> " } else { "" };
    let mean = geometric_mean(found.iter().map(|(ratio, _)| *ratio));
    mean.map_or_else(Cell::default, |mean| format!("{bound}{}", phrase::number(mean)).into())
}

/// The ratio in one scene, and whether it is a lower bound.
fn scene_speed_up(
    results: &Results,
    costs: &Costs,
    scene: &SceneResult,
    label: &str,
    spp: u32,
) -> Option<(f64, bool)> {
    let brute = &results.methods.iter().find(|m| m.name == "unfiltered")?.label;
    let error = scene.trials.iter().find(|t| t.method == label && t.spp == spp)?.score("rmse")?;
    let worth = equivalent_samples(&brute_force_curve(results, scene), error)?;
    let of_scene = || costs.trials.iter().filter(|t| t.scene == scene.slug);
    let own = of_scene().find(|t| t.method == label && t.spp == spp)?.ns_per_pixel;
    // The time of a sample is steadiest at the highest count, where fixed costs vanish.
    let most = of_scene().filter(|t| &t.method == brute).max_by_key(|t| t.spp)?;
    let per_sample = most.ns_per_pixel / f64::from(most.spp.max(1));
    match worth.speed_up(per_sample, own)? {
        SpeedUp::Times(times) => Some((times, false)),
        SpeedUp::MoreThan(times) => Some((times, true)),
        // Brute force is closer with the fewest samples it was measured at: nothing to compare.
        SpeedUp::FewerThan(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Equivalent, equivalent_samples};
    use crate::report::fixture;

    #[test]
    fn every_cost_has_a_row() {
        let costs = fixture::costs();
        let text = String::from_utf8(csv(&costs)).unwrap();
        assert_eq!(text.lines().count(), 1 + 2 * costs.prefilters.len() + costs.trials.len());
    }

    #[test]
    fn speed_up_is_samples_times_their_cost() {
        let (results, mut costs) = (fixture::results(), fixture::costs());
        for trial in &mut costs.trials {
            trial.ns_per_pixel = 10.0 * f64::from(trial.spp);
        }
        let scene = &results.scenes[0];
        let (ratio, bound) = scene_speed_up(&results, &costs, scene, "fournier", 1).unwrap();
        let error = scene.trials.iter().find(|t| t.method == "fournier").unwrap().scores[0].value;
        let samples = equivalent_samples(&brute_force_curve(&results, scene), error);
        let Some(Equivalent::Samples(samples)) = samples else { panic!("{samples:?}") };
        assert!(!bound);
        assert!((ratio - samples).abs() < 1e-9 * ratio);
    }

    #[test]
    fn no_costs_is_a_table_with_empty_cells() {
        let text = markdown(&CostPage::of(&fixture::results(), &Costs::default()));
        assert!(text.contains("| fournier |"), "{text}");
    }
}
