//! What became of a pyramid's cells: the counts of Fournier 1992 §2.3.

use super::Fournier;
use super::pyramid::{Level, build};
use crate::method::{PrefilterError, Progress};
use crate::texture::NormalMap;

/// What became of a level's cells, or of all levels'.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LevelCounts {
    /// Cells of the level.
    pub cells: usize,
    /// Cells whose normals, identical ones merged, were few enough to be kept as they are.
    pub kept: usize,
    /// Cells that were fitted.
    pub fits: usize,
    /// Fits that went to the most peaks.
    pub at_most_peaks: usize,
    /// Fits whose residual is above the stopping rule's bound.
    pub unmet: usize,
    /// Fits in which a peak more gave nothing better.
    pub failures: usize,
}

impl LevelCounts {
    /// The counts of all levels together.
    pub fn total(levels: &[Self]) -> Self {
        levels.iter().fold(Self::default(), |sum, level| Self {
            cells: sum.cells + level.cells,
            kept: sum.kept + level.kept,
            fits: sum.fits + level.fits,
            at_most_peaks: sum.at_most_peaks + level.at_most_peaks,
            unmet: sum.unmet + level.unmet,
            failures: sum.failures + level.failures,
        })
    }
}

/// Builds the pyramid of a map and counts what became of its cells, level by level from the first
/// above the map. `exponent` > 0 is the base lobe's.
///
/// # Errors
/// [`PrefilterError::Cancelled`].
pub fn count_fits(
    method: &Fournier,
    map: &NormalMap,
    exponent: f64,
    progress: &dyn Progress,
) -> Result<Vec<LevelCounts>, PrefilterError> {
    let levels = build(method, map, exponent, progress)?;
    Ok(levels.iter().map(|level| count(method, level)).collect())
}

fn count(method: &Fournier, level: &Level) -> LevelCounts {
    let mut counts = LevelCounts { cells: level.cells.len(), ..LevelCounts::default() };
    for outcome in level.cells.iter().map(|cell| &cell.outcome) {
        counts.failures += outcome.failures;
        if outcome.fitted == 0 {
            counts.kept += 1;
            continue;
        }
        counts.fits += 1;
        counts.at_most_peaks += usize::from(outcome.fitted == method.greedy.max_peaks);
        counts.unmet += usize::from(!outcome.met);
    }
    counts
}
