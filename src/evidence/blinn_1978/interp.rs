//! §3: the table, how it is interpolated, and what of that is continuous.

use std::sync::Arc;

use super::common::{SIDE, Scene, side_by_side, table};
use super::fval::{Between, Way, differences, fval};
use crate::evidence::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Series, Table, Task,
};
use crate::parameter::Value;
use crate::surface::{Plane, Shape, Surface};
use crate::texture::{HeightMap, Interpolation, NormalMap, Wrap};

/// The row.
pub const ROW: Row = Row {
    name: "blinn-interp",
    title: "The 64 × 64 table between its entries: what is continuous, what repeats, and what its creases look like",
    parts: &[],
    parameters: &[],
    secs: 1.0,
    make,
};

/// A step over a line between entries, and one to take derivatives with; parts of a cell.
const STEP: f64 = 1e-9;
const SLOPE_STEP: f64 = 1e-4;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let set = [("wavelength", Value::Number(9.0)), ("slope", Value::Number(0.4))];
    let map = table("waves", SIDE, &set, 7);
    let heights = Arc::clone(map.heights().expect("waves have heights"));
    let found: Vec<Jumps> = Way::ALL.iter().map(|(_, way)| Jumps::of(*way, &heights)).collect();
    let mut exhibit = ROW.exhibit();
    exhibit.claims = continuity(&found, &heights);
    exhibit.claims.extend(as_printed(&heights));
    exhibit.tables = vec![measured(&found)];
    exhibit.figures = vec![along_a_line(&heights), creases(&heights, task)?];
    exhibit.remarks = vec![
        "“Continuity of derivative but not of value”: F_u and F_v by differences are continuous, but they are not the \
         derivatives of any one surface between the entries, as their sum around a cell tells."
            .into(),
    ];
    Ok(exhibit)
}

/// What jumps, in parts of the root mean square of F_u.
struct Jumps {
    /// Of F_u, over the lines between entries.
    slope: f64,
    /// Of ∂F_u/∂u there, of the root mean square of F_u a cell.
    curvature: f64,
    /// Mean of |∮ F_u du + F_v dv| around cells a quarter off the entries.
    around: f64,
}

impl Jumps {
    fn of(way: Way, heights: &HeightMap) -> Self {
        let cell = 1.0 / SIDE as f64;
        let f_u = |x: f64, v: f64| way.slopes(heights, x * cell, v)[0];
        let (mut squares, mut slope, mut curvature, mut around, mut count) =
            (0.0, 0.0f64, 0.0f64, 0.0, 0.0);
        for j in (0..SIDE).step_by(3) {
            let v = (j as f64 + 0.37) * cell;
            // The places where a way may jump: at entries, or halfway between.
            for x in (0..2 * SIDE).map(|k| 0.5 * k as f64) {
                squares += f_u(x + 0.21, v) * f_u(x + 0.21, v);
                slope = slope.max((f_u(x + STEP, v) - f_u(x - STEP, v)).abs());
                let bend = |a: f64, b: f64| (f_u(x + b, v) - f_u(x + a, v)) / SLOPE_STEP;
                let jump = bend(STEP, SLOPE_STEP) - bend(-SLOPE_STEP, -STEP);
                curvature = curvature.max(jump.abs());
                around += circulation(way, heights, x + 0.25, j as f64 + 0.25).abs();
                count += 1.0;
            }
        }
        let rms = libm::sqrt(squares / count);
        Self { slope: slope / rms, curvature: curvature / rms, around: around / count / rms }
    }
}

/// The sum of slope times way around half a cell whose corner is at (x, y), in cells, by the midpoint rule.
fn circulation(way: Way, heights: &HeightMap, x: f64, y: f64) -> f64 {
    const STEPS: usize = 16;
    const HALF: f64 = 0.5;
    let cell = 1.0 / SIDE as f64;
    let of = |x: f64, y: f64| way.slopes(heights, x * cell, y * cell);
    let mut sum = 0.0;
    for k in 0..STEPS {
        let at = (k as f64 + 0.5) / STEPS as f64 * HALF;
        sum += of(x + at, y)[0] - of(x + at, y + HALF)[0];
        sum += of(x + HALF, y + at)[1] - of(x, y + at)[1];
    }
    sum * HALF / STEPS as f64
}

