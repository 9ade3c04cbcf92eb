//! Every figure of a report: its file, its picture and its caption.

use rayon::prelude::*;
use serde::Serialize;

use super::contest::{Comparison, Setting, setting_name, unique};
use super::figure::{Figure, FrameImages, data_uri};
use super::phrase::{self, count};
use super::png;
use super::scale::texels;
use super::sheet::{self, Frames};
use super::source::Lines;
use super::viewer::{Viewer, viewer};

use super::{budget, curves, disc, pareto};
use crate::experiment::results::{Costs, Probe, Results, SceneResult, TextureInfo, TrialResult};

/// The figures of a report.
#[derive(Serialize)]
pub struct Figures {
    /// Error against samples over all scenes.
    overall: Option<Figure>,
    /// Error against memory.
    memory: Option<Figure>,
    /// Figures of each setting: error against scale, error against samples scene by scene.
    settings: Vec<SettingFigures>,
    /// Figures of each scene.
    scenes: Vec<SceneFigures>,
    /// Budgets of errors, if any were drawn up.
    budget: Option<budget::Section>,
    /// The textures' pictures, in their order.
    textures: Vec<Option<String>>,
}

#[derive(Serialize)]
struct SettingFigures {
    name: String,
    figures: Vec<Figure>,
}

#[derive(Serialize)]
struct SceneFigures {
    heading: String,
    setting: String,
    remark: String,
    slug: String,
    sheet: Figure,
    /// The viewer of its images.
    viewer: Option<Viewer>,
    /// The images as pictures, if the page has no room for the viewer's films.
    frames: Vec<FrameImages>,
    probes: Vec<Figure>,
    films: Vec<Films>,
}

/// The images of a scene as the run keeps them: linear radiance, EXR.
#[derive(Serialize)]
struct Films {
    label: String,
    files: Vec<FilmFile>,
}

/// An EXR file that the runner wrote.
#[derive(Serialize)]
struct FilmFile {
    spp: u32,
    path: String,
}

impl Figures {
    /// Draws every figure.
    pub fn of(results: &Results, costs: &Costs) -> Self {
        let comparison = Comparison::of(results);
        let settings = comparison.settings.iter().enumerate();
        Self {
            overall: overall(&comparison),
            memory: memory(&comparison, costs),
            settings: settings.map(|(i, s)| setting_figures(&comparison, s, i + 1)).collect(),
            scenes: scenes(results, comparison.spp),
            budget: budget::Section::of(&comparison),
            textures: results.textures.iter().map(texture_picture).collect(),
        }
    }

    /// Every file with its bytes.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        let settings = self.settings.iter().flat_map(|s| &s.figures);
        let scenes = self.scenes.iter().flat_map(|s| std::iter::once(&s.sheet).chain(&s.probes));
        let budgets = self.budget.iter().flat_map(budget::Section::figures);
        let all =
            self.overall.iter().chain(&self.memory).chain(settings).chain(scenes).chain(budgets);
        all.map(|figure| (figure.file.as_str(), figure.png.as_slice()))
    }
}

/// Bytes of films that a page holds, as text.
const ROOM: usize = 14 << 20;
/// Bytes of figures of distributions that it holds. With [`ROOM`] a page stays under 20 MiB.
const PROBE_ROOM: usize = 5 << 20;

/// The page holds figures of distributions while there is room: the first of every scene before the second of any. The
/// others are shown from the files that stand beside it.
fn make_room(scenes: &mut [SceneFigures]) {
    let mut room = PROBE_ROOM;
    let most = scenes.iter().map(|scene| scene.probes.len()).max().unwrap_or(0);
    for number in 0..most {
        for probe in scenes.iter_mut().filter_map(|scene| scene.probes.get_mut(number)) {
            match room.checked_sub(probe.size()) {
                Some(left) => room = left,
                None => probe.stand_beside(),
            }
        }
    }
}

/// The figures of all scenes. Films find room in the page scene by scene: those that methods are compared by, then,
/// if all of them fit, those of brute force at more samples.
fn scenes(results: &Results, spp: u32) -> Vec<SceneFigures> {
    // In parallel, kept in order.
    let lines = Lines::of(results);
    let made = results.scenes.par_iter().map(|scene| scene_figures(results, &lines, scene, spp));
    let (mut made, compared): (Vec<SceneFigures>, Vec<usize>) = made.unzip();
    let viewers = || made.iter().filter_map(|figures| figures.viewer.as_ref());
    if viewers().map(|viewer| viewer.size(viewer.len())).sum::<usize>() > ROOM {
        let mut room = ROOM;
        for ((figures, scene), count) in made.iter_mut().zip(&results.scenes).zip(compared) {
            let Some(viewer) = &mut figures.viewer else { continue };
            viewer.shorten(count);
            match room.checked_sub(viewer.size(count)) {
                Some(left) => room = left,
                None => {
                    figures.viewer = None;
                    figures.frames = pictures(&sheet::frames(scene, spp));
                }
            }
        }
    }
    make_room(&mut made);
    made
}

fn pictures(frames: &Frames) -> Vec<FrameImages> {
    frames.frames.iter().map(FrameImages::of).collect()
}

