//! Gathering a paper's evidence: its sweeps one after the other, then its rows; each finished piece is
//! kept, and taken up by a later run.

mod shared;

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use serde::{Deserialize, Serialize};

pub use shared::{gather_share, missing};

use super::{Drawing, Evidence, Exhibit, FinishedPart, Panel, Paper, Row, Task};
use crate::experiment::runner::{self, Extent, Outcome, RunError, RunEvent, Watcher};
use crate::experiment::spec::{PaperSpec, RowSpec};
use crate::experiment::store::{Store, StoreError};
use crate::method::Progress;
use crate::render::Film;
use crate::scene::Halt;

/// What gathering came to, if not to an error.
#[derive(Debug)]
pub enum Gathered {
    /// All of it is done.
    Finished(Box<Findings>),
    /// It was halted; what was finished is kept.
    Halted,
}

/// All that was gathered.
#[derive(Debug)]
pub struct Findings {
    /// What was found about the paper.
    pub evidence: Evidence,
    /// The sweeps, in the order of the spec.
    pub parts: Vec<FinishedPart>,
    /// Rows with the seconds they took, when they were made.
    pub row_secs: Vec<(String, f64)>,
    /// Wall-clock seconds of this run.
    pub secs: f64,
}

/// Units of work a second of a row: about the unfiltered samples in a second of two cores.
const UNITS: f64 = 3e7;

/// Gathers the evidence that `spec` asks for, with what is finished kept in `folder`, until it is done or
/// `halt` is set. A sweep's results are in the folder of its name there.
///
/// # Errors
/// Those of [`runner::run`].
///
/// # Panics
/// If the spec names no paper there is: a programming error, as specs are checked.
pub fn gather(
    spec: &PaperSpec,
    folder: &Path,
    halt: &Halt,
    watch: &Watcher,
) -> Result<Gathered, RunError> {
    let paper = super::find(spec.paper).expect("specs name papers there are");
    gather_rows(paper, spec, folder, halt, watch)
}

fn gather_rows(
    paper: &Paper,
    spec: &PaperSpec,
    folder: &Path,
    halt: &Halt,
    watch: &Watcher,
) -> Result<Gathered, RunError> {
    let start = Instant::now();
    let Extent { scenes: all, .. } = announce(spec, paper, watch)?;
    let (mut parts, mut before) = (Vec::new(), 0);
    for part in &spec.parts {
        let told = told_of_part(watch, &part.name, before, all);
        match runner::run(part, &folder.join(&part.name), halt, &told)? {
            Outcome::Finished(found) => {
                let (results, costs) = *found;
                before += results.scenes.len();
                parts.push(FinishedPart { spec: part.clone(), results, costs });
            }
            Outcome::Halted => return Ok(Gathered::Halted),
        }
    }
    let store = store(spec, folder)?;
    let (mut exhibits, mut row_secs) = (Vec::new(), Vec::new());
    for (number, (row, told)) in (before + 1..).zip(paper.rows.iter().zip(&spec.rows)) {
        let slug = row.name.to_owned();
        watch(RunEvent::Scene { slug, part: None, number, of: all });
        let gathering = Gathering { spec, row, told, parts: &parts, store: &store, halt, watch };
        let Some((exhibit, secs)) = gathering.exhibit()? else { return Ok(Gathered::Halted) };
        exhibits.push(exhibit);
        row_secs.push((row.name.to_owned(), secs));
    }
    store.clear_images();
    let evidence = Evidence {
        name: spec.name.clone(),
        title: spec.title.clone(),
        question: spec.question.clone(),
        paper: paper.citation.to_owned(),
        spec: spec.text.clone(),
        seed: spec.seed,
        exhibits,
        parts: spec.parts.iter().map(|part| (part.name.clone(), part.title.clone())).collect(),
    };
    let secs = start.elapsed().as_secs_f64();
    Ok(Gathered::Finished(Box::new(Findings { evidence, parts, row_secs, secs })))
}

/// Where rows are kept.
fn store(spec: &PaperSpec, folder: &Path) -> Result<Store, StoreError> {
    Store::open(folder, &format!("{} {}", spec.paper, spec.seed))
}

/// Tells `watch` what a part tells, as of one of several: `before` of `all` scenes were other parts'.
fn told_of_part(watch: &Watcher, name: &str, before: usize, all: usize) -> Watcher {
    let (watch, name) = (Arc::clone(watch), name.to_owned());
    Arc::new(move |event| match event {
        RunEvent::Started { .. } => {}
        RunEvent::Scene { slug, number, .. } => {
            let part = Some(name.clone());
            watch(RunEvent::Scene { slug, part, number: before + number, of: all });
        }
        other => watch(other),
    })
}

/// Tells how much there is to all of it.
fn announce(spec: &PaperSpec, paper: &Paper, watch: &Watcher) -> Result<Extent, RunError> {
    let mut work: f64 = paper.rows.iter().map(|row| row.secs * UNITS).sum();
    let (mut scenes, mut trials) = (paper.rows.len(), 0);
    for part in &spec.parts {
        let extent = runner::extent(part)?;
        work += extent.work;
        scenes += extent.scenes;
        trials += extent.trials;
    }
    watch(RunEvent::Started { work, scenes, trials });
    Ok(Extent { work, scenes, trials })
}

