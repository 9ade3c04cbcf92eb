//! Figure 9: bumps on a stretched surface.

use std::sync::Arc;

use super::common::{Scene, side_by_side, table};
use crate::evidence::{Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Table, Task};
use crate::geometry::Vec3;
use crate::parameter::Value;
use crate::render::{Camera, direction};
use crate::surface::{Derivatives, Perturbation, Perturbed, Plane, Shape, Surface};
use crate::texture::NormalMap;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f9",
    title: "The same bumps on a patch and on stretched copies: as displacements, and scale-invariant",
    parts: &[],
    parameters: &[],
    secs: 1.0,
    make,
};

/// A patch, how much longer it is than the unit patch along u and along v.
const PATCHES: [(&str, &str, [f64; 2]); 3] = [
    ("unit", "the patch", [1.0, 1.0]),
    ("scaled", "scaled by 2", [2.0, 2.0]),
    ("stretched", "stretched by 2 along u", [2.0, 1.0]),
];
const FORMS: [(&str, &str, Perturbation); 2] = [
    ("displacement", "displacement", Perturbation::Displacement { unit: 1.0 }),
    ("scale-invariant", "scale-invariant", Perturbation::ScaleInvariant),
];

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let set = [
        ("count", Value::Number(4.0)),
        ("radius", Value::Number(0.8)),
        ("sunk", Value::Number(0.5)),
    ];
    let map = table("rivets", 256, &set, task.seed);
    let mut exhibit = ROW.exhibit();
    let mut lean = Table::new(
        "lean",
        "Root mean square of tan θ over the table, of that on the unit patch: along u, along v, in all.",
        &["form", "patch", "along u", "along v", "in all"],
    );
    let mut panels = Vec::new();
    let mut in_all = Vec::new();
    for (name, form, perturbation) in FORMS {
        let unit = tangents(&shape([1.0; 2], perturbation), &map);
        for (patch, label, size) in PATCHES {
            let shape = shape(size, perturbation);
            let here = tangents(&shape, &map);
            let parts = [0, 1, 2].map(|c| here[c] / unit[c]);
            lean.push(vec![
                form.into(),
                label.into(),
                parts[0].into(),
                parts[1].into(),
                parts[2].into(),
            ]);
            in_all.push(parts[2]);
            let film = seen(shape, size).picture(&map, task)?;
            panels.push(Panel::new(&format!("{name}-{patch}"), format!("{label}, {form}"), film));
        }
    }
    exhibit.claims = claims(&in_all);
    exhibit.tables = vec![lean];
    let drawing = Drawing::Images(side_by_side(panels, PATCHES.len()));
    let caption = "One table on a patch and its copies, the camera as much further off as the copy is larger.";
    exhibit.figures = vec![Figure::new("patches", caption, drawing)];
    exhibit.remarks = vec![
        "A scale-invariant perturbation keeps the angle; on a patch stretched one way it keeps the direction of D, not \
         that of the slopes on the unit patch."
            .into(),
    ];
    Ok(exhibit)
}

fn claims(in_all: &[f64]) -> Vec<Claim> {
    let p = Derivatives { u: Vec3::new(1.0, 0.2, 0.3), v: Vec3::new(-0.1, 0.8, 0.4) };
    let double = Derivatives { u: p.u * 2.0, v: p.v * 2.0 };
    let f = [0.4, -0.3];
    let grown = |of: &dyn Fn(&Derivatives) -> Vec3| of(&double).norm() / of(&p).norm();
    let near = |what: &str, paper: f64, here: f64| Claim::near(what, paper, here, 1e-5);
    vec![
        near("|N| of a patch scaled by 2, of its own", 4.0, grown(&|p| p.normal())),
        near("|D| of a patch scaled by 2, of its own", 2.0, grown(&|p| p.displacement(f))),
        near("|D′| of a patch scaled by 2, of its own", 4.0, grown(&|p| p.scale_invariant(f))),
        near("tan θ on the patch scaled by 2, of the unit patch's, displacement", 0.5, in_all[1]),
        near(
            "tan θ on the patch scaled by 2, of the unit patch's, scale-invariant",
            1.0,
            in_all[4],
        ),
        near(
            "tan θ on the patch stretched one way, of the unit patch's, scale-invariant",
            1.0,
            in_all[5],
        ),
        Claim::shown(
            "tan θ on the patch stretched one way, of the unit patch's, displacement",
            "if an object is scaled up, the wrinkles flatten out",
            in_all[2],
            "between 1/2 and 1",
            (0.5..1.0).contains(&in_all[2]),
        ),
    ]
}

/// The patch of this size, one tile of the table.
fn shape([u, v]: [f64; 2], perturbation: Perturbation) -> Shape {
    let plane = Plane::new().tiled(1.0 / u, v / u);
    Shape::Perturbed(Perturbed::new(Shape::Plane(plane), perturbation))
}

/// The patch of this size, filling the picture as the unit patch does.
fn seen(shape: Shape, [u, v]: [f64; 2]) -> Scene {
    let scene = Scene::plane(60.0, [300, 240]);
    let (middle, far) = (Vec3::new(0.5 * u, 0.5 * v, 0.0), 2.8 * u.max(v));
    let camera = Camera::look_at(middle + direction(60.0, -90.0) * far, middle, 18.0, 300, 240);
    Scene { shape, camera, ..scene }
}

/// Root mean square over the table of the tangent along u, along v, and in all.
fn tangents(shape: &Shape, map: &Arc<NormalMap>) -> [f64; 3] {
    let hit = shape.intersect(Vec3::new(0.3, 0.3, 1.0), -Vec3::z());
    let bend = hit.and_then(|hit| shape.bend(&hit)).unwrap_or_default();
    let mut sums = [0.0; 3];
    for &[x, y, z, _] in map.texels() {
        let [x, y, z] = bend.turn([x, y, z]).map(f64::from);
        let (a, b) = (x / z, y / z);
        sums = [sums[0] + a * a, sums[1] + b * b, sums[2] + a * a + b * b];
    }
    sums.map(|sum| libm::sqrt(sum / map.texels().len() as f64))
}
