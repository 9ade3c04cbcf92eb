//! The pyramid of peaks: one reconstruction a cell.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::Fournier;
use crate::fit::{Directions, Fit, Peak, reconstruct};
use crate::geometry::{HemisphereGrid, Vec3};
use crate::method::{PrefilterError, Progress};
use crate::texture::{NormalMap, level_sizes, tap_weights};

/// The cells of a level, row by row from v = 0.
pub(super) struct Level {
    pub width: usize,
    pub height: usize,
    pub cells: Vec<Fit>,
}

/// What became of a level's cells: the counts of Fournier 1992 §2.3.
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
    /// Fits whose residual is above the stopping rule's bound, in rms or maximum.
    pub unmet: usize,
    /// Fits in which a peak more gave nothing better.
    pub failures: usize,
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
    for fit in &level.cells {
        counts.failures += fit.failures;
        if fit.termination.is_none() {
            counts.kept += 1;
            continue;
        }
        counts.fits += 1;
        counts.at_most_peaks += usize::from(fit.fitted == method.greedy.max_peaks);
        counts.unmet += usize::from(!fit.within(method.greedy.stop));
    }
    counts
}

/// Every level above the map, each from the map itself.
pub(super) fn build(
    method: &Fournier,
    map: &NormalMap,
    exponent: f64,
    progress: &dyn Progress,
) -> Result<Vec<Level>, PrefilterError> {
    let directions = Directions::new(HemisphereGrid::new(method.rings, method.azimuths));
    let sizes = level_sizes(map.width(), map.height());
    // The largest regions first: what is left for the last moment is small.
    let places: Vec<_> = sizes[1..].iter().rev().flat_map(|&size| cells_of(size)).collect();
    let (done, total) = (AtomicUsize::new(0), places.len());
    let make = |&(size, i, j): &((usize, usize), usize, usize)| {
        let normals = normals_under(map, exponent, size, i, j);
        let cell = cell(method, &normals, &directions, progress);
        progress.advance(done.fetch_add(1, Ordering::Relaxed) + 1, total);
        cell
    };
    let made: Option<Vec<Fit>> = places.par_iter().with_max_len(1).map(make).collect();
    let mut rest = made.ok_or(PrefilterError::Cancelled)?.into_iter();
    let mut levels: Vec<Level> = Vec::with_capacity(sizes.len() - 1);
    for &(width, height) in sizes[1..].iter().rev() {
        levels.push(Level { width, height, cells: rest.by_ref().take(width * height).collect() });
    }
    levels.reverse();
    Ok(levels)
}

fn cells_of(size: (usize, usize)) -> impl Iterator<Item = ((usize, usize), usize, usize)> {
    (0..size.1).flat_map(move |j| (0..size.0).map(move |i| (size, i, j)))
}

/// The texels under cell (i, j) of a level of this size, spread with the base lobe's normalisation:
/// amplitude w (s+2)/2π times the texel's share of the cell.
fn normals_under(
    map: &NormalMap,
    exponent: f64,
    size: (usize, usize),
    i: usize,
    j: usize,
) -> Vec<Peak> {
    let unit = (exponent + 2.0) / TAU;
    let mut normals = Vec::new();
    for (y, share_y) in tap_weights(map.height(), size.1, j) {
        for (x, share_x) in tap_weights(map.width(), size.0, i) {
            let [nx, ny, nz, weight] = map.texel(x, y).map(f64::from);
            let amplitude = share_x * share_y * weight * unit;
            normals.push(Peak { amplitude, direction: Vec3::new(nx, ny, nz), exponent });
        }
    }
    normals
}

/// `None` if cancelled.
fn cell(
    method: &Fournier,
    normals: &[Peak],
    directions: &Directions,
    progress: &dyn Progress,
) -> Option<Fit> {
    if progress.cancelled() {
        return None;
    }
    let mut fit = reconstruct(normals, directions, method.greedy, &|| progress.cancelled())
        .expect("a normal map holds unit normals and weights of at least 0")?;
    if method.rescaled && fit.termination.is_some() {
        rescale(&mut fit.peaks, normals);
    }
    Some(fit)
}

/// Multiplies amplitudes so that the peaks' vector moment along the normals' own is that of the
/// normals; leaves them if the peaks have none to scale.
fn rescale(peaks: &mut [Peak], normals: &[Peak]) {
    let total = |list: &[Peak]| list.iter().fold(Vec3::zeros(), |sum, p| sum + p.moment());
    let want = total(normals);
    let factor = want.norm_squared() / total(peaks).dot(&want);
    if factor.is_finite() && factor > 0.0 {
        peaks.iter_mut().for_each(|peak| peak.amplitude *= factor);
    }
}
