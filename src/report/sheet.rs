//! Contact sheets: a scene's reference and each method's image above its error.

use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{SMALL, TEXT};
use super::colour::{GREY, signed};
use super::contest::{DECIDES, median};
use super::font;
use super::phrase;
use super::tone;
use crate::experiment::results::{Picture, SceneResult};

/// Most images in a row.
const ACROSS: usize = 4;
/// Images smaller than this are drawn with more than one unit a pixel.
const LEAST: usize = 180;
const GAP: f32 = 14.0;
const TITLE: f32 = 38.0;

/// One image of a scene, ready to show.
pub struct Frame {
    /// `reference` or the method's label.
    pub label: String,
    /// Its samples and error, in words.
    pub remark: String,
    /// The image.
    pub image: Picture,
    /// Its error against the reference; `None` for the reference itself.
    pub error: Option<Picture>,
}

/// A scene's images on one exposure and one scale of error.
pub struct Frames {
    /// The reference first, then the methods at `spp` samples a pixel.
    pub frames: Vec<Frame>,
    /// Radiance shown as white.
    pub white: f64,
    /// Error shown in full colour.
    pub full: f64,
}

/// The images of a scene at `spp` samples a pixel.
pub fn frames(scene: &SceneResult, spp: u32) -> Frames {
    let reference = &scene.reference;
    let white = reference.film.white();
    let trials: Vec<_> = scene.trials.iter().filter(|t| t.spp == spp).collect();
    let sizes = trials.iter().map(|t| tone::error_size(&t.film, &reference.film)).collect();
    let full = median(sizes, |v| v).filter(|v| *v > 0.0).unwrap_or(white);
    let first = Frame {
        label: "reference".into(),
        remark: format!("{} samples", reference.spp),
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
    Frames { frames: std::iter::once(first).chain(methods).collect(), white, full }
}

/// The contact sheet.
pub fn sheet(frames: &Frames) -> Canvas {
    let largest = |side: fn(&Picture) -> usize| frames.frames.iter().map(|f| side(&f.image)).max();
    let (width, height) = (largest(|p| p.width).unwrap_or(1), largest(|p| p.height).unwrap_or(1));
    let zoom = LEAST.div_ceil(width.max(1)).max(1) as f32;
    let size = [width as f32 * zoom, height as f32 * zoom];
    let cell = [size[0] + GAP, TITLE + 2.0 * size[1] + 4.0 + GAP];
    let across = frames.frames.len().min(ACROSS);
    let rows = frames.frames.len().div_ceil(across.max(1));
    let mut canvas = Canvas::new(across as f32 * cell[0] + GAP, rows as f32 * cell[1] + GAP);
    for (i, frame) in frames.frames.iter().enumerate() {
        let (row, column) = (i / across, i % across);
        let corner = [GAP + column as f32 * cell[0], GAP + row as f32 * cell[1]];
        draw(&mut canvas, frame, corner, size);
        if frame.error.is_none() {
            key(&mut canvas, [corner[0], corner[1] + TITLE + size[1] + 4.0], size, frames.full);
        }
    }
    canvas
}

fn draw(canvas: &mut Canvas, frame: &Frame, [x, y]: Point, size: Point) {
    let bold = Type { bold: true, ..TEXT };
    let label = font::fitted(&frame.label, bold.size, true, size[0]);
    canvas.text([x, y + 13.0], &label, bold);
    canvas.text([x, y + 29.0], &frame.remark, SMALL);
    canvas.picture([x, y + TITLE], size, &frame.image);
    if let Some(error) = &frame.error {
        canvas.picture([x, y + TITLE + size[1] + 4.0], size, error);
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
fn key(canvas: &mut Canvas, [x, y]: Point, size: Point, full: f64) {
    const STEPS: usize = 64;
    let rgb = (0..STEPS).map(|i| signed((i as f64 + 0.5) / STEPS as f64 * 2.0 - 1.0)).collect();
    let bar = [size[0], 14.0];
    let top = y + 0.5 * size[1] - 10.0;
    let middle = Type { anchor: Anchor::Middle, ..SMALL };
    canvas.text([x + 0.5 * size[0], top - 8.0], "method − reference", middle);
    canvas.picture([x, top], bar, &Picture { width: STEPS, height: 1, rgb });
    let frame = [[x, top], [x + bar[0], top], [x + bar[0], top + bar[1]], [x, top + bar[1]]];
    canvas.outline(&frame, GREY, 0.5);
    let end = phrase::number(full);
    canvas.text([x, top + 28.0], &format!("−{end}"), SMALL);
    canvas.text([x + 0.5 * size[0], top + 28.0], "0", middle);
    canvas.text([x + size[0], top + 28.0], &end, Type { anchor: Anchor::End, ..SMALL });
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
