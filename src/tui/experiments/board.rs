//! The figures of an experiment, as they come in from a run or from its report.

use std::collections::{BTreeMap, BTreeSet};

use crate::experiment::runner::RunEvent;
use crate::tui::library::Row;

/// All figures of an experiment that charts and tables are made of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Board {
    /// The methods, labels with the names of those they are forms of, in the order of the spec.
    pub methods: Vec<(String, String)>,
    /// The scenes, in the order they came.
    pub scenes: Vec<Scene>,
    /// The sequences of scenes that move, in the order they came.
    pub sequences: Vec<Sequence>,
    /// Where scenes and methods are in their lists.
    places: [BTreeMap<String, usize>; 3],
}

/// A scene's figures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Its slug, after its part's name where a paper has several sweeps.
    pub slug: String,
    /// The reference's own error.
    pub own_error: Option<f64>,
    /// By method and samples a pixel.
    pub trials: BTreeMap<(usize, u32), Trial>,
    /// By method, how far its distribution of normals is from the truth.
    pub normals: BTreeMap<usize, f64>,
}

/// A trial's figures by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trial(Vec<(String, f64)>);

impl Trial {
    /// The figure of this name.
    pub fn get(&self, metric: &str) -> Option<f64> {
        self.0.iter().find(|(name, _)| name == metric).map(|(_, value)| *value)
    }

    fn set(&mut self, metric: &str, value: f64) {
        match self.0.iter_mut().find(|(name, _)| name == metric) {
            Some((_, old)) => *old = value,
            None => self.0.push((metric.to_owned(), value)),
        }
    }
}

/// A sequence's figures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sequence {
    /// Its slug: what its frames' slugs begin with.
    pub slug: String,
    /// By method and samples a pixel.
    pub trials: BTreeMap<(usize, u32), Trial>,
}

/// The figures that are of a sequence.
pub const OF_SEQUENCES: [&str; 2] = ["flicker", "error_flicker"];
/// The figures a trial that are no scores of its image.
pub const COST: &str = "ns_per_pixel";

impl Board {
    /// A board without figures, for these methods.
    pub fn new(methods: &[(String, String)]) -> Self {
        let mut board = Self::default();
        board.add_methods(methods);
        board
    }

    /// Whether it has no figures.
    pub fn is_empty(&self) -> bool {
        self.scenes.is_empty() && self.sequences.is_empty()
    }

    /// Adds the figures of a report, its scenes named after `part` if it is one of several.
    pub fn add_rows(&mut self, part: Option<&str>, methods: &[(String, String)], rows: &[Row]) {
        self.add_methods(methods);
        for row in rows {
            let slug = in_part(part, &row.scene);
            self.add(&slug, &row.method, row.spp, &row.metric, row.value);
        }
    }

    /// Takes in what a run tells of the current `part`.
    pub fn take(&mut self, part: Option<&str>, event: &RunEvent) {
        match event {
            RunEvent::Scored { scene, method, spp, scores, ns_per_pixel, .. } => {
                let slug = in_part(part, scene);
                for score in scores {
                    self.add(&slug, method, Some(*spp), &score.metric, score.value);
                }
                self.add(&slug, method, Some(*spp), COST, *ns_per_pixel);
            }
            RunEvent::Converged { scene, rmse } => {
                self.add(&in_part(part, scene), REFERENCE, None, "rmse", *rmse);
            }
            RunEvent::Probed { scene, distances } => {
                for (method, distance) in distances {
                    self.add(&in_part(part, scene), method, None, "ndf_l1", *distance);
                }
            }
            RunEvent::Flickered { sequence, method, spp, flicker, error_flicker } => {
                let slug = in_part(part, sequence);
                for (metric, value) in OF_SEQUENCES.into_iter().zip([flicker, error_flicker]) {
                    if let Some(value) = value {
                        self.add(&slug, method, Some(*spp), metric, *value);
                    }
                }
            }
            _ => {}
        }
    }

