//! Figure 10: what aliases, and what filtering the table does to it.

use std::sync::Arc;

use crate::evidence::{
    Claim, Drawing, Exhibit, Figure, FinishedPart, Halted, Images, Panel, Row, Table, Task, rmse,
    trials,
};
use crate::experiment::results::SceneResult;
use crate::metric;
use crate::render::Film;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f10",
    title: "Aliasing: bumps as they are sampled, the bump table averaged, intensities averaged",
    parts: &["aliasing"],
    parameters: &[],
    secs: 0.5,
    make,
};

/// What is shown: label, method, samples a pixel.
const SHOWN: [(&str, &str, u32); 3] = [
    ("before: unfiltered", "unfiltered", 1),
    ("after: table averaged", "averaged", 1),
    ("intensities of 16 samples", "unfiltered", 16),
];
/// The texture without bumps.
const FLAT: &str = "flat";

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let part = task.part(ROW.parts[0]);
    let mut exhibit = ROW.exhibit();
    let head = ["scene", "image", "RMSE", "of that unfiltered", "SSIM", "light kept"];
    let mut table = Table::new("errors", "Error against the converged image.", &head);
    for scene in part.results.scenes.iter().filter(|scene| scene.key.texture != FLAT) {
        one(scene, part, &mut exhibit, &mut table);
    }
    exhibit.tables = vec![table];
    exhibit.claims.push(Claim::not_applicable(
        "likeness to Figure 10",
        "photographs",
        "its scene is not printed",
    ));
    Ok(exhibit)
}

fn place(scene: &SceneResult) -> String {
    format!("{} at {} texels a pixel", scene.key.texture, scene.key.texels_per_pixel)
}

fn one(scene: &SceneResult, part: &FinishedPart, exhibit: &mut Exhibit, table: &mut Table) {
    let found = match trials(scene, SHOWN.map(|(_, method, spp)| (method, spp))) {
        Ok(found) => found,
        Err(claim) => return exhibit.claims.push(*claim),
    };
    let at = place(scene);
    let [before, after, averaged] = found.map(rmse);
    let converged = Panel::new(
        &format!("{}-converged", scene.slug),
        "converged",
        Arc::clone(&scene.reference.film),
    );
    let mut panels = vec![converged.remarked(format!("{} samples a pixel", scene.reference.spp))];
    for ((label, method, spp), trial) in SHOWN.into_iter().zip(found) {
        let score = |name: &str| trial.score(name).unwrap_or(f64::NAN);
        table.push(vec![
            at.clone().into(),
            label.into(),
            rmse(trial).into(),
            (rmse(trial) / before).into(),
            score("ssim").into(),
            score("energy").into(),
        ]);
        let name = format!("{}-{method}-{spp}", scene.slug);
        let panel = Panel::new(&name, label, Arc::clone(&trial.film));
        panels.push(panel.remarked(format!("RMSE {:.3}", rmse(trial))));
    }
    exhibit.claims.push(Claim::shown(
        format!("RMSE with the table averaged, of that unfiltered, {at}"),
        "filtering the bump function can, however, reduce the more offensive artifacts of aliasing",
        after / before,
        "below 1",
        after < before,
    )
    .because(
        "a trilinear lookup smooths bumps that are still larger than pixels, and light that they would send elsewhere \
         stays in the highlight",
    ));
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE of intensities of 16 samples, of that with the table averaged, {at}"),
            "the correct solution would be to compute the intensities at some high sub-pixel resolution and average \
             them",
            averaged / after,
            "below 1",
            averaged < after,
        )
        .because("16 samples of bumps this small leave more noise than the lost roughness is worth"),
    );
    exhibit.claims.extend(smoothed(scene, part));
    let drawing = Drawing::Images(Images { panels, white: None, reference: Some(0), across: 2 });
    let caption = format!("{}: {at}.", part.results.title);
    exhibit.figures.push(Figure::new(&scene.slug, caption, drawing));
}

/// "If the bump texture is averaged the effect will be to smooth out the bumps": how near the image is to that of no
/// bumps.
fn smoothed(scene: &SceneResult, part: &FinishedPart) -> Option<Claim> {
    let bumpy = part.results.scenes.iter().filter(|other| other.key.texture == scene.key.texture);
    let coarsest = bumpy.map(|other| other.key.texels_per_pixel).fold(0.0, f64::max);
    if scene.key.texels_per_pixel < coarsest {
        return None;
    }
    let near = |other: &&SceneResult| {
        let ratio = other.key.texels_per_pixel / scene.key.texels_per_pixel;
        other.key.texture == FLAT && (0.8..1.25).contains(&ratio)
    };
    let flat = part.results.scenes.iter().find(near)?;
    let averaged = scene.trials.iter().find(|t| t.method == "averaged" && t.spp == 1)?;
    let away = |film: &Film| metric::score("rmse", film, &flat.reference.film).unwrap_or(f64::NAN);
    let ratio = away(&averaged.film) / away(&scene.reference.film);
    Some(Claim::shown(
        format!(
            "RMSE of the averaged table's image from a surface without bumps, of that of the converged image, {}",
            place(scene)
        ),
        "the effect will be to smooth out the bumps rather than average the intensities",
        ratio,
        "below 1/2, at the coarsest scale",
        ratio < 0.5,
    ))
}
