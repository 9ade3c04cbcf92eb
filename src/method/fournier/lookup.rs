//! Looking up and shading a pyramid of peaks.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use super::pyramid::{Level, Maker};
use super::{Fournier, stored};
use crate::fit::Directions;
use crate::geometry::Vec3;
use crate::lobe::BaseLobe;
use crate::lobe::vector::V3;
use crate::lobe::{MultipleSurface, PhongPeak, Shading, Spread};
use crate::method::one_lobe::{filtered_share, unfiltered_lobe};
use crate::method::{Batch, Lane, Prefiltered};
use crate::texture::{Cell, Footprint, Levels, Lookup, NormalMap};

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
    method: Fournier,
    /// The directions of the method's grid, once an exact lookup asks.
    directions: OnceLock<Directions>,
    exponent: f32,
    /// Amplitude of the base lobe: (s+2)/2π.
    unit: f32,
    pub base: BaseLobe,
    /// Levels 1 and up.
    pub levels: Vec<StoredLevel>,
}

/// The most points of an exact lookup: a fit's time grows with them.
const MOST_POINTS: usize = 256;

/// Which peak: its level, and its place in the level's list; at level 0, the texel's in the map's.
#[derive(Clone, Copy)]
pub(super) struct PeakAt {
    pub level: usize,
    pub index: usize,
}

impl PeakMap {
    pub(super) fn new(
        map: Arc<NormalMap>,
        method: Fournier,
        exponent: f64,
        levels: Vec<StoredLevel>,
    ) -> Self {
        let unit = ((exponent + 2.0) / std::f64::consts::TAU) as f32;
        let base = BaseLobe::BlinnPhong { exponent };
        let directions = OnceLock::new();
        Self { map, method, directions, exponent: exponent as f32, unit, base, levels }
    }

    /// The form of its pyramid.
    fn form(&self) -> Levels {
        let (width, height, wrap) = (self.map.width(), self.map.height(), self.map.wrap());
        Levels { width, height, wrap, top: self.levels.len() }
    }

    /// The peaks of the normals at points spread over a footprint, as the method makes them for a cell.
    #[inline(never)]
    fn exact(&self, at: &Footprint) -> Vec<PhongPeak> {
        let mut normals = Vec::with_capacity(MOST_POINTS);
        at.each_point(&self.form(), MOST_POINTS, |u, v, count| {
            let [x, y, z, weight] = self.map.normal_at(u, v).map(f64::from);
            // Between opposite normals there is none.
            let normal = Vec3::new(x, y, z).try_normalize(1e-6).unwrap_or(Vec3::z());
            normals.push((normal, weight / count as f64));
        });
        let BaseLobe::BlinnPhong { exponent } = self.base else { return Vec::new() };
        let directions = self.directions.get_or_init(|| Directions::new(self.method.grid()));
        let maker = Maker { method: &self.method, exponent, directions, cancelled: &|| false };
        maker.cell(normals.into_iter()).map_or_else(Vec::new, |cell| cell.peaks)
    }

    /// Calls `take` with the peaks under a footprint and their weights, by its lookup.
    #[inline(always)]
    fn each_weighted(&self, at: &Footprint, share: f32, mut take: impl FnMut(PhongPeak, f32)) {
        if at.lookup == Lookup::Exact {
            self.exact(at).into_iter().for_each(|peak| take(peak, share));
        } else {
            self.each_peak(at, share, |peak, weight, _| take(peak, weight));
        }
    }

    /// Calls `take` with every peak under a footprint, by its lookup: each peak, its weight and which it is. The
    /// cells' weights are their peaks'; peaks are never averaged (§2.4).
    #[inline(always)]
    pub(super) fn each_peak(
        &self,
        at: &Footprint,
        share: f32,
        mut take: impl FnMut(PhongPeak, f32, PeakAt),
    ) {
        at.each_cell(&self.form(), |cell| {
            let Cell { level, i, j, weight } = cell;
            let mut taken = |peak, index| take(peak, share * weight, PeakAt { level, index });
            match level.checked_sub(1) {
                Some(above) => {
                    let stored = &self.levels[above];
                    stored.places(i, j).for_each(|k| taken(stored.peaks[k], k));
                }
                None => taken(self.texel(i, j), j * self.map.width() + i),
            }
        });
    }