    /// Adds a figure; one that nothing here is made of is let go.
    fn add(&mut self, slug: &str, method: &str, spp: Option<u32>, metric: &str, value: f64) {
        match (method, spp, metric) {
            (_, _, "prefilter_seconds" | "bytes_per_texel") => {}
            (REFERENCE, _, "rmse") => self.scene(slug).own_error = Some(value),
            (REFERENCE, ..) => {}
            (_, _, "ndf_l1") => {
                let method = self.method(method, method);
                self.scene(slug).normals.insert(method, value);
            }
            (_, Some(spp), "flicker" | "error_flicker") => {
                let method = self.method(method, method);
                self.sequence(slug).trials.entry((method, spp)).or_default().set(metric, value);
            }
            // Of a sequence, and not drawn.
            (_, _, "change" | "error_change" | "noise") => {}
            (_, Some(spp), _) => {
                let method = self.method(method, method);
                self.scene(slug).trials.entry((method, spp)).or_default().set(metric, value);
            }
            (_, None, _) => {}
        }
    }

    fn add_methods(&mut self, methods: &[(String, String)]) {
        for (label, name) in methods {
            self.method(label, name);
        }
    }

    fn method(&mut self, label: &str, name: &str) -> usize {
        if let Some(place) = self.places[0].get(label) {
            return *place;
        }
        self.places[0].insert(label.to_owned(), self.methods.len());
        self.methods.push((label.to_owned(), name.to_owned()));
        self.methods.len() - 1
    }

    fn scene(&mut self, slug: &str) -> &mut Scene {
        let next = self.scenes.len();
        let place = *self.places[1].entry(slug.to_owned()).or_insert(next);
        if place == next {
            self.scenes.push(Scene { slug: slug.to_owned(), ..Scene::default() });
        }
        &mut self.scenes[place]
    }

    fn sequence(&mut self, slug: &str) -> &mut Sequence {
        let next = self.sequences.len();
        let place = *self.places[2].entry(slug.to_owned()).or_insert(next);
        if place == next {
            self.sequences.push(Sequence { slug: slug.to_owned(), ..Sequence::default() });
        }
        &mut self.sequences[place]
    }

    /// The place of a scene.
    pub fn place_of(&self, part: Option<&str>, slug: &str) -> Option<usize> {
        self.places[1].get(&in_part(part, slug)).copied()
    }

    /// The parts that scenes are of, in the order they came; none of a single sweep.
    pub fn parts(&self) -> Vec<&str> {
        let mut parts: Vec<&str> = Vec::new();
        for scene in &self.scenes {
            if let Some((part, _)) = scene.slug.split_once('/')
                && !parts.contains(&part)
            {
                parts.push(part);
            }
        }
        parts
    }

    /// The scenes of a part, or all of a single sweep.
    pub fn scenes_of(&self, part: Option<&str>) -> Vec<&Scene> {
        self.scenes
            .iter()
            .filter(|scene| part.is_none_or(|part| is_of(&scene.slug, part)))
            .collect()
    }

    /// The sequences of a part, or all of a single sweep.
    pub fn sequences_of(&self, part: Option<&str>) -> Vec<&Sequence> {
        self.sequences.iter().filter(|s| part.is_none_or(|part| is_of(&s.slug, part))).collect()
    }

