//! Figure 7: tables from a depth buffer.

use super::common::{Scene, field, oblong, side_by_side, table};
use crate::evidence::{Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Task};
use crate::parameter::Value;
use crate::texture::NormalMap;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f7",
    title: "Tables from a depth buffer: a sphere many times, and a solid character set",
    parts: &[],
    parameters: &[],
    secs: 0.5,
    make,
};

/// Rivets along a side, and texels of one.
const COUNT: usize = 4;
const CELL: usize = 64;
/// Radius of a rivet, of half its cell.
const RADIUS: f64 = 0.7;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let rivet = |count: usize, cell: usize| {
        let set = [
            ("count", Value::Number(count as f64)),
            ("radius", Value::Number(RADIUS)),
            ("sunk", Value::Number(0.0)),
        ];
        table("rivets", count * cell, &set, task.seed)
    };
    let (one, many) = (rivet(1, CELL), rivet(COUNT, CELL));
    let letters = |tilt: f64| {
        let set = [
            ("text", Value::Text("AUG\n1978".into())),
            ("margin", Value::Number(1.0)),
            ("tilt", Value::Number(tilt)),
        ];
        table("round-letters", 256, &set, task.seed)
    };
    let (lying, leaning) = (letters(0.0), letters(35.0));
    let [buffer, normals] = against_the_sphere(&one);
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::at_most(
            "error of the depth buffer against the sphere, radii",
            "an image of a sphere was generated, and the Z-buffer replicated",
            1e-12,
            buffer,
        ),
        Claim::count(
            "entries in which the replicated buffer and a buffer of all spheres differ",
            0,
            differing(&one.replicated(COUNT), &many),
        ),
        Claim::at_most(
            "largest angle between the sphere's normals and those by differences, within 0.8 radii, degrees",
            "only the derivatives of the table are used",
            1.0,
            normals,
        ),
        Claim::not_applicable(
            "likeness to Figure 7",
            "photographs",
            "the solid character set is lost",
        ),
    ];
    let coarse = rivet(1, 32);
    let small = [("text", Value::Text("78".into())), ("margin", Value::Number(0.0))];
    let small = table("round-letters", 64, &small, task.seed);
    let heights =
        |map: &NormalMap, label: &str| field(label, map.heights().expect("a depth buffer"));
    exhibit.figures = vec![Figure::new(
        "tables",
        "What a depth buffer holds.",
        Drawing::Nets(vec![heights(&coarse, "a sphere"), heights(&small, "solid letters")]),
    )];
    let mut panels = Vec::new();
    for (name, label, map) in [
        ("rivets", "rivets", &many),
        ("lying", "letters that lie", &lying),
        ("leaning", "letters that lean, 35°", &leaning),
    ] {
        let film = Scene::plane(60.0, [300, 260]).picture(map, task)?;
        panels.push(Panel::new(name, label, film));
    }
    let ball = Scene::ball(4.0, [300, 260]).picture(&many, task)?;
    panels.push(Panel::new("ball", "rivets on a sphere", ball));
    let date = [("text", Value::Text("AUGUST 1978".into())), ("tilt", Value::Number(20.0))];
    let date = oblong("round-letters", [512, 128], &date, task.seed);
    let film = Scene::ribbon(0.25, [480, 150]).picture(&date, task)?;
    let drawing = Drawing::Images(side_by_side(panels, 2));
    exhibit.figures.push(Figure::new("patch", "The tables on a patch, and on a sphere.", drawing));
    let ribbon = vec![Panel::new("ribbon", "a date on a ribbon", film)];
    let drawing = Drawing::Images(side_by_side(ribbon, 1));
    exhibit.figures.push(Figure::new(
        "ribbon",
        "As on the ribbon of the proceedings' cover.",
        drawing,
    ));
    Ok(exhibit)
}

/// Largest error of a rivet's heights, in radii, and of its normals away from the rim, degrees.
fn against_the_sphere(map: &NormalMap) -> [f64; 2] {
    let heights = map.heights().expect("a depth buffer");
    let radius = 0.5 * CELL as f64 * RADIUS;
    let (mut height, mut angle) = (0.0f64, 0.0f64);
    for (k, &found) in heights.values().iter().enumerate() {
        let [x, y] = [k % CELL, k / CELL].map(|c| c as f64 + 0.5 - 0.5 * CELL as f64);
        let square = radius * radius - x * x - y * y;
        let z = square.max(0.0).sqrt();
        height = height.max((found - z).abs() / radius);
        if x * x + y * y < 0.64 * radius * radius {
            let [a, b, c, _] = map.texel(k % CELL, k / CELL).map(f64::from);
            let cosine = ((a * x + b * y + c * z) / radius).clamp(-1.0, 1.0);
            angle = angle.max(libm::acos(cosine).to_degrees());
        }
    }
    [height, angle]
}

fn differing(a: &NormalMap, b: &NormalMap) -> usize {
    let [a, b] = [a, b].map(|map| map.heights().expect("a depth buffer").values());
    a.iter().zip(b).filter(|(a, b)| (*a - *b).abs() > 1e-9).count()
}
