//! Kautz, Heidrich and Seidel 2001, Real-Time Bump Map Synthesis.

mod common;
mod f1;
mod f2;
mod f4;
mod f5;
mod l;
#[cfg(test)]
mod tests;
mod x;
mod z;

use super::Paper;

/// The paper.
pub const PAPER: Paper = Paper {
    name: "kautz-2001",
    citation: "Jan Kautz, Wolfgang Heidrich and Hans-Peter Seidel, Real-Time Bump Map Synthesis, Proceedings of the ACM \
               SIGGRAPH/Eurographics Workshop on Graphics Hardware, 2001",
    rows: &[f1::ROW, f2::ROW, l::ROW, f4::ROW, f5::ROW, z::ROW, x::ROW],
};
