//! Distributions of normals on the disc: the hemisphere seen from above, in the (x, y) of the normal.

use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{SMALL, TEXT};
use super::colour::{BLACK, GREY, Ink, WHITE, magnitude};
use super::font;
use super::phrase;
use crate::experiment::results::{MethodInfo, Peak, Picture, Probe};
use crate::geometry::HemisphereGrid;

/// Radius of a disc, units.
const RADIUS: f32 = 92.0;
/// A disc with its title and surroundings.
const CELL: Point = [210.0, 246.0];
/// Pixels across a disc's picture: two a unit.
const PIXELS: usize = 4 * RADIUS as usize;
/// Most discs in a row.
const ACROSS: usize = 4;
/// Room for the colour bar.
const BAR: f32 = 86.0;

/// The true distribution of a probe beside each method's, in the order of `methods`, on one colour
/// scale.
pub fn draw(probe: &Probe, methods: &[MethodInfo]) -> Canvas {
    let most = probe.truth.iter().copied().filter(|v| v.is_finite()).fold(0.0, f32::max);
    let scale = if most > 0.0 { f64::from(most) } else { 1.0 };
    let discs = probe.methods.len() + 1;
    let across = discs.min(ACROSS);
    let rows = discs.div_ceil(across);
    let (width, height) = (across as f32 * CELL[0] + BAR, rows as f32 * CELL[1]);
    let mut canvas = Canvas::new(width, height);
    disc(&mut canvas, place(0, across), "true distribution", "", &probe.truth, scale);
    let place_of = |label: &str| methods.iter().position(|m| m.label == label);
    let mut probed: Vec<_> = probe.methods.iter().collect();
    probed.sort_by_key(|found| place_of(&found.method).unwrap_or(usize::MAX));
    for (i, method) in probed.into_iter().enumerate() {
        let corner = place(i + 1, across);
        let remark = format!("distance {}", phrase::number(method.l1));
        disc(&mut canvas, corner, &method.method, &remark, &method.density, scale);
        method.peaks.iter().for_each(|peak| ring(&mut canvas, corner, peak));
    }
    let bar = [across as f32 * CELL[0] + 10.0, 44.0];
    colour_bar(&mut canvas, bar, [14.0, 2.0 * RADIUS], scale);
    canvas
}

fn place(index: usize, across: usize) -> Point {
    [(index % across) as f32 * CELL[0], (index / across) as f32 * CELL[1]]
}

fn centre(corner: Point) -> Point {
    [corner[0] + 0.5 * CELL[0], corner[1] + 44.0 + RADIUS]
}

fn disc(
    canvas: &mut Canvas,
    corner: Point,
    title: &str,
    remark: &str,
    density: &[f32],
    scale: f64,
) {
    let at = centre(corner);
    let bold = Type { bold: true, anchor: Anchor::Middle, ..TEXT };
    let title = font::fitted(title, bold.size, true, CELL[0] - 12.0);
    canvas.text([at[0], corner[1] + 18.0], &title, bold);
    canvas.text([at[0], corner[1] + 34.0], remark, Type { anchor: Anchor::Middle, ..SMALL });
    let corner = [at[0] - RADIUS, at[1] - RADIUS];
    canvas.picture(corner, [2.0 * RADIUS, 2.0 * RADIUS], &picture(density, scale));
    canvas.ring(at, RADIUS + 0.4, WHITE, 2.4);
    canvas.ring(at, RADIUS, GREY, 1.0);
}

/// A lobe's axis: a light ring with a dark edge, seen on every colour.
fn ring(canvas: &mut Canvas, corner: Point, peak: &Peak) {
    let [x, y, _] = peak.axis;
    let centre = centre(corner);
    let at = [centre[0] + RADIUS * x, centre[1] - RADIUS * y];
    canvas.ring(at, 4.0, Ink { opacity: 170, ..BLACK }, 2.6);
    canvas.ring(at, 4.0, WHITE, 1.3);
}

/// Every pixel in the colour of the grid cell above it; x to the right, y up.
fn picture(density: &[f32], scale: f64) -> Picture {
    let cells = &*CELLS;
    let colour = |cell: &Option<u16>| match cell.and_then(|i| density.get(usize::from(i))) {
        Some(d) => magnitude((f64::from(d.max(0.0)) / scale).sqrt()),
        None => WHITE.rgb,
    };
    Picture { width: PIXELS, height: PIXELS, rgb: cells.iter().map(colour).collect() }
}

/// The grid cell under each pixel of a disc's picture.
static CELLS: std::sync::LazyLock<Vec<Option<u16>>> = std::sync::LazyLock::new(|| {
    let grid = HemisphereGrid::fournier();
    let at = |i: usize| (i as f64 + 0.5) / PIXELS as f64 * 2.0 - 1.0;
    let cell = |i: usize| cell_at(&grid, at(i % PIXELS), -at(i / PIXELS));
    (0..PIXELS * PIXELS).map(cell).collect()
});

/// The index of the sample whose cell holds the normal above (x, y); `None` off the disc.
fn cell_at(grid: &HemisphereGrid, x: f64, y: f64) -> Option<u16> {
    use std::f64::consts::{FRAC_PI_2, TAU};
    let radius = (x * x + y * y).sqrt();
    if radius > 1.0 {
        return None;
    }
    let theta = libm::asin(radius);
    let step = FRAC_PI_2 / grid.rings() as f64;
    if theta < step / 12.0 {
        return Some(0);
    }
    let ring = ((theta / step) as usize).min(grid.rings() - 1);
    // Azimuths are the middles of their cells.
    let turn = libm::atan2(y, x) / TAU + 1.0;
    let azimuth = (turn * grid.azimuths() as f64 + 0.5) as usize % grid.azimuths();
    Some((1 + ring * grid.azimuths() + azimuth) as u16)
}

fn colour_bar(canvas: &mut Canvas, [x, y]: Point, [width, height]: Point, scale: f64) {
    const STEPS: usize = 128;
    let rgb = (0..STEPS).map(|i| magnitude(1.0 - (i as f64 + 0.5) / STEPS as f64)).collect();
    canvas.picture([x, y], [width, height], &Picture { width: 1, height: STEPS, rgb });
    let frame = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
    canvas.outline(&frame, GREY, 1.0);
    for share in [0.0f64, 0.0625, 0.25, 0.5625, 1.0] {
        let at = y + height * (1.0 - share.sqrt() as f32);
        canvas.line(&[[x + width, at], [x + width + 4.0, at]], GREY, 1.0, None);
        let bound = if share == 1.0 { "≥ " } else { "" };
        let label = format!("{bound}{}", phrase::scale(share * scale));
        canvas.text([x + width + 7.0, at + 4.0], &label, SMALL);
    }
    canvas.text([x - 2.0, y - 22.0], "density", SMALL);
    canvas.text([x - 2.0, y - 9.0], "a steradian", SMALL);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_lies_in_its_own_cell() {
        let grid = HemisphereGrid::fournier();
        for (i, sample) in grid.samples().iter().enumerate() {
            let found = cell_at(&grid, sample.direction.x, sample.direction.y);
            assert_eq!(found, Some(i as u16));
        }
        assert_eq!(cell_at(&grid, 0.9, 0.9), None);
    }

    #[test]
    fn an_empty_distribution_is_drawn() {
        let probe = Probe { pixel: [0, 0], texels_across: 0.0, truth: vec![], methods: vec![] };
        assert!(draw(&probe, &[]).width() > 0);
    }
}
