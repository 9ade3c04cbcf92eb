//! A fit beside the samples it was made for: the hemisphere seen from above.

use super::canvas::{Anchor, Canvas, Point, Type};
use super::chart::{HALF_CAPITAL, SMALL, TEXT};
use super::colour::{BLACK, GREY, Ink, SHADE, WHITE, magnitude, signed};
use super::{bar, phrase, png};
use crate::experiment::results::Picture;
use crate::fit::{Directions, Distribution, Fit, Peak};
use crate::geometry::Vec3;

/// Radius of a disc, units.
const RADIUS: f32 = 120.0;
/// A disc with its title and surroundings.
const CELL: Point = [266.0, 310.0];
/// From the top of a cell to the middle of its disc.
const MIDDLE: f32 = 52.0 + RADIUS;
/// Room for a colour bar.
const BAR: f32 = 92.0;
/// Pixels across the picture of a fit: two a unit.
const PIXELS: usize = 4 * RADIUS as usize;
/// Dots are at least and at most this large, units.
const DOT: [f32; 2] = [0.7, 4.5];

/// What is left below this part of the largest value is no more than rounding, and drawn as nothing.
const ROUNDING: f64 = 1e-9;

/// Samples, fit and what the fit leaves of the samples, as discs in the (x, y) of the direction; a PNG file.
/// Samples are dots, the peaks of the fit rings with their number. Directions below the horizon are
/// not drawn, and counted.
pub fn fit_plot(directions: &Directions, distribution: &Distribution, fit: &Fit) -> Vec<u8> {
    png::exact(&draw(directions, distribution, fit).dots())
}

fn draw(directions: &Directions, distribution: &Distribution, fit: &Fit) -> Canvas {
    let mut canvas = Canvas::new(3.0 * CELL[0] + 2.0 * BAR, CELL[1]);
    let largest = distribution.maximum();
    let share = |value: f64| (value / largest).clamp(0.0, 1.0).sqrt();
    let fitted = |toward: Vec3| fit.peaks.iter().map(|peak| peak.value(toward)).sum::<f64>();

    let values = distribution.values();
    let seen: Vec<usize> = (0..values.len()).filter(|&i| directions.at(i).z >= 0.0).collect();
    let coloured = |colour: &dyn Fn(usize) -> [u8; 3], mut order: Vec<usize>, by: &[f64]| {
        // What sticks out is drawn last.
        order.sort_by(|&a, &b| by[a].total_cmp(&by[b]));
        let dot = |i: usize| (directions.at(i), colour(i));
        order.into_iter().map(dot).collect::<Vec<_>>()
    };

    let left = centre(0);
    let hidden = values.len() - seen.len();
    let below = if hidden > 0 { format!(", {hidden} below the horizon") } else { String::new() };
    head(
        &mut canvas,
        left,
        "samples",
        &format!("{}{below}", phrase::count(values.len(), "sample")),
    );
    dots(&mut canvas, left, &coloured(&|i| magnitude(share(values[i])), seen.clone(), values));

    let middle = centre(1);
    head(&mut canvas, middle, "fit", &phrase::count(fit.peaks.len(), "peak"));
    let corner = [middle[0] - RADIUS, middle[1] - RADIUS];
    let colour = |toward| magnitude(share(fitted(toward)));
    canvas.picture(corner, [2.0 * RADIUS, 2.0 * RADIUS], &picture(colour));
    rim(&mut canvas, middle);
    let upper = |(_, peak): &(usize, &Peak)| peak.direction.z >= 0.0;
    let marks: Vec<(usize, Point)> = (1..)
        .zip(&fit.peaks)
        .filter(upper)
        .map(|(number, peak)| (number, on(middle, peak.direction)))
        .collect();
    marks.iter().for_each(|(_, at)| ring(&mut canvas, *at));
    marks.iter().for_each(|(number, at)| label(&mut canvas, *at, *number));
    let labels =
        [0.0, 0.25, 0.5, 0.75, 1.0].map(|at: f64| (at as f32, phrase::scale(at * at * largest)));
    let bar = [2.0 * CELL[0] + 8.0, MIDDLE - RADIUS];
    key(&mut canvas, bar, magnitude, &labels, "value");

    let right = [centre(2)[0] + BAR, MIDDLE];
    let rest: Vec<f64> =
        directions.iter().zip(values).map(|(d, value)| (value - fitted(d)) / largest).collect();
    let size: Vec<f64> = rest.iter().map(|r| r.abs()).collect();
    let most = size.iter().copied().fold(0.0, f64::max);
    let scale = most.max(ROUNDING);
    let remark =
        format!("{} in rms, {} at most", phrase::percent(fit.rms), phrase::percent(fit.maximum));
    head(&mut canvas, right, "what is left: samples − fit", &remark);
    dots(&mut canvas, right, &coloured(&|i| signed(rest[i] / scale), seen, &size));
    let labels = [-1.0, -0.5, 0.0, 0.5, 1.0]
        .map(|at: f64| (0.5 + 0.5 * at as f32, phrase::scale(at * scale * largest)));
    let bar = [3.0 * CELL[0] + BAR + 8.0, MIDDLE - RADIUS];
    key(&mut canvas, bar, |at| signed(2.0 * at - 1.0), &labels, "value − fit");
    canvas
}