    /// A texel of the map as a peak.
    #[inline(always)]
    fn texel(&self, i: usize, j: usize) -> PhongPeak {
        let [x, y, z, weight] = self.map.texel(i, j);
        PhongPeak { amplitude: weight * self.unit, direction: [x, y, z], exponent: self.exponent }
    }
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
        let share = filtered_share(level, at.lookup);
        let mut surface = MultipleSurface::new();
        self.each_weighted(at, share, |peak, weight| surface.add(peak, weight));
        surface.add(unfiltered_lobe(&self.map, &self.base, at), 1.0 - share);
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
            let share = filtered_share(level, at.lookup);
            slots.clear();
            self.each_weighted(&at, share, |peak, weight| slots.push(peak, weight));
            let mut sum = slots.radiance(shading, half, light, view);
            if share < 1.0 {
                let lobe = unfiltered_lobe(&self.map, &self.base, &at).faded(1.0 - share);
                sum += lobe.radiance(shading, half, light, view);
            }
            *out = batch.irradiance[lane] * sum;
        }
    }
}

/// Peaks are worked through in groups of this many.
const GROUP: usize = 8;

/// The peaks at a shading point, axis by axis.
#[derive(Default)]
pub(super) struct Slots {
    direction: [Vec<f32>; 3],
    amplitude: Vec<f32>,
    exponent: Vec<f32>,
}

impl Slots {
    /// Empties them.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.direction.iter_mut().for_each(Vec::clear);
        self.amplitude.clear();
        self.exponent.clear();
    }

    /// Radiance for unit irradiance, summed over the peaks. Each arm is a loop of its own, without
    /// branches inside.
    #[inline(always)]
    pub(super) fn radiance(&self, shading: Shading, half: V3, light: V3, view: V3) -> f32 {
        match shading {
            Shading::Ndf => self.sum(|peak| peak.density(half)),
            _ => self.sum(|peak| peak.radiance(shading, half, light, view)),
        }
    }

    /// Adds a peak, its amplitude multiplied by `weight`; 0 adds nothing.
    #[inline(always)]
    pub(super) fn push(&mut self, peak: PhongPeak, weight: f32) {
        if weight > 0.0 {
            for (axis, value) in self.direction.iter_mut().zip(peak.direction) {
                axis.push(value);
            }
            self.amplitude.push(peak.amplitude * weight);
            self.exponent.push(peak.exponent);
        }
    }

    /// Σ f(peak), in the order they came.
    #[inline(always)]
    fn sum(&self, f: impl Fn(PhongPeak) -> f32) -> f32 {
        let (x, x_rest) = self.direction[0].as_chunks::<GROUP>();
        let (y, y_rest) = self.direction[1].as_chunks::<GROUP>();
        let (z, z_rest) = self.direction[2].as_chunks::<GROUP>();
        let (amplitude, amplitude_rest) = self.amplitude.as_chunks::<GROUP>();
        let (exponent, exponent_rest) = self.exponent.as_chunks::<GROUP>();
        let of = |amplitude, x, y, z, exponent| {
            f(PhongPeak { amplitude, direction: [x, y, z], exponent })
        };
        let mut sum = 0.0;
        for g in 0..x.len() {
            let mut values = [0.0; GROUP];
            for k in 0..GROUP {
                values[k] = of(amplitude[g][k], x[g][k], y[g][k], z[g][k], exponent[g][k]);
            }
            sum = values.iter().fold(sum, |sum, value| sum + value);
        }
        // The rest is filled up with nothing, so that it is worked through in one go as well.
        let filled = |rest: &[f32], nothing: f32| {
            let mut full = [nothing; GROUP];
            full[..rest.len()].copy_from_slice(rest);
            full
        };
        let (x, y, z) = (filled(x_rest, 0.0), filled(y_rest, 0.0), filled(z_rest, 1.0));
        let (a, n) = (filled(amplitude_rest, 0.0), filled(exponent_rest, 1.0));
        let mut values = [0.0; GROUP];
        for k in 0..GROUP {
            values[k] = of(a[k], x[k], y[k], z[k], n[k]);
        }
        values[..x_rest.len()].iter().fold(sum, |sum, value| sum + value)
    }
}
