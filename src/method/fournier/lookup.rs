//! Looking up and shading a pyramid of peaks.

use std::ops::Range;
use std::sync::Arc;

use super::pyramid::Level;
use super::{MOST_PEAKS, stored};
use crate::lobe::BaseLobe;
use crate::lobe::vector::V3;
use crate::lobe::{MultipleSurface, PhongPeak, Shading, Spread};
use crate::method::one_lobe::{filtered_share, unfiltered_lobe};
use crate::method::{Batch, Lane, Prefiltered};
use crate::texture::{Footprint, NormalMap, Taps};

/// A level as it is looked up: the peaks of all cells in one list.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StoredLevel {
    pub width: usize,
    pub height: usize,
    /// Where each cell's peaks begin, and the end.
    pub starts: Vec<u32>,
    pub peaks: Vec<PhongPeak>,
}

impl StoredLevel {
    pub(super) fn new(level: &Level) -> Self {
        let mut starts = vec![0];
        let mut peaks = Vec::new();
        for cell in &level.cells {
            peaks.extend(&cell.peaks);
            starts.push(peaks.len() as u32);
        }
        peaks.shrink_to_fit();
        Self { width: level.width, height: level.height, starts, peaks }
    }

    /// Cells along u.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Cells along v.
    pub(super) fn height(&self) -> usize {
        self.height
    }

    /// The peaks of a cell.
    #[inline(always)]
    pub(super) fn cell(&self, i: usize, j: usize) -> &[PhongPeak] {
        &self.peaks[self.places(i, j)]
    }

    /// Where the peaks of a cell stand in the list.
    #[inline(always)]
    fn places(&self, i: usize, j: usize) -> Range<usize> {
        let k = j * self.width + i;
        self.starts[k] as usize..self.starts[k + 1] as usize
    }

    fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.peaks.as_slice())
    }
}

/// A normal map with a pyramid of peaks above it. Level 0 is the map: each texel is one peak.
pub(super) struct PeakMap {
    pub map: Arc<NormalMap>,
    exponent: f32,
    /// Amplitude of the base lobe: (s+2)/2π.
    unit: f32,
    pub base: BaseLobe,
    /// Levels 1 and up.
    pub levels: Vec<StoredLevel>,
}

/// Which peak: its level, and its place in the level's list; at level 0, the texel's in the map's.
#[derive(Clone, Copy)]
pub(super) struct PeakAt {
    pub level: usize,
    pub index: usize,
}

impl PeakMap {
    pub(super) fn new(map: Arc<NormalMap>, exponent: f64, levels: Vec<StoredLevel>) -> Self {
        let unit = ((exponent + 2.0) / std::f64::consts::TAU) as f32;
        let base = BaseLobe::BlinnPhong { exponent };
        Self { map, exponent: exponent as f32, unit, base, levels }
    }

    /// Calls `take` with every peak at (u, v), its interpolation weight and which it is: bilinear within the two
    /// levels around `level`, linear between them. Peaks are never averaged (§2.4).
    #[inline(always)]
    pub(super) fn each_peak(
        &self,
        at: &Footprint,
        level: f32,
        share: f32,
        mut take: impl FnMut(PhongPeak, f32, PeakAt),
    ) {
        let held = level.clamp(0.0, self.levels.len() as f32);
        let below = held as usize;
        let blend = held - below as f32;
        self.each_of_level(at, below, share * (1.0 - blend), &mut take);
        if blend > 0.0 {
            self.each_of_level(at, below + 1, share * blend, &mut take);
        }
    }

    #[inline(always)]
    fn each_of_level(
        &self,
        at: &Footprint,
        level: usize,
        share: f32,
        take: &mut impl FnMut(PhongPeak, f32, PeakAt),
    ) {
        let stored = level.checked_sub(1).map(|above| &self.levels[above]);
        let (width, height) =
            stored.map_or((self.map.width(), self.map.height()), |l| (l.width, l.height));
        let wrap = self.map.wrap();
        for (j, weight_v) in ends(wrap.taps(at.v, height)) {
            for (i, weight_u) in ends(wrap.taps(at.u, width)) {
                let weight = share * weight_u * weight_v;
                let mut taken = |peak, index| take(peak, weight, PeakAt { level, index });
                match stored {
                    Some(stored) => stored.places(i, j).for_each(|k| taken(stored.peaks[k], k)),
                    None => taken(self.texel(i, j), j * width + i),
                }
            }
        }
    }

