//! The pictures of a sequence: its viewer or animations side by side, frames as files, flicker maps, charts over time.

use serde::Serialize;

use super::answer::moves;
use super::clip::{Clip, Scales, Shown};
use super::standing::Race;
use super::{curves, films as packed, tables};
use crate::experiment::results::Results;
use crate::experiment::sequence::{films, references};
use crate::metric::flicker_map;
use crate::render::percentile;
use crate::report::bar;
use crate::report::canvas::Canvas;
use crate::report::colour::magnitude;
use crate::report::contest::setting_name;
use crate::report::figure::Figure;
use crate::report::phrase::{count, number, percent};
use crate::report::scale::texels;
use crate::report::sheet::{self, Frame, Frames};
use crate::report::tables::Table;
use crate::report::viewer::Viewer;

/// Animations to an image's row of the Markdown report and the sheet of maps.
const ACROSS: usize = 4;

/// A sequence, ready to show.
#[derive(Serialize)]
pub struct Reel {
    heading: String,
    setting: String,
    remark: String,
    /// The viewer of its films, if the page has room for them.
    viewer: Option<Viewer>,
    /// What it leaves out of the frames; empty if nothing.
    missing: String,
    /// Folder of its frames, and the slug its frames' EXR folders begin with.
    slug: String,
    /// The reference, then every method.
    clips: Vec<Clip>,
    /// Clips in rows of the Markdown report.
    rows: Vec<Vec<usize>>,
    plots: Vec<Figure>,
    table: Table,
    maps: Figure,
}

impl Reel {
    /// The pictures of a sequence at `spp` samples a pixel. Its films go into the page if `room`, in bytes, holds them;
    /// else its animations do as far as it lasts.
    pub fn of(results: &Results, race: &Race, spp: u32, mut room: usize) -> Self {
        let slug = &race.sequence.slug;
        let shown = shown(race, spp);
        let scales = scales(results, &shown[0]);
        let mut clips: Vec<Clip> = shown.iter().map(|s| Clip::of(s, slug, scales)).collect();
        let found = packed::viewer(&shown, &clips, scales, room);
        if found.is_none() {
            clips.iter_mut().for_each(|clip| clip.embed(&mut room));
        }
        let missing = missing(found.as_ref().map(|(_, step)| *step));
        let order: Vec<usize> = (0..clips.len()).collect();
        Self {
            heading: heading(race),
            setting: setting_name(results, &race.frames[0].key),
            remark: format!(
                "{} {} at {} a second, {} a pixel. White is radiance {}.",
                results.motion.as_ref().map_or_else(String::new, moves),
                count(race.frames.len(), "frame"),
                scales.fps,
                count(spp as usize, "sample"),
                number(scales.white),
            ),
            plots: plots(results, race),
            table: tables::flicker(race),
            maps: maps(&shown, slug, scales.flicker),
            rows: order.chunks(ACROSS).map(<[usize]>::to_vec).collect(),
            slug: slug.clone(),
            viewer: found.map(|(viewer, _)| viewer),
            missing,
            clips,
        }
    }

    /// Every file with its bytes: animations, frames, plots, the sheet of maps.
    pub fn files(&self) -> impl Iterator<Item = (String, &[u8])> {
        let clips = self.clips.iter().flat_map(|clip| {
            let frames = clip.frames.iter().zip(1..).map(|(bytes, number)| {
                let name = format!("frames/{}/{}/{number:03}.png", self.slug, clip.label);
                (name, bytes.as_slice())
            });
            std::iter::once((clip.file.clone(), clip.animation.as_slice())).chain(frames)
        });
        let figures = self.plots.iter().chain(std::iter::once(&self.maps));
        clips.chain(figures.map(|figure| (figure.file.clone(), figure.png.as_slice())))
    }
}

/// `gaussian, 4 texels a pixel`; of what comes nearer, in the first frame and the last.
fn heading(race: &Race) -> String {
    let (first, last) = (&race.frames[0].key, &race.frames[race.frames.len() - 1].key);
    let from = texels(first.texels_per_pixel);
    if first.distance == last.distance {
        return format!("{}, {from}", first.texture);
    }
    format!("{}, from {from} to {}", first.texture, texels(last.texels_per_pixel))
}

