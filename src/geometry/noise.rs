//! Gradient noise and turbulence (Perlin 1985, *An Image Synthesizer*; 2002, *Improving Noise*).

use super::elementary::floor64;

/// Directions of lattice gradients.
const GRADIENTS: usize = 64;

/// Unit vectors 2π/64 apart, times √2: gradient noise of unit gradients stays within ±√½ in the plane, so this
/// stays within ±1.
const DIRECTIONS: [[f64; 2]; GRADIENTS] = {
    const COS: f64 = 0.995_184_726_672_196_9;
    const SIN: f64 = 0.098_017_140_329_560_6;
    let mut all = [[std::f64::consts::SQRT_2, 0.0]; GRADIENTS];
    let mut k = 1;
    while k < GRADIENTS {
        let [x, y] = all[k - 1];
        all[k] = [x * COS - y * SIN, x * SIN + y * COS];
        k += 1;
    }
    all
};

/// A sum of octaves of gradient noise over the unit tile: fractal noise, here called turbulence as in Kautz et al.
/// 2001. Octave k has `cells`·2ᵏ lattice cells along the tile's sides and `gain`ᵏ of the first one's height. It repeats with
/// the tile, and it is a function of its seed and place alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turbulence {
    /// Lattice cells of the first octave along u and along v, each in [1, 2²⁰].
    pub cells: [u32; 2],
    /// Height of an octave over that of the one before, in (0, 1).
    pub gain: f64,
    /// What the gradients are drawn from.
    pub seed: u64,
    /// Where the lattice of every octave stands, in its own cells along both axes. At lattice points noise is 0
    /// whatever its seed: two noises on the same lattice are small together, and so not independent. A quarter of a cell
    /// apart they all but are.
    pub offset: f64,
}

/// The most octaves a turbulence can have: cells of the last still have numbers of their own.
pub const MOST_OCTAVES: u32 = 24;

impl Turbulence {
    /// The sum of `octaves` octaves at (u, v), in (−1, 1) for any number of them. Of a number that is not whole, the
    /// last octave is blended in: it counts by [`blend`] of the fraction. More than [`MOST_OCTAVES`] are as many.
    pub fn at(&self, u: f64, v: f64, octaves: f64) -> f64 {
        let octaves = octaves.clamp(0.0, f64::from(MOST_OCTAVES));
        let mut sum = 0.0;
        let mut height = 1.0 - self.gain;
        for k in 0..MOST_OCTAVES {
            let part = octaves - f64::from(k);
            if part <= 0.0 {
                break;
            }
            sum += blend(part) * height * self.octave(u, v, k);
            height *= self.gain;
        }
        sum
    }

