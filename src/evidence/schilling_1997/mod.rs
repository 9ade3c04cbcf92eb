//! Schilling 1997, Antialiasing of Bump-Maps.

mod a;
mod bumped;
mod f14;
mod f6;
mod f7;
mod frames;
mod images;
mod k;
mod pyramids;
#[cfg(test)]
mod tests;

use super::Paper;

/// The paper.
pub const PAPER: Paper = Paper {
    name: "schilling-1997",
    citation: "Andreas G. Schilling, Antialiasing of Bump-Maps, Wilhelm-Schickard-Institut für Informatik, \
               WSI-97-15, Universität Tübingen, 1997",
    rows: &[
        images::F1,
        frames::ROW,
        f6::ROW,
        k::ROW,
        f7::ROW,
        images::F8,
        images::F10,
        f14::ROW,
        a::ROW,
    ],
};