/// A row under way.
struct Gathering<'a> {
    spec: &'a PaperSpec,
    row: &'a Row,
    told: &'a RowSpec,
    parts: &'a [FinishedPart],
    store: &'a Store,
    halt: &'a Halt,
    watch: &'a Watcher,
}

/// Tells the watcher how far a row is, and the row when to stop.
struct Onlooker<'a> {
    halt: &'a Halt,
    watch: &'a Watcher,
}

impl Progress for Onlooker<'_> {
    fn advance(&self, done: usize, total: usize) {
        (self.watch)(RunEvent::Partly { part: done as f64 / total.max(1) as f64 });
    }

    fn cancelled(&self) -> bool {
        self.halt.now()
    }
}

/// A finished row as a record; its films are files beside it.
#[derive(Serialize, Deserialize)]
struct Record {
    exhibit: Exhibit,
    secs: f64,
    /// What the films are found by, in the order of the panels.
    films: Vec<String>,
}

/// The folder of rows among records.
const ROWS: &str = "rows";

impl Gathering<'_> {
    /// The row's exhibit and the seconds it took; None if halted.
    fn exhibit(&self) -> Result<Option<(Exhibit, f64)>, RunError> {
        let work = self.row.secs * UNITS;
        if let Some(kept) = self.take_up() {
            (self.watch)(RunEvent::Advanced { work, kept: true });
            return Ok(Some(kept));
        }
        let what = format!("{}: {}", self.row.name, self.row.title);
        (self.watch)(RunEvent::Working { what, work });
        if self.halt.now() {
            return Ok(None);
        }
        let start = Instant::now();
        let task = Task {
            values: &self.told.values,
            seed: self.spec.seed,
            parts: self.parts,
            progress: &Onlooker { halt: self.halt, watch: self.watch },
        };
        let Ok(exhibit) = (self.row.make)(&task) else { return Ok(None) };
        let secs = start.elapsed().as_secs_f64();
        self.keep(&exhibit, secs)?;
        (self.watch)(RunEvent::Advanced { work, kept: false });
        Ok(Some((exhibit, secs)))
    }

    /// What the row depends on beside the program: its options, and its parts, images included.
    fn depends(&self) -> String {
        let of = |name: &&str| {
            let part = self.parts.iter().find(|part| part.results.name == **name)?;
            let films = part.results.scenes.iter().flat_map(|scene| {
                let trials = scene.trials.iter().map(|trial| trial.film.digest());
                std::iter::once(scene.reference.film.digest()).chain(trials)
            });
            Some(films.collect::<Vec<_>>().join(" "))
        };
        let parts: Vec<_> = self.row.parts.iter().filter_map(of).collect();
        format!("{:?} {}", self.told, blake3::hash(parts.join(" ").as_bytes()).to_hex())
    }

    fn take_up(&self) -> Option<(Exhibit, f64)> {
        let record: Record = self.store.find(ROWS, self.row.name, &self.depends())?;
        let mut exhibit = record.exhibit;
        let mut films = record.films.into_iter();
        for panel in panels_mut(&mut exhibit) {
            let film = self.store.find_film(self.row.name, &panel.name, &films.next()?)?;
            panel.film = Some(Arc::new(film));
        }
        Some((exhibit, record.secs))
    }

    fn keep(&self, exhibit: &Exhibit, secs: f64) -> Result<(), RunError> {
        let mut films = Vec::new();
        for (name, film) in exhibit.films() {
            films.push(self.store.keep_film(self.row.name, name, film)?);
        }
        let record = Record { exhibit: exhibit.clone(), secs, films };
        Ok(self.store.keep(ROWS, self.row.name, &self.depends(), &record)?)
    }
}

fn panels_mut(exhibit: &mut Exhibit) -> impl Iterator<Item = &mut Panel> {
    exhibit.figures.iter_mut().flat_map(|figure| match &mut figure.drawing {
        Drawing::Images(images) => images.panels.iter_mut(),
        _ => [].iter_mut(),
    })
}

