//! Normals gathered by direction.

use std::collections::BTreeMap;

use crate::fit::Peak;
use crate::geometry::Vec3;

/// The most bins: beyond, they grow.
const MOST_BINS: usize = 1024;
/// The finest grid has 2^this cells a side.
const FINEST: u32 = 16;

/// The exponent of the widest peak: 0.1, or that of a base lobe that is wider.
pub(super) fn least_exponent(s: f64) -> f64 {
    s.min(0.1)
}

/// Normals of one direction, nearly: their resultant Σ wᵢ nᵢ and their weight Σ wᵢ.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Resultant {
    pub vector: Vec3,
    pub weight: f64,
}

impl Resultant {
    fn add(&mut self, other: Resultant) {
        self.vector += other.vector;
        self.weight += other.weight;
    }

    /// The exponent n of the Phong peak that has the vector and total moments of these normals, each spread
    /// to a lobe of exponent s. A lobe's mean resultant length is (s+1)/(s+2); the normals' own, ρ,
    /// multiplies it: n + 2 = (s+2) / (1 + (s+1)(1−ρ)). For a single normal ρ = 1 and n = s. Normals all
    /// around (ρ < ½) get the widest peak there is.
    pub fn exponent(&self, s: f64) -> f64 {
        let short = (1.0 - self.vector.norm() / self.weight).max(0.0);
        ((s + 2.0) / (1.0 + (s + 1.0) * short) - 2.0).max(least_exponent(s))
    }
}

/// Weighted normals of a region, gathered in cells of an octahedral grid over the sphere (Meyer et al.
/// 2010, *On Floating-Point Normal Vectors*) that keep the vector and total moments of what falls into
/// them.
///
/// A cell is about half as wide as a lobe of the base exponent s, 0.5/√s; the spread within widens its lobe
/// by 2 % in variance, which is kept. Where that makes more than 1024 bins they become twice as
/// wide. A region of any size so costs a bounded amount to fit.
#[derive(Clone, Debug)]
pub struct NormalBins {
    exponent: f64,
    /// The grid has 2^bits cells a side.
    bits: u32,
    bins: BTreeMap<[u32; 2], Resultant>,
    /// Distinct normals with their weights, in order of appearance, while there are at most `keep`.
    few: Option<Vec<(Vec3, f64)>>,
    keep: usize,
}

impl NormalBins {
    /// No normals yet. Each will be spread to a lobe of `exponent` s > 0; up to `keep` distinct ones are
    /// remembered as they are.
    pub fn new(exponent: f64, keep: usize) -> Self {
        // The sphere's 4π in cells of (0.5/√s)².
        let side = (16.0 * std::f64::consts::PI * exponent).sqrt();
        let bits = (1..FINEST).find(|&bits| f64::from(1u32 << bits) >= side).unwrap_or(FINEST);
        Self { exponent, bits, bins: BTreeMap::new(), few: Some(Vec::new()), keep }
    }

    /// Adds a normal of any length above 0 with a weight ≥ 0.
    pub fn add(&mut self, normal: Vec3, weight: f64) {
        let length = normal.norm();
        if !(weight > 0.0 && length > 0.0 && length.is_finite() && weight.is_finite()) {
            return;
        }
        let normal = normal / length;
        self.remember(normal, weight);
        let one = Resultant { vector: normal * weight, weight };
        self.bins.entry(self.cell(normal)).or_default().add(one);
        if self.bins.len() > MOST_BINS {
            self.widen();
        }
    }

    fn remember(&mut self, normal: Vec3, weight: f64) {
        let Some(few) = &mut self.few else { return };
        if let Some((_, known)) = few.iter_mut().find(|(known, _)| *known == normal) {
            *known += weight;
        } else if few.len() < self.keep {
            few.push((normal, weight));
        } else {
            self.few = None;
        }
    }

    /// The cell of a unit normal.
    fn cell(&self, normal: Vec3) -> [u32; 2] {
        let scale = 1.0 / (normal.x.abs() + normal.y.abs() + normal.z.abs());
        let (x, y) = (normal.x * scale, normal.y * scale);
        let folded = if normal.z < 0.0 {
            [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)]
        } else {
            [x, y]
        };
        let side = 1u32 << self.bits;
        folded.map(|c| (((0.5 + 0.5 * c) * f64::from(side)) as u32).min(side - 1))
    }

    /// Makes the cells twice as wide.
    fn widen(&mut self) {
        self.bits -= 1;
        let mut wide: BTreeMap<[u32; 2], Resultant> = BTreeMap::new();
        for (cell, resultant) in &self.bins {
            wide.entry(cell.map(|c| c / 2)).or_default().add(*resultant);
        }
        self.bins = wide;
    }

    /// The base exponent.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// Σ wᵢ nᵢ: the vector moment.
    pub fn total(&self) -> Vec3 {
        self.bins.values().fold(Vec3::zeros(), |sum, bin| sum + bin.vector)
    }

    /// What is in the bins, in their order; bins whose normals cancel to nothing are left out.
    pub(super) fn resultants(&self) -> impl Iterator<Item = &Resultant> {
        self.bins.values().filter(|bin| bin.vector.norm_squared() > 0.0)
    }

    /// The normals as they are, each a base lobe, if at most `most` are distinct.
    pub(super) fn few(&self, most: usize) -> Option<Vec<Peak>> {
        let few = self.few.as_ref().filter(|few| few.len() <= most)?;
        let unit = (self.exponent + 2.0) / std::f64::consts::TAU;
        let peak = |&(direction, weight): &(Vec3, f64)| Peak {
            amplitude: weight * unit,
            direction,
            exponent: self.exponent,
        };
        Some(few.iter().map(peak).collect())
    }
}
