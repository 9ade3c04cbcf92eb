//! Reflection in the plane of incidence: polar plots above the line of the surface.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{HALF_CAPITAL, SMALL, TEXT};
use super::colour::{BLACK, GREY, Ink, PALE, series};
use super::{font, phrase};
use crate::evidence::{LobePlot, Reflection};

/// Radius of the greatest ring, units.
const RADIUS: f32 = 150.0;
const CELL: Point = [384.0, 262.0];
const ACROSS: usize = 2;
/// With more rings than these, every second is labelled.
const MOST_LABELS: usize = 7;
/// The middle of the surface within a cell.
const CENTRE: Point = [192.0, 214.0];

/// Polar plots side by side, radiance on one linear scale.
pub fn draw(plots: &[LobePlot]) -> Canvas {
    let radiances = plots.iter().flat_map(|p| &p.reflections).flat_map(|r| &r.exits).map(|e| e[1]);
    let most = radiances.filter(|r| r.is_finite()).fold(0.0, f64::max);
    let axis = Axis::linear([0.0, most].into_iter());
    let across = plots.len().clamp(1, ACROSS);
    let rows = plots.len().div_ceil(across);
    let mut canvas = Canvas::new(across as f32 * CELL[0], rows as f32 * CELL[1] + 8.0);
    for (i, plot) in plots.iter().enumerate() {
        let corner = [(i % across) as f32 * CELL[0], (i / across) as f32 * CELL[1]];
        one(&mut canvas, corner, plot, &axis);
    }
    canvas
}

fn one(canvas: &mut Canvas, corner: Point, plot: &LobePlot, axis: &Axis) {
    let centre = [corner[0] + CENTRE[0], corner[1] + CENTRE[1]];
    let title = font::fitted(&plot.label, TEXT.size, true, 250.0);
    canvas.text([corner[0] + 14.0, corner[1] + 18.0], &title, Type { bold: true, ..TEXT });
    let azimuth = format!("azimuth {}°", phrase::signed_scale(plot.azimuth));
    let at = [corner[0] + CELL[0] - 14.0, corner[1] + 18.0];
    canvas.text(at, &azimuth, Type { anchor: Anchor::End, ..SMALL });
    grid(canvas, centre, axis);
    for (i, reflection) in plot.reflections.iter().enumerate() {
        let ink = series(i).ink;
        curve(canvas, centre, reflection, axis, ink);
        arrow(canvas, centre, reflection.incidence, ink);
    }
    let [left, right] = [14.0, CELL[0] - 14.0].map(|x| corner[0] + x);
    let foot = corner[1] + CELL[1] - 8.0;
    key(canvas, [left, foot], plot);
    canvas.text([right, foot], "radiance outwards", Type { anchor: Anchor::End, ..SMALL });
}

/// The point at an angle from the normal, degrees, and a distance from the middle.
fn polar(centre: Point, degrees: f64, distance: f32) -> Point {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    [centre[0] + distance * sin as f32, centre[1] - distance * cos as f32]
}

fn arc(centre: Point, radius: f32) -> Vec<Point> {
    (-90..=90).map(|degrees| polar(centre, f64::from(degrees), radius)).collect()
}

/// Rings at round radiances, spokes every 30°, the surface.
fn grid(canvas: &mut Canvas, centre: Point, axis: &Axis) {
    for degrees in (-90..=90).step_by(30).map(f64::from) {
        canvas.line(&[centre, polar(centre, degrees, RADIUS)], PALE, 0.9, None);
        let at = polar(centre, degrees, RADIUS + 13.0);
        let anchor = match degrees as i32 {
            -90..=-1 => Anchor::End,
            0 => Anchor::Middle,
            _ => Anchor::Start,
        };
        let label = format!("{}°", phrase::signed_scale(degrees));
        let at = [at[0], at[1] + if degrees == 0.0 { 2.0 } else { HALF_CAPITAL * SMALL.size }];
        canvas.text(at, &label, Type { anchor, ..SMALL });
    }
    let every = if axis.ticks.len() > MOST_LABELS { 2 } else { 1 };
    for (i, tick) in axis.ticks.iter().enumerate() {
        let radius = RADIUS * axis.place(tick.value);
        canvas.line(&arc(centre, radius), PALE, 0.9, None);
        if i % every == 0 {
            let at = [centre[0] + radius, centre[1] + 14.0];
            canvas.text(at, &tick.label, Type { anchor: Anchor::Middle, size: 10.0, ..SMALL });
        }
    }
    canvas.line(&arc(centre, RADIUS), GREY, 1.0, None);
    let [left, right] = [-1.0, 1.0].map(|side| [centre[0] + side * RADIUS, centre[1]]);
    canvas.line(&[left, right], BLACK, 2.0, None);
}

fn curve(canvas: &mut Canvas, centre: Point, of: &Reflection, axis: &Axis, ink: Ink) {
    let finite = of.exits.iter().filter(|e| e.iter().all(|c| c.is_finite()));
    let above = finite.filter(|[exit, _]| (-90.0..=90.0).contains(exit));
    let points: Vec<Point> = above
        .map(|&[exit, radiance]| polar(centre, exit, RADIUS * axis.place(radiance.max(0.0))))
        .collect();
    canvas.line(&points, ink, 1.8, None);
}

/// The direction light comes from, pointing at the surface.
fn arrow(canvas: &mut Canvas, centre: Point, incidence: f64, ink: Ink) {
    if !(-90.0..=90.0).contains(&incidence) {
        return;
    }
    let [tail, tip] = [RADIUS * 0.98, RADIUS * 0.74].map(|r| polar(centre, -incidence, r));
    canvas.line(&[tail, tip], ink, 1.6, None);
    let [along_x, along_y] = [0, 1].map(|c| (tip[c] - tail[c]) / (0.24 * RADIUS));
    let side =
        |s: f32| [tip[0] - 8.0 * along_x - s * along_y, tip[1] - 8.0 * along_y + s * along_x];
    canvas.polygon(&[tip, side(4.0), side(-4.0)], ink);
}

/// The colours, one an incidence.
fn key(canvas: &mut Canvas, [x, y]: Point, plot: &LobePlot) {
    canvas.text([x, y], "light from", SMALL);
    let mut at = x + font::width("light from", SMALL.size, false) + 8.0;
    for (i, reflection) in plot.reflections.iter().enumerate() {
        let label = format!("{}°", phrase::signed_scale(reflection.incidence));
        canvas.line(&[[at, y - 4.0], [at + 16.0, y - 4.0]], series(i).ink, 2.4, None);
        canvas.text([at + 20.0, y], &label, SMALL);
        at += 32.0 + font::width(&label, SMALL.size, false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_comes_from_the_left_and_leaves_to_the_right() {
        let [x, y] = polar([0.0, 0.0], 90.0, 2.0);
        assert!((x - 2.0).abs() < 1e-6 && y.abs() < 1e-6);
        let [x, y] = polar([0.0, 0.0], -30.0, 1.0);
        assert!(x < 0.0 && y < 0.0, "up is towards the top");
    }

    #[test]
    fn odd_plots_are_drawn() {
        let plot = |exits| LobePlot {
            label: "velvet".into(),
            azimuth: f64::NAN,
            reflections: vec![Reflection { incidence: f64::NAN, exits }],
        };
        assert!(draw(&[]).width() > 0);
        assert!(draw(&[plot(vec![])]).width() > 0);
        assert!(
            draw(&[plot(vec![[f64::NAN, 1.0], [0.0, -1.0], [200.0, f64::INFINITY]])]).width() > 0
        );
    }
}