/// The reference, then every method of the race, in the order of the spec.
fn shown<'a>(race: &Race<'a>, spp: u32) -> Vec<Shown<'a>> {
    let reference = Shown {
        label: "reference",
        remark: format!("{} samples", race.frames[0].reference.spp),
        method: None,
        films: references(race.frames),
    };
    let methods = race.standings.iter().filter_map(|standing| {
        let label = standing.method.label.as_str();
        let wrong = |wrong| format!("wrong change {}", percent(wrong));
        let remark = standing.wrong.map_or_else(String::new, wrong);
        let films = films(race.frames, label, spp)?;
        Some(Shown { label, remark, method: Some(standing.method), films })
    });
    std::iter::once(reference).chain(methods).collect()
}

fn scales(results: &Results, reference: &Shown) -> Scales {
    let truth = &reference.films;
    let all = truth.iter().flat_map(|film| film.pixels()).copied();
    let white = Some(percentile(all)).filter(|white| *white > 0.0).unwrap_or(1.0);
    let map = flicker_map(truth).unwrap_or_else(|| truth[0].clone());
    let flicker = Some(percentile(map.pixels().iter().copied())).filter(|full| *full > 0.0);
    let fps = results.motion.map_or(12, |motion| motion.fps);
    Scales { white, flicker: flicker.unwrap_or(white), fps }
}

/// What a viewer of every `step`-th frame leaves out, or that there is none; nothing to say if it has all.
fn missing(step: Option<usize>) -> String {
    match step {
        Some(1) => String::new(),
        Some(2) => "The page has room for every second frame; changes here are from each of these to the next.".into(),
        Some(_) => "The page has room for every fourth frame; changes here are from each of these to the next.".into(),
        None => "The page has no room for the films of this sequence; it shows animations, whose flicker maps stand \
                 below. Click an image to flip through them in place; arrow and number keys choose, Escape shows all."
            .into(),
    }
}

/// The charts over time.
fn plots(results: &Results, race: &Race) -> Vec<Figure> {
    let (methods, slug) = (&results.methods, &race.sequence.slug);
    let figure = |name: &str, caption: &str, drawing: Option<Canvas>| {
        let file = format!("plots/{slug}-{name}.png");
        drawing.map(|drawing| Figure::drawing(file, caption.to_owned(), &drawing))
    };
    [
        figure(
            "errors",
            "RMSE of every frame. Heavy: brute force. Shaded: under the reference’s own error.",
            curves::errors(methods, race),
        ),
        figure(
            "changes",
            "Change from frame to frame, mean over pixels. Heavy and dashed: the truth’s; who is above it sparkles.",
            curves::changes(methods, race, |step| step.change, "change"),
        ),
        figure(
            "error-changes",
            "Change of the error from frame to frame, mean over pixels: the change that is wrong. Heavy and dashed: the \
             truth’s change, which is what an image that stands still gets wrong.",
            curves::changes(methods, race, |step| step.error_change, "change of the error"),
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The sheet of flicker maps, above the key to its colours.
fn maps(shown: &[Shown], slug: &str, full: f64) -> Figure {
    const KEY: f32 = 56.0;
    let frame = |s: &Shown| Frame {
        label: s.label.to_owned(),
        remark: s.remark.clone(),
        image: s.map(full),
        error: None,
    };
    let frames = Frames {
        frames: shown.iter().map(frame).collect(),
        white: full,
        full,
        difference: String::new(),
        across: ACROSS,
    };
    let sheet = sheet::sheet(&frames);
    let (width, height) = (sheet.width() as f32, sheet.height() as f32);
    let mut canvas = Canvas::new(width, height + KEY);
    canvas.paste([0.0, 0.0], &sheet);
    let end = number(full);
    let labels = ["0", "mean change a frame", end.as_str()];
    let size = [(width - 28.0).min(380.0), 14.0];
    bar::lying(&mut canvas, [14.0, height + 4.0], size, magnitude, labels);
    let caption = format!(
        "Flicker maps: each pixel’s mean change from frame to frame, yellow from {end} on, which 99.5 % of the \
         reference’s pixels do not exceed."
    );
    Figure::sheet(format!("images/{slug}-flicker.png"), caption, &canvas)
}
