//! Lookups: how what lies under a footprint is averaged.
//!
//! A pyramid holds averages over square cells; a footprint is a parallelogram. A lookup chooses cells and
//! weights for it. Whatever filters linearly can use any of them, and so can lists of peaks, whose
//! amplitudes take the weights (Fournier 1992 §2.4).

use serde::{Deserialize, Serialize};

use super::{Footprint, Taps, Wrap, ellipse::Ellipse};
use crate::geometry::elementary::{exp32, floor32, log2_32};

/// How what lies under a footprint is averaged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lookup {
    /// Bilinear in the two levels around the footprint's longer side, linear between them (Williams 1983).
    /// A long and narrow footprint is blurred across as much as along.
    #[default]
    Trilinear,
    /// Up to 16 trilinear probes of the footprint's width along its length (Barkans 1997; what graphics
    /// hardware does). Spread so that the variance along it is right.
    Anisotropic,
    /// The elliptical weighted average (Heckbert 1989): cells weighted by a Gaussian that has the second
    /// moments of the footprint, those of the cells themselves taken off. Cells are a half to a quarter of the
    /// footprint's width; a footprint more than 64 times as long as wide is widened.
    Ewa,
    /// No pyramid: the normals at many points spread over the footprint itself, and what the method makes of
    /// just these. Slow; what is left of a method's error is its lobe's.
    Exact,
}

impl Lookup {
    /// All of them, from the cheapest.
    pub const ALL: [Self; 4] = [Self::Trilinear, Self::Anisotropic, Self::Ewa, Self::Exact];

    /// Its name in specs and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trilinear => "trilinear",
            Self::Anisotropic => "anisotropic",
            Self::Ewa => "ewa",
            Self::Exact => "exact",
        }
    }
}

/// A cell of a pyramid and its weight in a lookup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Its level; 0 is the map.
    pub level: usize,
    /// Its column.
    pub i: usize,
    /// Its row.
    pub j: usize,
    /// Its weight; the weights of a lookup sum to 1.
    pub weight: f32,
}

/// The form of a pyramid: each level's sides are half of the one's below, rounded down, at least 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Levels {
    /// Texels of the map along u.
    pub width: usize,
    /// Texels of the map along v.
    pub height: usize,
    /// What lies beyond its edge.
    pub wrap: Wrap,
    /// The coarsest level there is.
    pub top: usize,
}

impl Levels {
    /// The sides of a level.
    #[inline(always)]
    pub fn size(&self, level: usize) -> (usize, usize) {
        let halved = |side: usize| side.checked_shr(level as u32).unwrap_or(0).max(1);
        (halved(self.width), halved(self.height))
    }
}

/// A trilinear lookup at a point: one part of a lookup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Probe {
    pub u: f32,
    pub v: f32,
    pub level: f32,
    pub weight: f32,
}

impl Probe {
    /// Its cells.
    #[inline]
    pub(crate) fn each_cell(&self, levels: &Levels, take: &mut impl FnMut(Cell)) {
        let held = self.level.clamp(0.0, levels.top as f32);
        let below = held as usize;
        let blend = held - below as f32;
        self.each_of_level(levels, below, self.weight * (1.0 - blend), take);
        if blend > 0.0 {
            self.each_of_level(levels, below + 1, self.weight * blend, take);
        }
    }

    // One copy for each kind of `take`: inlined, it would be copied to every place that asks for a level.
    #[inline(never)]
    fn each_of_level(
        &self,
        levels: &Levels,
        level: usize,
        share: f32,
        take: &mut impl FnMut(Cell),
    ) {
        let (width, height) = levels.size(level);
        for (j, weight_v) in ends(levels.wrap.taps(self.v, height)) {
            for (i, weight_u) in ends(levels.wrap.taps(self.u, width)) {
                take(Cell { level, i, j, weight: share * weight_u * weight_v });
            }
        }
    }
}

/// The two cells of a lookup along an axis with their weights; one with all of it where they are the
/// same.
#[inline(always)]
fn ends(taps: Taps) -> [(usize, f32); 2] {
    let both = if taps.first == taps.second { 0.0 } else { taps.blend };
    [(taps.first, 1.0 - both), (taps.second, both)]
}

