//! Blinn 1978, Simulation of Wrinkled Surfaces.

mod common;
mod f10;
mod f11;
mod f2;
mod f5;
mod f6;
mod f7;
mod f8;
mod f9;
mod fval;
mod interp;
mod t;
#[cfg(test)]
mod tests;

use super::Paper;

/// The paper.
pub const PAPER: Paper = Paper {
    name: "blinn-1978",
    citation: "James F. Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH '78, Computer Graphics 12(3), 286–292, 1978",
    rows: &[
        f2::ROW,
        interp::ROW,
        f5::ROW,
        f6::ROW,
        f7::ROW,
        f8::ROW,
        f9::ROW,
        f10::ROW,
        f11::ROW,
        t::ROW,
    ],
};
