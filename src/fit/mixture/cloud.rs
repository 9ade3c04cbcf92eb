//! The lobes to be represented, axis by axis, and the loop over them that takes the time.

use std::f64::consts::TAU;

use super::NormalBins;
use super::fisher::{Fisher, LEAST};
use crate::geometry::elementary::exp64;
use crate::geometry::{Kernel, vectorised};

/// Lobes handled at a time.
pub(super) const LANES: usize = 8;

/// A number for each lobe, filled up to whole chunks.
pub(super) type Axis = Vec<[f64; LANES]>;

/// One lobe a bin, filled up with lobes of no strength.
pub(super) struct Cloud {
    /// The lobes.
    pub lobes: Vec<Fisher>,
    /// x, y and z of η.
    pub natural: [Axis; 3],
    pub kappa: Axis,
    /// e^λ.
    pub peak: Axis,
    /// x, y and z of the resultants.
    pub vector: [Axis; 3],
    /// Weights of the bins.
    pub weight: Axis,
}

impl Cloud {
    pub fn new(normals: &NormalBins) -> Self {
        let s = normals.exponent();
        let lobe = |bin: &super::bins::Resultant| {
            let strength = bin.vector.norm();
            Fisher::new(bin.vector / strength, bin.exponent(s), strength)
        };
        let lobes: Vec<Fisher> = normals.resultants().map(lobe).collect();
        let vector = |c: usize| chunked(normals.resultants().map(|bin| bin.vector[c]), 0.0);
        let axis = |c: usize| chunked(lobes.iter().map(|lobe| lobe.natural[c]), 0.0);
        Self {
            natural: [axis(0), axis(1), axis(2)],
            kappa: chunked(lobes.iter().map(|lobe| lobe.kappa), 2.0),
            peak: chunked(lobes.iter().map(|lobe| exp64(lobe.log_peak)), 0.0),
            vector: [vector(0), vector(1), vector(2)],
            weight: chunked(normals.resultants().map(|bin| bin.weight), 0.0),
            lobes,
        }
    }

    pub fn chunks(&self) -> usize {
        self.kappa.len()
    }

    /// Σ over the cloud's lobes of the integrals of their product with `lobe`, over 1 and over ω.
    /// Adds ∫ lobe · lobe_b / e^λ_b dω, for each lobe b of the cloud, to `seen`.
    pub fn products(&self, lobe: &Fisher, seen: &mut Axis) -> [f64; 4] {
        let mut sums = [[0.0; LANES]; 4];
        vectorised(Products { cloud: self, lobe, seen, sums: &mut sums });
        sums.map(total)
    }
}

/// Numbers in chunks, the last filled up.
pub(super) fn chunked(numbers: impl Iterator<Item = f64>, filling: f64) -> Axis {
    let numbers: Vec<f64> = numbers.collect();
    let chunk = |some: &[f64]| std::array::from_fn(|i| some.get(i).copied().unwrap_or(filling));
    numbers.chunks(LANES).map(chunk).collect()
}

/// The sum of partial sums.
pub(super) fn total(lanes: [f64; LANES]) -> f64 {
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

struct Products<'a> {
    cloud: &'a Cloud,
    lobe: &'a Fisher,
    seen: &'a mut Axis,
    sums: &'a mut [[f64; LANES]; 4],
}

impl Kernel for Products<'_> {
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "lanes run through several arrays at once")]
    fn run(self) {
        let Self { cloud, lobe, seen, sums } = self;
        let ([x, y, z], base) = ([0, 1, 2].map(|c| lobe.natural[c]), lobe.log_peak - lobe.kappa);
        let mut out = *sums;
        for (k, seen) in seen.iter_mut().enumerate().take(cloud.chunks()) {
            let [ax, ay, az] = [0, 1, 2].map(|c| &cloud.natural[c][k]);
            let (kappa, peak) = (&cloud.kappa[k], &cloud.peak[k]);
            for i in 0..LANES {
                let sum = [ax[i] + x, ay[i] + y, az[i] + z];
                let square = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
                let t = square.sqrt().max(LEAST);
                let (over, tail) = (1.0 / t, exp64(-2.0 * t));
                let scale = TAU * over * exp64(base - kappa[i] + t);
                let zeroth = scale * (1.0 - tail);
                let first = peak[i] * over * (scale * (1.0 + tail) - zeroth * over);
                seen[i] += zeroth;
                out[0][i] += peak[i] * zeroth;
                out[1][i] += first * sum[0];
                out[2][i] += first * sum[1];
                out[3][i] += first * sum[2];
            }
        }
        *sums = out;
    }
}