fn centre(cell: usize) -> Point {
    [(cell as f32 + 0.5) * CELL[0], MIDDLE]
}

/// The point of a disc under a direction: x to the right, y up.
fn on(centre: Point, direction: Vec3) -> Point {
    [centre[0] + RADIUS * direction.x as f32, centre[1] - RADIUS * direction.y as f32]
}

fn head(canvas: &mut Canvas, [x, _]: Point, title: &str, remark: &str) {
    let middle = Anchor::Middle;
    canvas.text([x, 20.0], title, Type { bold: true, anchor: middle, ..TEXT });
    canvas.text([x, 37.0], remark, Type { anchor: middle, ..SMALL });
}

fn rim(canvas: &mut Canvas, centre: Point) {
    canvas.ring(centre, RADIUS + 0.6, WHITE, 2.4);
    canvas.ring(centre, RADIUS, GREY, 1.0);
}

/// A disc with a dot a direction, as large as there is room for so many.
fn dots(canvas: &mut Canvas, centre: Point, dots: &[(Vec3, [u8; 3])]) {
    canvas.disc(centre, RADIUS, SHADE);
    canvas.ring(centre, RADIUS, GREY, 1.0);
    let radius = (0.85 * RADIUS / (dots.len().max(1) as f32).sqrt()).clamp(DOT[0], DOT[1]);
    for (direction, rgb) in dots {
        canvas.disc(on(centre, *direction), radius, Ink::new(*rgb));
    }
}

/// A ring with a dark edge, seen on every colour.
fn ring(canvas: &mut Canvas, at: Point) {
    canvas.ring(at, 5.0, Ink { opacity: 170, ..BLACK }, 3.0);
    canvas.ring(at, 5.0, WHITE, 1.5);
}

/// The number of a peak beside its ring.
fn label(canvas: &mut Canvas, [x, y]: Point, number: usize) {
    let look = Type { ink: WHITE, bold: true, ..SMALL };
    canvas.text([x + 8.0, y + HALF_CAPITAL * look.size], &number.to_string(), look);
}

/// Every pixel of a disc in the colour of the direction above it.
fn picture(colour: impl Fn(Vec3) -> [u8; 3]) -> Picture {
    let at = |i: usize| (i as f64 + 0.5) / PIXELS as f64 * 2.0 - 1.0;
    let pixel = |i: usize| {
        let (x, y) = (at(i % PIXELS), -at(i / PIXELS));
        let square = 1.0 - x * x - y * y;
        if square < 0.0 { WHITE.rgb } else { colour(Vec3::new(x, y, square.sqrt())) }
    };
    Picture { width: PIXELS, height: PIXELS, rgb: (0..PIXELS * PIXELS).map(pixel).collect() }
}

/// A colour bar as high as a disc, with its title.
fn key(
    canvas: &mut Canvas,
    [x, y]: Point,
    colour: impl Fn(f64) -> [u8; 3],
    labels: &[(f32, String)],
    title: &str,
) {
    bar::upright(canvas, [x, y], [14.0, 2.0 * RADIUS], colour, labels);
    canvas.text([x - 2.0, y - 15.0], title, SMALL);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{GreedyOptions, fit};

    #[test]
    fn anything_that_can_be_fitted_can_be_drawn() {
        let up = [Vec3::z(), Vec3::x(), Vec3::new(0.3, 0.4, 0.5), Vec3::new(-0.1, 0.2, 0.9)];
        for (sign, unit) in [(1.0, 1.0), (1.0, 1e300), (1.0, 1e-300), (-1.0, 1.0)] {
            let directions = Directions::scattered(&up.map(|d| d * sign)).unwrap();
            let values = [2.0, 1.0, 0.5, 0.0].map(|v| v * unit);
            let distribution = Distribution::from_samples(&values, &directions).unwrap();
            let options = GreedyOptions { max_peaks: 1, ..GreedyOptions::default() };
            let fit = fit(&distribution, &directions, options, &|| false).unwrap();
            assert!(image::load_from_memory(&fit_plot(&directions, &distribution, &fit)).is_ok());
        }
    }

    #[test]
    fn where_nothing_is_left_nothing_is_coloured() {
        let peak = Peak { amplitude: 1.0, direction: Vec3::z(), exponent: 5.0 };
        let directions = Directions::new(crate::geometry::HemisphereGrid::new(4, 8));
        let distribution = Distribution::spread(&[peak], &directions, &|| false).unwrap();
        let options = GreedyOptions { max_peaks: 1, stop: 0.0, restarts: 0 };
        let mut found = fit(&distribution, &directions, options, &|| false).unwrap();
        let pole = |found: &Fit| {
            let dots = draw(&directions, &distribution, found).dots();
            let [x, y] = [centre(2)[0] + BAR, MIDDLE].map(|units| (2.0 * units) as usize);
            dots.rgb[y * dots.width + x]
        };
        found.peaks = vec![peak];
        assert_eq!(pole(&found), WHITE.rgb);
        found.peaks[0].amplitude = 0.5;
        assert_eq!(pole(&found), signed(1.0));
    }
}
