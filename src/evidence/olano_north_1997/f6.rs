//! Figure 6: a Gaussian restricted to a circle.

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use super::densities::{Density, over_sphere};
use crate::geometry::{HemisphereGrid, Vec3};
use crate::parameter::{Domain, Parameter};

/// The row.
pub const ROW: Row = Row {
    name: "olano-f6",
    title: "A 2D Gaussian restricted to a circle: a cluster of directions about its mean",
    parts: &[],
    parameters: &[Parameter {
        name: "sigma",
        meaning: "standard deviation of the Gaussian about its mean",
        domain: Domain::Real { default: 0.35, min: 0.05, max: 1.0 },
    }],
    secs: 0.1,
    make,
};

/// Directions round the circle.
const POINTS: usize = 720;

/// exp(−½ (h − u) S⁻¹ (h − u)ᵀ) at angle φ from x; S with axes along x and y.
fn restricted(phi: f64, mean: [f64; 2], variance: [f64; 2]) -> f64 {
    let (sin, cos) = libm::sincos(phi);
    let [x, y] = [cos - mean[0], sin - mean[1]];
    libm::exp(-0.5 * (x * x / variance[0] + y * y / variance[1]))
}

fn angles() -> impl Iterator<Item = f64> {
    (0..POINTS).map(|k| std::f64::consts::TAU * (k as f64 / POINTS as f64 - 0.5))
}

/// The density a radian, of integral 1 round the circle.
fn density(mean: [f64; 2], variance: [f64; 2]) -> Vec<f64> {
    let values: Vec<f64> = angles().map(|phi| restricted(phi, mean, variance)).collect();
    let whole = values.iter().sum::<f64>() * std::f64::consts::TAU / POINTS as f64;
    values.into_iter().map(|value| value / whole).collect()
}

/// von Mises: e^(κ cos φ) / (2π I₀(κ)), I₀ by its series, here with the factor e^(−κ) on both sides.
fn von_mises(phi: f64, kappa: f64) -> f64 {
    let mut term = libm::exp(-kappa);
    let mut bessel = term;
    for k in 1..4000 {
        let ratio = 0.5 * kappa / f64::from(k);
        term *= ratio * ratio;
        bessel += term;
    }
    libm::exp(kappa * (libm::cos(phi) - 1.0)) / (std::f64::consts::TAU * bessel)
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let sigma = task.values.number("sigma");
    let v = sigma * sigma;
    let mut exhibit = ROW.exhibit();
    let round = density([1.0, 0.0], [v, v]);
    let peak = round[POINTS / 2];
    let worst = angles().zip(&round).map(|(phi, d)| (von_mises(phi, 1.0 / v) - d).abs() / peak);
    exhibit.claims.push(Claim::at_most(
        "largest difference of the restriction from von Mises' density with κ = 1/σ², of the peak",
        "a conditional probability on the circle, Gaussian-like (§4, §5)",
        1e-6,
        worst.fold(0.0, f64::max),
    ));
    let step = std::f64::consts::TAU / POINTS as f64;
    let tight = angles().zip(density([1.0, 0.0], [0.01, 0.01])).map(|(phi, d)| {
        let gauss = libm::exp(-0.5 * phi * phi / 0.01) / (std::f64::consts::TAU * 0.01).sqrt();
        0.5 * (d - gauss).abs() * step
    });
    exhibit.claims.push(Claim::at_most(
        "total variation distance from a Gaussian of the angle, σ = 0.1",
        "reproduces the tight Gaussian-like cluster of a shiny surface (§5)",
        0.01,
        tight.sum(),
    ));
    let grid = HemisphereGrid::new(720, 8);
    let printed = over_sphere(&grid, |h| Density::Restricted.printed(h, sigma));
    let closed = 1.0 / Density::Restricted.factor(Vec3::z(), sigma);
    exhibit.claims.push(Claim::shown(
        "on the sphere: integral of the restricted round Gaussian, over 2πσ²(1 − e^(−2/σ²))",
        "does not integrate well over the sphere (§6)",
        printed / closed,
        "1 within 10⁻⁴: a round one has a closed form",
        (printed / closed - 1.0).abs() < 1e-4,
    ));
    let shown = [
        ("σ on both axes, mean on the circle", [1.0, 0.0], [v, v]),
        ("3σ along the circle", [1.0, 0.0], [v, 9.0 * v]),
        ("3σ along the circle, mean at 0.8", [0.8, 0.0], [v, 9.0 * v]),
    ];
    let mut table = Table::new(
        "restrictions",
        "Standard deviation of the angle of the restricted distributions.",
        &["2D Gaussian", "standard deviation, degrees"],
    );
    let mut series = vec![];
    for (label, mean, variance) in shown {
        let values = density(mean, variance);
        let square: f64 = angles().zip(&values).map(|(phi, d)| phi * phi * d * step).sum();
        table.push(vec![label.into(), square.sqrt().to_degrees().into()]);
        let points = angles().zip(values).map(|(phi, d)| [phi.to_degrees(), d]).collect();
        series.push(Series { label: label.into(), points, joined: true });
    }
    exhibit.tables.push(table);
    exhibit.figures = vec![plane(sigma), chart(series)];
    Ok(exhibit)
}

/// Half the circle and contours of the Gaussian about its top, as the paper draws them.
fn plane(sigma: f64) -> Figure {
    let ring = |label: String, radius: f64, centre: f64, degrees: i32| {
        let of = |k: i32| {
            let (sin, cos) = libm::sincos(f64::from(degrees * k).to_radians());
            [radius * cos, centre + radius * sin]
        };
        Series { label, points: (0..=60).map(of).collect(), joined: true }
    };
    let tangent = vec![[-1.5, 1.0], [1.5, 1.0]];
    let series = vec![
        ring("unit circle, its upper half".into(), 1.0, 0.0, 3),
        ring("σ".into(), sigma, 1.0, 6),
        ring("2σ".into(), 2.0 * sigma, 1.0, 6),
        Series { label: "tangent at the mean".into(), points: tangent, joined: true },
    ];
    let chart = Chart { x: Axis::linear("x"), y: Axis::linear("y"), series };
    Figure::new(
        "plane",
        "A 2D Gaussian about a direction, its contours, and the circle that it is restricted to.",
        Drawing::Chart(chart),
    )
}

fn chart(series: Vec<Series>) -> Figure {
    let chart = Chart {
        x: Axis::linear("angle from the mean, degrees"),
        y: Axis::linear("density a radian"),
        series,
    };
    Figure::new("densities", "Restricted distributions on the circle.", Drawing::Chart(chart))
}
