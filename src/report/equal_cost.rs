//! What brute force reaches with as much time as a method takes.

use super::contest::{BRUTE_FORCE, Comparison, brute_force_curve, geometric_mean, median};
use super::phrase;
use super::tables::{Cell, Table, label};
use crate::experiment::results::{Costs, Results, SceneResult};

/// A method and brute force in a scene, with as much time.
struct Pair {
    /// Samples a pixel that brute force has the time for.
    samples: f64,
    /// Brute force's error with them over the method's.
    ratio: f64,
}

/// A row a method. `None` without brute force to compare with.
pub fn table(comparison: &Comparison, costs: &Costs) -> Option<Table> {
    let brute = &comparison.brute_force()?.label;
    let methods = comparison.results.methods.iter().filter(|m| m.label != *brute);
    let row = |method: &crate::experiment::results::MethodInfo| {
        let of = |scene| in_scene(comparison.results, costs, scene, &method.label, comparison.spp);
        let found: Vec<Pair> = comparison.contests().filter_map(|c| of(c.scene)).collect();
        let samples = median(found.iter().map(|pair| pair.samples).collect(), |v| v);
        let ratio = geometric_mean(found.iter().map(|pair| pair.ratio));
        let nearer = found.iter().filter(|pair| pair.ratio > 1.0).count();
        let cell = |value: Option<f64>| {
            value.map_or_else(Cell::default, |value| phrase::number(value).into())
        };
        vec![
            label(method).into(),
            cell(samples),
            Cell { best: ratio.is_some_and(|ratio| ratio > 1.0), ..cell(ratio) },
            format!("{nearer} of {}", found.len()).into(),
        ]
    };
    Some(Table {
        title: "At equal cost".into(),
        head: vec![
            "Method".into(),
            format!("{brute} samples a pixel in the same time"),
            format!("RMSE of {brute} with them, ÷ the method’s"),
            "Scenes in which the method is closer".into(),
        ],
        rows: methods.map(row).collect(),
        notes: vec![format!(
            "Samples: median over scenes; a sample’s time is taken from the highest count measured. RMSE of {brute} \
             between measured counts by interpolation in log-log coordinates, and beyond them that of the nearest \
             count: no image has less than its first sample. Geometric mean over scenes; over 1, in bold, the time \
             is better spent on the filter. Prefiltering is not counted."
        )],
    })
}

fn in_scene(
    results: &Results,
    costs: &Costs,
    scene: &SceneResult,
    method: &str,
    spp: u32,
) -> Option<Pair> {
    let brute = &results.methods.iter().find(|m| m.name == BRUTE_FORCE)?.label;
    let error = scene.trials.iter().find(|t| t.method == method && t.spp == spp)?.score("rmse")?;
    let of_scene = || costs.trials.iter().filter(|t| t.scene == scene.slug);
    let own = of_scene().find(|t| t.method == method && t.spp == spp)?.ns_per_pixel;
    let most = of_scene().filter(|t| &t.method == brute).max_by_key(|t| t.spp)?;
    let samples = own * f64::from(most.spp) / most.ns_per_pixel;
    let ratio = error_at(&brute_force_curve(results, scene), samples)? / error;
    (samples.is_finite() && ratio.is_finite()).then_some(Pair { samples, ratio })
}

/// A curve's error at a number of samples, straight in log-log coordinates and level beyond its ends.
fn error_at(curve: &[(u32, f64)], samples: f64) -> Option<f64> {
    let (first, last) = (curve.first()?, curve.last()?);
    let segment = curve.windows(2).find(|pair| samples <= f64::from(pair[1].0));
    let Some([low, high]) = segment.and_then(|pair| <&[_; 2]>::try_from(pair).ok()) else {
        return Some(last.1);
    };
    if samples <= f64::from(first.0) || low.1 <= 0.0 || high.1 <= 0.0 {
        return Some(low.1);
    }
    let along =
        libm::log(samples / f64::from(low.0)) / libm::log(f64::from(high.0) / f64::from(low.0));
    Some(low.1 * libm::pow(high.1 / low.1, along))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn errors_lie_on_the_line_and_level_beyond_it() {
        let curve = [(1, 1.0), (4, 0.5), (16, 0.25)];
        let at = |samples| error_at(&curve, samples).unwrap();
        assert!((at(2.0) - 0.5f64.sqrt()).abs() < 1e-12);
        assert!((at(8.0) - 0.125f64.sqrt()).abs() < 1e-12);
        assert_eq!([at(0.1), at(1.0), at(4.0), at(99.0)], [1.0, 1.0, 0.5, 0.25]);
        assert_eq!(error_at(&[], 1.0), None);
        assert_eq!(error_at(&[(1, 0.3)], 7.0), Some(0.3));
    }

    #[test]
    fn a_method_as_dear_as_a_sample_is_set_against_a_sample() {
        let (results, mut costs) = (fixture::results(), fixture::costs());
        costs.trials.iter_mut().for_each(|t| t.ns_per_pixel = 10.0 * f64::from(t.spp));
        let scene = &results.scenes[2];
        let pair = in_scene(&results, &costs, scene, "fournier", 1).unwrap();
        let error = |m: &str| scene.trials.iter().find(|t| t.method == m).unwrap().scores[0].value;
        assert_eq!(pair.samples, 1.0);
        assert!((pair.ratio - error("unfiltered") / error("fournier")).abs() < 1e-12);
    }
}
