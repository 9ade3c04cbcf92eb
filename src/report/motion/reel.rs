//! The pictures of a sequence: animations side by side, frames as files, flicker maps.

use serde::Serialize;

use super::animation::Codes;
use super::answer::moves;
use super::standing::Race;
use super::{curves, tables};
use crate::experiment::results::{Picture, Results};
use crate::experiment::sequence::{films, references};
use crate::metric::flicker_map;
use crate::render::{Film, percentile};
use crate::report::bar;
use crate::report::canvas::Canvas;
use crate::report::colour::magnitude;
use crate::report::contest::setting_name;
use crate::report::figure::{Figure, data_uri};
use crate::report::phrase::{count, number, percent};
use crate::report::png;
use crate::report::scale::texels;
use crate::report::sheet::{self, Frame, Frames};
use crate::report::tables::Table;

/// Animations to an image's row of the Markdown report and the sheet of maps.
const ACROSS: usize = 4;

/// A sequence, ready to show.
#[derive(Serialize)]
pub struct Reel {
    heading: String,
    setting: String,
    remark: String,
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

/// An image in motion.
#[derive(Serialize)]
struct Clip {
    label: String,
    remark: String,
    /// The animation's file, relative to the report.
    file: String,
    /// The animation as the page holds it; None if the page has no room for it and shows the file.
    uri: Option<String>,
    /// The first frame, for those who want no motion.
    still: String,
    /// Its flicker map.
    map: String,
    #[serde(skip)]
    animation: Vec<u8>,
    #[serde(skip)]
    frames: Vec<Vec<u8>>,
}

impl Reel {
    /// The pictures of a sequence at `spp` samples a pixel. Its animations go into the page as far as `room`, in
    /// bytes, lasts.
    pub fn of(results: &Results, race: &Race, spp: u32, room: &mut usize) -> Self {
        let slug = &race.sequence.slug;
        let truth = references(race.frames);
        let all = || truth.iter().flat_map(|film| film.pixels()).copied();
        let white = Some(percentile(all())).filter(|white| *white > 0.0).unwrap_or(1.0);
        let map = flicker_map(&truth).unwrap_or_else(|| truth[0].clone());
        let full = Some(percentile(map.pixels().iter().copied())).filter(|full| *full > 0.0);
        let full = full.unwrap_or(white);
        let fps = results.motion.map_or(12, |motion| motion.fps);

        let mut shown: Vec<Shown> = vec![Shown {
            label: "reference",
            remark: format!("{} samples", race.frames[0].reference.spp),
            films: truth,
        }];
        shown.extend(race.standings.iter().filter_map(|standing| {
            let label = standing.method.label.as_str();
            let wrong = |wrong| format!("wrong change {}", percent(wrong));
            let remark = standing.wrong.map_or_else(String::new, wrong);
            Some(Shown { label, remark, films: films(race.frames, label, spp)? })
        }));
        let clips: Vec<Clip> = shown.iter().map(|s| s.clip(slug, white, full, fps, room)).collect();
        let order: Vec<usize> = (0..clips.len()).collect();
        Self {
            heading: heading(race),
            setting: setting_name(results, &race.frames[0].key),
            remark: format!(
                "{} {} at {} a second, {} a pixel. White is radiance {}.",
                results.motion.as_ref().map_or_else(String::new, moves),
                count(race.frames.len(), "frame"),
                fps,
                count(spp as usize, "sample"),
                number(white),
            ),
            plots: plots(results, race),
            table: tables::flicker(race),
            maps: maps(&shown, slug, full),
            rows: order.chunks(ACROSS).map(<[usize]>::to_vec).collect(),
            slug: slug.clone(),
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

/// A method's films, or the reference's.
struct Shown<'a> {
    label: &'a str,
    remark: String,
    films: Vec<&'a Film>,
}

impl Shown<'_> {
    fn clip(&self, slug: &str, white: f64, full: f64, fps: u32, room: &mut usize) -> Clip {
        let codes = Codes::of(&self.films, white);
        let animation = codes.animated(fps);
        let fits = animation.len() <= *room;
        if fits {
            *room -= animation.len();
        }
        Clip {
            label: self.label.to_owned(),
            remark: self.remark.clone(),
            file: format!("animations/{slug}/{}.png", self.label),
            uri: fits.then(|| data_uri(&animation)),
            still: data_uri(&codes.still(0)),
            map: data_uri(&png::exact(&self.map(full))),
            animation,
            frames: (0..self.films.len()).map(|frame| codes.still(frame)).collect(),
        }
    }

    /// Its flicker map in colour, `full` the change of the last colour.
    fn map(&self, full: f64) -> Picture {
        let map = flicker_map(&self.films).unwrap_or_else(|| self.films[0].clone());
        let rgb = map.pixels().iter().map(|change| magnitude(f64::from(*change) / full));
        Picture { width: map.width(), height: map.height(), rgb: rgb.collect() }
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
