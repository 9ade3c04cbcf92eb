//! A polynomial in u and v (Blinn 1978 §3).

use super::{Bumps, Card, Entry, analytic};
use crate::parameter::{Column, Domain, Parameter, Values};

/// F(u, v) = Σ c uⁱ vʲ with u and v from 0 to 1 over the tile and F in widths of the tile. Its own derivatives
/// are its slopes. Where it does not agree with itself at opposite sides, tiles meet in a step that no normal
/// shows.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "polynomial",
        source: "Blinn 1978, Simulation of Wrinkled Surfaces, §3 (a bivariate polynomial)",
        summary: "A polynomial in u and v of given coefficients.",
    },
    parameters: &[Parameter {
        name: "terms",
        meaning: "the terms c u^i v^j, u and v from 0 to 1, heights in widths of the tile",
        domain: Domain::Rows {
            columns: &[
                Column { name: "i", min: 0.0, max: 32.0, whole: true },
                Column { name: "j", min: 0.0, max: 32.0, whole: true },
                Column { name: "c", min: -1000.0, max: 1000.0, whole: false },
            ],
            // 1.6 u (1 − u) v (1 − v): a cushion a tenth high.
            default: &[&[1.0, 1.0, 1.6], &[2.0, 1.0, -1.6], &[1.0, 2.0, -1.6], &[2.0, 2.0, 1.6]],
            most: 1024,
        },
    }],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let terms: Vec<([u32; 2], f64)> =
        values.rows("terms").iter().map(|t| ([t[0] as u32, t[1] as u32], t[2])).collect();
    analytic::bumps(width, height, |u, v| {
        terms.iter().fold([0.0; 3], |sum, &([i, j], c)| {
            let ([x, x_u], [y, y_v]) = (power(u, i), power(v, j));
            [sum[0] + c * x * y, sum[1] + c * x_u * y, sum[2] + c * x * y_v]
        })
    })
}

/// xⁿ and its derivative.
fn power(x: f64, n: u32) -> [f64; 2] {
    let below = (1..n).fold(1.0, |product, _| product * x);
    if n == 0 { [1.0, 0.0] } else { [below * x, f64::from(n) * below] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Value;

    #[test]
    fn a_plane_leans_as_it_is_told() {
        let rows =
            Value::Rows(vec![vec![1.0, 0.0, 0.25], vec![0.0, 1.0, -0.5], vec![0.0, 0.0, 7.0]]);
        let values = Values::defaults(ENTRY.parameters).with(&[("terms", rows)]);
        let bumps = build(8, 4, &values, 0);
        // v goes from 0 to 1 over half the width.
        let slopes = [bumps.normals.slope(0, 0), bumps.normals.slope(5, 3)];
        for [x, y] in slopes {
            assert!((x - 0.25).abs() < 1e-6 && (y + 1.0).abs() < 1e-6, "{x} {y}");
        }
        assert_eq!(power(3.0, 0), [1.0, 0.0]);
        assert_eq!(power(3.0, 4), [81.0, 108.0]);
    }
}
