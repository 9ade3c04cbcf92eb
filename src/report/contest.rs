//! Results arranged for comparison: settings, scales, and in each scene who came closest.

use super::phrase;
use super::scale::{Scale, scales};
use crate::experiment::results::{MethodInfo, Results, SceneKey, SceneResult, TrialResult};
use crate::geometry::elementary::{exp64, ln64};
use crate::metric::{Equivalent, Lead, Verdict, equivalent_samples};

/// The metric that decides: root mean square error against the reference.
pub const DECIDES: &str = "rmse";
/// The registry's name of the method that is brute force when given many samples.
pub const BRUTE_FORCE: &str = "unfiltered";

/// One method in one scene, at the fewest samples a pixel that the experiment used.
pub struct Standing<'a> {
    /// The method.
    pub method: &'a MethodInfo,
    /// Its RMSE.
    pub error: f64,
    /// What that is worth in unfiltered samples; `None` if there is no brute-force curve.
    pub worth: Option<Equivalent>,
    /// Where its RMSE before a reference without noise lies 95 times in 100, if that is known.
    pub interval: Option<[f64; 2]>,
    /// What can be said of the closest method's lead over it; `Level` of the closest itself.
    pub behind: Verdict,
}

impl Standing<'_> {
    /// Whether nothing is closer beyond the reference's noise, by as much as is worth reporting.
    pub fn best(&self) -> bool {
        self.behind != Verdict::Ahead
    }
}

/// All methods in one scene.
pub struct Contest<'a> {
    /// The scene.
    pub scene: &'a SceneResult,
    /// The mean radiance of its reference.
    pub mean: f64,
    /// Who was measured, in the order of the spec.
    pub standings: Vec<Standing<'a>>,
}

impl<'a> Contest<'a> {
    fn of(results: &'a Results, scene: &'a SceneResult, spp: u32) -> Self {
        let curve = brute_force_curve(results, scene);
        let trial = |method: &MethodInfo| {
            scene.trials.iter().find(|t| t.method == method.label && t.spp == spp)
        };
        let measured = results.methods.iter().filter_map(|method| {
            let score = trial(method)?.scores.iter().find(|s| s.metric == DECIDES)?;
            let error = Some(score.value).filter(|e| e.is_finite())?;
            let (worth, interval) = (equivalent_samples(&curve, error), score.interval);
            Some(Standing { method, error, worth, interval, behind: Verdict::Level })
        });
        let mut standings: Vec<_> = measured.collect();
        let closest = standings.iter().min_by(|a, b| a.error.total_cmp(&b.error));
        if let Some(near) = closest.and_then(|closest| trial(closest.method)) {
            for standing in &mut standings {
                let of = &scene.reference;
                let lead = |far: &TrialResult| {
                    Lead::of(&near.film, &far.film, &of.film, &of.variance, of.gap).verdict()
                };
                standing.behind = trial(standing.method).map_or(Verdict::Level, lead);
            }
        }
        Self { scene, mean: mean_radiance(scene), standings }
    }

    /// The methods that came closest: one, or all that tie.
    pub fn winners(&self) -> impl Iterator<Item = &Standing<'a>> {
        self.standings.iter().filter(|s| s.best())
    }

    /// The methods that the reference's noise leaves open whether they are farther off than the closest.
    pub fn undecided(&self) -> impl Iterator<Item = &Standing<'a>> {
        self.standings.iter().filter(|s| s.behind == Verdict::Undecided)
    }

    /// An error as a part of the reference's mean radiance.
    pub fn relative(&self, error: f64) -> Option<f64> {
        (self.mean > 0.0).then(|| error / self.mean)
    }

    /// `twill at 4 texels a pixel`.
    pub fn name(&self) -> String {
        let key = &self.scene.key;
        format!("{} at {}", key.texture, super::scale::texels(key.texels_per_pixel))
    }

    /// The standing of a method.
    pub fn standing(&self, label: &str) -> Option<&Standing<'a>> {
        self.standings.iter().find(|s| s.method.label == label)
    }
}

/// Scenes that differ in texture and scale only.
pub struct Setting<'a> {
    /// Surface, light, base lobe and shading, in words.
    pub name: String,
    /// Its scales, from fine to coarse.
    pub scales: Vec<Scale>,
    /// One a scene, in the order of the results.
    pub contests: Vec<Contest<'a>>,
}

impl<'a> Setting<'a> {
    /// The scenes of one scale.
    pub fn at<'b>(&'b self, scale: &'b Scale) -> impl Iterator<Item = &'b Contest<'a>> {
        scale.members.iter().map(|&i| &self.contests[i])
    }

    /// The texture names, in the order of first appearance.
    pub fn textures(&self) -> Vec<&'a str> {
        unique(self.contests.iter().map(|c| c.scene.key.texture.as_str()))
    }
}

/// The whole experiment, arranged.
pub struct Comparison<'a> {
    /// What is arranged.
    pub results: &'a Results,
    /// Samples a pixel at which methods are compared: the fewest that any trial used.
    pub spp: u32,
    /// Settings in the order of the results.
    pub settings: Vec<Setting<'a>>,
}

impl<'a> Comparison<'a> {
    /// Arranges results.
    pub fn of(results: &'a Results) -> Self {
        let counts = results.scenes.iter().flat_map(|s| s.trials.iter().map(|t| t.spp));
        let spp = counts.min().unwrap_or(1);
        let named: Vec<String> =
            results.scenes.iter().map(|scene| setting_name(results, &scene.key)).collect();
        let settings = unique(named.iter())
            .into_iter()
            .map(|name| setting(results, &named, name, spp))
            .collect();
        Self { results, spp, settings }
    }

