//! Figures 4 to 7: a bump map on a surface unfiltered, filtered, and with sixteen samples a pixel.

use std::sync::Arc;

use crate::experiment::preview::{Wish, stage_one};
use crate::experiment::results::SceneResult;
use crate::parameter::Parameter;
use crate::render::Film;
use crate::surface::Shape;

use super::super::{
    Claim, Drawing, Exhibit, Figure, FinishedPart, Halted, Images, Panel, Row, Table, Task, rmse,
    trials,
};

/// Samples a pixel of the paper's supersampled images.
const SUPERSAMPLES: u32 = 16;

const fn row(
    name: &'static str,
    title: &'static str,
    parts: &'static [&'static str],
    make: fn(&Task) -> Result<Exhibit, Halted>,
) -> Row {
    const NONE: &[Parameter] = &[];
    Row { name, title, parts, parameters: NONE, secs: 0.5, make }
}

/// Figure 4.
pub const F4: Row = row(
    "fournier-f4",
    "Cylinder texture on a plane: unfiltered, filtered, supersampled",
    &["cylinder-on-plane"],
    |task| compare(&F4, task),
);
/// Figure 5.
pub const F5: Row = row(
    "fournier-f5",
    "Sphere texture on a plane: unfiltered, filtered, supersampled",
    &["sphere-on-plane"],
    |task| compare(&F5, task),
);
/// Figure 6.
pub const F6: Row = row(
    "fournier-f6",
    "Sphere texture on a sphere: unfiltered, filtered, supersampled",
    &["sphere-on-sphere"],
    |task| {
        let mut exhibit = compare(&F6, task)?;
        exhibit.claims.push(near_the_pole(task.part("sphere-on-sphere")));
        Ok(exhibit)
    },
);
/// Figure 7.
pub const F7: Row = row(
    "fournier-f7",
    "Denim texture on a plane: unfiltered, filtered, supersampled",
    &["denim-on-plane"],
    |task| compare(&F7, task),
);

/// Figure 8.
pub const F8: Row = row(
    "fournier-f8",
    "Denim texture on drapery, a coarse 11 × 40 grid",
    &["denim-on-drapery"],
    |task| {
        let mut exhibit = compare(&F8, task)?;
        exhibit.claims.push(Claim::not_applicable(
            "the shape of the cloth",
            "a model of Frederic Taillefer's",
            "the model is lost: the cloth here is another one, on a grid as coarse",
        ));
        Ok(exhibit)
    },
);

fn compare(row: &Row, task: &Task) -> Result<Exhibit, Halted> {
    let part = task.part(row.parts[0]);
    let mut exhibit = row.exhibit();
    let mut table = Table::new(
        "errors",
        "Error against the converged image, by the texels across the pixel in the middle of the image.",
        &[
            "texture",
            "texels a pixel",
            "image",
            "samples a pixel",
            "RMSE",
            "part of unfiltered's",
            "SSIM",
        ],
    );
    for scene in &part.results.scenes {
        at_scale(scene, &part.results.title, &mut exhibit, &mut table);
    }
    exhibit.tables = vec![table];
    Ok(exhibit)
}

/// The images of the paper: label, method, samples a pixel.
const SHOWN: [(&str, &str, u32); 3] = [
    ("unfiltered", "unfiltered", 1),
    ("filtered", "fournier", 1),
    ("supersampled", "unfiltered", SUPERSAMPLES),
];

