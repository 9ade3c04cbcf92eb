//! Rendered images of a row, with their errors if one is the reference.

use crate::evidence::{Images, Panel};
use crate::experiment::results::Picture;
use crate::render::Film;
use crate::report::colour::SHADE;
use crate::report::contest::median;
use crate::report::phrase;
use crate::report::sheet::{Frame, Frames};
use crate::report::tone;
use crate::report::viewer::{self, Image, Viewer};

/// The images on one exposure, errors on one scale.
pub fn frames(images: &Images) -> Frames {
    let white = images.white.filter(|white| *white > 0.0 && white.is_finite());
    let white = white.or_else(|| images.panels.iter().find_map(film).map(Film::white));
    let white = white.unwrap_or(1.0);
    let reference = images.reference.and_then(|i| images.panels.get(i)).and_then(film);
    let compared = |i: usize, panel: &Panel| {
        let (test, reference) = (film(panel)?, reference?);
        let same = (test.width(), test.height()) == (reference.width(), reference.height());
        (Some(i) != images.reference && same).then(|| (test.clone(), reference.clone()))
    };
    let pairs: Vec<_> = images.panels.iter().enumerate().map(|(i, p)| compared(i, p)).collect();
    let sizes = pairs.iter().flatten().map(|(test, of)| tone::error_size(test, of)).collect();
    let full = median(sizes, |v| v).filter(|v| *v > 0.0).unwrap_or(white);
    let frame = |(panel, pair): (&Panel, &Option<(Film, Film)>)| Frame {
        label: panel.label.clone(),
        remark: if film(panel).is_some() { panel.remark.clone() } else { "no image".into() },
        image: film(panel).map_or_else(nothing, |film| tone::picture(film, white)),
        error: pair.as_ref().map(|(test, of)| tone::error_picture(test, of, full)),
    };
    Frames {
        frames: images.panels.iter().zip(&pairs).map(frame).collect(),
        white,
        full,
        difference: reference_label(images).map_or_else(String::new, |l| format!("image − {l}")),
        across: images.across.max(1),
    }
}

/// The viewer of these images; `None` if some panel has none, or one of another size.
pub fn viewer(images: &Images, frames: &Frames) -> Option<Viewer> {
    let image = |panel| film(panel).map(|film| image_of(panel, film));
    let panels: Option<Vec<Image>> = images.panels.iter().map(image).collect();
    let reference = images.reference.filter(|i| *i < images.panels.len());
    Viewer::of(&viewer::Images {
        images: panels?,
        reference,
        against: usize::from(reference == Some(0) && images.panels.len() > 1),
        // Figures of papers are small, and shown as they were printed: without magnified parts.
        telling: Vec::new(),
        white: frames.white,
        full: frames.full,
        motion: None,
    })
}

/// What the exposure and the colours mean, a sentence or two.
pub fn remark(images: &Images, frames: &Frames) -> String {
    let white = format!("White is radiance {}.", phrase::scale(frames.white));
    match reference_label(images) {
        Some(label) if frames.frames.iter().any(|frame| frame.error.is_some()) => format!(
            "{white} Below each image its difference from {label}: blue too dark, orange too bright, in full \
             colour at ±{}.",
            phrase::number(frames.full)
        ),
        _ => white,
    }
}

fn reference_label(images: &Images) -> Option<&str> {
    images.reference.and_then(|i| images.panels.get(i)).map(|panel| panel.label.as_str())
}

fn image_of<'a>(panel: &Panel, film: &'a Film) -> Image<'a> {
    Image {
        label: panel.label.clone(),
        remark: panel.remark.clone(),
        lines: String::new(),
        films: vec![film],
        prints: Vec::new(),
    }
}

/// A panel's film, if it has one with pixels.
pub fn film(panel: &Panel) -> Option<&Film> {
    panel.film.as_deref().filter(|film| !film.pixels().is_empty())
}

/// In the place of an image that is not there.
fn nothing() -> Picture {
    Picture { width: 1, height: 1, rgb: vec![SHADE.rgb] }
}