    /// A texel of the map as a peak.
    #[inline(always)]
    fn texel(&self, i: usize, j: usize) -> PhongPeak {
        let [x, y, z, weight] = self.map.texel(i, j);
        PhongPeak { amplitude: weight * self.unit, direction: [x, y, z], exponent: self.exponent }
    }
}

/// The two cells of a lookup along an axis with their weights; one with all of it where they are the
/// same.
#[inline(always)]
fn ends(taps: Taps) -> [(usize, f32); 2] {
    let both = if taps.first == taps.second { 0.0 } else { taps.blend };
    [(taps.first, 1.0 - both), (taps.second, both)]
}

impl Prefiltered for PeakMap {
    fn bytes(&self) -> usize {
        self.levels.iter().map(StoredLevel::bytes).sum()
    }

    fn store(&self) -> Option<Vec<u8>> {
        Some(stored::to_bytes(&self.levels, &[]))
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let level = at.level(self.map.width(), self.map.height());
        let share = filtered_share(level);
        let mut surface = MultipleSurface::new();
        self.each_peak(at, level, share, |peak, weight, _| surface.add(peak, weight));
        surface.add(unfiltered_lobe(&self.map, &self.base, at.u, at.v), 1.0 - share);
        surface
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        let mut slots = Slots::default();
        for (lane, out) in radiance.iter_mut().enumerate().take(batch.len) {
            *out = 0.0;
            if batch.irradiance[lane] <= 0.0 {
                continue;
            }
            let (half, light, view) = (batch.half(lane), batch.light(lane), batch.view(lane));
            let at = batch.footprint(lane);
            let level = at.level(self.map.width(), self.map.height());
            let share = filtered_share(level);
            slots.clear();
            self.each_peak(&at, level, share, |peak, weight, _| slots.push(peak, weight));
            let mut sum = slots.radiance(shading, half, light, view);
            if share < 1.0 {
                let lobe = unfiltered_lobe(&self.map, &self.base, at.u, at.v).faded(1.0 - share);
                sum += lobe.radiance(shading, half, light, view);
            }
            *out = batch.irradiance[lane] * sum;
        }
    }
}

/// Peaks of four cells of two levels.
const SLOTS: usize = MOST_PEAKS * 4 * 2;
/// Slots are worked through in groups of this many, the last filled up with what is there.
const GROUP: usize = 8;

/// The peaks at a shading point, axis by axis.
pub(super) struct Slots {
    count: usize,
    direction: [[f32; SLOTS]; 3],
    amplitude: [f32; SLOTS],
    exponent: [f32; SLOTS],
}

impl Default for Slots {
    fn default() -> Self {
        let (zero, one) = ([0.0; SLOTS], [1.0; SLOTS]);
        Self { count: 0, direction: [zero, zero, one], amplitude: zero, exponent: one }
    }
}

impl Slots {
    /// Empties them.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Radiance for unit irradiance, summed over the peaks. Each arm is a loop of its own, without
    /// branches inside.
    #[inline(always)]
    pub(super) fn radiance(&self, shading: Shading, half: V3, light: V3, view: V3) -> f32 {
        match shading {
            Shading::Ndf => self.sum(|peak| peak.density(half)),
            Shading::Microfacet => self.sum(|peak| peak.radiance(shading, half, light, view)),
        }
    }

    /// Adds a peak, its amplitude multiplied by `weight`; 0 adds nothing.
    #[inline(always)]
    pub(super) fn push(&mut self, peak: PhongPeak, weight: f32) {
        if weight > 0.0 && self.count < SLOTS {
            for (axis, value) in self.direction.iter_mut().zip(peak.direction) {
                axis[self.count] = value;
            }
            self.amplitude[self.count] = peak.amplitude * weight;
            self.exponent[self.count] = peak.exponent;
            self.count += 1;
        }
    }

    /// Σ f(peak), in the order they came.
    #[inline(always)]
    fn sum(&self, f: impl Fn(PhongPeak) -> f32) -> f32 {
        let mut values = [0.0; SLOTS];
        for start in (0..self.count).step_by(GROUP) {
            for (value, k) in values[start..start + GROUP].iter_mut().zip(start..) {
                let direction = [self.direction[0][k], self.direction[1][k], self.direction[2][k]];
                let (amplitude, exponent) = (self.amplitude[k], self.exponent[k]);
                *value = f(PhongPeak { amplitude, direction, exponent });
            }
        }
        values[..self.count].iter().sum()
    }
}
