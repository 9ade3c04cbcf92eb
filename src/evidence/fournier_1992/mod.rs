//! Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces.

mod f2;
mod f3;
mod fast;
mod horizons;
mod images;
mod n1;
mod peaks;
mod surfaces;
mod t0;
mod t1;
#[cfg(test)]
mod tests;
mod textures;

use super::Paper;

/// The paper.
pub const PAPER: Paper = Paper {
    name: "fournier-1992",
    citation: "Alain Fournier, Filtering Normal Maps and Creating Multiple Surfaces, University of \
               British Columbia, 1992",
    rows: &[
        f2::ROW,
        f3::ROW,
        n1::ROW,
        t0::ROW,
        images::F4,
        images::F5,
        images::F6,
        images::F7,
        images::F8,
        t1::ROW,
        surfaces::F9,
        surfaces::F10,
        surfaces::F11,
        horizons::F12,
        horizons::F13,
        horizons::F14,
        peaks::ROW,
        fast::ROW,
    ],
};
