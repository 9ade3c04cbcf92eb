//! Figures 12 to 14: horizons, and what shadowing and masking make of the cylinder (§5).

use std::sync::Arc;

use crate::light::Light;
use crate::lobe::{BaseLobe, MultipleSurface};
use crate::method::Method;
use crate::method::fournier::{Fournier, Shadowing};
use crate::render::{Camera, Film, Portrait, direction};
use crate::texture::{Footprint, HorizonMap};

use super::super::{
    Claim, Drawing, Exhibit, Field, Figure, Halted, Images, Panel, Quantity, Row, Table, Task,
};
use super::super::{rmse, trials};
use super::f3::EXPONENT;
use super::surfaces::plot;
use super::textures::Subject;

/// Figure 12.
pub const F12: Row = Row {
    name: "fournier-f12",
    title: "Horizon slopes of a height map towards ±X and ±Y",
    parts: &[],
    parameters: &[],
    secs: 0.5,
    make: f12,
};

/// Figure 13.
pub const F13: Row = Row {
    name: "fournier-f13",
    title: "Cylinder on a plane with shadowing and masking, unfiltered and filtered",
    parts: &["cylinder-on-plane-shadowed"],
    parameters: &[],
    secs: 0.5,
    make: f13,
};

/// Figure 14.
pub const F14: Row = Row {
    name: "fournier-f14",
    title: "The cylinder's top level on a sphere, without and with shadowing and masking",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 1.0,
    make: f14,
};

fn f12(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = F12.exhibit();
    let mut table = Table::new(
        "bytes",
        "Decisions whether a texel sees a direction, 5° to 85° high towards ±X and ±Y, that change when its \
         slopes are kept as four bytes (the angle in 256 steps).",
        &["map", "decisions", "changed", "part changed"],
    );
    let mut worst: f64 = 0.0;
    for subject in Subject::ALL {
        task.go_on()?;
        let map = subject.map();
        let horizons = HorizonMap::of(&map.heights_or_integrated());
        let (decisions, changed) = changed_by_bytes(&horizons);
        let part = changed as f64 / decisions as f64;
        worst = worst.max(part);
        table.push(vec![subject.name().into(), decisions.into(), changed.into(), part.into()]);
        exhibit.figures.push(drawn(subject, &horizons));
    }
    exhibit.claims.push(Claim::at_most(
        "part of the decisions what a texel sees that change with four bytes a texel, worst map",
        "4 values a texel can be encoded as 4 bytes (§5)",
        0.01,
        worst,
    ));
    exhibit.tables.push(table);
    Ok(exhibit)
}

fn drawn(subject: Subject, horizons: &HorizonMap) -> Figure {
    let angle = |slope: f32| libm::atan(f64::from(slope)).to_degrees();
    let field = |(side, label): (usize, &str)| Field {
        label: label.into(),
        width: horizons.width(),
        values: horizons.slopes().iter().map(|slopes| angle(slopes[side])).collect(),
    };
    let sides = ["towards −X", "towards +X", "towards −Y", "towards +Y"];
    let caption = format!(
        "Height of the horizon over each texel of the {}, degrees: the angle whose tangent is the slope.",
        subject.name()
    );
    let fields = sides.into_iter().enumerate().map(field).collect();
    Figure::new(subject.name(), caption, Drawing::Fields(fields))
}

/// Decisions whether a texel sees a direction of its four sides, and how many of them change when the
/// horizon's angle is kept in 256 steps.
fn changed_by_bytes(horizons: &HorizonMap) -> (usize, usize) {
    let (mut decisions, mut changed) = (0, 0);
    for slope in horizons.slopes().iter().flatten() {
        let exact = libm::atan(f64::from(*slope)).to_degrees();
        let kept = (exact * 255.0 / 90.0).round() * 90.0 / 255.0;
        for height in (5..=85).map(f64::from) {
            decisions += 1;
            changed += usize::from((height > exact) != (height > kept));
        }
    }
    (decisions, changed)
}

/// The part's methods: label, what it is called, samples a pixel.
const SHOWN: [(&str, &str, u32); 4] = [
    ("unfiltered-shadowed", "unfiltered", 1),
    ("fournier", "filtered, no shadowing", 1),
    ("fournier-shadowed", "filtered, as printed", 1),
    ("fournier-ratioed", "filtered, ratioed", 1),
];

