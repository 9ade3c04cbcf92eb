//! Solid letters in a depth buffer (Blinn 1978 §3, figure 7).

use super::depth::{DepthBuffer, Rod};
use super::glyphs::{LETTER, MARGIN, Page, TEXT};
use super::{Bumps, Card, Entry};
use crate::geometry::Vec3;
use crate::parameter::{Domain, Parameter, Values};

/// A text of solid letters, as a depth buffer sees them: rods with round ends along the strokes of a bitmap font,
/// which lie on the ground, or lean, each line about its foot. (The paper's "3D character set" is lost.)
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "round-letters",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3, figure 7",
        summary: "A text of the user's in round solid letters, from a depth buffer.",
    },
    parameters: &[
        TEXT,
        MARGIN,
        Parameter {
            name: "radius",
            meaning: "radius of the strokes, pixels of the font",
            domain: Domain::Real { default: 0.7, min: 0.05, max: 4.0 },
        },
        Parameter {
            name: "tilt",
            meaning: "how far the letters' heads are raised, degrees",
            domain: Domain::Real { default: 0.0, min: 0.0, max: 80.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let page = Page::of(values.text("text"));
    let (scale, corner) = page.fitted(width, height, values.number("margin"));
    let (sin, cos) = libm::sincos(values.number("tilt").to_radians());
    let radius = scale * values.number("radius");
    let place = |[x, y]: [isize; 2]| {
        let foot = (y.div_euclid(LETTER as isize) * LETTER as isize) as f64;
        let [x, up] = [x as f64 + 0.5, y as f64 + 0.5 - foot];
        Vec3::new(corner[0] + scale * x, corner[1] + scale * (foot + up * cos), scale * up * sin)
    };
    let mut buffer = DepthBuffer::new(width, height);
    for stroke in strokes(&page) {
        buffer.render(&Rod { ends: stroke.map(place), radius });
    }
    buffer.bumps()
}

/// The lines between neighbouring set pixels of a line of text, and the pixels that have no neighbour. Pixels
/// that touch at a corner are joined where no third one joins them.
fn strokes(page: &Page) -> Vec<[[isize; 2]; 2]> {
    const AROUND: [[isize; 2]; 8] =
        [[1, 0], [0, 1], [1, 1], [-1, 1], [-1, 0], [0, -1], [-1, -1], [1, -1]];
    let mut all = Vec::new();
    for from in page.pixels() {
        let joined = |[a, b]: [isize; 2]| {
            let to = [from[0] + a, from[1] + b];
            let line = |y: isize| y.div_euclid(LETTER as isize);
            let corner = a != 0 && b != 0;
            let third = corner && (page.at(to[0], from[1]) || page.at(from[0], to[1]));
            page.at(to[0], to[1]) && line(to[1]) == line(from[1]) && !third
        };
        let to = |[a, b]: [isize; 2]| [from, [from[0] + a, from[1] + b]];
        // Each line is found from one of its ends.
        all.extend(AROUND[..4].iter().filter(|&&step| joined(step)).map(|&step| to(step)));
        if !AROUND.iter().any(|&step| joined(step)) {
            all.push([from, from]);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Value;

    fn heights(tilt: f64) -> crate::texture::HeightMap {
        let set = [("text", Value::Text("I".into())), ("tilt", Value::Number(tilt))];
        build(96, 96, &Values::defaults(ENTRY.parameters).with(&set), 0).heights.unwrap()
    }

    #[test]
    fn strokes_are_as_high_as_they_are_thick() {
        // A pixel of the font is 96/12 texels.
        let [low, high] = heights(0.0).range();
        assert!(low == 0.0 && (high - 0.7 * 8.0).abs() < 0.1, "{low} {high}");
    }

    #[test]
    fn a_leaning_letter_is_higher_at_its_head() {
        let map = heights(30.0);
        let row = |rows: std::ops::Range<usize>| {
            let all = rows.flat_map(|j| (0..96).map(move |i| (i, j)));
            all.map(|(i, j)| map.at(i, j as isize)).fold(0.0, f64::max)
        };
        assert!(row(55..75) > row(20..35) + 10.0, "{} {}", row(55..75), row(20..35));
    }

    #[test]
    fn a_dot_is_a_ball_and_a_stroke_a_chain() {
        let page = Page::of("L");
        assert!(strokes(&page).len() >= page.pixels().count() - 1);
        assert!(strokes(&page).iter().all(|[a, b]| a != b));
    }
}
