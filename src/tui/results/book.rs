//! A report that is looked into.

use std::path::PathBuf;
use std::sync::Arc;

use crate::experiment::results::Picture;
use crate::render::Film;
use crate::tui::library::{Kind, Opened};
use crate::tui::viewer::{Shot, Viewer};

/// A report that is looked into, and what of it is shown.
#[derive(Debug)]
pub struct Book {
    /// The report.
    pub report: Opened,
    /// What can be shown of it.
    pub items: Vec<Item>,
    /// The one chosen.
    pub item: usize,
    /// What is shown.
    pub shown: Shown,
    /// How images are looked at; it stays from one scene to the next.
    pub viewer: Viewer,
    /// The first line of text that is shown.
    pub scroll: usize,
}

/// A line of a report's list, by places in [`Opened`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    /// A scene's images.
    Scene(usize),
    /// A plot of a sweep.
    Plot(usize),
    /// A paper's row: its claims.
    Row(usize),
    /// A plot of a row.
    Figure(usize, usize),
    /// The images of a row.
    Panels(usize),
}

impl Item {
    /// Whether it begins something: a figure belongs to the row before it.
    pub fn leads(self) -> bool {
        matches!(self, Self::Scene(_) | Self::Plot(_) | Self::Row(_))
    }
}

/// What is shown of an item.
#[derive(Debug, Default)]
pub enum Shown {
    /// Nothing but words.
    #[default]
    Nothing,
    /// Images that are compared.
    Images(Stack),
    /// A plot, once it is read.
    Plot(Option<Arc<Picture>>),
}

/// An image of a scene.
#[derive(Clone, Debug)]
pub struct Image {
    /// Its name: `reference`, a method's label, a panel's name.
    pub label: String,
    /// Samples a pixel, if it is one of several.
    pub spp: Option<u32>,
    /// Its root mean square error against the reference, if it is known.
    pub rmse: Option<f64>,
    /// The image, once it is read.
    pub film: Option<Arc<Film>>,
    /// Whether it cannot be shown.
    pub failed: bool,
}

/// The images of a scene, of which those of one sample count are compared.
#[derive(Debug, Default)]
pub struct Stack {
    /// All of them, the reference first.
    pub images: Vec<Image>,
    /// The sample counts there are, ascending.
    pub counts: Vec<u32>,
    /// Which of them is looked at.
    pub count: usize,
}

impl Stack {
    /// The images that are compared now, by their places: the reference and those of the chosen count.
    pub fn compared(&self) -> Vec<usize> {
        let count = self.counts.get(self.count);
        let of = |(place, image): &(usize, &Image)| {
            *place == 0 || image.spp.is_none() || image.spp.as_ref() == count
        };
        self.images.iter().enumerate().filter(of).map(|(place, _)| place).collect()
    }

    /// The same as the viewer takes them.
    pub fn shots(&self) -> Vec<Shot> {
        let shot = |place: usize| {
            let image = &self.images[place];
            let remark = match (image.failed, image.spp) {
                (true, _) => "(cannot be read)".to_owned(),
                (_, Some(spp)) => format!("{spp} spp"),
                (_, None) => String::new(),
            };
            Shot { label: image.label.clone(), remark, film: image.film.clone() }
        };
        self.compared().into_iter().map(shot).collect()
    }
}

impl Book {
    /// A report just opened.
    pub fn of(report: Opened) -> Self {
        let items = items(&report);
        let viewer = Viewer::default();
        Self { report, items, item: 0, shown: Shown::Nothing, viewer, scroll: 0 }
    }

    /// What is chosen, if there is anything.
    pub fn chosen(&self) -> Option<Item> {
        self.items.get(self.item).copied()
    }

    /// The name of an item, for the list.
    pub fn name(&self, item: Item) -> String {
        let report = &self.report;
        match item {
            Item::Scene(i) => report.scenes[i].slug.clone(),
            Item::Plot(i) => format!("plot {}", report.plots[i].0),
            Item::Row(i) => report.paper[i].name.clone(),
            Item::Figure(i, j) => format!("  {}", report.paper[i].plots[j].0),
            Item::Panels(_) => "  images".to_owned(),
        }
    }