/// A texture's picture as a page holds it.
pub fn texture_picture(texture: &TextureInfo) -> Option<String> {
    texture.picture.as_ref().map(|picture| data_uri(&png::exact(picture)))
}

fn overall(comparison: &Comparison) -> Option<Figure> {
    let plot = curves::overall(comparison)?;
    let which = if plot.complete {
        " that every method took part in"
    } else {
        "; not every method took part in each"
    };
    let slope = plot.slope.map_or_else(String::new, |slope| {
        format!(
            " Brute force falls as N to the power {} from its first point to its last; independent samples would \
             give −0.5.",
            format!("{slope:.2}").replace('-', "−")
        )
    });
    let caption = format!(
        "RMSE against samples a pixel, the geometric mean over the {}{which}. Heavy: brute force. A thin dashed line \
         carries an error measured at one number of samples across, to where brute force meets it.{slope}",
        count(plot.scenes, "scene"),
    );
    Some(Figure::drawing("plots/samples.png".into(), caption, &plot.drawing))
}

fn memory(comparison: &Comparison, costs: &Costs) -> Option<Figure> {
    let caption = format!(
        "RMSE at {} a pixel, the geometric mean over the scenes that every method took part in, against the memory \
         that a method holds beside the normal map, the median over maps. What is on the front is beaten by no \
         method in both.",
        count(comparison.spp as usize, "sample"),
    );
    let drawing = pareto::memory(comparison, costs)?;
    Some(Figure::drawing("plots/memory.png".into(), caption, &drawing))
}

fn setting_figures(comparison: &Comparison, setting: &Setting, number: usize) -> SettingFigures {
    let spp = count(comparison.spp as usize, "sample");
    let by_scale = curves::by_scale(comparison, setting).map(|drawing| {
        let caption = format!(
            "RMSE against texels a pixel at {spp} a pixel, texture by texture. Shaded: under the reference’s own error."
        );
        Figure::drawing(format!("plots/scale-{number}.png"), caption, &drawing)
    });
    let by_scene = curves::by_scene(comparison, setting).map(|drawing| {
        let caption = "RMSE against samples a pixel, scene by scene. Shaded: under the reference’s own error."
            .to_owned();
        Figure::drawing(format!("plots/samples-{number}.png"), caption, &drawing)
    });
    let figures = [by_scale, by_scene].into_iter().flatten().collect();
    SettingFigures { name: setting.name.clone(), figures }
}

/// The figures of a scene, and how many of its viewer's images methods are compared by.
fn scene_figures(
    results: &Results,
    lines: &Lines,
    scene: &SceneResult,
    spp: u32,
) -> (SceneFigures, usize) {
    let frames = sheet::frames(scene, spp);
    let remark = format!(
        "White is radiance {}. Errors are method − reference: blue too dark, orange too bright, in full colour \
         at ±{}.",
        phrase::number(frames.white),
        phrase::number(frames.full),
    );
    let probes = scene.probes.iter().enumerate();
    let (viewer, compared) = viewer(results, lines, scene, &frames, spp);
    let figures = SceneFigures {
        slug: scene.slug.clone(),
        heading: format!("{}, {}", scene.key.texture, texels(scene.key.texels_per_pixel)),
        setting: setting_name(results, &scene.key),
        sheet: sheet_figure(scene, &frames, spp),
        frames: if viewer.is_none() { pictures(&frames) } else { Vec::new() },
        viewer,
        probes: probes.map(|(i, probe)| probe_figure(results, scene, probe, i + 1)).collect(),
        films: films(scene),
        remark,
    };
    (figures, compared)
}

fn sheet_figure(scene: &SceneResult, frames: &Frames, spp: u32) -> Figure {
    let caption =
        format!("The reference and each method at {} a pixel.", count(spp as usize, "sample"));
    Figure::sheet(format!("images/{}.png", scene.slug), caption, &sheet::sheet(frames))
}

/// The runner's files: `images/SLUG/reference.exr` and `images/SLUG/LABEL-Nspp.exr`.
fn films(scene: &SceneResult) -> Vec<Films> {
    let path = |name: &str| format!("images/{}/{name}.exr", scene.slug);
    let reference = FilmFile { spp: scene.reference.spp, path: path("reference") };
    let trial = |t: &TrialResult| FilmFile {
        spp: t.spp,
        path: path(&format!("{}-{}spp", t.method, t.spp)),
    };
    let of_method = |label: &str| Films {
        label: label.to_owned(),
        files: scene.trials.iter().filter(|t| t.method == label).map(trial).collect(),
    };
    let labels = unique(scene.trials.iter().map(|t| t.method.as_str()));
    let reference = Films { label: "reference".into(), files: vec![reference] };
    std::iter::once(reference).chain(labels.into_iter().map(of_method)).collect()
}

fn probe_figure(results: &Results, scene: &SceneResult, probe: &Probe, number: usize) -> Figure {
    let [x, y] = probe.pixel;
    let caption = format!(
        "Distributions of normals under pixel ({x}, {y}) of {}: a footprint {} texels across.",
        scene.key.texture,
        phrase::scale(probe.texels_across),
    );
    let file = format!("plots/{}-normals-{number}.png", scene.slug);
    Figure::drawing(file, caption, &disc::probe(probe, &results.methods))
}
