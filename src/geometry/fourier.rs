//! The discrete Fourier transform of any size.
//!
//! Written here because libraries choose their kernels by CPU, or take their sines from the platform
//! (rustfft does both; its scalar planner still the latter), and a map must have the same bits on every
//! machine.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use rayon::prelude::*;

/// A complex number [re, im].
pub type Complex = [f64; 2];

/// The product of two complex numbers.
pub fn product([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

/// The complex conjugate.
pub fn conjugate([re, im]: Complex) -> Complex {
    [re, -im]
}

/// e^(i angle).
pub fn turn(angle: f64) -> Complex {
    let (sin, cos) = libm::sincos(angle);
    [cos, sin]
}

/// Re Σ c · e^(2πi (m i/width + n j/height)) at (i, j), row by row, over the coefficients c given by
/// (m, n) within 0..width, 0..height. Rows without coefficients cost nothing.
pub fn synthesise(
    width: usize,
    height: usize,
    coefficients: impl Iterator<Item = ([usize; 2], Complex)>,
) -> Vec<f64> {
    let mut sparse: BTreeMap<usize, Vec<Complex>> = BTreeMap::new();
    for ([m, n], c) in coefficients {
        let entry = &mut sparse.entry(n).or_insert_with(|| vec![[0.0; 2]; width])[m];
        *entry = [entry[0] + c[0], entry[1] + c[1]];
    }
    let (across, along) = (Transform::new(width), Transform::new(height));
    let sparse: Vec<(usize, Vec<Complex>)> = sparse.into_iter().collect();
    let rows: Vec<(usize, Vec<Complex>)> =
        sparse.into_par_iter().map(|(n, row)| (n, across.of(&row))).collect();
    let column = |i: usize| {
        let mut column = vec![[0.0; 2]; height];
        rows.iter().for_each(|(n, row)| column[*n] = row[i]);
        along.of(&column).into_iter().map(|c| c[0]).collect()
    };
    let columns: Vec<Vec<f64>> = (0..width).into_par_iter().map(column).collect();
    (0..height).flat_map(|j| columns.iter().map(move |column| column[j])).collect()
}

/// The transform of a table of `width` × `height` numbers, row by row: at (m, n) the sum of its entries
/// times e^(2πi (m i/width + n j/height)). Not scaled.
pub fn transform(width: usize, height: usize, table: &[Complex]) -> Vec<Complex> {
    let (across, along) = (Transform::new(width), Transform::new(height));
    let rows: Vec<Vec<Complex>> = table.par_chunks(width).map(|row| across.of(row)).collect();
    let column = |i: usize| along.of(&rows.iter().map(|row| row[i]).collect::<Vec<_>>());
    let columns: Vec<Vec<Complex>> = (0..width).into_par_iter().map(column).collect();
    (0..height).flat_map(|j| columns.iter().map(move |column| column[j])).collect()
}

/// The transform X_k = Σ x_r e^(2πi r k/size), by splitting off one prime factor of the size after the
/// other (Cooley and Tukey 1965): size · (sum of the prime factors) products. A size with a large prime
/// factor is a convolution instead (Bluestein 1970), which a power of two serves.
struct Transform {
    /// e^(2πi k/size).
    turns: Vec<Complex>,
    chirp: Option<Box<Chirp>>,
}

/// From this prime factor on, a convolution is faster.
const LARGE_PRIME: usize = 67;

impl Transform {
    fn new(size: usize) -> Self {
        let turns = (0..size).map(|k| turn(TAU * k as f64 / size as f64)).collect();
        let large = largest_factor(size) >= LARGE_PRIME;
        Self { turns, chirp: large.then(|| Box::new(Chirp::new(size))) }
    }

    fn of(&self, input: &[Complex]) -> Vec<Complex> {
        if let Some(chirp) = &self.chirp {
            return chirp.of(input);
        }
        let mut out = vec![[0.0; 2]; input.len()];
        self.split(input, 1, &mut out);
        out
    }

    /// Transforms `out.len()` entries of `input`, `stride` apart, into `out`.
    fn split(&self, input: &[Complex], stride: usize, out: &mut [Complex]) {
        let size = out.len();
        if size == 1 {
            out[0] = input[0];
            return;
        }
        let factor = smallest_factor(size);
        let part = size / factor;
        for (r, out) in out.chunks_exact_mut(part).enumerate() {
            self.split(&input[r * stride..], stride * factor, out);
        }
        let mut turned = vec![[0.0; 2]; factor];
        for k in 0..part {
            for (r, t) in turned.iter_mut().enumerate() {
                *t = product(out[r * part + k], self.turns[r * k * stride]);
            }
            for q in 0..factor {
                let (mut sum, mut at) = ([0.0; 2], 0); // at = r q modulo the factor
                for &t in &turned {
                    let [re, im] = product(t, self.turns[at * part * stride]);
                    sum = [sum[0] + re, sum[1] + im];
                    at = if at + q < factor { at + q } else { at + q - factor };
                }
                out[q * part + k] = sum;
            }
        }
    }
}

/// A transform as a convolution: r k = (r² + k² − (k − r)²) / 2 (Bluestein 1970).
struct Chirp {
    /// e^(πi j²/size).
    chirp: Vec<Complex>,
    padded: Transform,
    /// The padded transform of the chirp's conjugate, over the padded size.
    kernel: Vec<Complex>,
}

impl Chirp {
    fn new(size: usize) -> Self {
        let angle = |j: usize| TAU * ((j * j) % (2 * size)) as f64 / (2 * size) as f64;
        let chirp: Vec<Complex> = (0..size).map(|j| turn(angle(j))).collect();
        let length = (2 * size).next_power_of_two();
        let mut kernel = vec![[0.0; 2]; length];
        for (j, &[re, im]) in chirp.iter().enumerate() {
            let value = [re / length as f64, -im / length as f64];
            kernel[j] = value;
            kernel[(length - j) % length] = value;
        }
        let padded = Transform::new(length);
        let kernel = padded.of(&kernel);
        Self { chirp, padded, kernel }
    }

    fn of(&self, input: &[Complex]) -> Vec<Complex> {
        let mut turned: Vec<Complex> =
            input.iter().zip(&self.chirp).map(|(&x, &c)| product(x, c)).collect();
        turned.resize(self.kernel.len(), [0.0; 2]);
        let both = self.padded.of(&turned).into_iter().zip(&self.kernel);
        // Back again: the conjugate of the conjugate's transform.
        let back: Vec<Complex> = both.map(|(x, &k)| conjugate(product(x, k))).collect();
        let sums = self.padded.of(&back).into_iter();
        sums.zip(&self.chirp).map(|(sum, &c)| product(conjugate(sum), c)).collect()
    }
}

/// The largest prime that divides `n`; 1 if none does.
fn largest_factor(mut n: usize) -> usize {
    let mut largest = 1;
    while n > 1 {
        largest = smallest_factor(n);
        n /= largest;
    }
    largest
}

/// The smallest prime that divides `n` > 1.
fn smallest_factor(n: usize) -> usize {
    (2..).take_while(|p| p * p <= n).find(|p| n.is_multiple_of(*p)).unwrap_or(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_there_and_back_is_itself() {
        let table: Vec<Complex> = (0..7 * 12).map(|k| turn(0.3 * (k * k) as f64)).collect();
        let there: Vec<Complex> = transform(12, 7, &table).into_iter().map(conjugate).collect();
        for (back, want) in transform(12, 7, &there).into_iter().map(conjugate).zip(&table) {
            let error = (back[0] / 84.0 - want[0]).abs() + (back[1] / 84.0 - want[1]).abs();
            assert!(error < 1e-13, "{back:?} {want:?}");
        }
    }

    #[test]
    fn any_size_is_the_sum_it_stands_for() {
        for size in (1..=36).chain([49, 64, 67, 97, 134, 201]) {
            let input: Vec<Complex> = (0..size).map(|k| turn(0.7 * (k * k) as f64)).collect();
            for (k, got) in Transform::new(size).of(&input).iter().enumerate() {
                let mut want = [0.0; 2];
                for (r, &x) in input.iter().enumerate() {
                    let [re, im] = product(x, turn(TAU * ((r * k) % size) as f64 / size as f64));
                    want = [want[0] + re, want[1] + im];
                }
                let error = (got[0] - want[0]).abs() + (got[1] - want[1]).abs();
                assert!(error < 1e-12 * size as f64, "size {size}, entry {k}: {error}");
            }
        }
    }
}