/// The most probes of an anisotropic lookup.
pub const MOST_PROBES: usize = 16;
/// The longest ellipse of an elliptical weighted average, in its own widths.
const LONGEST: f32 = 64.0;
/// Squared distance, in standard deviations, at which the Gaussian is cut off.
const CUT: f32 = 9.0;

impl Footprint {
    /// Calls `take` with the cells of this footprint's lookup, whose weights sum to 1. An [`Lookup::Exact`]
    /// lookup has points, not cells; it gives those of [`Lookup::Ewa`].
    #[inline]
    pub fn each_cell(&self, levels: &Levels, mut take: impl FnMut(Cell)) {
        match self.lookup {
            Lookup::Trilinear | Lookup::Anisotropic => {
                self.each_probe(levels, |probe| probe.each_cell(levels, &mut take));
            }
            Lookup::Ewa | Lookup::Exact => self.each_weighted(levels, &mut take),
        }
    }

    /// The probes of a [`Lookup::Trilinear`] or [`Lookup::Anisotropic`] lookup; their weights sum to 1.
    #[inline(always)]
    pub(crate) fn each_probe(&self, levels: &Levels, mut take: impl FnMut(Probe)) {
        let (u, v) = (self.u, self.v);
        if self.lookup == Lookup::Trilinear {
            return take(Probe {
                u,
                v,
                level: self.level(levels.width, levels.height),
                weight: 1.0,
            });
        }
        let ellipse = Ellipse::of(self, levels.width, levels.height);
        let Ellipse { major, minor, along } = ellipse.at_most(MOST_PROBES as f32);
        // A hair over a whole ratio needs no further probe.
        let count = ((major / minor - 1e-3).ceil()).clamp(1.0, MOST_PROBES as f32);
        // n probes a distance d apart have variance d² (n² − 1)/12; with the probe's own, minor²/12, it is to be
        // major²/12.
        let spread = (major * major - minor * minor) / (count * count - 1.0).max(1.0);
        let apart = if count > 1.0 { spread.sqrt() } else { 0.0 };
        let level = log2_32(minor);
        let step =
            [apart * along[0] / levels.width as f32, apart * along[1] / levels.height as f32];
        for k in 0..count as usize {
            let from_middle = k as f32 - 0.5 * (count - 1.0);
            let fold = |c: f32| match levels.wrap {
                Wrap::Repeat => c - floor32(c).1,
                Wrap::Clamp => c.clamp(0.0, 1.0),
            };
            let (u, v) = (fold(u + from_middle * step[0]), fold(v + from_middle * step[1]));
            take(Probe { u, v, level, weight: 1.0 / count });
        }
    }

    /// The cells of an elliptical weighted average.
    pub(crate) fn each_weighted(&self, levels: &Levels, take: &mut impl FnMut(Cell)) {
        let ellipse = Ellipse::of(self, levels.width, levels.height).at_most(LONGEST);
        // The finest level whose cells are no more than half as wide as the ellipse: a Gaussian of its variance,
        // less a cell's own, is still sampled often enough (at a distance of two standard deviations).
        let level = (log2_32(ellipse.minor) - 1.0).max(0.0) as usize;
        if level > levels.top {
            let probe = Probe { u: self.u, v: self.v, level: levels.top as f32, weight: 1.0 };
            return probe.each_cell(levels, take);
        }
        let gaussian = Gaussian::new(&ellipse, self, levels, level);
        let mut total = 0.0;
        gaussian.each(|_, _, weight| total += weight);
        let (width, height) = levels.size(level);
        let inverse = 1.0 / total;
        gaussian.each(|i, j, weight| {
            let (i, j) = (levels.wrap.index(i, width), levels.wrap.index(j, height));
            take(Cell { level, i, j, weight: weight * inverse });
        });
    }