impl Exhibit {
    /// The films of its images with their names, figure by figure.
    pub fn films(&self) -> impl Iterator<Item = (&str, &Arc<Film>)> {
        self.figures
            .iter()
            .flat_map(|figure| match &figure.drawing {
                Drawing::Images(images) => images.panels.as_slice(),
                _ => &[],
            })
            .filter_map(|panel| Some((panel.name.as_str(), panel.film.as_ref()?)))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    use super::*;
    use crate::evidence::{Claim, Figure, Images};
    use crate::experiment::runner::unwatched;
    use crate::experiment::spec::Spec;
    use crate::parameter::Values;

    static MADE: AtomicUsize = AtomicUsize::new(0);

    fn make(task: &Task) -> Result<Exhibit, super::super::Halted> {
        task.go_on()?;
        MADE.fetch_add(1, Ordering::Relaxed);
        let film = Arc::new(Film::new(2, 1, vec![0.25, 1.5]));
        let panels = vec![Panel::new("only", "only", film)];
        let images = Images { panels, white: None, reference: None, across: 1 };
        let mut exhibit = ROW.exhibit();
        exhibit.claims = vec![Claim::count("rows", 1, 1), Claim::near("π", 3.0, 3.125, 0.1)];
        exhibit.figures = vec![Figure::new("images", "One image.", Drawing::Images(images))];
        Ok(exhibit)
    }

    const ROW: Row =
        Row { name: "bumps-f1", title: "Bumps", parts: &[], parameters: &[], secs: 0.0, make };
    const PAPER: Paper = Paper { name: "bumps-1990", citation: "Bumps", rows: &[ROW] };

    fn quiet(_: &Task) -> Result<Exhibit, super::super::Halted> {
        Ok(ROW.exhibit())
    }

    pub(super) const QUIET: Paper =
        Paper { name: "bumps-1990", citation: "Bumps", rows: &[Row { make: quiet, ..ROW }] };

    pub(super) fn spec() -> PaperSpec {
        PaperSpec {
            name: "bumps".into(),
            title: "Bumps".into(),
            question: String::new(),
            seed: 1,
            paper: "bumps-1990",
            rows: vec![RowSpec { row: "bumps-f1", values: Values::default() }],
            parts: vec![],
            text: String::new(),
        }
    }

    /// A sweep of two scenes.
    pub(super) fn part(name: &str) -> Spec {
        const PART: &str = r#"
            image = { width = 8, height = 8 }
            reference = { spp = 16, replicates = 2 }
            sweep = { texture = ["flat"], method = ["unfiltered"], spp = [1], unfiltered_spp = [1], texels_per_pixel = [1.0, 2.0] }
        "#;
        Spec { name: name.into(), ..Spec::parse(PART, Path::new("x.toml")).unwrap() }
    }

    fn exhibits(spec: &PaperSpec, folder: &Path) -> Vec<Exhibit> {
        match gather_rows(&PAPER, spec, folder, &Halt::default(), &unwatched()).unwrap() {
            Gathered::Finished(found) => found.evidence.exhibits,
            Gathered::Halted => panic!("nothing halts it"),
        }
    }

    #[test]
    fn watchers_hear_of_parts_and_rows_as_of_one_run() {
        let spec = PaperSpec { parts: vec![part("one"), part("two")], ..spec() };
        let told = Arc::new(Mutex::new(Vec::new()));
        let telling = Arc::clone(&told);
        let watch: Watcher = Arc::new(move |event| telling.lock().unwrap().push(event));
        let folder = tempfile::tempdir().unwrap();
        gather_rows(&QUIET, &spec, folder.path(), &Halt::default(), &watch).unwrap();
        let told = told.lock().unwrap();
        let scene = |event: &RunEvent| match event {
            RunEvent::Scene { part, number, of, .. } => Some((part.clone(), *number, *of)),
            _ => None,
        };
        let (one, two) = (Some("one".to_owned()), Some("two".to_owned()));
        let all =
            [(one.clone(), 1, 5), (one, 2, 5), (two.clone(), 3, 5), (two, 4, 5), (None, 5, 5)];
        assert_eq!(told.iter().filter_map(scene).collect::<Vec<_>>(), all);
        assert_eq!(
            told.iter().filter(|event| matches!(event, RunEvent::Started { .. })).count(),
            1
        );
        let row = |event: &&RunEvent| matches!(event, RunEvent::Working { what, .. } if what.starts_with("bumps-f1"));
        assert_eq!(told.iter().filter(row).count(), 1);
    }

    #[test]
    fn finished_rows_are_taken_up_and_damaged_ones_made_again() {
        let folder = tempfile::tempdir().unwrap();
        let halted = Halt(Arc::new(AtomicBool::new(true)));
        let stopped = gather_rows(&PAPER, &spec(), folder.path(), &halted, &unwatched()).unwrap();
        assert!(matches!(stopped, Gathered::Halted));
        let first = exhibits(&spec(), folder.path());
        assert_eq!(exhibits(&spec(), folder.path()), first);
        assert_eq!(MADE.load(Ordering::Relaxed), 1, "the second run takes the row up");
        // Another seed: made again; the first seed again: still there.
        exhibits(&PaperSpec { seed: 2, ..spec() }, folder.path());
        assert_eq!(exhibits(&spec(), folder.path()), first);
        assert_eq!(MADE.load(Ordering::Relaxed), 2);
        // Another film under its film's name: the name is put right. A film that is no more what it was: made again.
        let image = folder.path().join("images/bumps-f1/only.exr");
        Film::new(2, 1, vec![0.0, 0.0]).write_exr(&image).unwrap();
        assert_eq!(exhibits(&spec(), folder.path()), first);
        assert_eq!(MADE.load(Ordering::Relaxed), 2);
        std::fs::write(&image, b"scribbled into the film itself").unwrap();
        assert_eq!(exhibits(&spec(), folder.path()), first);
        assert_eq!(MADE.load(Ordering::Relaxed), 3);
    }
}
