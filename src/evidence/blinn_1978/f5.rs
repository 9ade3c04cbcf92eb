//! Figure 5: a grid of high and low values.

use std::collections::BTreeSet;

use super::common::{SIDE, Scene, field, side_by_side, table};
use crate::evidence::{Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Task};
use crate::parameter::Value;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f5",
    title: "A simple grid pattern: its table as a line drawing, and mapped onto a patch",
    parts: &[],
    parameters: &[],
    secs: 0.5,
    make,
};

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let set = |bevel: f64| {
        [
            ("count", Value::Number(4.0)),
            ("groove", Value::Number(5.0)),
            ("bevel", Value::Number(bevel)),
            ("depth", Value::Number(3.0)),
        ]
    };
    let map = table("grid", SIDE, &set(0.0), task.seed);
    let heights = map.heights().expect("a grid has heights");
    let levels: BTreeSet<u64> = heights.values().iter().map(|h| h.to_bits()).collect();
    // In a cliff a difference over two cells sees half of it on either side.
    let leaning = map.texels().iter().filter(|t| t[2] < 1.0).count() as f64;
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::count("different values in the table", 2, levels.len()),
        Claim::count("entries of the table", 64 * 64, heights.values().len()),
        Claim::not_applicable(
            "likeness to Figure 5",
            "a line drawing and a photograph",
            "neither how many plates there are nor how high they are is printed",
        ),
    ];
    let nets = Drawing::Nets(vec![field("the table, cliffs", heights)]);
    exhibit.figures = vec![Figure::new("table", "The 64 × 64 entries of F.", nets)];
    let soft = table("grid", SIDE, &set(2.0), task.seed);
    let mut panels = Vec::new();
    for (name, label, map) in
        [("cliffs", "cliffs, as drawn", &map), ("bevels", "bevels of two cells", &soft)]
    {
        let film = Scene::plane(45.0, [300, 230]).picture(map, task)?;
        panels.push(Panel::new(&format!("plane-{name}"), format!("flat patch, {label}"), film));
    }
    for (name, label, map) in [("cliffs", "cliffs", &map), ("bevels", "bevels", &soft)] {
        let film = Scene::bent(2.0, [300, 230]).picture(map, task)?;
        let label = format!("one corner bent back, {label}");
        panels.push(Panel::new(&format!("bent-{name}"), label, film));
    }
    let drawing = Drawing::Images(side_by_side(panels, 2));
    exhibit.figures.push(Figure::new(
        "patch",
        "The grid on a flat patch, and on one with a corner bent back.",
        drawing,
    ));
    exhibit.remarks = vec![format!(
        "Differences over two cells tilt the normals of {:.0} % of the entries; all others look straight up.",
        100.0 * leaning / (SIDE * SIDE) as f64
    )];
    Ok(exhibit)
}
