//! Height fields made of waves that fit the tile.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::Bumps;
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
    ///
    /// Waves of one `m` are summed for each row first, then the rows are run through, as a transform
    /// separates: width · height · (distinct m) + height · (waves) products, rows in parallel, each sum
    /// in a fixed order.
    pub fn new(width: usize, height: usize, waves: &[Wave]) -> Self {
        let mut columns: BTreeMap<i32, Vec<Wave>> = BTreeMap::new();
        for &wave in waves {
            columns.entry(wave.m).or_default().push(wave);
        }
        let (across, along) = (Turns::new(width), Turns::new(height));
        let point = |j: usize| {
            let row: Vec<(i32, Ripple)> =
                columns.iter().map(|(&m, waves)| (m, Ripple::of_row(waves, &along, j))).collect();
            let (across, row) = (&across, row);
            (0..width).map(move |i| {
                row.iter().fold([0.0; 3], |sum, (m, ripple)| {
                    let add = ripple.at(across.turn(*m, i), TAU * f64::from(*m) / width as f64);
                    [sum[0] + add[0], sum[1] + add[1], sum[2] + add[2]]
                })
            })
        };
        let rows: Vec<Vec<[f64; 3]>> =
            (0..height).into_par_iter().map(|j| point(j).collect()).collect();
        Self { width, height, points: rows.concat() }
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

/// The waves of one `m` along a row: Re(c · turn) and, for ∂/∂y, Re(d · turn).
struct Ripple {
    value: [f64; 2],
    rise: [f64; 2],
}

impl Ripple {
    fn of_row(waves: &[Wave], along: &Turns, j: usize) -> Self {
        let (mut value, mut rise) = ([0.0; 2], [0.0; 2]);
        for wave in waves {
            let (sin, cos) = libm::sincos(wave.phase);
            let [x, y] = product([cos, sin], along.turn(wave.n, j));
            let (re, im) = (wave.amplitude * x, wave.amplitude * y);
            let k = TAU * f64::from(wave.n) / along.size as f64;
            value = [value[0] + re, value[1] + im];
            rise = [rise[0] - k * im, rise[1] + k * re]; // times i k
        }
        Self { value, rise }
    }

    /// [F, ∂F/∂x, ∂F/∂y] where `turn` is e^(i k x).
    fn at(&self, turn: [f64; 2], k: f64) -> [f64; 3] {
        let [re, im] = product(self.value, turn);
        [re, -k * im, product(self.rise, turn)[0]]
    }
}

/// The product of two complex numbers.
fn product([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

/// e^(2πi · m · (i + ½)/size) from a table over all half texels, indexed in whole numbers.
struct Turns {
    size: usize,
    table: Vec<[f64; 2]>,
}

impl Turns {
    fn new(size: usize) -> Self {
        let turn = |k: usize| {
            let (sin, cos) = libm::sincos(TAU * k as f64 / (2 * size) as f64);
            [cos, sin]
        };
        Self { size, table: (0..2 * size).map(turn).collect() }
    }

    fn turn(&self, periods: i32, i: usize) -> [f64; 2] {
        let half_texels = i64::from(periods) * (2 * i as i64 + 1);
        self.table[half_texels.rem_euclid(2 * self.size as i64) as usize]
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
