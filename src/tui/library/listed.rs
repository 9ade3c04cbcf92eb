//! The experiments there are.

use std::path::{Path, PathBuf};

use super::text::clean;
use crate::evidence;
use crate::experiment::spec::{Experiment, Scale, Spec};
use crate::job;

/// What kind of experiment one is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One sweep.
    Sweep,
    /// The evidence of a paper: several sweeps, and rows made of them.
    Paper,
}

/// An experiment as it is listed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Its name: the file's stem.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
    /// Its title, a line; the name where the file is wrong.
    pub title: String,
    /// The question it answers; may be empty.
    pub question: String,
    /// Its kind; `None` where the file is wrong.
    pub kind: Option<Kind>,
    /// How much there is to it, such as `8 scenes, 11 methods, 208 trials`; empty where the file is wrong.
    pub size: String,
    /// The labels of its methods with the names of the methods they are forms of, in the order of the spec; of a
    /// paper, those of all its sweeps.
    pub methods: Vec<(String, String)>,
    /// What is wrong with its file: the first line of what a run of it would say.
    pub problem: Option<String>,
}

/// The experiments in the working folder, in alphabetical order.
pub fn experiments() -> Vec<Listed> {
    let of = |name: String| listed(&Path::new(job::FOLDER).join(format!("{name}.toml")));
    job::names().into_iter().map(of).collect()
}

/// The experiment in a file, read and checked; no texture is loaded.
pub fn listed(path: &Path) -> Listed {
    let name = clean(&path.file_stem().unwrap_or_default().to_string_lossy());
    let wrong = |problem: String| Listed {
        title: name.clone(),
        name: name.clone(),
        path: path.to_owned(),
        question: String::new(),
        kind: None,
        size: String::new(),
        methods: Vec::new(),
        problem: Some(clean(problem.lines().next().unwrap_or("it is wrong"))),
    };
    let experiment = match Experiment::load(path, &evidence::keys()) {
        Ok(experiment) => experiment,
        Err(error) => return wrong(error.to_string()),
    };
    let (kind, size, methods) = match &experiment {
        Experiment::Sweep(spec) => (Kind::Sweep, size_of_sweep(spec), methods(spec)),
        Experiment::Paper(paper) => {
            let trials: usize = paper.parts.iter().map(trials).sum();
            let (rows, parts) =
                (counted(paper.rows.len(), "row"), counted(paper.parts.len(), "sweep"));
            let size = format!("{rows}, {parts}, {}", counted(trials, "trial"));
            let mut all: Vec<(String, String)> = Vec::new();
            for method in paper.parts.iter().flat_map(methods) {
                if all.iter().all(|(label, _)| *label != method.0) {
                    all.push(method);
                }
            }
            (Kind::Paper, size, all)
        }
    };
    Listed {
        name: name.clone(),
        path: path.to_owned(),
        title: clean(experiment.title()),
        question: clean(experiment.question()),
        kind: Some(kind),
        size,
        methods,
        problem: None,
    }
}

fn methods(spec: &Spec) -> Vec<(String, String)> {
    let named = spec.sweep.methods.iter().map(|method| (clean(&method.label), method.name.into()));
    named.collect()
}

fn size_of_sweep(spec: &Spec) -> String {
    let (scenes, methods) = (scenes(spec), spec.sweep.methods.len());
    let all = counted(trials(spec), "trial");
    format!("{}, {}, {all}", counted(scenes, "scene"), counted(methods, "method"))
}

/// Scenes of a sweep, frames included.
fn scenes(spec: &Spec) -> usize {
    let sweep = &spec.sweep;
    let scales = match &sweep.scale {
        Scale::TexelsPerPixel(list) => list.len(),
        Scale::Distance { distances, .. } => distances.len(),
    };
    let frames = spec.motion.map_or(1, |motion| motion.frames as usize);
    sweep.textures.len() * sweep.lobes.len() * sweep.elevations.len() * scales * frames
}

/// Trials of a sweep, those that methods will refuse included.
fn trials(spec: &Spec) -> usize {
    let of_scene = spec.sweep.methods.iter().map(|method| spec.sweep.spp_of(method).len());
    scenes(spec) * of_scene.sum::<usize>()
}

/// "1 scene", "2 scenes".
fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::author::author;
    use crate::scene::{Halt, Stagehand};

    #[test]
    fn every_experiment_that_comes_with_the_program_is_listed_with_its_size() {
        let listed = experiments();
        assert!(listed.len() >= 10);
        for one in &listed {
            assert_eq!(one.problem, None, "{}", one.name);
            assert!(!one.question.is_empty() && !one.size.is_empty());
        }
        let quick = listed.iter().find(|one| one.name == "quick").unwrap();
        assert_eq!((quick.kind, quick.methods[0].0.as_str()), (Some(Kind::Sweep), "unfiltered"));
    }

    #[test]
    fn sizes_are_those_of_the_plan() {
        for name in ["quick", "motion", "approach", "lookups"] {
            let spec = Spec::load(&Path::new(job::FOLDER).join(format!("{name}.toml"))).unwrap();
            let plan = author(&spec, &mut Stagehand::new(spec.seed, Halt::default()));
            let planned: usize = plan.scenes.iter().map(|scene| scene.trials.len()).sum();
            assert_eq!((scenes(&spec), trials(&spec)), (plan.scenes.len(), planned), "{name}");
        }
    }

    #[test]
    fn a_wrong_file_is_listed_with_what_is_wrong() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("odd.toml");
        std::fs::write(&path, "[image]\nwidht = 3\n").unwrap();
        let odd = listed(&path);
        assert!(odd.problem.unwrap().contains("unknown key `widht`"));
        assert_eq!((odd.title.as_str(), odd.kind), ("odd", None));
        std::fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
        assert!(listed(&path).problem.unwrap().contains("cannot read"));
        assert!(listed(&folder.path().join("none.toml")).problem.is_some());
    }
}
