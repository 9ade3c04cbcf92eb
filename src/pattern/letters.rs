//! Embossed letters (Blinn 1978 §3, figure 6).

use super::glyphs::{MARGIN, Page, TEXT};
use super::relief::rise;
use super::{Bumps, Card, Entry};
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{HeightMap, NormalMap, Wrap};

/// A text in "a bit-map character set as used to display text on a raster scan display", raised from the ground.
/// Normals come from central differences over one texel either side, as in the paper.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "letters",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3, figure 6",
        summary: "A text of the user's, embossed from a bitmap font.",
    },
    parameters: &[
        TEXT,
        MARGIN,
        Parameter {
            name: "bevel",
            meaning: "width of the slope from ground to letter, pixels of the font (0: a cliff)",
            domain: Domain::Real { default: 0.4, min: 0.0, max: 2.0 },
        },
        Parameter {
            name: "depth",
            meaning: "height of the letters above the ground, texels",
            domain: Domain::Real { default: 2.0, min: -1000.0, max: 1000.0 },
        },
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let page = Page::of(values.text("text"));
    let [margin, bevel, depth] = ["margin", "bevel", "depth"].map(|name| values.number(name));
    let (scale, corner) = page.fitted(width, height, margin);
    let place = |i: usize, axis: usize| (i as f64 + 0.5 - corner[axis]) / scale;
    let texels = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
    let inside =
        |(i, j)| depth * rise(depth_inside(&page, [place(i, 0), place(j, 1)], bevel), bevel);
    let heights = HeightMap::new(width, height, Wrap::Repeat, texels.map(inside).collect());
    let normals = NormalMap::from_heights(&heights, 1.0);
    Bumps { normals, heights: Some(heights), notes: vec![] }
}

/// How far a point lies within the set pixels, to `most`, pixels; negative outside.
fn depth_inside(page: &Page, at: [f64; 2], most: f64) -> f64 {
    let [x, y] = at.map(|c| libm::floor(c) as isize);
    if !page.at(x, y) {
        return -1.0;
    }
    let reach = libm::ceil(most) as isize;
    let around = (-reach..=reach).flat_map(|b| (-reach..=reach).map(move |a| [x + a, y + b]));
    let bare = around.filter(|&[x, y]| !page.at(x, y));
    let square = bare.map(|pixel| {
        let away = [0, 1].map(|c| {
            let low = pixel[c] as f64;
            (low - at[c]).max(at[c] - low - 1.0).max(0.0)
        });
        away[0] * away[0] + away[1] * away[1]
    });
    // A point within is off the ground, however near its edge.
    square.fold(most * most, f64::min).sqrt().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Value;

    fn heights(size: usize, bevel: f64) -> HeightMap {
        let set = [
            ("text", Value::Text("L".into())),
            ("margin", Value::Number(0.0)),
            ("bevel", Value::Number(bevel)),
        ];
        let values = Values::defaults(ENTRY.parameters).with(&set);
        build(size, size, &values, 0).heights.unwrap()
    }

    #[test]
    fn without_a_bevel_a_texel_a_pixel_is_the_bitmap() {
        let (page, map) = (Page::of("L"), heights(8, 0.0));
        for (k, &h) in map.values().iter().enumerate() {
            let set = page.at(k as isize % 8, k as isize / 8);
            assert_eq!(h, if set { 2.0 } else { 0.0 });
        }
    }

    #[test]
    fn a_bevel_rises_within_the_letter_alone() {
        let (cliff, soft) = (heights(96, 0.0), heights(96, 0.8));
        let mut between = 0;
        for (&sharp, &soft) in cliff.values().iter().zip(soft.values()) {
            assert!((0.0..=sharp).contains(&soft), "{soft} {sharp}");
            between += usize::from(soft > 0.0 && soft < sharp);
        }
        assert!(between > 200, "{between}");
    }
}
