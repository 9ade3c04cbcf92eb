//! Beyond the paper: the fast mode, which does not sample the hemisphere, beside the paper's fits.

use crate::experiment::results::SceneResult;

use super::super::{Claim, Exhibit, Halted, Row, Table, Task};
use super::super::{rmse, trials};

/// The row.
pub const ROW: Row = Row {
    name: "fournier-fast",
    title: "Beyond the paper: a mode that does not sample the hemisphere, beside the paper's fits",
    parts: &["fast-mode"],
    parameters: &[],
    secs: 0.1,
    make,
};

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let part = task.part("fast-mode");
    let mut exhibit = ROW.exhibit();
    let head = ["texture", "texels a pixel", "RMSE, fits", "RMSE, fast", "fast, of fits'"];
    let distances = ["distance of normals, fits", "distance of normals, fast"];
    let head: Vec<&str> = head.into_iter().chain(distances).collect();
    let mut table = Table::new(
        "errors",
        "Errors of an image at one sample a pixel, and distances ½∫|D − D_true| cos θ dω of the normals under a \
         footprint, the mean over the scene's probes.",
        &head,
    );
    let mut logs = 0.0;
    for scene in &part.results.scenes {
        let found = match trials(scene, [("fournier", 1), ("fournier-fast", 1)]) {
            Ok(found) => found,
            Err(claim) => {
                exhibit.claims.push(*claim);
                continue;
            }
        };
        let [fits, fast] = found.map(rmse);
        let [far_fits, far_fast] = ["fournier", "fournier-fast"].map(|m| distance(scene, m));
        logs += libm::log(fast / fits);
        table.push(vec![
            scene.key.texture.as_str().into(),
            scene.key.texels_per_pixel.into(),
            fits.into(),
            fast.into(),
            (fast / fits).into(),
            far_fits.into(),
            far_fast.into(),
        ]);
    }
    if !table.rows.is_empty() {
        let mean = libm::exp(logs / table.rows.len() as f64);
        exhibit.remarks.push(format!(
            "RMSE of the fast mode is {mean:.3} times that of the fits, the geometric mean over {} scenes.",
            table.rows.len()
        ));
    }
    // What the paper does not claim cannot be reproduced.
    exhibit.claims.push(Claim::not_applicable(
        "a mode that does not sample the hemisphere",
        "nothing: the paper samples it every 5°",
        "beyond the paper; the table sets it beside the fits",
    ));
    let mut times = Table::new(
        "times",
        "Time to build the pyramid.",
        &["texture", "fits, s", "fast, s", "times as fast"],
    );
    for texture in &part.results.textures {
        let of = |method: &str| {
            let costs = part.costs.prefilters.iter();
            let mut found = costs.filter(|c| c.method == method && c.texture == texture.name);
            found.next().map_or(f64::NAN, |cost| cost.secs)
        };
        let (fits, fast) = (of("fournier"), of("fournier-fast"));
        let name = format!("{} {} × {}", texture.name, texture.width, texture.height);
        times.push(vec![name.into(), fits.into(), fast.into(), (fits / fast).into()]);
    }
    exhibit.tables.push(table);
    exhibit.timed.tables.push(times);
    Ok(exhibit)
}

/// The mean distance of a method's normals from the true ones over the scene's probes.
fn distance(scene: &SceneResult, method: &str) -> f64 {
    let found = scene.probes.iter().flat_map(|p| p.methods.iter().find(|m| m.method == method));
    let all: Vec<f64> = found.map(|method| method.l1).collect();
    all.iter().sum::<f64>() / all.len() as f64
}