    /// Calls `take` with points (u, v) spread evenly over the parallelogram, folded, and how many there will be.
    /// Their number grows with the footprint's texels.
    pub fn each_point(&self, levels: &Levels, most: usize, mut take: impl FnMut(f32, f32, usize)) {
        let ellipse = Ellipse::of(self, levels.width, levels.height);
        let wanted = (2.0 * ellipse.major * ellipse.minor).max(8.0 * ellipse.major);
        let count = (wanted.min(most as f32) as usize).clamp(LEAST_POINTS.min(most), most);
        let fold = |c: f32| levels.wrap.fold(f64::from(c)) as f32;
        for k in 0..count {
            // A lattice: the golden ratio's multiples are spread evenly at every count.
            let a = (k as f32 + 0.5) / count as f32 - 0.5;
            let bits = (k as u32).wrapping_mul(2_654_435_769).wrapping_add(1 << 31);
            let b = (f64::from(bits) / 4_294_967_296.0 - 0.5) as f32;
            let [x, y] = [0, 1].map(|c| a * self.along_x[c] + b * self.along_y[c]);
            take(fold(self.u + x), fold(self.v + y), count);
        }
    }
}

/// The fewest points of an exact lookup.
const LEAST_POINTS: usize = 256;

/// A Gaussian over the cells of a level.
struct Gaussian {
    /// Its middle, in cells; cell (i, j) has its centre at (i, j).
    middle: [f32; 2],
    /// Its inverse covariance in cells, as [xx, xy, yy].
    inverse: [f32; 3],
    /// Half the height of its box, in cells.
    reach: f32,
}

impl Gaussian {
    fn new(ellipse: &Ellipse, at: &Footprint, levels: &Levels, level: usize) -> Self {
        let (width, height) = levels.size(level);
        let (sx, sy) = (width as f32 / levels.width as f32, height as f32 / levels.height as f32);
        let [xx, xy, yy] = ellipse.covariance();
        // Bilinear interpolation between texels, which the surface itself has, adds a variance of 1/6 texel²;
        // averaging over a cell has added 1/12 cell² already, but at level 0.
        let own = if level > 0 { 1.0 / 12.0 } else { 0.0 };
        let along = |variance: f32, s: f32| variance * s * s + s * s / 6.0 - own;
        let (vx, vy) = (along(xx, sx), along(yy, sy));
        // Wider than the map it is even over it: no wider is needed.
        let (fx, fy) = (held(vx, width), held(vy, height));
        let (vx, vxy, vy) = (vx * fx * fx, xy * sx * sy * fx * fy, vy * fy * fy);
        let determinant = (vx * vy - vxy * vxy).max(1e-6 * vx * vy);
        Self {
            middle: [at.u * width as f32 - 0.5, at.v * height as f32 - 0.5],
            inverse: [vy / determinant, -vxy / determinant, vx / determinant],
            reach: (CUT * vy).sqrt(),
        }
    }

    /// Calls `take` with column, row and weight of each cell within reach, row by row.
    fn each(&self, mut take: impl FnMut(isize, isize, f32)) {
        let [a, b, c] = self.inverse;
        let [x, y] = self.middle;
        for j in (y - self.reach).ceil() as isize..=(y + self.reach).floor() as isize {
            let dy = j as f32 - y;
            // a dx² + 2b dx dy + c dy² ≤ CUT
            let root = (b * b * dy * dy - a * (c * dy * dy - CUT)).max(0.0).sqrt();
            let (from, to) = ((-b * dy - root) / a, (-b * dy + root) / a);
            for i in (x + from).ceil() as isize..=(x + to).floor() as isize {
                let dx = i as f32 - x;
                let q = a * dx * dx + 2.0 * b * dx * dy + c * dy * dy;
                take(i, j, exp32(-0.5 * q));
            }
        }
    }
}

/// What a variance along an axis of `size` cells is scaled by, as a factor of the standard deviation, to be at
/// most the size.
fn held(variance: f32, size: usize) -> f32 {
    let most = size.max(1) as f32;
    (most / variance.sqrt().max(f32::MIN_POSITIVE)).min(1.0)
}

#[cfg(test)]
mod tests;
