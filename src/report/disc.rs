//! Distributions of normals on the disc: the hemisphere seen from above, in the (x, y) of the normal.

use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{SMALL, TEXT};
use super::colour::{self, BLACK, GREY, Ink, WHITE, magnitude};
use super::{bar, font, phrase};
use crate::evidence::Disc;
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
/// Room for the bar below a disc on a scale of its own.
const OWN_BAR: f32 = 32.0;

/// The true distribution of a probe beside each method's, in the order of `methods`, on the colour
/// scale of the true one.
pub fn probe(probe: &Probe, methods: &[MethodInfo]) -> Canvas {
    let disc = |label: &str, remark: String, density: &[f32], peaks: &[Peak]| Disc {
        label: label.to_owned(),
        remark,
        density: density.iter().copied().map(f64::from).collect(),
        peaks: peaks.iter().map(|peak| peak.axis.map(f64::from)).collect(),
        own_scale: false,
    };
    let mut discs = vec![disc("true distribution", String::new(), &probe.truth, &[])];
    let scale = greatest(&discs[0]);
    let place_of = |label: &str| methods.iter().position(|m| m.label == label);
    let mut probed: Vec<_> = probe.methods.iter().collect();
    probed.sort_by_key(|found| place_of(&found.method).unwrap_or(usize::MAX));
    discs.extend(probed.into_iter().map(|found| {
        let remark = format!("distance {}", phrase::number(found.l1));
        disc(&found.method, remark, &found.density, &found.peaks)
    }));
    draw(&discs, scale)
}

/// Distributions side by side on one colour scale, that of the greatest density among them, but for
/// those that ask for their own.
pub fn discs(discs: &[Disc]) -> Canvas {
    let common = discs.iter().filter(|disc| !disc.own_scale);
    draw(discs, common.map(greatest).fold(0.0, f64::max))
}

fn draw(discs: &[Disc], scale: f64) -> Canvas {
    let scale = if scale > 0.0 { scale } else { 1.0 };
    let below = if discs.iter().any(|disc| disc.own_scale) { OWN_BAR } else { 0.0 };
    let cell = [CELL[0], CELL[1] + below];
    let across = discs.len().clamp(1, ACROSS);
    let rows = discs.len().div_ceil(across);
    let (width, height) = (across as f32 * cell[0] + BAR, rows as f32 * cell[1]);
    let mut canvas = Canvas::new(width, height);
    for (i, disc) in discs.iter().enumerate() {
        let corner = [(i % across) as f32 * cell[0], (i / across) as f32 * cell[1]];
        let own = if disc.own_scale { greatest(disc) } else { scale };
        one(&mut canvas, corner, disc, if own > 0.0 { own } else { 1.0 });
    }
    if discs.iter().any(|disc| !disc.own_scale) {
        let bar = [across as f32 * cell[0] + 10.0, 44.0];
        let common = discs.iter().filter(|disc| !disc.own_scale);
        let beyond = common.map(greatest).any(|most| most > scale);
        colour_bar(&mut canvas, bar, [14.0, 2.0 * RADIUS], scale, beyond);
    }
    canvas
}

/// The greatest size of its finite values.
fn greatest(disc: &Disc) -> f64 {
    disc.density.iter().map(|d| d.abs()).filter(|d| d.is_finite()).fold(0.0, f64::max)
}

/// Whether it is a difference: drawn in two hues.
fn signed(disc: &Disc) -> bool {
    disc.density.iter().any(|d| *d < 0.0)
}

fn one(canvas: &mut Canvas, corner: Point, disc: &Disc, scale: f64) {
    let at = [corner[0] + 0.5 * CELL[0], corner[1] + 44.0 + RADIUS];
    let bold = Type { bold: true, anchor: Anchor::Middle, ..TEXT };
    let room = CELL[0] - 12.0;
    let title = font::fitted(&disc.label, bold.size, true, room);
    canvas.text([at[0], corner[1] + 18.0], &title, bold);
    let remark = font::fitted(&disc.remark, SMALL.size, false, room);
    canvas.text([at[0], corner[1] + 34.0], &remark, Type { anchor: Anchor::Middle, ..SMALL });
    let corner = [at[0] - RADIUS, at[1] - RADIUS];
    canvas.picture(corner, [2.0 * RADIUS, 2.0 * RADIUS], &picture(disc, scale));
    canvas.ring(at, RADIUS + 0.4, WHITE, 2.4);
    canvas.ring(at, RADIUS, GREY, 1.0);
    let seen = disc.peaks.iter().filter(|peak| peak[0].is_finite() && peak[1].is_finite());
    seen.for_each(|peak| ring(canvas, at, *peak));
    if disc.own_scale {
        own_bar(canvas, [corner[0], corner[1] + 2.0 * RADIUS + 10.0], disc, scale);
    }
}

