//! What a bump map is between its texel centres (Blinn 1978 §3).

use serde::{Deserialize, Serialize};

use super::HeightMap;
use crate::geometry::elementary::floor64;

/// How normals between texel centres are found.
///
/// All but the B-spline give a texel's own normal at its centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Bilinear in the unit normals' coordinates and the weight, then normalised.
    #[default]
    Bilinear,
    /// The texel's own normal over the whole texel: a mosaic of flat facets. What a filter that
    /// counts texels assumes, and the differences of Blinn's first `FVAL`, "a checkerboard of constant
    /// valued squares".
    Nearest,
    /// Bilinear in the *slopes*: Blinn's differences of a bilinear table, (F(u+E) − F(u−E)) / 2E with E
    /// one cell, for those are the bilinear interpolation of the differences at its nodes. Continuous; its
    /// own derivatives jump at the lines between nodes.
    Table,
    /// The derivatives of a Catmull-Rom spline through the heights (Catmull and Rom 1974): the slopes of
    /// [`Interpolation::Table`] at the nodes, of a surface that is there between them. Needs heights.
    CatmullRom,
    /// The derivatives of the uniform cubic B-spline with the heights as its control points, "the standard
    /// solution": slopes and their derivatives are continuous, heights smoothed by [1, 4, 1] / 6. Needs
    /// heights.
    BSpline,
}

impl Interpolation {
    /// All of them with their names in specs, the default first.
    pub const ALL: [(&'static str, Self); 5] = [
        ("bilinear", Self::Bilinear),
        ("nearest", Self::Nearest),
        ("table", Self::Table),
        ("catmull-rom", Self::CatmullRom),
        ("b-spline", Self::BSpline),
    ];

    /// The spline it differentiates, if it does.
    pub fn spline(self) -> Option<Spline> {
        match self {
            Self::Bilinear | Self::Nearest | Self::Table => None,
            Self::CatmullRom => Some(Spline::CatmullRom),
            Self::BSpline => Some(Spline::BSpline),
        }
    }
}

/// A cubic spline of heights at equal distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spline {
    /// Through the heights, its slope there their central difference (Catmull and Rom 1974).
    CatmullRom,
    /// The uniform cubic B-spline: twice continuously differentiable, not through the heights.
    BSpline,
}

impl Spline {
    /// Weights of the heights at −1, 0, 1 and 2 for the spline's value at t in [0, 1], and for its derivative.
    pub fn weights(self, t: f64) -> [[f64; 4]; 2] {
        let s = 1.0 - t;
        match self {
            Self::CatmullRom => [
                [
                    -0.5 * t * s * s,
                    1.0 + t * t * (1.5 * t - 2.5),
                    1.0 + s * s * (1.5 * s - 2.5),
                    -0.5 * s * t * t,
                ],
                [
                    -0.5 * s * (1.0 - 3.0 * t),
                    t * (4.5 * t - 5.0),
                    s * (5.0 - 4.5 * s),
                    0.5 * t * (3.0 * t - 2.0),
                ],
            ],
            Self::BSpline => [
                [
                    s * s * s / 6.0,
                    2.0 / 3.0 + t * t * (0.5 * t - 1.0),
                    2.0 / 3.0 + s * s * (0.5 * s - 1.0),
                    t * t * t / 6.0,
                ],
                [-0.5 * s * s, t * (1.5 * t - 2.0), s * (2.0 - 1.5 * s), 0.5 * t * t],
            ],
        }
    }

    /// [F, ∂F/∂x, ∂F/∂y] of the spline of `heights` at folded texture coordinates, height units and height
    /// units per texel. At a clamped edge heights go on in a straight line. Finite wherever (u, v) is.
    pub fn at(self, heights: &HeightMap, u: f64, v: f64) -> [f64; 3] {
        let (i, [across, across_slope]) = self.taps(u, heights.width());
        let (j, [along, along_slope]) = self.taps(v, heights.height());
        let mut sum = [0.0; 3];
        for b in 0..4 {
            let row = [0, 1, 2, 3].map(|a| heights.beyond(i + a - 1, j + b as isize - 1));
            let dot = |weights: &[f64; 4]| {
                (weights[0] * row[0] + weights[1] * row[1])
                    + (weights[2] * row[2] + weights[3] * row[3])
            };
            let value = dot(&across);
            sum[0] += along[b] * value;
            sum[1] += along[b] * dot(&across_slope);
            sum[2] += along_slope[b] * value;
        }
        sum
    }

