//! Figures 1 to 3 and 8 to 11: bumps that mirror an environment, sampled, filtered, and with their roughness kept.

use std::sync::Arc;

use super::super::{
    Claim, Drawing, Exhibit, Figure, FinishedPart, Halted, Images, Panel, Row, Table, Task, rmse,
    trials,
};
use crate::experiment::results::{SceneResult, TrialResult};
use crate::metric;
use crate::render::Film;

const fn row(
    name: &'static str,
    title: &'static str,
    parts: &'static [&'static str],
    make: fn(&Task) -> Result<Exhibit, Halted>,
) -> Row {
    Row { name, title, parts, parameters: &[], secs: 0.5, make }
}

/// Figures 1 to 3.
pub const F1: Row = row(
    "schilling-f1-f3",
    "Sampled bumps reflect at random, filtered bumps like a mirror, bumps with roughness into a cone",
    &["cone"],
    |task| {
        let mut exhibit = compared(&F1, task);
        let part = task.part("cone");
        exhibit
            .claims
            .extend(mirrors(part, "standard filtering results in a smoothened surface (Figure 2)"));
        exhibit.remarks.push(
            "The paper's three figures are drawings of rays; here they are images of one scene."
                .into(),
        );
        Ok(exhibit)
    },
);
/// Figures 8 and 9.
pub const F8: Row = row(
    "schilling-f8-f9",
    "Moonlit water, waves bump-mapped, with and without the roughness pyramid",
    &["water"],
    |task| {
        let mut exhibit = compared(&F8, task);
        let part = task.part("water");
        exhibit.claims.extend(mirrors(
            part,
            "the average normal vector will always point straight up: the same reflections as in a perfect mirror, \
             regardless of waves",
        ));
        exhibit.claims.push(photographs("Figures 8 and 9"));
        Ok(exhibit)
    },
);
/// Figures 10 and 11.
pub const F10: Row = row(
    "schilling-f10-f11",
    "A bump-mapped flat surface that reflects stripes, with and without the roughness pyramid",
    &["stripes"],
    |task| {
        let mut exhibit = compared(&F10, task);
        exhibit.claims.push(photographs("Figures 10 and 11"));
        exhibit
            .remarks
            .push("The zebras of the paper's environment map are lost; stripes stand in.".into());
        Ok(exhibit)
    },
);

fn photographs(which: &str) -> Claim {
    Claim::not_applicable(
        format!("likeness to {which}"),
        "images without numbers",
        "neither bumps nor environment nor camera are printed",
    )
}

/// What the figures show: label, method, samples a pixel.
const SHOWN: [(&str, &str, u32); 4] = [
    ("no antialiasing", "unfiltered", 1),
    ("filtered bumps", "averaged", 1),
    ("isotropic roughness", "schilling-isotropic", 1),
    ("roughness", "schilling-anisotropic", 1),
];
/// The texture without bumps.
const FLAT: &str = "flat";

fn compared(row: &Row, task: &Task) -> Exhibit {
    let part = task.part(row.parts[0]);
    let mut exhibit = row.exhibit();
    let caption = "Error against the converged image.";
    let head =
        ["scene", "image", "RMSE", "part of that without antialiasing", "SSIM", "light kept"];
    let mut table = Table::new("errors", caption, &head);
    for scene in part.results.scenes.iter().filter(|scene| scene.key.texture != FLAT) {
        one(scene, part, &mut exhibit, &mut table);
    }
    exhibit.tables = vec![table];
    exhibit
}

/// What a scene is called.
fn place(scene: &SceneResult) -> String {
    format!("{} at {} texels a pixel", scene.key.texture, scene.key.texels_per_pixel)
}

