//! Figure 4: the Gauss map of a curve.

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};

/// The row.
pub const ROW: Row = Row {
    name: "olano-f4",
    title: "The Gauss map of a section of a curve: its normals on the unit circle, and their density",
    parts: &[],
    parameters: &[],
    secs: 0.1,
    make,
};

/// Points of the curve.
const POINTS: usize = 20_000;
/// Cells of the histogram of directions.
const CELLS: usize = 30;

/// The curve y = 0.35 sin(1.7 x) + 0.2 cos(3.1 x), x from −1.5 to 1.5: [y, y′, y″].
fn curve(x: f64) -> [f64; 3] {
    let (s1, c1) = libm::sincos(1.7 * x);
    let (s2, c2) = libm::sincos(3.1 * x);
    [
        0.35 * s1 + 0.2 * c2,
        0.35 * 1.7 * c1 - 0.2 * 3.1 * s2,
        -0.35 * 1.7 * 1.7 * s1 - 0.2 * 3.1 * 3.1 * c2,
    ]
}

fn xs() -> impl Iterator<Item = f64> {
    (0..POINTS).map(|i| -1.5 + 3.0 * (i as f64 + 0.5) / POINTS as f64)
}

/// Angle of the normal (−y′, 1) from +y towards −x, radians.
fn angle(slope: f64) -> f64 {
    libm::atan(slope)
}

fn make(_: &Task) -> Result<Exhibit, Halted> {
    let dx = 3.0 / POINTS as f64;
    // The length of the Gauss map's image, counted with turns back, is ∫ |κ| ds.
    let turned: f64 = xs().map(|x| curve(x)[2].abs() / (1.0 + curve(x)[1].powi(2)) * dx).sum();
    let angles: Vec<f64> = xs().map(|x| angle(curve(x)[1])).collect();
    let walked: f64 = angles.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    let (low, high) = angles.iter().fold((f64::MAX, f64::MIN), |(l, h), &a| (l.min(a), h.max(a)));
    let length: f64 = xs().map(|x| (1.0 + curve(x)[1].powi(2)).sqrt() * dx).sum();
    // The share of the curve whose normals lie in a cell, over the cell's size.
    let cell = (high - low) / CELLS as f64;
    let mut share = [0.0; CELLS];
    for (x, a) in xs().zip(&angles) {
        let k = (((a - low) / cell) as usize).min(CELLS - 1);
        share[k] += (1.0 + curve(x)[1].powi(2)).sqrt() * dx / length / cell;
    }
    let total: f64 = share.iter().map(|s| s * cell).sum();
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::shown(
            "length of the walk of the normals along the unit circle, over the curve's ∫ |κ| ds",
            "every point's unit normal is a point of the unit circle (§3)",
            walked / turned,
            "1 within 10⁻³",
            (walked / turned - 1.0).abs() < 1e-3,
        ),
        Claim::shown(
            "integral of the density of the Gauss map over its angles",
            "its density can be modelled as a probability density (§3)",
            total,
            "1 within 10⁻⁶",
            (total - 1.0).abs() < 1e-6,
        ),
    ];
    let mut table = Table::new("section", "The section of the curve.", &["what", "value"]);
    table.push(vec!["length".into(), length.into()]);
    table.push(vec!["arc of its Gauss map, degrees".into(), (high - low).to_degrees().into()]);
    table.push(vec!["walk of its normals, degrees".into(), walked.to_degrees().into()]);
    exhibit.tables = vec![table];
    exhibit.figures = figures(&angles, low, cell, &share);
    Ok(exhibit)
}

fn figures(angles: &[f64], low: f64, cell: f64, share: &[f64]) -> Vec<Figure> {
    let series = |label: &str, points, joined| Series { label: label.into(), points, joined };
    let every = POINTS / 12;
    let has_normal = |k: usize| k % every == every / 2;
    let mut comb = vec![];
    for (k, x) in xs().enumerate().filter(|(k, _)| k % 50 == 0 || has_normal(*k)) {
        let ([y, _, _], (sin, cos)) = (curve(x), libm::sincos(angles[k]));
        comb.push([x, y]);
        if has_normal(k) {
            comb.extend([[x - 0.25 * sin, y + 0.25 * cos], [x, y]]);
        }
    }
    let arc = (0..=60).map(|k| {
        let (sin, cos) = libm::sincos((3.0 * f64::from(k)).to_radians());
        [cos, sin]
    });
    let images = angles.iter().skip(every / 2).step_by(every).map(|a| {
        let (sin, cos) = libm::sincos(*a);
        [-sin, cos]
    });
    let gauss = vec![
        series("unit circle, its upper half", arc.collect(), true),
        series("normals of the curve", images.collect(), false),
    ];
    let middles = share.iter().enumerate();
    let density =
        middles.map(|(k, s)| [(low + cell * (k as f64 + 0.5)).to_degrees(), *s]).collect();
    let chart = |x: &str, y: &str, series| {
        Drawing::Chart(Chart { x: Axis::linear(x), y: Axis::linear(y), series })
    };
    vec![
        Figure::new(
            "curve",
            "A section of a curve with normals.",
            chart("x", "y", vec![series("curve with its normals", comb, true)]),
        ),
        Figure::new(
            "gauss-map",
            "Its Gauss map: those normals on the unit circle.",
            chart("n_x", "n_y", gauss),
        ),
        Figure::new(
            "density",
            "Density of its Gauss map by length of curve; it is 1/|κ|, so it piles up at inflections.",
            chart(
                "angle of the normal, degrees",
                "density a radian",
                vec![series("density", density, true)],
            ),
        ),
    ]
}
