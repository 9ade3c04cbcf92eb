//! Figure 2: NDFs on the hemispherical (x, y) map.

use super::common::{SIDE, anisotropic, isotropic, maps, several};
use crate::evidence::{Claim, Exhibit, Halted, Row, Table, Task};
use crate::lobe::{BaseLobe, Measure, NdfImage};
use crate::parameter::Values;
use crate::pattern;

/// The row.
pub const ROW: Row = Row {
    name: "kautz-f2",
    title: "Distributions of normals on the hemispherical (x, y) map: analytic, of several lobes, measured",
    parts: &[],
    parameters: &[],
    secs: 1.0,
    make,
};

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let entry = pattern::find("brushed").expect("a pattern of the program's own");
    let map = (entry.build)(256, 256, &Values::defaults(entry.parameters), task.seed).normals;
    let base = BaseLobe::BlinnPhong { exponent: 60.0 };
    let measured = |base| NdfImage::of_normals(map.texels(), base, 128).expect("normals point up");
    task.go_on()?;
    let all = [
        ("isotropic", isotropic(12.0)),
        ("anisotropic", anisotropic()),
        ("several lobes", several()),
        ("measured, brushed metal", measured(None)),
        ("the same with a base lobe", measured(Some(&base))),
    ];
    let head = ["distribution", "integral over the map", "mean normal x", "y", "z"];
    let mut table = Table::new("sums", "Sums over the images.", &head);
    let mut worst = 0.0f64;
    for (label, ndf) in &all {
        let pixel = 4.0 / (ndf.side() * ndf.side()) as f64;
        let integral: f64 = ndf.values().iter().map(|d| f64::from(*d) * pixel).sum();
        worst = worst.max((integral - 1.0).abs());
        let [x, y, z] = ndf.mean_normal();
        table.push(vec![(*label).into(), integral.into(), x.into(), y.into(), z.into()]);
    }
    let texels = map.texels();
    let of_map =
        [0, 1].map(|c| texels.iter().map(|t| f64::from(t[c])).sum::<f64>() / texels.len() as f64);
    let of_image = all[3].1.mean_normal();
    let off = (0..2).map(|c| (of_image[c] - of_map[c]).abs()).fold(0.0, f64::max);
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::at_most(
            "how far integrals over the map are from 1, at most",
            "a probability density function (§3.1)",
            1e-5,
            worst,
        ),
        Claim::at_most(
            "mean normal of the measured NDF beside the map's own, x and y, apart by at most",
            "generate an NDF for an existing bump map (§7)",
            1e-4,
            off,
        ),
        per_solid_angle(),
    ];
    let shown: Vec<(&str, &NdfImage)> = all.iter().map(|(label, ndf)| (*label, ndf)).collect();
    exhibit.tables = vec![table];
    exhibit.figures =
        vec![maps("ndfs", "Distributions, each in parts of its greatest density.", &shown)];
    Ok(exhibit)
}

/// What it costs to read a density over solid angle as one over the map.
fn per_solid_angle() -> Claim {
    let wide = isotropic(2.0);
    let side = wide.side();
    let rows =
        |values: &[f32]| -> Vec<f32> { values.chunks(side).rev().flatten().copied().collect() };
    // D cosθ is the density over solid angle.
    let per_angle: Vec<f32> = (0..side * side)
        .map(|k| {
            let [x, y] = [k % side, k / side].map(|c| (2 * c + 1) as f64 / side as f64 - 1.0);
            (f64::from(wide.values()[k]) * (1.0 - x * x - y * y).max(0.0).sqrt()) as f32
        })
        .collect();
    let read = |measure| {
        let image = NdfImage::of_image((side, side), &rows(&per_angle), measure);
        let image = image.expect("a distribution");
        let apart = |(a, b): (&f32, &f32)| f64::from((a - b).abs());
        let sum: f64 = image.values().iter().zip(wide.values()).map(apart).sum();
        0.5 * sum * 4.0 / (SIDE * SIDE) as f64
    };
    let [right, wrong] = [read(Measure::SolidAngle), read(Measure::Map)];
    Claim::shown(
        "total variation from a wide lobe (exponent 2) given over solid angle: divided by n_z, and taken as it is",
        "the NDF as a map of x and y (§4); which density its values are is not said",
        format!("{right:.4}, {wrong:.3}"),
        "at most 0.01 if divided by n_z",
        right <= 0.01,
    )
}
