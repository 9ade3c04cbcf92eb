//! Figure 6: embossed letters.

use super::common::{Scene, field, oblong, side_by_side, table};
use crate::evidence::{Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Task};
use crate::parameter::Value;
use crate::render::direction;
use crate::texture::Texel;

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
    let same = |(a, b): (&Texel, &Texel)| (0..2).any(|c| (a[c] + b[c]).abs() > 1e-6);
    let upright = fine.texels().iter().zip(pressed.texels()).filter(|&pair| same(pair)).count();
    exhibit.claims = vec![
        Claim::count("entries of the table that are neither ground nor letter", 0, between),
        Claim::count(
            "normals that do not lean the other way if the letters are pressed in",
            0,
            upright,
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
    let title = [("text", Value::Text("SIGGRAPH '78".into())), ("depth", Value::Number(4.0))];
    let title = oblong("letters", [512, 128], &title, task.seed);
    let film = Scene::ribbon(0.25, [480, 150]).picture(&title, task)?;
    let panels = vec![Panel::new("ribbon", "a title on a ribbon", film)];
    exhibit.figures.push(Figure::new(
        "ribbon",
        "As on the ribbon of the proceedings' cover.",
        Drawing::Images(side_by_side(panels, 1)),
    ));
    exhibit.remarks =
        vec!["The font is one in the public domain, of eight by eight pixels a letter.".into()];
    Ok(exhibit)
}
