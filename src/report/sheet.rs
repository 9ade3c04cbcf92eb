//! Contact sheets: a scene's reference and each method's image above its error.

use super::bar;
use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{SMALL, TEXT};
use super::colour::{GREY, signed};
use super::contest::{DECIDES, median};
use super::font;
use super::phrase;
use super::tone;
use crate::experiment::results::{Picture, SceneResult};
use crate::method::Truth;

/// Most images in a row.
const ACROSS: usize = 4;
/// Images smaller than this are drawn with more than one unit a pixel.
const LEAST: usize = 180;
const GAP: f32 = 14.0;
const TITLE: f32 = 38.0;
/// Between an image and its error.
const BETWEEN: f32 = 4.0;

/// One image, ready to show.
pub struct Frame {
    /// `reference`, the method's label, or what else it is called.
    pub label: String,
    /// Its samples and error, in words.
    pub remark: String,
    /// The image.
    pub image: Picture,
    /// Its error against the reference; `None` for the reference itself.
    pub error: Option<Picture>,
}

/// Images on one exposure and one scale of error.
pub struct Frames {
    /// The images, in the order they are shown.
    pub frames: Vec<Frame>,
    /// Radiance shown as white.
    pub white: f64,
    /// Error shown in full colour.
    pub full: f64,
    /// What an error is, in words.
    pub difference: String,
    /// Most images in a row.
    pub across: usize,
}

/// The images of a scene: the reference, then the methods at `spp` samples a pixel.
pub fn frames(scene: &SceneResult, spp: u32) -> Frames {
    let reference = &scene.reference;
    let white = reference.film.white();
    let trials: Vec<_> = scene.trials.iter().filter(|t| t.spp == spp).collect();
    let sizes = trials.iter().map(|t| tone::error_size(&t.film, &reference.film)).collect();
    let full = median(sizes, |v| v).filter(|v| *v > 0.0).unwrap_or(white);
    let first = Frame {
        label: "reference".into(),
        remark: match reference.truth {
            Truth::Bumps => format!("{} samples", reference.spp),
            truth => format!("{} samples, {}", reference.spp, truth.name()),
        },
        image: tone::picture(&reference.film, white),
        error: None,
    };
    let methods = trials.into_iter().map(|trial| Frame {
        label: trial.method.clone(),
        remark: trial
            .score(DECIDES)
            .map_or_else(String::new, |e| format!("RMSE {}", phrase::number(e))),
        image: tone::picture(&trial.film, white),
        error: Some(tone::error_picture(&trial.film, &reference.film, full)),
    });
    Frames {
        frames: std::iter::once(first).chain(methods).collect(),
        white,
        full,
        difference: "method − reference".into(),
        across: ACROSS,
    }
}

/// The contact sheet.
pub fn sheet(frames: &Frames) -> Canvas {
    let size = size(frames);
    let errors = frames.frames.iter().any(|f| f.error.is_some());
    let tall = if errors { 2.0 * size[1] + BETWEEN } else { size[1] };
    let cell = [size[0] + GAP, TITLE + tall + GAP];
    let across = frames.frames.len().min(frames.across).max(1);
    let rows = frames.frames.len().div_ceil(across);
    let mut canvas = Canvas::new(across as f32 * cell[0] + GAP, rows as f32 * cell[1] + GAP);
    for (i, frame) in frames.frames.iter().enumerate() {
        let (row, column) = (i / across, i % across);
        let corner = [GAP + column as f32 * cell[0], GAP + row as f32 * cell[1]];
        draw(&mut canvas, frame, corner, size);
        if errors && frame.error.is_none() {
            let below = [corner[0], corner[1] + TITLE + size[1] + BETWEEN];
            key(&mut canvas, below, size, frames);
        }
    }
    canvas
}

/// How large its images are shown: a whole number of units a pixel.
pub fn size(frames: &Frames) -> Point {
    let largest = |side: fn(&Picture) -> usize| frames.frames.iter().map(|f| side(&f.image)).max();
    let (width, height) = (largest(|p| p.width).unwrap_or(1), largest(|p| p.height).unwrap_or(1));
    let zoom = LEAST.div_ceil(width.max(1)).max(1) as f32;
    [width as f32 * zoom, height as f32 * zoom]
}

fn draw(canvas: &mut Canvas, frame: &Frame, [x, y]: Point, size: Point) {
    let bold = Type { bold: true, ..TEXT };
    let label = font::fitted(&frame.label, bold.size, true, size[0]);
    canvas.text([x, y + 13.0], &label, bold);
    let remark = font::fitted(&frame.remark, SMALL.size, false, size[0]);
    canvas.text([x, y + 29.0], &remark, SMALL);
    canvas.picture([x, y + TITLE], size, &frame.image);
    if let Some(error) = &frame.error {
        canvas.picture([x, y + TITLE + size[1] + BETWEEN], size, error);
    }
    canvas.outline(
        &[
            [x, y + TITLE],
            [x + size[0], y + TITLE],
            [x + size[0], y + TITLE + size[1]],
            [x, y + TITLE + size[1]],
        ],
        GREY,
        0.5,
    );
}

/// Where the reference's error would be: the key to the colours of the others.
fn key(canvas: &mut Canvas, [x, y]: Point, size: Point, frames: &Frames) {
    let top = y + 0.5 * size[1] - 10.0;
    let middle = Type { anchor: Anchor::Middle, ..SMALL };
    canvas.text([x + 0.5 * size[0], top - 8.0], &frames.difference, middle);
    let end = phrase::number(frames.full);
    let ends = [&format!("−{end}"), "0", &end];
    bar::lying(canvas, [x, top], [size[0], 14.0], |share| signed(2.0 * share - 1.0), ends);
    canvas.text([x, top + 43.0], "too dark", SMALL);
    canvas.text([x + size[0], top + 43.0], "too bright", Type { anchor: Anchor::End, ..SMALL });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_reference_comes_first_and_every_method_follows() {
        let results = fixture::results();
        let found = frames(&results.scenes[0], 1);
        assert_eq!(found.frames.len(), 7);
        assert!(found.frames[0].error.is_none() && found.frames[1].error.is_some());
        assert!(found.full > 0.0 && found.white > 0.0);
    }

    #[test]
    fn a_black_scene_without_trials_has_a_sheet() {
        let mut scene = fixture::results().scenes.remove(0);
        scene.trials.clear();
        scene.reference.film = std::sync::Arc::new(crate::render::Film::new(3, 2, vec![0.0; 6]));
        assert!(sheet(&frames(&scene, 1)).width() > 0);
    }
}