    /// The node at or below a coordinate on an axis of `size` texels, and the weights about it.
    fn taps(self, coordinate: f64, size: usize) -> (isize, [[f64; 4]; 2]) {
        let size = size as f64;
        let position = (coordinate * size - 0.5).clamp(-2.0, size + 2.0);
        let below = floor64(position);
        (below as isize, self.weights(position - below))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{NormalMap, Wrap};
    use proptest::prelude::*;
    use std::sync::Arc;

    const SIDE: usize = 64;
    const E: f64 = 1.0 / SIDE as f64;

    fn table() -> HeightMap {
        let f = |u: f64, v: f64| (9.0 * u).sin() * 2.0 + (31.0 * v * u).cos() + v;
        HeightMap::from_fn(SIDE, SIDE, Wrap::Repeat, f)
    }

    /// Blinn's functions word for word, in table entries: entry i stands at u = i/64.
    fn fval_nearest(f: &HeightMap, u: f64, v: f64) -> f64 {
        f.at((64.0 * u).floor() as isize, (64.0 * v).floor() as isize)
    }

    fn fval(f: &HeightMap, u: f64, v: f64) -> f64 {
        let (iu, iv) = ((64.0 * u).floor(), (64.0 * v).floor());
        let (du, dv) = (64.0 * u - iu, 64.0 * v - iv);
        let [iu, iv] = [iu as isize, iv as isize];
        let fu0 = f.at(iu, iv) + du * (f.at(iu + 1, iv) - f.at(iu, iv));
        let fu1 = f.at(iu, iv + 1) + du * (f.at(iu + 1, iv + 1) - f.at(iu, iv + 1));
        fu0 + dv * (fu1 - fu0)
    }

    /// FU and FV, per cell.
    fn differences(at: impl Fn(f64, f64) -> f64, u: f64, v: f64) -> [f64; 2] {
        [at(u + E, v) - at(u - E, v), at(u, v + E) - at(u, v - E)].map(|d| d / 2.0)
    }

    fn slopes(map: &NormalMap, u: f64, v: f64) -> [f64; 2] {
        let [x, y, z, _] = map.sample(u as f32, v as f32).map(f64::from);
        [-x / z, -y / z]
    }

    fn near(a: [f64; 2], b: [f64; 2], within: f64) -> bool {
        (0..2).all(|c| (a[c] - b[c]).abs() < within)
    }

    proptest! {
        #[test]
        fn differences_of_a_bilinear_table_are_bilinear_in_slopes(u in 0.02f64..0.97, v in 0.02f64..0.97) {
            // Texels have their centres half a cell further on than the entries of the print.
            let heights = table();
            let map = NormalMap::from_heights(&heights, 1.0).with_interpolation(Interpolation::Table);
            let (at_u, at_v) = (f64::from((u + E / 2.0) as f32), f64::from((v + E / 2.0) as f32));
            let printed = differences(|u, v| fval(&heights, u, v), at_u - E / 2.0, at_v - E / 2.0);
            prop_assert!(near(slopes(&map, at_u, at_v), printed, 1e-4), "{printed:?}");
        }

        #[test]
        fn differences_of_a_checkerboard_are_the_nearest_normals(u in 0.02f64..0.97, v in 0.02f64..0.97) {
            prop_assume!([u, v].iter().all(|c| (64.0 * c).fract() > 1e-3 && (64.0 * c).fract() < 0.999));
            let heights = table();
            let map = NormalMap::from_heights(&heights, 1.0).with_interpolation(Interpolation::Nearest);
            let printed = differences(|u, v| fval_nearest(&heights, u, v), u, v);
            prop_assert!(near(slopes(&map, u, v), printed, 1e-5), "{printed:?}");
        }

        #[test]
        fn weights_add_up_and_slopes_are_of_values(t in 0.0f64..1.0) {
            for spline in [Spline::CatmullRom, Spline::BSpline] {
                let [value, slope] = spline.weights(t);
                prop_assert!((value.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                prop_assert!(slope.iter().sum::<f64>().abs() < 1e-12);
                let h = 1e-6;
                let [ahead, behind] = [t + h, t - h].map(|t| spline.weights(t)[0]);
                for k in 0..4 {
                    prop_assert!(((ahead[k] - behind[k]) / (2.0 * h) - slope[k]).abs() < 1e-8);
                }
                // A straight line stays one.
                let line = value.iter().enumerate().map(|(k, w)| w * (k as f64 - 1.0)).sum::<f64>();
                prop_assert!((line - t).abs() < 1e-12);
            }
        }

        #[test]
        fn splines_know_no_seams(u in 0.0f64..1.0, v in 0.0f64..1.0) {
            let map = table();
            for spline in [Spline::CatmullRom, Spline::BSpline] {
                let [f, fx, fy] = spline.at(&map, u, v);
                let h = 1e-5;
                let fold = |c: f64| Wrap::Repeat.fold(c);
                let moved = spline.at(&map, fold(u + h * E), fold(v + h * E));
                prop_assert!((moved[0] - f - h * (fx + fy)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_b_spline_alone_leaves_the_nodes() {
        let heights = Arc::new(table());
        let map = NormalMap::from_heights(&heights, 1.0).with_heights(Arc::clone(&heights));
        for (name, interpolation) in Interpolation::ALL {
            let map = map.clone().with_interpolation(interpolation);
            let apart = (0..SIDE * SIDE).map(|k| {
                let (i, j) = (k % SIDE, k / SIDE);
                let at = |i: usize| (i as f64 + 0.5) * E;
                let (here, own) = (slopes(&map, at(i), at(j)), map.slope(i, j));
                (0..2).map(|c| (here[c] - own[c]).abs()).fold(0.0, f64::max)
            });
            let apart = apart.fold(0.0, f64::max);
            let spline = interpolation == Interpolation::BSpline;
            assert!(if spline { apart > 1e-2 } else { apart < 1e-4 }, "{name}: {apart}");
        }
    }

    #[test]
    fn lanes_are_samples() {
        let heights = Arc::new(table());
        let map = NormalMap::from_heights(&heights, 1.0).with_heights(heights);
        let [u, v] = [7, 5].map(|k| std::array::from_fn(|i| ((i * k) % 64) as f32 / 64.3));
        for (name, interpolation) in Interpolation::ALL {
            let map = map.clone().with_interpolation(interpolation);
            let mut lanes = [[0.0; 64]; 4];
            map.sample_lanes::<64, true>(&u, &v, &mut lanes);
            for i in 0..64 {
                let one = map.sample(u[i], v[i]);
                for c in 0..4 {
                    assert!((lanes[c][i] - one[c]).abs() <= 1e-6, "{name} {i} {one:?}");
                }
            }
        }
    }

    #[test]
    fn a_clamped_slope_goes_on() {
        let heights = HeightMap::from_fn(5, 4, Wrap::Clamp, |u, v| 10.0 * u - 8.0 * v);
        for spline in [Spline::CatmullRom, Spline::BSpline] {
            for [u, v] in [[0.0, 0.0], [1.0, 0.3], [0.5, 1.0], [f64::NAN, 0.5]] {
                let [_, fx, fy] = spline.at(&heights, u, v);
                let flat = u.is_nan() || ((fx - 2.0).abs() < 1e-9 && (fy + 2.0).abs() < 1e-9);
                assert!(flat, "{u} {v}: {fx} {fy}");
            }
        }
    }
}