    /// Octave `k` alone, of full height: gradient noise in [−1, 1].
    #[inline]
    pub fn octave(&self, u: f64, v: f64, k: u32) -> f64 {
        let period = self.cells.map(|cells| (u64::from(cells) << k) as f64);
        let seed = mixed(self.seed ^ u64::from(k + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        gradient_noise([u * period[0] + self.offset, v * period[1] + self.offset], period, seed)
    }
}

/// How much of an octave is in when this part of it is to be: 0 at 0, 1 at 1 and above, level at both, so that
/// nothing pops. The quintic of Perlin 2002.
#[inline(always)]
pub fn blend(part: f64) -> f64 {
    let t = part.clamp(0.0, 1.0);
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Gradient noise at a place in lattice cells that repeats every `period` cells along either axis.
#[inline]
fn gradient_noise(place: [f64; 2], period: [f64; 2], seed: u64) -> f64 {
    let axis = |a: usize| {
        let within = place[a] - period[a] * floor64(place[a] / period[a]);
        let cell = floor64(within);
        // Rounding may have put it at the very end.
        let first = if cell >= period[a] { 0.0 } else { cell };
        let second = if first + 1.0 >= period[a] { 0.0 } else { first + 1.0 };
        (within - cell, [first, second])
    };
    let ((fx, columns), (fy, rows)) = (axis(0), axis(1));
    let columns = columns.map(|c| (c as u64).wrapping_mul(0xD6E8_FEB8_6659_FD93));
    let rows = rows.map(|c| mixed(seed ^ c as u64));
    let corner = |a: usize, b: usize| {
        let hash = mixed(rows[b] ^ columns[a]);
        let [gx, gy] = DIRECTIONS[(hash >> 58) as usize];
        gx * (fx - a as f64) + gy * (fy - b as f64)
    };
    let (across, along) = (blend(fx), blend(fy));
    let low = corner(0, 0) + across * (corner(1, 0) - corner(0, 0));
    let high = corner(0, 1) + across * (corner(1, 1) - corner(0, 1));
    low + along * (high - low)
}

/// Bits well mixed: the finaliser of Murmur3 (Appleby 2011).
#[inline(always)]
fn mixed(mut bits: u64) -> u64 {
    bits ^= bits >> 33;
    bits = bits.wrapping_mul(0xFF51_AFD7_ED55_8CCD);
    bits ^= bits >> 33;
    bits = bits.wrapping_mul(0xC4CE_B9FE_1A85_EC53);
    bits ^ (bits >> 33)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const NOISE: Turbulence = Turbulence { cells: [5, 5], gain: 0.5, seed: 3, offset: 0.0 };

    proptest! {
        #[test]
        fn it_repeats_with_the_tile_and_stays_within_one(
            u in -3.0f64..3.0, v in -3.0f64..3.0, octaves in 0.0f64..12.0
        ) {
            let here = NOISE.at(u, v, octaves);
            prop_assert!(here.abs() < 1.0);
            let there = NOISE.at(u + 1.0, v - 2.0, octaves);
            // Places are rounded to 2⁻⁵¹, and the last octave has slopes up to 10⁴ or so.
            prop_assert!((here - there).abs() < 1e-9, "{here} {there}");
        }

        #[test]
        fn octaves_come_in_without_a_jump(u in 0.0f64..1.0, v in 0.0f64..1.0, octaves in 0.0f64..9.0) {
            // The steepest blend is 15/8, and what is blended is at most the octave's height.
            let step = 1e-4;
            let change = (NOISE.at(u, v, octaves + step) - NOISE.at(u, v, octaves)).abs();
            prop_assert!(change <= 0.5 * 1.875 * step * 1.001);
        }
    }

    #[test]
    fn it_is_zero_at_the_lattice_and_its_own_at_every_seed() {
        for k in 0..5 {
            assert_eq!(NOISE.octave(f64::from(k) / 5.0, 0.4, 0), 0.0);
        }
        let other = Turbulence { seed: 4, ..NOISE };
        assert_ne!(NOISE.at(0.13, 0.77, 4.0), other.at(0.13, 0.77, 4.0));
        assert_ne!(NOISE.octave(0.13, 0.77, 0), NOISE.octave(0.065, 0.385, 1));
    }

    /// Seeds 3 and 4, N = 2²⁰ points: the correlation of squares has a standard error of 10⁻³.
    #[test]
    fn noises_on_one_lattice_are_small_together_and_a_quarter_apart_are_not() {
        let one = Turbulence { cells: [1 << 20; 2], ..NOISE };
        let correlation = |offset: f64| {
            let two = Turbulence { seed: 4, offset, ..one };
            let n = 1u32 << 20;
            let mut sums = [0.0; 5];
            for k in 0..n {
                let u = (f64::from(k) + 0.5) / f64::from(n);
                let v = f64::from(k.wrapping_mul(2_654_435_769)) / 4_294_967_296.0;
                let [a, b] = [one, two].map(|t| t.octave(u + 0.37 * v, v, 0).powi(2));
                let parts = [a, b, a * a, b * b, a * b];
                sums.iter_mut().zip(parts).for_each(|(s, p)| *s += p / f64::from(n));
            }
            let [a, b, aa, bb, ab] = sums;
            (ab - a * b) / ((aa - a * a) * (bb - b * b)).sqrt()
        };
        assert!(correlation(0.0) > 0.05, "{}", correlation(0.0));
        assert!(correlation(0.25).abs() < 5e-3, "{}", correlation(0.25));
    }

    #[test]
    fn gradients_are_spread_evenly_round_the_circle() {
        let first = DIRECTIONS[GRADIENTS - 1];
        let back = [first[0] * 0.995_184_726_672_196_9 - first[1] * 0.098_017_140_329_560_6, 0.0];
        assert!((back[0] - std::f64::consts::SQRT_2).abs() < 1e-12);
        let sum = DIRECTIONS.iter().fold([0.0; 2], |s, d| [s[0] + d[0], s[1] + d[1]]);
        assert!(sum.iter().all(|s| s.abs() < 1e-12));
    }

    /// Seed 3, N = 2²⁰ points of a lattice over 2²⁰ by 2²⁰ cells: the mean's standard error is 4·10⁻⁴ (values are
    /// all but independent), so 2·10⁻³ is five of them.
    #[test]
    fn one_octave_has_mean_zero_and_the_variance_of_its_gradients() {
        let noise = Turbulence { cells: [1 << 20; 2], ..NOISE };
        let n = 1u32 << 20;
        let (mut mean, mut square) = (0.0, 0.0);
        for k in 0..n {
            let u = (f64::from(k) + 0.5) / f64::from(n);
            let v = f64::from(k.wrapping_mul(2_654_435_769)) / 4_294_967_296.0;
            let value = noise.octave(u + 0.37 * v, v, 0);
            mean += value / f64::from(n);
            square += value * value / f64::from(n);
        }
        // Σ over corners of w² |d|² E[g²] with E[gx²] = 1: the mean of Σ w² |d|² over the cell.
        let m = 400;
        let mut want = 0.0;
        for a in 0..m {
            for b in 0..m {
                let at = |k: i32| (f64::from(k) + 0.5) / f64::from(m);
                let (x, y) = (at(a), at(b));
                let w = |t: f64| [1.0 - blend(t), blend(t)];
                for (i, wx) in w(x).into_iter().enumerate() {
                    for (j, wy) in w(y).into_iter().enumerate() {
                        let (dx, dy) = (x - i as f64, y - j as f64);
                        want += (wx * wy).powi(2) * (dx * dx + dy * dy) / f64::from(m * m);
                    }
                }
            }
        }
        assert!(mean.abs() < 2e-3, "{mean}");
        assert!((square / want - 1.0).abs() < 0.01, "{square} {want}");
    }
}