    /// Of these scenes, those that every method with any trial took part in, or all with trials if there are
    /// none: those that means are over.
    pub fn full<'a>(scenes: &[&'a Scene]) -> Vec<&'a Scene> {
        let methods = |scene: &Scene| -> BTreeSet<usize> {
            scene.trials.keys().map(|(method, _)| *method).collect()
        };
        let all: BTreeSet<usize> = scenes.iter().flat_map(|scene| methods(scene)).collect();
        let measured = scenes.iter().copied().filter(|scene| !scene.trials.is_empty());
        let full: Vec<&Scene> = measured.clone().filter(|scene| methods(scene) == all).collect();
        if full.is_empty() { measured.collect() } else { full }
    }

    /// The sequence that a scene is a frame of.
    pub fn sequence_of(&self, scene: &Scene) -> Option<&Sequence> {
        let begins = |sequence: &&Sequence| {
            let rest = scene.slug.strip_prefix(sequence.slug.as_str());
            rest.is_some_and(|rest| rest.starts_with("-f") || rest.is_empty())
        };
        self.sequences.iter().find(begins)
    }
}

/// The method that is none.
const REFERENCE: &str = "reference";

/// A slug after its part's name.
fn in_part(part: Option<&str>, slug: &str) -> String {
    part.map_or_else(|| slug.to_owned(), |part| format!("{part}/{slug}"))
}

/// Whether a slug is of a part.
fn is_of(slug: &str, part: &str) -> bool {
    slug.strip_prefix(part).is_some_and(|rest| rest.starts_with('/'))
}

/// The geometric mean of values above zero; `None` if there are none or one is not.
pub fn geometric_mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0u32);
    for value in values {
        if value <= 0.0 || !value.is_finite() {
            return None;
        }
        (sum, count) = (sum + libm::log(value), count + 1);
    }
    (count > 0).then(|| libm::exp(sum / f64::from(count)))
}

/// The mean; `None` if there are none.
pub fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0u32);
    for value in values {
        (sum, count) = (sum + value, count + 1);
    }
    (count > 0).then(|| sum / f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::results::Score;

    fn scored(scene: &str, method: &str, spp: u32, rmse: f64) -> RunEvent {
        let scores = vec![Score { metric: "rmse".into(), value: rmse, interval: None }];
        let (scene, method) = (scene.to_owned(), method.to_owned());
        RunEvent::Scored { scene, method, spp, scores, ns_per_pixel: 7.0, kept: false }
    }

    #[test]
    fn a_run_and_its_report_fill_the_same_board() {
        let methods = [("a".to_owned(), "averaged".to_owned())];
        let mut live = Board::new(&methods);
        live.take(None, &RunEvent::Converged { scene: "s".into(), rmse: 0.01 });
        live.take(None, &scored("s", "a", 4, 0.5));
        live.take(
            None,
            &RunEvent::Probed { scene: "s".into(), distances: vec![("a".into(), 0.2)] },
        );
        let row = |method: &str, spp, metric: &str, value| Row {
            scene: "s".into(),
            method: method.into(),
            spp,
            metric: metric.into(),
            value,
        };
        let mut read = Board::default();
        let rows = [
            row("reference", Some(64), "rmse", 0.01),
            row("reference", Some(64), "mean_radiance", 1.0),
            row("a", Some(4), "rmse", 0.5),
            row("a", Some(4), COST, 7.0),
            row("a", None, "ndf_l1", 0.2),
            row("a", None, "prefilter_seconds", 0.2),
        ];
        read.add_rows(None, &methods, &rows);
        assert_eq!(live, read);
    }

    #[test]
    fn means_are_over_scenes_that_all_took_part_in() {
        let mut board = Board::default();
        board.take(Some("p"), &scored("one", "a", 1, 1.0));
        board.take(Some("p"), &scored("one", "b", 1, 1.0));
        board.take(Some("p"), &scored("two", "a", 1, 1.0));
        let full: Vec<_> =
            Board::full(&board.scenes_of(Some("p"))).iter().map(|s| s.slug.as_str()).collect();
        assert_eq!(full, ["p/one"]);
        assert_eq!(board.place_of(Some("p"), "two"), Some(1));
        assert_eq!(geometric_mean([1.0, 4.0].into_iter()), Some(2.0));
        assert_eq!(geometric_mean([1.0, 0.0].into_iter()), None);
        assert_eq!(mean([].into_iter()), None);
    }
}
