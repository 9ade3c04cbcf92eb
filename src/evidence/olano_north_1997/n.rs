//! Nine numbers a texel, in 16 bits each (§5).

use std::sync::Arc;

use super::super::{Claim, Exhibit, Halted, Row, Table, Task};
use super::common::{
    EXPONENT, SIDE, compare, grid, maps, method, prefiltered, probes, sampled, truth,
};
use crate::geometry::HemisphereGrid;
use crate::lobe::BaseLobe;
use crate::parameter::Value;
use crate::texture::{NormalMap, level_sizes};

/// The row.
pub const ROW: Row = Row {
    name: "olano-n",
    title: "Nine numbers a texel: what 16 and 8 bits cost",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 8.0,
    make,
};

const STORAGE: [&str; 3] = ["float", "16-bit", "8-bit"];

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let base = BaseLobe::BlinnPhong { exponent: task.values.number("exponent") };
    let mut exhibit = ROW.exhibit();
    let mut table = Table::new(
        "errors",
        "½ ∫ |D − D′| cos θ dω over cells of 4 × 4 texels and more, in the middle of cells and between them: of \
         rounded storage from floats, and of all from the normals themselves; the mean, and the largest. Shaded as \
         a projected 2D Gaussian.",
        &[
            "map",
            "16 bits from floats",
            "largest",
            "8 bits from floats",
            "largest",
            "floats from the normals",
            "16 bits from the normals",
            "8 bits from the normals",
        ],
    );
    let (grid, probes) = (grid(), probes(2));
    let (mut worst, mut added) = ([0f64; 2], 0f64);
    let maps = maps(task.seed);
    for (done, (name, map)) in maps.iter().enumerate() {
        let built = STORAGE.map(|word| {
            let method = method("olano-north", &[("storage", Value::Word(word))]);
            prefiltered(method.as_ref(), map, &base)
        });
        let (mut from_float, mut from_truth) = ([(0.0, 0f64); 2], [0.0; 3]);
        for probe in &probes {
            task.go_on()?;
            let (true_density, mean) = truth(&grid, map, &base, probe.block);
            let found = built.each_ref().map(|b| sampled(&grid, &b.lobes_at(&probe.footprint)));
            for (sum, density) in from_truth.iter_mut().zip(&found) {
                *sum += compare(&grid, density, &true_density, mean).distance / probes.len() as f64;
            }
            for (k, (sum, most)) in from_float.iter_mut().enumerate() {
                let far = compare(&grid, &found[k + 1], &found[0], mean).distance;
                *sum += far / probes.len() as f64;
                *most = most.max(far);
                worst[k] = worst[k].max(far);
            }
        }
        added = added.max(from_truth[1] / from_truth[0]);
        let [(fine, fine_most), (coarse, coarse_most)] = from_float;
        let [a, b, c] = from_truth;
        let values = [fine, fine_most, coarse, coarse_most, a, b, c].map(Into::into);
        table.push(std::iter::once((*name).into()).chain(values).collect());
        task.progress.advance(done + 1, maps.len());
    }
    exhibit.claims = vec![
        Claim::count("numbers a texel", 9, numbers(&maps[0].1, &base, "float", 4)),
        Claim::count(
            "bytes a texel with 16 bits a component",
            18,
            numbers(&maps[0].1, &base, "16-bit", 1),
        ),
        Claim::at_most(
            "largest distance of 16-bit storage from floats",
            "three three-colour maps with 16 bits per component (§5)",
            0.01,
            worst[0],
        ),
        Claim::at_most(
            "distance of 16-bit storage from the normals, over that of floats, the largest of the maps",
            "three three-colour maps with 16 bits per component (§5)",
            1.05,
            added,
        ),
    ];
    exhibit.tables = vec![table, positivity()];
    exhibit.remarks.push(format!(
        "8 bits, which the paper does not try, are up to {:.2} from floats: the difference of second moments and \
         squares is smaller than its own rounding, and is held to half of the base variance.",
        worst[1]
    ));
    Ok(exhibit)
}

/// Bytes of a stored cell, over `bytes`.
fn numbers(map: &Arc<NormalMap>, base: &BaseLobe, storage: &'static str, bytes: usize) -> usize {
    let method = method("olano-north", &[("storage", Value::Word(storage))]);
    let cells: usize = level_sizes(SIDE, SIDE).iter().skip(1).map(|(w, h)| w * h).sum();
    prefiltered(method.as_ref(), map, base).bytes() / cells / bytes
}

/// How many single normals are left without a covariance by rounding.
fn positivity() -> Table {
    let head = ["base exponent", "8 bits", "16 bits"];
    let mut table = Table::new(
        "positivity",
        "Share of single normals, tilted by up to 60°, of which rounded E₂ − uᵀu has an eigenvalue of 0 or less: \
         no covariance.",
        &head,
    );
    for exponent in [20.0, 50.0, 100.0, 200.0, 500.0] {
        let [eight, sixteen] = [8, 16].map(|bits| broken(bits, 1.0 / exponent));
        table.push(vec![exponent.into(), eight.into(), sixteen.into()]);
    }
    table
}

/// The share of normals whose covariance does not survive whole numbers of `bits` from −1 to 1 (second
/// moments: from −1 − v to 1 + v).
fn broken(bits: u32, v: f64) -> f64 {
    let most = f64::from((1u32 << (bits - 1)) - 1);
    let round = |x: f64, range: f64| (x / range * most).round() / most * range;
    let normals = HemisphereGrid::new(60, 60);
    let high: Vec<_> = normals.samples().iter().filter(|s| s.direction.z > 0.5).collect();
    let lost = high.iter().filter(|s| {
        let n = s.direction;
        let (u, mut s) = (n.map(|c| round(c, 1.0)), nalgebra::Matrix3::zeros());
        for i in 0..3 {
            for j in 0..3 {
                let own = if i == j { v } else { 0.0 };
                s[(i, j)] = round(n[i] * n[j] + own, 1.0 + v) - u[i] * u[j];
            }
        }
        !positive(&s)
    });
    lost.count() as f64 / high.len() as f64
}

/// Whether a symmetric matrix is positive, by its leading minors.
fn positive(s: &nalgebra::Matrix3<f64>) -> bool {
    let two = s[(0, 0)] * s[(1, 1)] - s[(0, 1)] * s[(0, 1)];
    s[(0, 0)] > 0.0 && two > 0.0 && s.determinant() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_bits_keep_every_covariance_and_eight_hardly_any() {
        assert_eq!(broken(16, 1.0 / 200.0), 0.0);
        assert!(broken(8, 1.0 / 200.0) > 0.5);
    }
}