fn continuity(found: &[Jumps], heights: &HeightMap) -> Vec<Claim> {
    let cell = 1.0 / SIDE as f64;
    let across = |between: Between| {
        let jump = |k: usize| {
            let (u, v) = ((k % SIDE) as f64 * cell, (k / SIDE) as f64 * cell + 0.3 * cell);
            let f = |step: f64| fval(heights, between, u + step * cell, v);
            (f(STEP) - f(-STEP)).abs()
        };
        (0..SIDE * SIDE).map(jump).fold(0.0, f64::max)
    };
    let [low, high] = heights.range();
    let [board, smooth] = [Between::Nothing, Between::Bilinear].map(|b| across(b) / (high - low));
    let shown = |what: &str, paper: &str, here: f64, rule: &str, holds: bool| {
        Claim::shown(what, paper, here, rule, holds)
    };
    vec![
        shown(
            "largest jump of F by the first FVAL, of its range",
            "a checkerboard of constant valued squares",
            board,
            "above 0.1",
            board > 0.1,
        ),
        Claim::at_most(
            "largest jump of the bilinear F, of its range",
            "continuous in value",
            1e-6,
            smooth,
        ),
        shown(
            "largest jump of the bilinear F's own F_u, of its root mean square",
            "but discontinuous in derivative: creases",
            found[1].slope,
            "above 0.1",
            found[1].slope > 0.1,
        ),
        Claim::at_most(
            "largest jump of F_u by differences of the bilinear F, of its root mean square",
            "continuity of derivative",
            1e-6,
            found[2].slope,
        ),
        shown(
            "F_u du + F_v dv summed around half a cell, mean, by differences, of the root mean square of F_u",
            "but not of value: no surface has these derivatives",
            found[2].around,
            "above 10⁻³, and a spline's below 10⁻³ of it",
            found[2].around > 1e-3 && found[3].around < 1e-3 * found[2].around,
        ),
    ]
}

/// That the program's own tables are the paper's.
fn as_printed(heights: &Arc<HeightMap>) -> Vec<Claim> {
    let cell = 1.0 / SIDE as f64;
    let map = NormalMap::from_heights(heights, 1.0).with_interpolation(Interpolation::Table);
    let three = map.replicated(3);
    let (mut mixed, mut period, mut own, mut unit_cell) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for k in 0..4000 {
        let x = f64::from(k + 1);
        let [u, v] = [0.754_877_666, 0.569_840_291].map(|a| (a * x).rem_euclid(1.0));
        let printed = differences(heights, Between::Bilinear, u, v);
        let farther = differences(heights, Between::Bilinear, u + 1.0, v - 2.0);
        let nodes = bilinear_of_nodes(heights, u, v);
        // Texels have their centres where entries of the print have their corners.
        let fold = |c: f64| Wrap::Repeat.fold(c);
        let of = |map: &NormalMap, u: f64, v: f64| {
            let [x, y, z, _] = map.sample(fold(u) as f32, fold(v) as f32).map(f64::from);
            [-x / z, -y / z]
        };
        let ours = of(&map, u + 0.5 * cell, v + 0.5 * cell);
        let again = of(&three, (u + 0.5 * cell) / 3.0, (v + 0.5 * cell + 1.0) / 3.0);
        for c in 0..2 {
            mixed = mixed.max((printed[c] - nodes[c]).abs());
            period = period.max((printed[c] - farther[c]).abs());
            own = own.max((printed[c] - ours[c]).abs());
            unit_cell = unit_cell.max((again[c] - ours[c]).abs());
        }
    }
    let claim =
        |what: &str, paper: &str, bound: f64, here: f64| Claim::at_most(what, paper, bound, here);
    vec![
        claim(
            "difference between differencing the bilinear table and interpolating the differences of its entries",
            "it is the same: interpolation is linear in the table",
            1e-12,
            mixed,
        ),
        claim(
            "change of F_u and F_v over whole periods",
            "periodic, with the table one period",
            1e-11,
            period,
        ),
        claim(
            "difference of the program's `table` maps from the print, slopes, single precision",
            "this is the form used in the pictures shown here",
            2e-4,
            own,
        ),
        claim(
            "difference of a table replicated three times from u and v times three",
            "a unit cell pattern to be replicated many times per patch",
            2e-4,
            unit_cell,
        ),
    ]
}

