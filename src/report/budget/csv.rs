//! `budget.csv`: one row a scene, method and part. docs/results.md is its manual.

use super::super::tidy::{round_trip, table};
use crate::experiment::results::{Budget, Results, SceneResult};

/// The columns of `budget.csv`, in order.
const COLUMNS: [&str; 15] = [
    "scene",
    "texture",
    "surface",
    "light",
    "lobe",
    "parameter",
    "shading",
    "texels_per_pixel",
    "elevation",
    "method",
    "part",
    "rmse",
    "rmse_alone",
    "share",
    "nothing",
];

/// `budget.csv`.
pub fn csv(results: &Results) -> Vec<u8> {
    let scenes = results.scenes.iter();
    let budgets = scenes.flat_map(|scene| scene.budgets.iter().map(move |budget| (scene, budget)));
    table(COLUMNS, budgets.flat_map(|(scene, budget)| rows(scene, budget)))
}

/// The method as it is, then its parts, then what remains.
fn rows(scene: &SceneResult, budget: &Budget) -> Vec<[String; 15]> {
    let balance = &budget.balance;
    let mut shares = balance.shares().into_iter().map(round_trip);
    let mut share = || shares.next().unwrap_or_default();
    let root = |square: f64| round_trip(square.sqrt());
    let row = |part: &str, [rmse, alone, share, nothing]: [String; 4]| {
        let key = &scene.key;
        [
            scene.slug.clone(),
            key.texture.clone(),
            key.surface.clone(),
            key.light.clone(),
            key.lobe.clone(),
            round_trip(key.parameter),
            key.shading.clone(),
            round_trip(key.texels_per_pixel),
            round_trip(key.elevation),
            budget.method.clone(),
            part.to_owned(),
            rmse,
            alone,
            share,
            nothing,
        ]
    };
    let empty = String::new;
    let mut all = vec![row("none", [root(balance.whole), empty(), empty(), empty()])];
    for entry in &balance.entries {
        let nothing = entry.nothing.clone().unwrap_or_default();
        let figures = [root(entry.left), root(entry.alone), share(), nothing];
        all.push(row(entry.part.name(), figures));
    }
    let noise = balance.entries.last().map_or(f64::NAN, |entry| entry.left);
    all.push(row("noise", [root(noise), empty(), share(), empty()]));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::budget::tests::with_budgets;

    #[test]
    fn the_shares_of_each_method_sum_to_one() {
        let results = with_budgets();
        let bytes = csv(&results);
        let mut reader = ::csv::Reader::from_reader(bytes.as_slice());
        assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), COLUMNS);
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        let budgets: usize = results.scenes.iter().map(|scene| scene.budgets.len()).sum();
        assert_eq!(records.len(), 10 * budgets);
        for method in records.chunks(10) {
            let sum: f64 = method.iter().filter_map(|row| row[13].parse::<f64>().ok()).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
        }
    }
}
