//! A row's figures, drawn.

use rayon::prelude::*;
use serde::Serialize;

use super::{fields, file_name, images, net, plot, sketch};
use crate::evidence::{Drawing, Evidence, Figure, Images};
use crate::report::figure::{self, FrameImages};
use crate::report::words::DISTRIBUTIONS_ALONE;
use crate::report::{disc, polar, sheet};

/// A figure as the report shows it.
#[derive(Serialize)]
pub struct Drawn {
    /// The drawing, or the contact sheet of the images.
    figure: figure::Figure,
    /// How to read it; empty if that has been said of an earlier figure of the row.
    reading: String,
    /// The images one by one, for flipping; none for other drawings.
    frames: Vec<FrameImages>,
    /// How wide the largest image is shown, CSS pixels, and how many stand in a row.
    wide: usize,
    across: usize,
    /// The images as floats.
    films: Vec<FilmFile>,
}

/// An EXR file that the run wrote.
#[derive(Serialize)]
struct FilmFile {
    label: String,
    path: String,
}

impl Drawn {
    /// Its file's name and bytes.
    pub fn file(&self) -> (&str, &[u8]) {
        (&self.figure.file, &self.figure.png)
    }
}

/// Every figure drawn: row by row, figure by figure.
pub fn of(evidence: &Evidence) -> Vec<Vec<Drawn>> {
    let all: Vec<(&str, &Figure)> = evidence
        .exhibits
        .iter()
        .flat_map(|exhibit| exhibit.figures.iter().map(|figure| (exhibit.row.as_str(), figure)))
        .collect();
    // One by one in parallel, kept in order.
    let drawn: Vec<Drawn> = all.par_iter().map(|(row, figure)| draw(row, figure)).collect();
    let mut drawn = drawn.into_iter();
    let of_row = |figures: &Vec<Figure>| said_once(drawn.by_ref().take(figures.len()).collect());
    evidence.exhibits.iter().map(|exhibit| &exhibit.figures).map(of_row).collect()
}

/// Leaves out of each figure what an earlier one says of reading it.
fn said_once(mut figures: Vec<Drawn>) -> Vec<Drawn> {
    for i in (1..figures.len()).rev() {
        let (before, rest) = figures.split_at_mut(i);
        if before.iter().any(|figure| figure.reading == rest[0].reading) {
            rest[0].reading.clear();
        }
    }
    figures
}

fn draw(row: &str, figure: &Figure) -> Drawn {
    let name = file_name(&format!("{row}-{}", figure.name));
    let file = format!("plots/{name}.png");
    let caption = figure.caption.clone();
    let (canvas, reading) = match &figure.drawing {
        Drawing::Images(panels) => return draw_images(row, panels, file, caption),
        Drawing::Discs(discs) => (disc::discs(discs), DISTRIBUTIONS_ALONE),
        Drawing::Chart(chart) => (plot::draw(chart), ""),
        Drawing::Fields(list) => (fields::draw(list), ""),
        Drawing::Lobes(plots) => (polar::draw(plots), READING_LOBES),
        Drawing::Nets(tables) => (net::draw(tables), ""),
        Drawing::Sketches(list) => (sketch::draw(list), ""),
    };
    Drawn {
        figure: figure::Figure::drawing(file, caption, &canvas),
        reading: reading.into(),
        frames: Vec::new(),
        wide: 0,
        across: 1,
        films: Vec::new(),
    }
}

/// How to read polar plots.
const READING_LOBES: &str = "The plane of incidence, light from the left along the arrows; the distance from the middle \
    is the radiance that leaves in that direction, for unit irradiance on a plane facing the light.";

fn draw_images(row: &str, panels: &Images, file: String, caption: String) -> Drawn {
    let frames = images::frames(panels);
    let film = |panel: &crate::evidence::Panel| {
        let path = format!("images/{}/{}.exr", file_name(row), file_name(&panel.name));
        images::film(panel).map(|_| FilmFile { label: panel.label.clone(), path })
    };
    Drawn {
        reading: images::remark(panels, &frames),
        figure: figure::Figure::sheet(file, caption, &sheet::sheet(&frames)),
        frames: frames.frames.iter().map(FrameImages::of).collect(),
        wide: sheet::size(&frames)[0] as usize,
        across: frames.across.min(frames.frames.len()).max(1),
        films: panels.panels.iter().filter_map(film).collect(),
    }
}
