//! Figure 7: two Gaussians mixed into one.

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use crate::parameter::{Domain, Parameter};

/// The row.
pub const ROW: Row = Row {
    name: "olano-f7",
    title: "Two Gaussians mixed into one: mean and second moments add, covariance does not",
    parts: &[],
    parameters: &[
        Parameter {
            name: "share",
            meaning: "p, the share of the first of the two",
            domain: Domain::Real { default: 0.5, min: 0.05, max: 0.95 },
        },
        Parameter {
            name: "apart",
            meaning: "angle between the two means, degrees",
            domain: Domain::Real { default: 40.0, min: 1.0, max: 120.0 },
        },
        Parameter {
            name: "sigma",
            meaning: "standard deviation of each",
            domain: Domain::Real { default: 0.12, min: 0.05, max: 0.5 },
        },
    ],
    secs: 0.2,
    make,
};

/// Mean and second moments about the origin, xx, xy, yy.
#[derive(Clone, Copy, Debug)]
struct Moments {
    mean: [f64; 2],
    second: [f64; 3],
}

impl Moments {
    /// By the midpoint rule over the square of half side 3 about the origin.
    fn of(density: impl Fn(f64, f64) -> f64) -> Self {
        const CELLS: i32 = 800;
        let side = 6.0 / f64::from(CELLS);
        let at = |k: i32| -3.0 + side * (f64::from(k) + 0.5);
        let (mut mean, mut second) = ([0.0; 2], [0.0; 3]);
        for j in 0..CELLS {
            for i in 0..CELLS {
                let (x, y) = (at(i), at(j));
                let mass = density(x, y) * side * side;
                mean = [mean[0] + mass * x, mean[1] + mass * y];
                second =
                    [second[0] + mass * x * x, second[1] + mass * x * y, second[2] + mass * y * y];
            }
        }
        Self { mean, second }
    }

    /// p a + (1 − p) b
    fn mixed(p: f64, a: Self, b: Self) -> Self {
        let mix = |x: f64, y: f64| p * x + (1.0 - p) * y;
        Self {
            mean: [0, 1].map(|c| mix(a.mean[c], b.mean[c])),
            second: [0, 1, 2].map(|c| mix(a.second[c], b.second[c])),
        }
    }

    /// S = E₂ − uᵀu
    fn covariance(self) -> [f64; 3] {
        let [x, y] = self.mean;
        [self.second[0] - x * x, self.second[1] - x * y, self.second[2] - y * y]
    }
}

/// dᵀ S d
fn along(s: [f64; 3], [x, y]: [f64; 2]) -> f64 {
    s[0] * x * x + 2.0 * s[1] * x * y + s[2] * y * y
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let [p, apart, sigma] = ["share", "apart", "sigma"].map(|name| task.values.number(name));
    let means = [90.0 - 0.5 * apart, 90.0 + 0.5 * apart].map(|degrees: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        [cos, sin]
    });
    let v = sigma * sigma;
    let gauss = |mean: [f64; 2]| {
        move |x: f64, y: f64| {
            let square = (x - mean[0]) * (x - mean[0]) + (y - mean[1]) * (y - mean[1]);
            libm::exp(-0.5 * square / v) / (std::f64::consts::TAU * v)
        }
    };
    let [first, second] = means.map(gauss);
    let [a, b] = means.map(|mean| Moments::of(gauss(mean)));
    let both = Moments::of(|x, y| p * first(x, y) + (1.0 - p) * second(x, y));
    let sum = Moments::mixed(p, a, b);
    let gap =
        |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let apart_by = [means[0][0] - means[1][0], means[0][1] - means[1][1]];
    let distance = (apart_by[0] * apart_by[0] + apart_by[1] * apart_by[1]).sqrt();
    let axis = apart_by.map(|c| c / distance);
    let across = [-axis[1], axis[0]];
    let s = both.covariance();
    let of_parts = {
        let [s, t] = [a, b].map(Moments::covariance);
        [0, 1, 2].map(|c| p * s[c] + (1.0 - p) * t[c])
    };
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::at_most(
            "largest difference of the mixture's mean from p u₁ + (1 − p) u₂",
            "the mean is an average of the means (§5)",
            1e-6,
            gap(&both.mean, &sum.mean),
        ),
        Claim::at_most(
            "largest difference of its second moments from p E₁ + (1 − p) E₂",
            "second moments about the origin combine linearly (§5)",
            1e-6,
            gap(&both.second, &sum.second),
        ),
        Claim::shown(
            "largest difference of its covariance from p S₁ + (1 − p) S₂, of a part's variance",
            "variances do not combine linearly (§5)",
            gap(&s, &of_parts) / v,
            "above 0.1",
            gap(&s, &of_parts) > 0.1 * v,
        ),
        Claim::shown(
            "variance across the axis between the means, over each part's",
            "the same in the other directions (§5)",
            along(s, across) / v,
            "1 within 10⁻³",
            (along(s, across) / v - 1.0).abs() < 1e-3,
        ),
        Claim::near(
            "variance along that axis: the part's and p (1 − p) |u₁ − u₂|²",
            v + p * (1.0 - p) * distance * distance,
            along(s, axis),
            1e-3,
        ),
    ];
    let mut table = Table::new(
        "moments",
        "Mean and covariance of the parts and of their mixture.",
        &["distribution", "u_x", "u_y", "S_xx", "S_xy", "S_yy"],
    );
    for (name, moments) in [("first", a), ("second", b), ("mixture", both)] {
        let [xx, xy, yy] = moments.covariance();
        let [x, y] = moments.mean;
        let values = [x, y, xx, xy, yy].map(Into::into);
        table.push(std::iter::once(name.into()).chain(values).collect());
    }
    exhibit.tables = vec![table];
    exhibit.figures = vec![drawn(means, v, both)];
    Ok(exhibit)
}

/// Contours at one and two standard deviations.
fn drawn(means: [[f64; 2]; 2], v: f64, both: Moments) -> Figure {
    let ring = |label: String, mean: [f64; 2], s: [f64; 3], times: f64, turn: f64| {
        // S = L Lᵀ.
        let l = [s[0].sqrt(), s[1] / s[0].sqrt()];
        let rest = (s[2] - l[1] * l[1]).max(0.0).sqrt();
        let points = (0..=72).map(|k| {
            let (sin, cos) = libm::sincos((turn * f64::from(k) / 72.0).to_radians());
            [mean[0] + times * l[0] * cos, mean[1] + times * (l[1] * cos + rest * sin)]
        });
        Series { label, points: points.collect(), joined: true }
    };
    let mut series =
        vec![ring("unit circle, its upper half".into(), [0.0; 2], [1.0, 0.0, 1.0], 1.0, 180.0)];
    for times in [1.0, 2.0] {
        series.push(ring(format!("first, {times}σ"), means[0], [v, 0.0, v], times, 360.0));
        series.push(ring(format!("second, {times}σ"), means[1], [v, 0.0, v], times, 360.0));
        series.push(ring(format!("mixture, {times}σ"), both.mean, both.covariance(), times, 360.0));
    }
    let chart = Chart { x: Axis::linear("x"), y: Axis::linear("y"), series };
    Figure::new(
        "contours",
        "Contours of two Gaussians on the plane of the Gauss map, and of the one of their moments.",
        Drawing::Chart(chart),
    )
}