fn f13(task: &Task) -> Result<Exhibit, Halted> {
    let part = task.part("cylinder-on-plane-shadowed");
    let mut exhibit = F13.exhibit();
    let mut table = Table::new(
        "errors",
        "Error against a converged image of rays over the heights.",
        &["texels a pixel", "image", "RMSE", "part of unfiltered's", "energy, of the converged"],
    );
    for scene in &part.results.scenes {
        let texels = scene.key.texels_per_pixel;
        let film = Arc::clone(&scene.reference.film);
        let mut panels = vec![
            Panel::new(&format!("converged-{texels}"), "converged, rays over the heights", film)
                .remarked(format!("{} samples a pixel", scene.reference.spp)),
        ];
        let found = match trials(scene, SHOWN.map(|(method, _, spp)| (method, spp))) {
            Ok(found) => found,
            Err(claim) => {
                exhibit.claims.push(*claim);
                continue;
            }
        };
        let [first, without, with, _] = found.map(rmse);
        for ((method, label, _), found) in SHOWN.into_iter().zip(found) {
            let energy = found.score("energy").unwrap_or(f64::NAN);
            let error = rmse(found);
            table.push(vec![
                texels.into(),
                label.into(),
                error.into(),
                (error / first).into(),
                energy.into(),
            ]);
            let name = format!("{method}-{texels}");
            panels.push(
                Panel::new(&name, label, Arc::clone(&found.film)).remarked("1 sample a pixel"),
            );
        }
        let ratio = with / without;
        exhibit.claims.push(
            Claim::shown(
                format!("RMSE with shadowing and masking, of that without, at {texels} texels a pixel"),
                "it is important to model these effects for convincing rendering (§5)",
                ratio,
                "below 1",
                ratio < 1.0,
            )
            .because("ramps between mean ± deviation, taken for independent along X and Y and for light and eye, are far from the rays' truth here"),
        );
        let images = Images { panels, white: None, reference: Some(0), across: 3 };
        let caption =
            format!("{}, {texels} texels across the pixel in the middle.", part.results.title);
        let name = format!("images-{texels}");
        exhibit.figures.push(Figure::new(&name, caption, Drawing::Images(images)));
    }
    exhibit.tables.push(table);
    Ok(exhibit)
}

fn f14(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = F14.exhibit();
    let view = across();
    let bare = top(Shadowing::None, task)?;
    let shadowed = top(Shadowing::Printed, task)?;
    let [without, with] = [&bare, &shadowed].map(|surface| view.of(surface.clone()));
    let [all_without, all_with] = [&without, &with].map(|film| by_angle(film, &view));
    let kept: Vec<f64> = all_with.iter().zip(all_without).map(|(with, bare)| with / bare).collect();
    exhibit.claims.push(Claim::shown(
        "light kept by points over 60° from the plane of eye and light, of that kept by points within 30°",
        "only the cylinders close to the plane defined by the eye and the light vectors reflect strongly (§5)",
        kept[2] / kept[0],
        "at most 1/2",
        kept[2] <= 0.5 * kept[0],
    ));
    let mut table = Table::new(
        "light",
        "Light of the sphere's points by their angle from the plane of eye and light, the sum of the image's \
         radiances.",
        &["angle", "without", "with shadowing and masking", "part kept"],
    );
    for (k, zone) in ["0° to 30°", "30° to 60°", "60° to 90°"].into_iter().enumerate() {
        let row = [all_without[k], all_with[k], kept[k]].map(Quantity::from);
        table.push(std::iter::once(zone.into()).chain(row).collect());
    }
    exhibit.tables.push(table);
    let panels = vec![
        Panel::new("without", "without", Arc::new(without)),
        Panel::new("with", "with shadowing and masking", Arc::new(with)),
    ];
    let images = Images { panels, white: None, reference: None, across: 2 };
    let caption = "The cylinder's top level on a sphere, grooves along the meridians; light straight above the eye.";
    let lobes = [("without", &bare), ("with shadowing and masking", &shadowed)];
    let lobes = lobes
        .into_iter()
        .flat_map(|(label, surface)| [0.0, 90.0].map(|azimuth| plot(label, surface, azimuth)));
    exhibit.figures = vec![
        Figure::new("spheres", caption, Drawing::Images(images)),
        Figure::new(
            "reflection",
            "What the top level reflects across (0°) and along (90°) the grooves.",
            Drawing::Lobes(lobes.collect()),
        ),
    ];
    Ok(exhibit)
}

/// The top of the cylinder's pyramid.
fn top(shadowing: Shadowing, task: &Task) -> Result<MultipleSurface, Halted> {
    let base = BaseLobe::BlinnPhong { exponent: task.values.number("exponent") };
    let method = Fournier { shadowing, ..Fournier::default() };
    let map = Arc::new(Subject::Cylinder.map());
    let ready = method.prefilter(&map, &base, task.progress).map_err(|_| Halted)?;
    let whole = Footprint::whole();
    Ok(ready.lobes_at(&whole))
}

/// The sphere with the light straight above the eye: their plane is x = 0.
fn across() -> Portrait {
    Portrait {
        camera: Camera::orbiting(6.0, 15.0, -90.0, 22.0, 320, 320),
        light: Light::Directional { direction: direction(65.0, -90.0), irradiance: 1.0 },
        ..Portrait::sphere(320, 320)
    }
}

/// The light of an image by the angle of the sphere's normal from the plane x = 0: 0° to 30°, to 60°, to
/// 90°.
fn by_angle(film: &Film, view: &Portrait) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (i, &radiance) in film.pixels().iter().enumerate() {
        let (x, y) = ((i % film.width()) as f64 + 0.5, (i / film.width()) as f64 + 0.5);
        let ray = view.camera.ray(x, y);
        let Some(hit) = view.shape.intersect(view.camera.origin(), ray) else { continue };
        let angle = libm::asin(hit.frame.normal.x.abs().min(1.0)).to_degrees();
        sums[((angle / 30.0) as usize).min(2)] += f64::from(radiance);
    }
    sums
}
