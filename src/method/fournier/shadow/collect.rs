//! What each peak collects of the horizons under it.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::fit::{Directions, Peak, spread_channels};
use crate::geometry::{HemisphereGrid, Vec3};
use crate::lobe::{Horizon, PhongPeak};
use crate::method::fournier::lookup::StoredLevel;
use crate::texture::{HorizonMap, NormalMap, SIDES, tap_weights};

/// What a normal carries: 1, the slopes of its horizon, their squares.
const CHANNELS: usize = 1 + 2 * SIDES;
type Carried = [f64; CHANNELS];

/// What horizons are collected from.
pub struct Collector<'a> {
    /// The map.
    pub map: &'a NormalMap,
    /// Its horizons.
    pub texels: HorizonMap,
    /// The base lobe's exponent, which normals are spread with.
    pub exponent: f64,
    /// Where N is sampled.
    pub grid: HemisphereGrid,
    /// The grid's directions.
    pub directions: Directions,
    /// The most distinct normals that a cell keeps as they are.
    pub max_peaks: usize,
    /// Whether to stop.
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
}

/// The horizons of a level's peaks, in the order of its list; `None` if cancelled.
///
/// Where a cell keeps its normals, a peak has the mean and the deviation over the texels of its normal,
/// each with its weight. Where peaks are fitted, peak j collects from every sample direction ω of N
/// "weighted by a cosⁿ(α) term" (Fournier 1992 §5), which is read as an integral: with wᵢ(ω) what normal i
/// adds to N(ω), and sᵢ its slope,
///
/// mean = ∫ cosⁿα Σᵢ wᵢ(ω) sᵢ dω / ∫ cosⁿα Σᵢ wᵢ(ω) dω,
///
/// and the same of sᵢ², less the mean's square, is the variance: that within a sample direction and that
/// between them together (the law of total variance). The samples' solid angles stand for dω; in a plain
/// sum over the paper's grid, the pole would count most.
pub fn collect(from: &Collector<'_>, level: &StoredLevel) -> Option<Vec<Horizon>> {
    let cells: Vec<(usize, usize)> =
        (0..level.height()).flat_map(|j| (0..level.width()).map(move |i| (i, j))).collect();
    let made: Option<Vec<Vec<Horizon>>> = cells
        .par_iter()
        .with_max_len(1)
        .map(|&(i, j)| from.cell([level.width(), level.height()], [i, j], level.cell(i, j)))
        .collect();
    Some(made?.into_iter().flatten().collect())
}

impl Collector<'_> {
    /// The horizons of the peaks of cell (i, j) of a level of this size.
    fn cell(&self, size: [usize; 2], at: [usize; 2], peaks: &[PhongPeak]) -> Option<Vec<Horizon>> {
        if (self.cancelled)() {
            return None;
        }
        let normals = self.distinct(size, at);
        let mut sums = vec![[0.0; CHANNELS]; peaks.len()];
        if normals.len() <= self.max_peaks {
            for (normal, carried) in &normals {
                let near = nearest(peaks.iter().map(direction), normal.direction);
                near.into_iter().for_each(|k| add(&mut sums[k], carried, normal.amplitude));
            }
        } else {
            let spread = spread_channels(&normals, &self.directions, self.cancelled)?;
            for (peak, sum) in peaks.iter().zip(&mut sums) {
                let (exponent, direction) = (f64::from(peak.exponent), direction(peak));
                let shape = Peak { amplitude: 1.0, direction, exponent };
                for (sample, carried) in self.grid.samples().iter().zip(&spread) {
                    add(sum, carried, sample.solid_angle * shape.value(sample.direction));
                }
            }
        }
        let horizon = |(peak, sum): (&PhongPeak, Carried)| {
            // A peak so narrow that no sample is under it takes what its nearest normal has.
            let near = || nearest(normals.iter().map(|(n, _)| n.direction), direction(peak));
            let lone = || near().map_or(Horizon::default(), |k| horizon(&normals[k].1));
            if sum[0] > 0.0 { horizon(&sum) } else { lone() }
        };
        Some(peaks.iter().zip(sums).map(horizon).collect())
    }

    /// The distinct normals under a cell, each with what its texels carry on average, by direction.
    fn distinct(&self, size: [usize; 2], at: [usize; 2]) -> Vec<(Peak, Carried)> {
        let mut sums: BTreeMap<[u32; 3], (Vec3, Carried)> = BTreeMap::new();
        for (y, share_y) in tap_weights(self.map.height(), size[1], at[1]) {
            for (x, share_x) in tap_weights(self.map.width(), size[0], at[0]) {
                let [nx, ny, nz, weight] = self.map.texel(x, y);
                let weight = share_x * share_y * f64::from(weight);
                if weight > 0.0 {
                    // Adding 0 turns −0 into 0: equal numbers have equal bits.
                    let key = [nx, ny, nz].map(|c| (c + 0.0).to_bits());
                    let direction = Vec3::from([nx, ny, nz].map(f64::from));
                    let entry = sums.entry(key).or_insert((direction, [0.0; CHANNELS]));
                    let slopes = self.texels.slopes()[y * self.map.width() + x].map(f64::from);
                    add(&mut entry.1, &carried(slopes), weight);
                }
            }
        }
        let normal = |(direction, sum): (Vec3, Carried)| {
            let normal = Peak { amplitude: sum[0], direction, exponent: self.exponent };
            (normal, sum.map(|c| c / sum[0]))
        };
        sums.into_values().map(normal).collect()
    }
}

fn carried(slopes: [f64; SIDES]) -> Carried {
    let mut all = [1.0; CHANNELS];
    for (k, slope) in slopes.into_iter().enumerate() {
        all[1 + k] = slope;
        all[1 + SIDES + k] = slope * slope;
    }
    all
}

fn add(sum: &mut Carried, carried: &Carried, weight: f64) {
    sum.iter_mut().zip(carried).for_each(|(sum, c)| *sum += weight * c);
}

/// Mean and standard deviation of what was summed.
fn horizon(sum: &Carried) -> Horizon {
    let mean: [f64; SIDES] = std::array::from_fn(|k| sum[1 + k] / sum[0]);
    let deviation = std::array::from_fn(|k| {
        let variance = sum[1 + SIDES + k] / sum[0] - mean[k] * mean[k];
        // What rounding leaves of slopes that are all alike is no deviation.
        let some = variance > 1e-12 * mean[k] * mean[k];
        if some { variance.sqrt() as f32 } else { 0.0 }
    });
    Horizon { mean: mean.map(|slope| slope as f32), deviation }
}

fn direction(peak: &PhongPeak) -> Vec3 {
    Vec3::from(peak.direction.map(f64::from))
}

/// Which of these directions comes nearest; the first of equals.
fn nearest(directions: impl Iterator<Item = Vec3>, to: Vec3) -> Option<usize> {
    let best = |best: (usize, f64), next: (usize, f64)| if next.1 > best.1 { next } else { best };
    directions.map(|d| d.dot(&to)).enumerate().reduce(best).map(|(k, _)| k)
}
