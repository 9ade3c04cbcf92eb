//! Olano and North 1997, Normal Distribution Mapping.

mod body;
mod common;
mod densities;
mod f1;
mod f2;
mod f4;
mod f5;
mod f6;
mod f7;
mod n;
mod s;
#[cfg(test)]
mod tests;
mod times;

use super::Paper;

/// The paper.
pub const PAPER: Paper = Paper {
    name: "olano-north-1997",
    citation: "Marc Olano and Michael North, Normal Distribution Mapping, University of North Carolina at Chapel \
               Hill, Computer Science Technical Report 97-041, 1997",
    rows: &[f1::ROW, f2::ROW, f4::ROW, f5::ROW, f6::ROW, f7::ROW, n::ROW, s::ROW],
};
