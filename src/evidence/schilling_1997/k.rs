//! The recursive rule for the roughness covariance (*The roughness pyramid*).

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use super::pyramids::{Covariance, Level, bumps, direct, factor, product, recursive, vectors};
use crate::parameter::{Domain, Parameter};

const SIDE: Parameter = Parameter {
    name: "side",
    meaning: "texels along a side of the maps, a power of two or the next one below",
    domain: Domain::Whole { default: 64, min: 2, max: 512 },
};

/// The row.
pub const ROW: Row = Row {
    name: "schilling-k",
    title: "The recursive rule for the roughness covariance, against the covariance over the whole area",
    parts: &[],
    parameters: &[SIDE],
    secs: 0.2,
    make,
};

/// The maps the rule is tried on.
const PATTERNS: [&str; 6] = ["gaussian", "waves", "corrugated", "brushed", "bricks", "twill"];
/// What counts as rounding: the greatest difference of an entry, parts of the whole map's variance.
const ROUNDING: f64 = 1e-12;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let side = task.values.whole("side");
    let side = if side.is_power_of_two() { side } else { side.next_power_of_two() / 2 };
    let mut exhibit = ROW.exhibit();
    let head = ["map", "kept between levels", "worst level", "largest difference"];
    let caption = "Largest difference of an entry of K, over all cells of all levels, from the covariance over the \
                   cell's whole area; parts of the variance of the whole map.";
    let mut table = Table::new("differences", caption, &head);
    let mut worst = [0.0f64; KEPT.len()];
    let mut curves: Vec<Series> = Vec::new();
    for pattern in PATTERNS {
        task.go_on()?;
        let bottom = vectors(&bumps(pattern, side, &[], task.seed).normals);
        let truth: Vec<Level> =
            (0..=side.ilog2() as usize).map(|level| direct(&bottom, level)).collect();
        for (kept, worst) in KEPT.iter().zip(&mut worst) {
            let by_level = differences(&truth, &recursive(bottom.clone(), kept.keep(&truth)));
            let (level, most) = largest(&by_level);
            table.push(vec![pattern.into(), kept.name().into(), level.into(), most.into()]);
            *worst = worst.max(most);
            if pattern == PATTERNS[0] {
                curves.push(curve(kept.name(), &by_level));
            }
        }
    }
    exhibit.claims = vec![Claim::at_most(
        "largest difference between K by the recursive rule and over the whole area, of the map's variance",
        "this formula is equivalent to the calculation of the covariance matrix for all f_u and f_v values in the \
         highest resolution level for the whole area",
        ROUNDING,
        worst[0],
    )];
    exhibit.remarks = vec![
        "The print sums from 0 to n and divides by n; n terms are summed here.".into(),
        format!(
            "The equivalence is that of the rule. With D kept in single precision between levels the difference grows \
             to {:.1e}, with D in bytes to {:.1e}: rounding is passed on from level to level.",
            worst[1], worst[2]
        ),
    ];
    let chart = Chart {
        x: Axis::linear("level"),
        y: Axis::log("largest difference, parts of the variance"),
        series: curves,
    };
    let caption = format!("By level, for the map {} of {side} × {side} texels.", PATTERNS[0]);
    exhibit.figures = vec![Figure::new("levels", caption, Drawing::Chart(chart))];
    exhibit.tables = vec![table];
    Ok(exhibit)
}

/// What a pyramid keeps of K between levels.
#[derive(Clone, Copy)]
enum Kept {
    Double,
    Single,
    Byte,
}

const KEPT: [Kept; 3] = [Kept::Double, Kept::Single, Kept::Byte];

impl Kept {
    fn name(self) -> &'static str {
        match self {
            Self::Double => "K, double precision",
            Self::Single => "D, single precision",
            Self::Byte => "D, bytes",
        }
    }

    /// The rounding. Bytes have the range of the largest deviation of any cell of the `truth`.
    fn keep(self, truth: &[Level]) -> impl Fn(Covariance) -> Covariance {
        let deviations =
            truth.iter().flat_map(|level| &level.cells).flat_map(|c| factor(c.roughness));
        let range = deviations.fold(0.0, |most: f64, d| most.max(d.abs())).max(f64::MIN_POSITIVE);
        move |k| match self {
            Self::Double => k,
            Self::Single => product(factor(k).map(|d| f64::from(d as f32))),
            Self::Byte => {
                let [d1, d2, d3] = factor(k);
                let round = |d: f64, steps: f64| (d / range * steps).round() / steps * range;
                product([round(d1, 255.0), round(d2, 127.0), round(d3, 255.0)])
            }
        }
    }
}

/// The largest difference of an entry by level, parts of the variance at the top.
fn differences(truth: &[Level], found: &[Level]) -> Vec<f64> {
    let [a, _, c] = truth[truth.len() - 1].cells[0].roughness;
    let per = 1.0 / (a + c).max(f64::MIN_POSITIVE);
    let of = |(truth, found): (&Level, &Level)| {
        let pairs = truth.cells.iter().zip(&found.cells);
        let entries =
            pairs.flat_map(|(t, f)| [0, 1, 2].map(|e| (t.roughness[e] - f.roughness[e]).abs()));
        entries.fold(0.0, f64::max) * per
    };
    truth.iter().zip(found).map(of).collect()
}

fn largest(by_level: &[f64]) -> (usize, f64) {
    let worst = by_level.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    worst.map_or((0, 0.0), |(level, most)| (level, *most))
}

/// A curve from level 1 up; a logarithmic axis has no 0.
fn curve(label: &str, by_level: &[f64]) -> Series {
    let points = by_level.iter().enumerate().skip(1).map(|(l, d)| [l as f64, d.max(1e-18)]);
    Series { label: label.into(), points: points.collect(), joined: true }
}
