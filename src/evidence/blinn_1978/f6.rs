//! Figure 6: embossed letters.

use super::common::{Scene, field, side_by_side, table};
use crate::evidence::{Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Task};
use crate::parameter::Value;
use crate::render::direction;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f6",
    title: "Embossed letters from a bitmap character set",
    parts: &[],
    parameters: &[],
    secs: 0.5,
    make,
};

/// Texels a pixel of the font in the pictures.
const FINE: usize = 4;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let text = "SIG-\nGRAPH\n'78";
    let set = |margin: f64, bevel: f64, depth: f64| {
        [
            ("text", Value::Text(text.into())),
            ("margin", Value::Number(margin)),
            ("bevel", Value::Number(bevel)),
            ("depth", Value::Number(depth)),
        ]
    };
    // Five letters of eight pixels and a margin of twelve: an entry a pixel.
    let raster = table("letters", 64, &set(12.0, 0.0, 2.0), task.seed);
    let heights = raster.heights().expect("letters have heights");
    let between = heights.values().iter().filter(|h| **h != 0.0 && **h != 2.0).count();
    let fine = table("letters", 64 * FINE, &set(2.0, 0.4, 5.0), task.seed);
    let pressed = table("letters", 64 * FINE, &set(2.0, 0.4, -5.0), task.seed);
    let mut exhibit = ROW.exhibit();
    let scene =
        |azimuth: f64| Scene { light: direction(40.0, azimuth), ..Scene::plane(60.0, [300, 260]) };
    let [raised, sunk, turned] = [
        scene(150.0).picture(&fine, task)?,
        scene(150.0).picture(&pressed, task)?,
        scene(-30.0).picture(&fine, task)?,
    ];
    // Dents are bumps lit from the other side: the half vector moves, so not to the last bit.
    let alike = |a: &crate::render::Film, b: &crate::render::Film| {
        let mean = |f: &crate::render::Film| {
            f.pixels().iter().map(|p| f64::from(*p)).sum::<f64>() / f.pixels().len() as f64
        };
        let (p, q) = (mean(a), mean(b));
        let sums = a.pixels().iter().zip(b.pixels()).fold([0.0; 3], |[ab, aa, bb], (&x, &y)| {
            let (x, y) = (f64::from(x) - p, f64::from(y) - q);
            [ab + x * y, aa + x * x, bb + y * y]
        });
        sums[0] / libm::sqrt(sums[1] * sums[2])
    };
    exhibit.claims = vec![
        Claim::count("entries of the table that are neither ground nor letter", 0, between),
        Claim::shown(
            "correlation of the image with that of the letters pressed in",
            "darker is a dent and brighter a bump; this correspondence will be reversed [from] the back side (§3)",
            alike(&raised, &sunk),
            "below 0",
            alike(&raised, &sunk) < 0.0,
        ),
        Claim::not_applicable(
            "likeness to Figure 6",
            "a photograph",
            "its character set and text are not printed",
        ),
    ];
    exhibit.figures = vec![
        Figure::new(
            "table",
            "The table of the letters, a cell a pixel of the font.",
            Drawing::Nets(vec![field("64 × 64 entries", heights)]),
        ),
        Figure::new(
            "letters",
            "The letters with bevels, in finer tables.",
            Drawing::Images(side_by_side(
                vec![
                    Panel::new("raised", "embossed, light from the left", raised),
                    Panel::new("turned", "the same, light from the right", turned),
                    Panel::new("sunk", "pressed in, light from the left", sunk),
                ],
                3,
            )),
        ),
    ];
    exhibit.remarks =
        vec!["The font is one in the public domain, of eight by eight pixels a letter.".into()];
    Ok(exhibit)
}
