//! The paper's functions `FVAL` and its differences, as printed (§3). Entry i of the table stands at u = i/64; a
//! [`HeightMap`] has it half a cell further on.

use crate::geometry::elementary::floor64;
use crate::texture::{HeightMap, Spline};

/// How F is found between entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// The first function: the entry at or before (u, v).
    Nothing,
    /// The second: bilinear interpolation.
    Bilinear,
}

/// `FVAL(U, V)`; the table repeats, as by "masking off all but the low 6 bits".
pub fn fval(table: &HeightMap, between: Between, u: f64, v: f64) -> f64 {
    let [x, y] = [u * table.width() as f64, v * table.height() as f64];
    let [iu, iv] = [x, y].map(|c| floor64(c) as isize);
    if between == Between::Nothing {
        return table.at(iu, iv);
    }
    let (du, dv) = (x - floor64(x), y - floor64(y));
    let [f00, f10] = [table.at(iu, iv), table.at(iu + 1, iv)];
    let [f01, f11] = [table.at(iu, iv + 1), table.at(iu + 1, iv + 1)];
    let (fu0, fu1) = (f00 + du * (f10 - f00), f01 + du * (f11 - f01));
    fu0 + dv * (fu1 - fu0)
}

/// `FU` and `FV` with E one cell, in heights a cell.
pub fn differences(table: &HeightMap, between: Between, u: f64, v: f64) -> [f64; 2] {
    let (e_u, e_v) = (1.0 / table.width() as f64, 1.0 / table.height() as f64);
    let f = |u, v| fval(table, between, u, v);
    [0.5 * (f(u + e_u, v) - f(u - e_u, v)), 0.5 * (f(u, v + e_v) - f(u, v - e_v))]
}

/// A way to have derivatives of F between the entries of its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Differences of the checkerboard.
    Checkerboard,
    /// The derivatives that the bilinear function itself has.
    Bilinear,
    /// Differences of the bilinear function: what the paper uses.
    Differences,
    /// Derivatives of a cubic spline.
    Spline(Spline),
}

impl Way {
    /// All of them with their names.
    pub const ALL: [(&'static str, Self); 5] = [
        ("differences of the checkerboard", Self::Checkerboard),
        ("derivative of the bilinear table", Self::Bilinear),
        ("differences of the bilinear table", Self::Differences),
        ("Catmull-Rom spline", Self::Spline(Spline::CatmullRom)),
        ("B-spline", Self::Spline(Spline::BSpline)),
    ];

    /// [F_u, F_v] at (u, v), heights a cell.
    pub fn slopes(self, table: &HeightMap, u: f64, v: f64) -> [f64; 2] {
        match self {
            Self::Checkerboard => differences(table, Between::Nothing, u, v),
            Self::Differences => differences(table, Between::Bilinear, u, v),
            Self::Bilinear => {
                let [x, y] = [u * table.width() as f64, v * table.height() as f64];
                let [iu, iv] = [x, y].map(|c| floor64(c) as isize);
                let (du, dv) = (x - floor64(x), y - floor64(y));
                let step = |a: isize, b: isize, c: isize, d: isize| {
                    table.at(iu + c, iv + d) - table.at(iu + a, iv + b)
                };
                let across = step(0, 0, 1, 0) * (1.0 - dv) + step(0, 1, 1, 1) * dv;
                let along = step(0, 0, 0, 1) * (1.0 - du) + step(1, 0, 1, 1) * du;
                [across, along]
            }
            Self::Spline(spline) => {
                let half = [0.5 / table.width() as f64, 0.5 / table.height() as f64];
                let [u, v] = [u + half[0], v + half[1]].map(|c| c - floor64(c));
                let [_, f_u, f_v] = spline.at(table, u, v);
                [f_u, f_v]
            }
        }
    }
}
