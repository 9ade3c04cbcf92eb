//! Normals spread by a base lobe.

use rayon::prelude::*;

use super::{NdfError, NdfImage, centre, off_disc};
use crate::lobe::BaseLobe;

impl NdfImage {
    /// Every pixel's normal spread by a base lobe about it. Where the lobe is below 10⁻⁷ of its peak it counts as 0.
    pub(super) fn spread_by(&self, base: &BaseLobe) -> Result<Self, NdfError> {
        let side = self.side;
        let normals: Vec<([f64; 3], f64)> = (0..side * side)
            .filter(|k| self.density[*k] > 0.0)
            .map(|k| {
                let [x, y] = centre(side, k);
                ([x, y, (1.0 - x * x - y * y).max(0.0).sqrt()], f64::from(self.density[k]))
            })
            .collect();
        let fall = Fall::of(base);
        let mut density = vec![0.0f32; side * side];
        density.par_chunks_mut(side).enumerate().for_each(|(row, line)| {
            for (column, value) in line.iter_mut().enumerate() {
                let [x, y] = centre(side, row * side + column);
                if off_disc([x, y]) {
                    continue;
                }
                let z = (1.0 - x * x - y * y).sqrt();
                let sum: f64 = normals
                    .iter()
                    .map(|([nx, ny, nz], weight)| weight * fall.at(nx * x + ny * y + nz * z))
                    .sum();
                *value = sum as f32;
            }
        });
        Self { side, density }.normalised()
    }
}

/// A base lobe by the cosine of the angle to its normal, from a table: linear in 1 − cos.
struct Fall {
    values: Vec<f64>,
}

impl Fall {
    const STEPS: usize = 1 << 14;

    fn of(base: &BaseLobe) -> Self {
        let peak = base.density(0.0);
        // Finer towards cos = 1: the table runs over √(1 − cos).
        let value = |k: usize| {
            let root = k as f64 / Self::STEPS as f64;
            let cosine = 1.0 - root * root;
            let square = cosine * cosine;
            let found = if cosine > 1e-6 { base.density((1.0 - square) / square) } else { 0.0 };
            if found > 1e-7 * peak { found } else { 0.0 }
        };
        Self { values: (0..=Self::STEPS + 1).map(value).collect() }
    }

    #[inline(always)]
    fn at(&self, cosine: f64) -> f64 {
        let place = (1.0 - cosine).clamp(0.0, 1.0).sqrt() * Self::STEPS as f64;
        let low = place as usize;
        let part = place - low as f64;
        self.values[low] + part * (self.values[low + 1] - self.values[low])
    }
}
