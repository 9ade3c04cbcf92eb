//! A row's figures, drawn.

use rayon::prelude::*;
use serde::Serialize;

use super::{fields, file_name, images, net, plot, sketch};
use crate::evidence::{Drawing, Evidence, Figure, Images};
use crate::report::figure::{self, FrameImages};
use crate::report::viewer::Viewer;
use crate::report::words::DISTRIBUTIONS_ALONE;
use crate::report::{disc, polar, sheet};

/// A figure as the report shows it.
#[derive(Serialize)]
pub struct Drawn {
    /// The drawing, or the contact sheet of the images.
    figure: figure::Figure,
    /// How to read it; empty if that has been said of an earlier figure of the row.
    reading: String,
    /// The viewer of the images; none for other drawings, and where the page has no room for it.
    viewer: Option<Viewer>,
    /// The images one by one, for flipping, where there is no viewer; none for other drawings.
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

/// Bytes of films that a page holds, as text.
const ROOM: usize = 14 << 20;

/// Every figure drawn: row by row, figure by figure. The page holds the films of the first ones, as far as it has room.
pub fn of(evidence: &Evidence) -> Vec<Vec<Drawn>> {
    let all: Vec<(&str, &Figure)> = evidence
        .exhibits
        .iter()
        .flat_map(|exhibit| exhibit.figures.iter().map(|figure| (exhibit.row.as_str(), figure)))
        .collect();
    // One by one in parallel, kept in order.
    let mut drawn: Vec<Drawn> = all.par_iter().map(|(row, figure)| draw(row, figure)).collect();
    make_room(&mut drawn, ROOM);
    let mut drawn = drawn.into_iter();
    let of_row = |figures: &Vec<Figure>| said_once(drawn.by_ref().take(figures.len()).collect());
    evidence.exhibits.iter().map(|exhibit| &exhibit.figures).map(of_row).collect()
}

/// Keeps viewers as far as `room`, in bytes, lasts, and in their place pictures.
fn make_room(figures: &mut [Drawn], mut room: usize) {
    for figure in figures {
        let Some(viewer) = &figure.viewer else { continue };
        match room.checked_sub(viewer.size(viewer.len())) {
            Some(left) => (room, figure.frames) = (left, Vec::new()),
            None => figure.viewer = None,
        }
    }
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
        viewer: None,
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
        viewer: images::viewer(panels, &frames),
        frames: frames.frames.iter().map(FrameImages::of).collect(),
        wide: sheet::size(&frames)[0] as usize,
        across: frames.across.min(frames.frames.len()).max(1),
        films: panels.panels.iter().filter_map(film).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::evidence::fixture;

    #[test]
    fn figures_have_a_viewer_while_there_is_room_and_pictures_then() {
        let evidence = fixture::evidence();
        let exhibit = evidence.exhibits.iter().find(|e| e.row == "fournier-f9").unwrap();
        let drawn = || exhibit.figures.iter().map(|f| draw("x", f)).collect::<Vec<_>>();
        let sizes: Vec<usize> =
            drawn().iter().filter_map(|d| d.viewer.as_ref()).map(|v| v.size(v.len())).collect();
        assert_eq!(sizes.len(), 2);
        for (room, kept) in
            [(usize::MAX, [true, true]), (sizes[0], [true, false]), (0, [false, false])]
        {
            let mut figures = drawn();
            make_room(&mut figures, room);
            for (figure, kept) in figures.iter().zip(kept) {
                assert_eq!(figure.viewer.is_some(), kept);
                assert_eq!(figure.frames.len(), if kept { 0 } else { 3 });
            }
        }
    }
}