fn bilinear_of_nodes(heights: &HeightMap, u: f64, v: f64) -> [f64; 2] {
    let [x, y] = [u, v].map(|c| c * SIDE as f64);
    let (i, j) = (libm::floor(x), libm::floor(y));
    let (a, b) = (x - i, y - j);
    let at = |di: isize, dj: isize| heights.gradient(i as isize + di, j as isize + dj);
    let [p, q, r, s] = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
    std::array::from_fn(|c| {
        let (low, high) = (p[c] + a * (q[c] - p[c]), r[c] + a * (s[c] - r[c]));
        low + b * (high - low)
    })
}

fn measured(found: &[Jumps]) -> Table {
    let mut table = Table::new(
        "jumps",
        "What jumps at and between the table's entries, in parts of the root mean square of F_u (a cell).",
        &["F_u by", "jump of F_u", "jump of its derivative", "sum around half a cell"],
    );
    for ((name, _), jumps) in Way::ALL.iter().zip(found) {
        table.push(vec![
            (*name).into(),
            jumps.slope.into(),
            jumps.curvature.into(),
            jumps.around.into(),
        ]);
    }
    table
}

fn along_a_line(heights: &HeightMap) -> Figure {
    let series = |&(name, way): &(&str, Way)| Series {
        label: name.into(),
        points: (0..=480)
            .map(|k| 20.0 + f64::from(k) / 80.0)
            .map(|x| [x, way.slopes(heights, (x + 1e-7) / SIDE as f64, 0.4)[0]])
            .collect(),
        joined: true,
    };
    let chart = Chart {
        x: Axis::linear("u, cells of the table"),
        y: Axis::linear("F_u, height a cell"),
        series: Way::ALL.iter().map(series).collect(),
    };
    let caption = "F_u along u over six cells of one table.";
    Figure::new("slopes", caption, Drawing::Chart(chart))
}

/// Texels a cell of the pictures.
const FINE: usize = 16;
/// Cells that are seen.
const SEEN: usize = 12;

fn creases(heights: &HeightMap, task: &Task) -> Result<Figure, Halted> {
    let mut panels = Vec::new();
    let scene = Scene::plane(50.0, [280, 220]);
    let scene =
        Scene { shape: Shape::Plane(Plane::new().tiled(1.0, 1.0)), exponent: 20.0, ..scene };
    for (k, (name, way)) in Way::ALL.iter().enumerate() {
        let side = SEEN * FINE;
        let map = NormalMap::from_fn(side, side, Wrap::Clamp, |u, v| {
            let at = |c: f64| (c * SEEN as f64 + 20.0) / SIDE as f64;
            let [f_u, f_v] = way.slopes(heights, at(u), at(v));
            [-f_u, -f_v, 1.0, 1.0]
        });
        let film = scene.picture(&Arc::new(map), task)?;
        panels.push(Panel::new(&format!("way-{k}"), *name, film));
    }
    let caption = format!("{SEEN} × {SEEN} cells of that table, magnified.");
    Ok(Figure::new("creases", caption, Drawing::Images(side_by_side(panels, 3))))
}
