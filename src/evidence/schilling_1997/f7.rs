//! Figure 7: the bump pyramid and the roughness pyramid.

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Field, Figure, Halted, Row, Series, Task,
};
use super::pyramids::{Cell, Level, bumps, factor, product, recursive, vectors};

/// The row.
pub const ROW: Row = Row {
    name: "schilling-f7",
    title: "The bump pyramid and the roughness pyramid d₁, d₂, d₃, every level",
    parts: &[],
    parameters: &[],
    secs: 0.5,
    make,
};

const SIDE: usize = 64;
/// The maps that are drawn.
const PATTERNS: [&str; 2] = ["waves", "twill"];
/// What counts as rounding, parts of the variance.
const ROUNDING: f64 = 1e-12;

/// One number of a cell.
type Reading = fn(&Cell) -> f64;
const PYRAMIDS: [(&str, &str, Reading); 5] = [
    ("bump-u", "the bump pyramid along u, f_u", |cell| cell.mean[0]),
    ("bump-v", "the bump pyramid along v, f_v", |cell| cell.mean[1]),
    ("roughness-1", "the roughness pyramid, d₁", |cell| factor(cell.roughness)[0]),
    ("roughness-2", "the roughness pyramid, d₂", |cell| factor(cell.roughness)[1]),
    ("roughness-3", "the roughness pyramid, d₃", |cell| factor(cell.roughness)[2]),
];

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = ROW.exhibit();
    let mut series = Vec::new();
    let (mut lost, mut negative, mut unlike) = (0.0f64, 0usize, 0.0f64);
    for pattern in PATTERNS {
        task.go_on()?;
        let levels = recursive(vectors(&bumps(pattern, SIDE, &[], task.seed).normals), |k| k);
        for (name, what, reading) in PYRAMIDS {
            let fields = levels.iter().enumerate().map(|(at, level)| field(at, level, reading));
            let caption = format!("{pattern}: {what}, {SIDE} × {SIDE} texels and up.");
            let drawing = Drawing::Fields(fields.collect());
            exhibit.figures.push(Figure::new(&format!("{pattern}-{name}"), caption, drawing));
        }
        let [bumps, roughness] = shares(&levels);
        let total = bumps[0] + roughness[0];
        for (b, r) in bumps.iter().zip(&roughness) {
            lost = lost.max((b + r - total).abs() / total);
        }
        for cell in levels.iter().flat_map(|level| &level.cells) {
            let d = factor(cell.roughness);
            negative += usize::from(d[0] < 0.0 || d[2] < 0.0);
            let back = product(d);
            for (back, k) in back.into_iter().zip(cell.roughness) {
                unlike = unlike.max((back - k).abs() / total);
            }
        }
        series.push(curve(&format!("{pattern}: bumps"), &bumps, total));
        series.push(curve(&format!("{pattern}: roughness"), &roughness, total));
    }
    exhibit.claims = vec![
        Claim::at_most(
            "largest change between levels of the variance in bumps and roughness together",
            "the lower resolution levels contain the roughness information representing those bumps that are omitted \
             from the bump map",
            ROUNDING,
            lost,
        ),
        Claim::count(
            "cells with a negative d₁ or d₃ (they can be chosen to be nonnegative)",
            0,
            negative,
        ),
        Claim::at_most(
            "largest difference of D Dᵀ from K, of the variance",
            "D Dᵀ = K",
            ROUNDING,
            unlike,
        ),
    ];
    let chart = Chart {
        x: Axis::linear("level"),
        y: Axis::linear("share of the variance of the perturbation vectors"),
        series,
    };
    let caption = "What filtering takes from the bump pyramid it puts into the roughness pyramid.";
    exhibit.figures.push(Figure::new("shares", caption, Drawing::Chart(chart)));
    Ok(exhibit)
}

fn field(at: usize, level: &Level, reading: Reading) -> Field {
    Field {
        label: format!("level {at}"),
        width: level.side,
        values: level.cells.iter().map(reading).collect(),
    }
}

/// By level: the variance, u and v together, of the means, and the mean variance within cells.
fn shares(levels: &[Level]) -> [Vec<f64>; 2] {
    let mean = |level: &Level, f: &dyn Fn(&Cell) -> f64| {
        level.cells.iter().map(f).sum::<f64>() / level.cells.len() as f64
    };
    let of_means = |level: &Level| {
        let along = |axis: usize| {
            let middle = mean(level, &|cell| cell.mean[axis]);
            mean(level, &|cell| (cell.mean[axis] - middle) * (cell.mean[axis] - middle))
        };
        along(0) + along(1)
    };
    let within = |level: &Level| mean(level, &|cell| cell.roughness[0] + cell.roughness[2]);
    [levels.iter().map(of_means).collect(), levels.iter().map(within).collect()]
}

fn curve(label: &str, by_level: &[f64], total: f64) -> Series {
    let points = by_level.iter().enumerate().map(|(at, share)| [at as f64, share / total]);
    Series { label: label.into(), points: points.collect(), joined: true }
}