    /// Makes ready for what is chosen; the files to be read for it, each with its place.
    pub fn turn_to(&mut self) -> Vec<(usize, PathBuf)> {
        self.scroll = 0;
        let report = &self.report;
        let plot = |path: &PathBuf| (Shown::Plot(None), vec![(0, path.clone())]);
        let (shown, files) = match self.chosen() {
            Some(Item::Scene(i)) => scene(report, i),
            Some(Item::Panels(i)) => panels(report, i),
            Some(Item::Plot(i)) => plot(&report.plots[i].1),
            Some(Item::Figure(i, j)) => plot(&report.paper[i].plots[j].1),
            Some(Item::Row(i)) => {
                report.paper[i].plots.first().map_or((Shown::Nothing, Vec::new()), |(_, p)| plot(p))
            }
            None => (Shown::Nothing, Vec::new()),
        };
        let count = match (&self.shown, &shown) {
            (Shown::Images(old), Shown::Images(new)) => {
                let old = old.counts.get(old.count);
                new.counts.iter().position(|count| Some(count) == old)
            }
            _ => None,
        };
        self.shown = shown;
        if let (Shown::Images(stack), Some(count)) = (&mut self.shown, count) {
            stack.count = count;
        }
        self.look();
        files
    }

    /// Gives the viewer the images as they now are.
    pub fn look(&mut self) {
        let Shown::Images(stack) = &self.shown else { return };
        let shots = stack.shots();
        if self.viewer.shots.len() < 2 {
            self.viewer = Viewer::of(shots);
        } else {
            self.viewer.replace(shots);
        }
    }

    /// Takes an image in; a sentence if it is of no use.
    pub fn hang(&mut self, place: usize, read: Result<Arc<Film>, String>) -> Option<String> {
        let Shown::Images(stack) = &mut self.shown else { return None };
        let known = stack.images.iter().find_map(|image| image.film.as_ref());
        let size = known.map(|film| [film.width(), film.height()]);
        let image = stack.images.get_mut(place)?;
        let fits = read.and_then(|film| match (size, [film.width(), film.height()]) {
            (Some(size), own) if size != own => {
                let [w, h] = own;
                let name = &image.label;
                Err(format!("{name} has {w} × {h} pixels, unlike the images beside it: left out"))
            }
            _ => Ok(film),
        });
        image.failed = fits.is_err();
        let problem = fits.map(|film| image.film = Some(film)).err();
        self.look();
        problem
    }
}

fn items(report: &Opened) -> Vec<Item> {
    if report.kind != Kind::Paper {
        let scenes = (0..report.scenes.len()).map(Item::Scene);
        return scenes.chain((0..report.plots.len()).map(Item::Plot)).collect();
    }
    let of = |(i, row): (usize, &crate::tui::library::PaperRow)| {
        let figures = (0..row.plots.len()).map(move |j| Item::Figure(i, j));
        let panels = (!row.images.is_empty()).then_some(Item::Panels(i));
        std::iter::once(Item::Row(i)).chain(figures).chain(panels).collect::<Vec<_>>()
    };
    report.paper.iter().enumerate().flat_map(of).collect()
}

fn scene(report: &Opened, i: usize) -> (Shown, Vec<(usize, PathBuf)>) {
    let scene = &report.scenes[i];
    let rmse = |label: &str, spp: u32| {
        let mut rows =
            report.rows.iter().filter(|row| row.metric == "rmse" && row.scene == scene.slug);
        rows.find(|row| row.method == label && row.spp == Some(spp)).map(|row| row.value)
    };
    let plain = |label: &str| Image {
        label: label.to_owned(),
        spp: None,
        rmse: None,
        film: None,
        failed: false,
    };
    let mut images = vec![Image { failed: scene.reference.is_none(), ..plain("reference") }];
    let mut files: Vec<_> = scene.reference.iter().map(|path| (0, path.clone())).collect();
    for image in &scene.images {
        files.push((images.len(), image.path.clone()));
        let (spp, rmse) = (Some(image.spp), rmse(&image.method, image.spp));
        images.push(Image { spp, rmse, ..plain(&image.method) });
    }
    let mut counts: Vec<u32> = scene.images.iter().map(|image| image.spp).collect();
    counts.sort_unstable();
    counts.dedup();
    (Shown::Images(Stack { images, counts, count: 0 }), files)
}

/// A row's images; the one that is the truth, if any is, comes first.
fn panels(report: &Opened, i: usize) -> (Shown, Vec<(usize, PathBuf)>) {
    let mut panels: Vec<_> = report.paper[i].images.iter().collect();
    let truth = |name: &str| name.contains("reference") || name.contains("truth");
    panels.sort_by_key(|(name, _)| !truth(name));
    let no_truth = !panels.first().is_some_and(|(name, _)| truth(name));
    let image = |label: &str, failed| Image {
        label: label.to_owned(),
        spp: None,
        rmse: None,
        film: None,
        failed,
    };
    let mut images = Vec::new();
    if no_truth {
        images.push(image("reference", true));
    }
    let first = images.len();
    images.extend(panels.iter().map(|(name, _)| image(name, false)));
    let files = panels.iter().enumerate().map(|(n, (_, path))| (first + n, path.clone()));
    (Shown::Images(Stack { images, ..Stack::default() }), files.collect())
}
