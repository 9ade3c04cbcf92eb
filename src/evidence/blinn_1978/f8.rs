//! Figure 8: painted bump functions.

use super::common::{Scene, side_by_side};
use crate::evidence::{Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Task};
use crate::experiment::preview::{Wish, stage_one};
use crate::texture::{HeightMap, NormalMap};

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f8",
    title: "Painted bump functions: pictures read as heights, a cell of bricks among them",
    parts: &["painted"],
    parameters: &[],
    secs: 0.5,
    make,
};

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let part = task.part(ROW.parts[0]);
    let mut exhibit = ROW.exhibit();
    let mut panels = Vec::new();
    for texture in &part.spec.sweep.textures {
        task.go_on()?;
        let wish = Wish { texture: Some(&texture.name), texels_per_pixel: None, spp: 1, frame: 0 };
        // The part has run, so its texture is there.
        let Ok(staged) = stage_one(&part.spec, &wish) else { continue };
        let Some(heights) = staged.map.heights() else { continue };
        let name = &texture.name;
        exhibit.claims.extend(claims(name, &staged.map, heights));
        let film = Scene::plane(60.0, [300, 260]).picture(&staged.map, task)?;
        panels.push(Panel::new(name, format!("{name} on a patch"), film));
        let ball = Scene::ball(4.0, [300, 260]).picture(&staged.map, task)?;
        panels.push(Panel::new(&format!("{name}-ball"), format!("{name} on a sphere"), ball));
    }
    exhibit.claims.push(Claim::not_applicable(
        "likeness to Figure 8",
        "photographs",
        "the paintings are lost",
    ));
    let drawing = Drawing::Images(side_by_side(panels, 3));
    exhibit.figures =
        vec![Figure::new("painted", "Grey pictures as bump functions on a patch.", drawing)];
    Ok(exhibit)
}

fn claims(name: &str, map: &NormalMap, heights: &HeightMap) -> [Claim; 2] {
    let (width, height) = (map.width() as isize, map.height() as isize);
    let all = || (0..height).flat_map(move |j| (0..width).map(move |i| (i, j)));
    let even = |i: isize, j: isize| {
        let here = heights.at(i, j);
        [(1, 0), (-1, 0), (0, 1), (0, -1)].iter().all(|(a, b)| heights.at(i + a, j + b) == here)
    };
    let lean = |i: isize, j: isize| map.texel(i as usize, j as usize)[2] < 1.0;
    let rough = all().filter(|&(i, j)| even(i, j) && lean(i, j)).count();
    // Where it gets brighter along u the normal leans back.
    let wrong = all().filter(|&(i, j)| {
        let rise = heights.at(i + 1, j) - heights.at(i - 1, j);
        rise * f64::from(map.texel(i as usize, j as usize)[0]) > 0.0
    });
    [
        Claim::count(format!("{name}: normals that lean where the picture is even"), 0, rough),
        Claim::count(
            format!("{name}: normals that lean towards where it gets brighter"),
            0,
            wrong.count(),
        ),
    ]
}