fn one(scene: &SceneResult, part: &FinishedPart, exhibit: &mut Exhibit, table: &mut Table) {
    let found = match trials(scene, SHOWN.map(|(_, method, spp)| (method, spp))) {
        Ok(found) => found,
        Err(claim) => return exhibit.claims.push(*claim),
    };
    let at = place(scene);
    let [sampled, smooth, isotropic, kept] = found.map(rmse);
    let converged = Panel::new(
        &format!("{}-converged", scene.slug),
        "converged",
        Arc::clone(&scene.reference.film),
    );
    let mut panels = vec![converged.remarked(format!("{} samples a pixel", scene.reference.spp))];
    for ((label, method, _), trial) in SHOWN.into_iter().zip(found) {
        table.push(vec![
            at.clone().into(),
            label.into(),
            rmse(trial).into(),
            (rmse(trial) / sampled).into(),
            trial.score("ssim").unwrap_or(f64::NAN).into(),
            trial.score("energy").unwrap_or(f64::NAN).into(),
        ]);
        let panel = Panel::new(&format!("{}-{method}", scene.slug), label, Arc::clone(&trial.film));
        panels.push(panel.remarked(format!("RMSE {:.3}", rmse(trial))));
    }
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE with roughness, of that without antialiasing, {at}"),
            "otherwise we get rays reflected into random directions (Figure 1)",
            kept / sampled,
            "below 1/2",
            kept < 0.5 * sampled,
        )
        .because(
            "one lobe cannot tell the few slopes of regular bumps apart, and a square lookup blurs along the short \
             side of a slanted footprint",
        ),
    );
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE with roughness, of that of filtered bumps alone, {at}"),
            "preserves roughness information in all resolution levels",
            kept / smooth,
            "below 1",
            kept < smooth,
        )
        .because("one broad lobe stands for slopes that are few and far apart, and where bumps are larger than pixels \
                  there is little roughness to keep"),
    );
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE with roughness, of that with isotropic roughness, {at}"),
            "a cheap, isotropic and a more expensive anisotropic version",
            kept / isotropic,
            "at most 1",
            kept <= isotropic,
        )
        .because("the footprint's lookup, a square one, is the larger part of the error of both"),
    );
    let (width, height) = (scene.reference.film.width(), scene.reference.film.height());
    let caption = format!("{}: {at}, {width} × {height} pixels.", part.results.title);
    let images = Images { panels, white: None, reference: Some(0), across: 3 };
    exhibit.figures.push(Figure::new(&scene.slug, caption, Drawing::Images(images)));
}

/// At the coarsest scale, filtered bumps are held to no bumps at all.
fn mirrors(part: &FinishedPart, words: &str) -> Option<Claim> {
    let bumpy = part.results.scenes.iter().filter(|scene| scene.key.texture != FLAT);
    let scene = bumpy.max_by(|a, b| a.key.texels_per_pixel.total_cmp(&b.key.texels_per_pixel))?;
    let alike = |other: &&SceneResult| {
        let near = other.key.texels_per_pixel / scene.key.texels_per_pixel;
        other.key.texture == FLAT
            && other.key.distance == scene.key.distance
            && (0.99..1.01).contains(&near)
    };
    // Tiles of the flat texture may hold another number of texels.
    let flat = part.results.scenes.iter().find(alike);
    let flat = flat.or_else(|| part.results.scenes.iter().find(|s| s.key.texture == FLAT))?;
    let averaged = |scene: &SceneResult| -> Option<Arc<Film>> {
        let trial: &TrialResult =
            scene.trials.iter().find(|t| t.method == "averaged" && t.spp == 1)?;
        Some(Arc::clone(&trial.film))
    };
    let mirror = averaged(flat)?;
    let from_mirror = |film: &Film| metric::score("rmse", film, &mirror).unwrap_or(f64::NAN);
    let filtered = averaged(scene)?;
    let ratio = from_mirror(&filtered) / from_mirror(&scene.reference.film);
    Some(Claim::shown(
        format!(
            "RMSE of filtered bumps from a surface without bumps, of that of the converged image, {}",
            place(scene)
        ),
        words,
        ratio,
        "below 1/4",
        ratio < 0.25,
    ).because("bumps near the eye are larger than its pixels and stay"))
}