/// One scene: how small the bumps were in the paper's images is not printed, so there are several.
fn at_scale(scene: &SceneResult, title: &str, exhibit: &mut Exhibit, table: &mut Table) {
    let (texture, texels) = (scene.key.texture.as_str(), scene.key.texels_per_pixel);
    let name = format!("converged-{texture}-{texels}");
    let converged = Panel::new(&name, "converged", Arc::clone(&scene.reference.film));
    let mut panels = vec![converged.remarked(format!("{} samples a pixel", scene.reference.spp))];
    let found = match trials(scene, SHOWN.map(|(_, method, spp)| (method, spp))) {
        Ok(found) => found,
        Err(claim) => return exhibit.claims.push(*claim),
    };
    let [first, filtered, supersampled] = found.map(rmse);
    for ((label, _, spp), found) in SHOWN.into_iter().zip(found) {
        let (error, ssim) = (rmse(found), found.score("ssim").unwrap_or(f64::NAN));
        table.push(vec![
            texture.into(),
            texels.into(),
            label.into(),
            (spp as usize).into(),
            error.into(),
            (error / first).into(),
            ssim.into(),
        ]);
        let remark = format!("{spp} sample{} a pixel", if spp == 1 { "" } else { "s" });
        let name = format!("{label}-{texture}-{texels}");
        panels.push(Panel::new(&name, label, Arc::clone(&found.film)).remarked(remark));
    }
    let at = format!("{texture} at {texels} texels a pixel");
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE of the filtered image, of the unfiltered one's, {at}"),
            "filtering takes the aliasing away",
            filtered / first,
            "below 1/2",
            filtered < 0.5 * first,
        )
        .because(
            "a trilinear lookup takes the slanted footprint for a round one: it blurs along the footprint's short \
             side, which costs most where bumps are seen lengthwise or are hardly smaller than a pixel",
        ),
    );
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE of the filtered image, of the supersampled one's, {at}"),
            "supersampling costs 16 times as much and usually exhibits more aliasing (§3)",
            filtered / supersampled,
            "below 1",
            filtered < supersampled,
        )
        .because(
            "what is left after filtering here is blur, of a square lookup on slanted footprints, more than aliasing; \
             and the 16 samples are a scrambled net, whose error falls faster than that of the paper's sampling",
        ),
    );
    let images = Images { panels, white: None, reference: Some(0), across: 2 };
    let (width, height) = (scene.reference.film.width(), scene.reference.film.height());
    let caption = format!(
        "{title} ({texture}), {width} × {height} pixels, {texels} texels across the pixel in the middle."
    );
    let name = format!("images-{texture}-{texels}");
    exhibit.figures.push(Figure::new(&name, caption, Drawing::Images(images)));
}

/// "The texture is slightly more aliased near the north pole with filtering than with super sampling."
fn near_the_pole(part: &FinishedPart) -> Claim {
    let scene = &part.results.scenes[0];
    let wish = Wish { texture: None, texels_per_pixel: None, spp: 1, frame: 0 };
    let near = stage_one(&part.spec, &wish).map(|staged| {
        let (camera, surface) = (staged.view.camera, staged.view.surface);
        let hit = |x: usize, y: usize| -> bool {
            let ray = camera.ray(x as f64 + 0.5, y as f64 + 0.5);
            let hit = surface.intersect(camera.origin(), ray);
            matches!(surface, Shape::Sphere(_)) && hit.is_some_and(|hit| hit.point.z > POLE)
        };
        let (width, height) = (camera.width(), camera.height());
        (0..width * height).map(|i| hit(i % width, i / width)).collect::<Vec<bool>>()
    });
    let near = near.unwrap_or_default();
    let reference = &scene.reference.film;
    let [filtered, supersampled] =
        match trials(scene, [("fournier", 1), ("unfiltered", SUPERSAMPLES)]) {
            Ok(found) => found.map(|trial| error_where(&near, &trial.film, reference)),
            Err(claim) => return *claim,
        };
    let ratio = filtered / supersampled;
    Claim::shown(
        "RMSE near the north pole of the filtered image, of the supersampled one's",
        "slightly more aliased near the north pole with filtering (§3)",
        ratio,
        "above 1",
        ratio > 1.0,
    )
    .because("footprints here come from exact ray differentials, which the mapping's Jacobian is part of")
}

/// Near the pole: within 26° of it.
const POLE: f64 = 0.9;

/// RMSE over the pixels that `near` marks.
fn error_where(near: &[bool], film: &Film, reference: &Film) -> f64 {
    let pixels = film.pixels().iter().zip(reference.pixels()).zip(near);
    let (mut sum, mut count) = (0.0, 0usize);
    for ((a, b), _) in pixels.filter(|(_, near)| **near) {
        sum += f64::from(a - b).powi(2);
        count += 1;
    }
    (sum / count as f64).sqrt()
}
