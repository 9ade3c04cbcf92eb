//! The pyramid of peaks: one reconstruction a cell.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::{Fournier, Mode};
use crate::fit::{Directions, NormalBins, Peak, mixture, reconstruct};
use crate::geometry::Vec3;
use crate::lobe::PhongPeak;
use crate::method::{PrefilterError, Progress};
use crate::texture::{NormalMap, level_sizes, tap_weights};

/// The cells of a level, row by row from v = 0.
pub(super) struct Level {
    pub width: usize,
    pub height: usize,
    pub cells: Vec<Cell>,
}

/// A cell: its peaks, and how they came about.
pub(super) struct Cell {
    pub peaks: Vec<PhongPeak>,
    pub outcome: Outcome,
}

/// How a cell's peaks came about.
pub(super) struct Outcome {
    /// Peaks fitted, those left out included; 0 if the normals were kept as they are.
    pub fitted: usize,
    /// Whether the stopping rule's bound was met.
    pub met: bool,
    /// Peaks more that gave nothing better.
    pub failures: usize,
}

/// Where a cell is: the size of its level, its column and row.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub size: (usize, usize),
    pub column: usize,
    pub row: usize,
}

impl Place {
    /// The cells of a level.
    fn all(size: (usize, usize)) -> impl Iterator<Item = Self> {
        let row = move |row| (0..size.0).map(move |column| Self { size, column, row });
        (0..size.1).flat_map(row)
    }

    /// The texels under it, row by row: unit normal, and weight times the texel's share of the cell.
    pub fn texels(self, map: &NormalMap) -> impl Iterator<Item = (Vec3, f64)> {
        let rows = tap_weights(map.height(), self.size.1, self.row);
        rows.flat_map(move |(y, share_y)| {
            let columns = tap_weights(map.width(), self.size.0, self.column);
            columns.map(move |(x, share_x)| {
                let [nx, ny, nz, weight] = map.texel(x, y).map(f64::from);
                (Vec3::new(nx, ny, nz), share_x * share_y * weight)
            })
        })
    }
}

/// Every level above the map, each from the map itself.
pub(super) fn build(
    method: &Fournier,
    map: &NormalMap,
    exponent: f64,
    progress: &dyn Progress,
) -> Result<Vec<Level>, PrefilterError> {
    let directions = Directions::new(method.grid());
    let cancelled = &|| progress.cancelled();
    let maker = Maker { method, exponent, directions: &directions, cancelled };
    let sizes = level_sizes(map.width(), map.height());
    // The largest regions first: what is left for the last moment is small.
    let places: Vec<Place> = sizes[1..].iter().rev().flat_map(|&size| Place::all(size)).collect();
    let (done, total) = (AtomicUsize::new(0), places.len());
    let make = |&place: &Place| {
        let cell = maker.cell(place.texels(map));
        progress.advance(done.fetch_add(1, Ordering::Relaxed) + 1, total);
        cell
    };
    let made: Option<Vec<Cell>> = places.par_iter().with_max_len(1).map(make).collect();
    let mut rest = made.ok_or(PrefilterError::Cancelled)?.into_iter();
    let mut levels: Vec<Level> = Vec::with_capacity(sizes.len() - 1);
    for &(width, height) in sizes[1..].iter().rev() {
        levels.push(Level { width, height, cells: rest.by_ref().take(width * height).collect() });
    }
    levels.reverse();
    Ok(levels)
}

/// Makes peaks of normals.
pub(super) struct Maker<'a> {
    pub method: &'a Fournier,
    pub exponent: f64,
    pub directions: &'a Directions,
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
}

/// Texels taken between two looks at whether to stop.
const TEXELS_AT_A_TIME: usize = 4096;

impl Maker<'_> {
    /// The cell of these unit normals and weights; `None` if cancelled.
    pub(super) fn cell(&self, normals: impl Iterator<Item = (Vec3, f64)>) -> Option<Cell> {
        if (self.cancelled)() {
            return None;
        }
        let (peaks, outcome) = match self.method.mode {
            Mode::Paper => self.fitted(normals)?,
            Mode::Fast => self.mixed(normals)?,
        };
        Some(Cell { peaks: peaks.iter().map(phong).collect(), outcome })
    }

    /// The paper's way: a fit to the sampled distribution.
    fn fitted(&self, normals: impl Iterator<Item = (Vec3, f64)>) -> Option<(Vec<Peak>, Outcome)> {
        let (unit, exponent) = ((self.exponent + 2.0) / TAU, self.exponent);
        let normals: Vec<Peak> = normals
            .map(|(direction, weight)| Peak { amplitude: weight * unit, direction, exponent })
            .collect();
        let greedy = self.method.greedy;
        let fit = reconstruct(&normals, self.directions, greedy, self.cancelled)
            .expect("a normal map holds unit normals and weights of at least 0")?;
        let mut peaks = fit.peaks;
        if self.method.rescaled && fit.fitted > 0 {
            rescale(&mut peaks, &normals);
        }
        let met = fit.rms < greedy.stop && fit.maximum < greedy.stop;
        // A first fit that fails is a fit all the same.
        let fitted = if fit.termination.is_some() { fit.fitted.max(1) } else { 0 };
        Some((peaks, Outcome { fitted, met, failures: fit.failures }))
    }

    /// The fast way: a mixture in closed form.
    fn mixed(&self, normals: impl Iterator<Item = (Vec3, f64)>) -> Option<(Vec<Peak>, Outcome)> {
        let greedy = self.method.greedy;
        let mut bins = NormalBins::new(self.exponent, greedy.max_peaks);
        for (k, (normal, weight)) in normals.enumerate() {
            if k % TEXELS_AT_A_TIME == 0 && (self.cancelled)() {
                return None;
            }
            bins.add(normal, weight);
        }
        let found = mixture(&bins, greedy, self.cancelled)?;
        let met = found.error < greedy.stop && found.largest < greedy.stop;
        Some((found.peaks, Outcome { fitted: found.fitted, met, failures: found.failures }))
    }
}

fn phong(peak: &Peak) -> PhongPeak {
    PhongPeak {
        amplitude: peak.amplitude as f32,
        direction: [peak.direction.x, peak.direction.y, peak.direction.z].map(|c| c as f32),
        exponent: peak.exponent as f32,
    }
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
