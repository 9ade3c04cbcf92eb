//! A report, opened.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::claims::{self, PaperRow};
use super::images::{self, SceneImages, entries};
use super::rows::{self, Metrics, Row};
use super::text::clean;
use super::{Kind, Report, reports};

/// All of a report that can be shown.
#[derive(Clone, Debug)]
pub struct Opened {
    /// Its folder.
    pub folder: PathBuf,
    /// Its kind; what is neither is taken for a sweep's.
    pub kind: Kind,
    /// Its title; may be empty.
    pub title: String,
    /// The question it answers; may be empty.
    pub question: String,
    /// The labels of the methods with the names of those they are forms of, in the order of the spec.
    pub methods: Vec<(String, String)>,
    /// All figures.
    pub rows: Vec<Row>,
    /// The scenes with their images, in the order of the spec.
    pub scenes: Vec<SceneImages>,
    /// The plots of a sweep: PNG files with their stems.
    pub plots: Vec<(String, PathBuf)>,
    /// Of a paper, its rows.
    pub paper: Vec<PaperRow>,
    /// What is wrong with it, a sentence each.
    pub problems: Vec<String>,
}

/// Opens the report in `folder`. Whatever is missing or damaged is told of in [`Opened::problems`].
pub fn open(folder: &Path) -> Opened {
    let mut opened = Opened {
        folder: folder.to_owned(),
        kind: Kind::Sweep,
        title: String::new(),
        question: String::new(),
        methods: Vec::new(),
        rows: Vec::new(),
        scenes: Vec::new(),
        plots: Vec::new(),
        paper: Vec::new(),
        problems: Vec::new(),
    };
    if !folder.is_dir() {
        opened.problems.push(format!("there is no folder {}", folder.display()));
    } else if reports::kind_of(folder) == Kind::Paper {
        opened.kind = Kind::Paper;
        if let Ok(bytes) = std::fs::read(folder.join("evidence.json")) {
            rows::is_known("evidence.json", &bytes, &mut opened.problems);
        }
        opened.paper = claims::rows(folder, &mut opened.problems);
        opened.title = reports::title_of(folder);
    } else {
        opened.fill();
    }
    opened
}

impl Opened {
    /// Reads a sweep.
    fn fill(&mut self) {
        let (folder, problems) = (self.folder.as_path(), &mut self.problems);
        match rows::metrics_json(folder, problems) {
            Some(metrics) => {
                self.rows = metrics.rows();
                self.scenes = scenes(folder, &metrics, problems);
                let label = |m: &rows::Method| (clean(&m.label), clean(&m.name));
                self.methods = metrics.methods.iter().map(label).collect();
                (self.title, self.question) = (clean(&metrics.title), clean(&metrics.question));
            }
            None => {
                self.rows = rows::metrics_csv(folder, problems);
                self.scenes = images::found_in(folder);
                self.title = reports::title_of(folder);
            }
        }
        self.rows.extend(rows::costs(folder, problems));
        self.rows.extend(rows::flicker(folder, problems));
        if self.methods.is_empty() {
            let mut seen = HashSet::new();
            let labels = self.rows.iter().map(|row| &row.method);
            let new = labels.filter(|label| *label != "reference" && seen.insert(*label));
            self.methods = new.map(|label| (label.clone(), label.clone())).collect();
        }
        self.plots = images::files(&folder.join("plots"), "png");
    }
}

/// The scenes of `metrics.json` with the images of their trials.
fn scenes(folder: &Path, metrics: &Metrics, problems: &mut Vec<String>) -> Vec<SceneImages> {
    let mut missing = 0;
    let of = |scene: &rows::Scene| {
        let mut seen = HashSet::new();
        let shown = scene.metrics.iter().filter(|figure| figure.method != "reference");
        let trials = shown.filter_map(|figure| Some((figure.method.clone(), figure.spp?)));
        let trials: Vec<_> = trials.filter(|trial| seen.insert(trial.clone())).collect();
        images::of_scene(folder, &scene.slug, trials.into_iter(), &mut missing)
    };
    let mut scenes: Vec<SceneImages> = metrics.scenes.iter().map(of).collect();
    // Slugs led to files; from here on they are only shown and compared.
    scenes.iter_mut().for_each(|scene| scene.slug = clean(&scene.slug));
    if missing > 0 {
        let count =
            if missing == 1 { "1 image is".into() } else { format!("{missing} images are") };
        problems.push(format!("{count} missing: run the experiment again to have them"));
    }
    scenes
}

/// The reports of a paper's parts that are in its folder.
pub fn parts(folder: &Path) -> Vec<(String, PathBuf)> {
    let within = entries(folder, |path| path.is_dir());
    within.into_iter().filter(|(_, path)| Report::is_one(path)).collect()
}