/// A lobe's axis: a light ring with a dark edge, seen on every colour. An axis below the horizon stands
/// at the edge.
fn ring(canvas: &mut Canvas, centre: Point, [x, y, z]: [f64; 3]) {
    let out = if z < 0.0 { 1.0 / (x * x + y * y).sqrt().max(1e-9) } else { 1.0 };
    let [x, y] = [x * out, y * out].map(|c| c.clamp(-1.0, 1.0) as f32);
    let at = [centre[0] + RADIUS * x, centre[1] - RADIUS * y];
    canvas.ring(at, 4.0, Ink { opacity: 170, ..BLACK }, 2.6);
    canvas.ring(at, 4.0, WHITE, 1.3);
}

/// Every pixel in the colour of the grid cell above it; x to the right, y up.
fn picture(disc: &Disc, scale: f64) -> Picture {
    let cells = &*CELLS;
    let two = signed(disc);
    let colour = |cell: &Option<u16>| match cell.and_then(|i| disc.density.get(usize::from(i))) {
        Some(d) if two => colour::signed(d / scale),
        Some(d) => magnitude((d.max(0.0) / scale).sqrt()),
        None => WHITE.rgb,
    };
    Picture { width: PIXELS, height: PIXELS, rgb: cells.iter().map(colour).collect() }
}

/// The grid cell under each pixel of a disc's picture.
static CELLS: std::sync::LazyLock<Vec<Option<u16>>> = std::sync::LazyLock::new(|| {
    let at = |i: usize| (i as f64 + 0.5) / PIXELS as f64 * 2.0 - 1.0;
    let cell = |i: usize| cell_of_normal(at(i % PIXELS), -at(i / PIXELS));
    (0..PIXELS * PIXELS).map(cell).collect()
});

/// The index of the direction of [`HemisphereGrid::fournier`] whose cell holds the normal above (x, y); `None` off the
/// disc.
pub fn cell_of_normal(x: f64, y: f64) -> Option<u16> {
    static GRID: std::sync::LazyLock<HemisphereGrid> =
        std::sync::LazyLock::new(HemisphereGrid::fournier);
    cell_at(&GRID, x, y)
}

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

/// The key to densities; `beyond`, if some exceed the scale.
fn colour_bar(canvas: &mut Canvas, [x, y]: Point, size: Point, scale: f64, beyond: bool) {
    let label = |share: f64| {
        let bound = if share == 1.0 && beyond { "≥ " } else { "" };
        (share.sqrt() as f32, format!("{bound}{}", phrase::scale(share * scale)))
    };
    let labels = [0.0f64, 0.0625, 0.25, 0.5625, 1.0].map(label);
    bar::upright(canvas, [x, y], size, magnitude, &labels);
    canvas.text([x - 2.0, y - 22.0], "density", SMALL);
    canvas.text([x - 2.0, y - 9.0], "a steradian", SMALL);
}

/// The key to a disc on a scale of its own.
fn own_bar(canvas: &mut Canvas, corner: Point, disc: &Disc, scale: f64) {
    let (size, end) = ([2.0 * RADIUS, 9.0], phrase::scale(scale));
    if signed(disc) {
        let ends = [&format!("−{end}"), "0", &end];
        bar::lying(canvas, corner, size, |share| colour::signed(2.0 * share - 1.0), ends);
    } else {
        // The middle of a scale of square roots is a quarter.
        let ends = ["0", &phrase::scale(0.25 * scale), &end];
        bar::lying(canvas, corner, size, magnitude, ends);
    }
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
        let empty = Probe { pixel: [0, 0], texels_across: 0.0, truth: vec![], methods: vec![] };
        assert!(probe(&empty, &[]).width() > 0);
        assert!(discs(&[]).width() > 0);
    }

    #[test]
    fn differences_are_drawn_in_two_hues_and_what_is_no_number_is_seen() {
        let disc = |density| Disc {
            label: "residual".into(),
            remark: String::new(),
            density,
            peaks: vec![[f64::NAN; 3], [0.0, 0.6, -0.8]],
            own_scale: true,
        };
        let of = |density: Vec<f64>| picture(&disc(density), 1.0).rgb;
        let middle = PIXELS * PIXELS / 2 + PIXELS / 2;
        assert_eq!(of(vec![-1.0; 1297])[middle], colour::signed(-1.0));
        assert_eq!(of(vec![1.0; 1297])[middle], magnitude(1.0));
        let mut broken = vec![-0.5; 1297];
        broken[0] = f64::NAN;
        assert!(of(broken.clone()).contains(&[0; 3]));
        assert!(discs(&[disc(broken)]).width() > 0);
    }
}
