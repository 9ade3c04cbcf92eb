//! Height fields made of waves that fit the tile.

use std::f64::consts::TAU;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::Bumps;
use crate::geometry::fourier::{Complex, product, synthesise, turn};
use crate::texture::{HeightMap, NormalMap, Wrap};

/// A cosine wave that repeats with the tile: `amplitude` · cos(2π(m u + n v) + phase).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wave {
    /// Periods along u.
    pub m: i32,
    /// Periods along v.
    pub n: i32,
    /// Height of a crest, texels.
    pub amplitude: f64,
    /// Phase at (0, 0), radians.
    pub phase: f64,
}

impl Wave {
    /// Where the wave stands in the transform of a map of `size`, and its complex amplitude at the first
    /// texel's centre, times `times([kx, ky])`; k in radians a texel.
    fn term(&self, size: [usize; 2], times: fn([f64; 2]) -> Complex) -> ([usize; 2], Complex) {
        let periods = [self.m, self.n];
        let k = [0, 1].map(|axis| TAU * f64::from(periods[axis]) / size[axis] as f64);
        let [re, im] = product(times(k), turn(self.phase + 0.5 * (k[0] + k[1])));
        let index = |axis: usize| i64::from(periods[axis]).rem_euclid(size[axis] as i64) as usize;
        ([index(0), index(1)], [self.amplitude * re, self.amplitude * im])
    }
}

/// The most periods that `size` texels hold apart from every other number of periods.
pub(super) fn most_periods(size: usize) -> i32 {
    ((size - 1) / 2) as i32
}

/// Random numbers, the same for a seed everywhere, uniform in [0, 1).
pub(super) fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    move || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// A field [F, ∂F/∂x, ∂F/∂y] at texel centres, row by row from v = 0; x and y and F in texels. The
/// slopes are the waves' own derivatives, not differences.
pub(super) struct Field {
    width: usize,
    height: usize,
    points: Vec<[f64; 3]>,
}

impl Field {
    /// The sum of these waves.
    pub fn new(width: usize, height: usize, waves: &[Wave]) -> Self {
        // What F, ∂F/∂x and ∂F/∂y make of a wave's complex amplitude: times 1, i kx and i ky.
        let sum = |times: fn([f64; 2]) -> Complex| {
            let terms = waves.iter().map(|w| w.term([width, height], times));
            synthesise(width, height, terms)
        };
        let fields = [sum(|_| [1.0, 0.0]), sum(|k| [0.0, k[0]]), sum(|k| [0.0, k[1]])];
        let point = |at: usize| [fields[0][at], fields[1][at], fields[2][at]];
        Self { width, height, points: (0..width * height).map(point).collect() }
    }

    /// A field of these points, in lines of `width`.
    pub fn from_points(width: usize, points: Vec<[f64; 3]>) -> Self {
        Self { width, height: points.len() / width, points }
    }

    /// Mean over the texels of the squared slope along x and along y.
    pub fn mean_square_slopes(&self) -> [f64; 2] {
        let count = self.points.len() as f64;
        let mean = |axis: usize| self.points.iter().map(|p| p[axis] * p[axis]).sum::<f64>() / count;
        [mean(1), mean(2)]
    }

    /// The bumps of the field with all heights times `scale`.
    pub fn bumps(&self, scale: f64, notes: Vec<String>) -> Bumps {
        let slope = |d: f64| (-d * scale) as f32;
        let texels = self.points.iter().map(|p| [slope(p[1]), slope(p[2]), 1.0, 1.0]).collect();
        let heights = self.points.iter().map(|p| p[0] * scale).collect();
        Bumps {
            normals: NormalMap::new(self.width, self.height, Wrap::Repeat, texels),
            heights: Some(HeightMap::new(self.width, self.height, Wrap::Repeat, heights)),
            notes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_is_its_waves_summed_directly() {
        let wave = |m, n, amplitude, phase| Wave { m, n, amplitude, phase };
        let waves = [wave(1, -2, 1.5, 0.3), wave(1, 1, 0.5, 4.0), wave(-3, 0, 2.0, 1.0)];
        let (width, height) = (9, 6);
        let field = Field::new(width, height, &waves);
        for (at, point) in field.points.iter().enumerate() {
            let (x, y) = ((at % width) as f64 + 0.5, (at / width) as f64 + 0.5);
            let mut want = [0.0; 3];
            for w in waves {
                let k = [TAU * f64::from(w.m) / 9.0, TAU * f64::from(w.n) / 6.0];
                let angle = k[0] * x + k[1] * y + w.phase;
                want[0] += w.amplitude * angle.cos();
                want[1] -= w.amplitude * k[0] * angle.sin();
                want[2] -= w.amplitude * k[1] * angle.sin();
            }
            for c in 0..3 {
                assert!((point[c] - want[c]).abs() < 1e-12, "{point:?} {want:?}");
            }
        }
    }
}
