//! Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces.

use super::Paper;

/// The paper.
pub const PAPER: Paper = Paper {
    name: "fournier-1992",
    citation: "Alain Fournier, Filtering Normal Maps and Creating Multiple Surfaces, University of \
               British Columbia, 1992",
    rows: &[],
};