    /// Every contest in which at least one method was measured.
    pub fn contests(&self) -> impl Iterator<Item = &Contest<'a>> + Clone {
        self.settings.iter().flat_map(|s| &s.contests).filter(|c| !c.standings.is_empty())
    }

    /// The brute-force method, if the experiment has it.
    pub fn brute_force(&self) -> Option<&'a MethodInfo> {
        self.results.methods.iter().find(|m| m.name == BRUTE_FORCE)
    }
}

fn setting<'a>(results: &'a Results, named: &[String], name: &str, spp: u32) -> Setting<'a> {
    let of_name = results.scenes.iter().zip(named).filter(|(_, of)| *of == name);
    let scenes: Vec<&SceneResult> = of_name.map(|(scene, _)| scene).collect();
    let keys: Vec<_> = scenes.iter().map(|s| &s.key).collect();
    let contests = scenes.iter().map(|scene| Contest::of(results, scene, spp)).collect();
    Setting { name: name.to_owned(), scales: scales(&keys), contests }
}

/// Surface, light, base lobe and shading of a scene, in words; the camera's elevation where there are several.
pub fn setting_name(results: &Results, key: &SceneKey) -> String {
    let parameter = if key.lobe == "blinn-phong" { "exponent" } else { "α" };
    let several = results.scenes.iter().any(|other| other.key.elevation != key.elevation);
    let from = if several {
        format!(" seen from {}°", phrase::scale(key.elevation))
    } else {
        String::new()
    };
    format!(
        "{}{from}, {} light, {} lobe with {parameter} {}, {} shading",
        key.surface,
        key.light,
        key.lobe,
        phrase::scale(key.parameter),
        key.shading
    )
}

/// The name that all forms of one method share: a printed form is named after the normalised one.
pub fn family(method: &MethodInfo) -> &str {
    method.name.strip_suffix("-printed").unwrap_or(&method.name)
}

/// The mean radiance of a scene's reference, summed in the order of its pixels.
pub fn mean_radiance(scene: &SceneResult) -> f64 {
    let pixels = scene.reference.film.pixels();
    pixels.iter().map(|p| f64::from(*p)).sum::<f64>() / pixels.len() as f64
}

/// (samples a pixel, RMSE) of the brute-force method, in rising order.
pub fn brute_force_curve(results: &Results, scene: &SceneResult) -> Vec<(u32, f64)> {
    let label = results.methods.iter().find(|m| m.name == BRUTE_FORCE).map(|m| m.label.as_str());
    label.map_or_else(Vec::new, |label| curve(scene, label))
}

/// (samples a pixel, RMSE) of one method in one scene, in rising order.
pub fn curve(scene: &SceneResult, label: &str) -> Vec<(u32, f64)> {
    let of_method = scene.trials.iter().filter(|t| t.method == label);
    let scored = of_method.filter_map(|t| Some((t.spp, t.score(DECIDES)?)));
    let mut curve: Vec<_> = scored.filter(|(_, error)| error.is_finite()).collect();
    curve.sort_by_key(|&(spp, _)| spp);
    curve
}

/// A key that orders equivalents from worst to best.
pub fn rank(worth: Equivalent) -> f64 {
    match worth {
        Equivalent::FewerThan(_) => 0.0,
        Equivalent::Samples(samples) => samples,
        Equivalent::MoreThan(_) => f64::INFINITY,
    }
}

/// Items without repeats, in the order of first appearance.
pub fn unique<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut seen = Vec::new();
    for item in items {
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    seen
}

/// Geometric mean of the positive values; `None` if there are none.
pub fn geometric_mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let logs: Vec<f64> = values.filter(|v| *v > 0.0 && v.is_finite()).map(ln64).collect();
    (!logs.is_empty()).then(|| exp64(logs.iter().sum::<f64>() / logs.len() as f64))
}

/// The middle value; the lower one of two.
pub fn median<T: Copy>(mut values: Vec<T>, key: impl Fn(T) -> f64) -> Option<T> {
    values.sort_by(|a, b| key(*a).total_cmp(&key(*b)));
    values.get(values.len().saturating_sub(1) / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn a_lead_that_noise_explains_or_that_is_too_small_to_report_is_a_tie() {
        let mut results = fixture::results();
        let label = |c: &Contest| c.winners().map(|s| s.method.label.clone()).collect::<Vec<_>>();
        let comparison = Comparison::of(&results);
        let alone = label(comparison.contests().next().unwrap());
        assert_eq!(alone.len(), 1);
        let mut blurred = results.clone();
        for scene in &mut blurred.scenes {
            scene.reference.variance.fill(1e4);
        }
        let comparison = Comparison::of(&blurred);
        let first = comparison.contests().next().unwrap();
        assert_eq!(label(first).len(), first.standings.len());
        assert!(first.undecided().count() > 0);
        for scene in &mut results.scenes {
            scene.reference.gap = 100.0;
        }
        let comparison = Comparison::of(&results);
        let first = comparison.contests().next().unwrap();
        assert_eq!(label(first).len(), first.standings.len());
        assert_eq!(first.undecided().count(), 0);
    }

    #[test]
    fn means_and_medians() {
        let mean = geometric_mean([1.0, 4.0, 0.0, 16.0].into_iter()).unwrap();
        assert!((mean - 4.0).abs() < 1e-12);
        assert_eq!(geometric_mean([0.0].into_iter()), None);
        assert_eq!(median(vec![3.0, 1.0, 2.0, 9.0], |v| v), Some(2.0));
        assert_eq!(median(Vec::<f64>::new(), |v| v), None);
    }
}
