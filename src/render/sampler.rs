//! Sample positions within a pixel.

/// The first two dimensions of Sobol's sequence, scrambled a pixel at a time.
///
/// Any 4ᵏ successive points from the start form a (0, 2k, 2)-net: one in each elementary interval, so
/// they are as even as a stratified grid and more. Each pixel flips the binary digits of both
/// coordinates by random masks of its own (random digit scrambling, Kollig and Keller 2002), which
/// makes every point uniformly distributed, leaves the net a net, and makes pixels independent. Digits
/// below the mask's end keep points off the pixel's edges.
///
/// Everything is integer arithmetic up to the last step: the same points on every machine.
#[derive(Clone, Debug)]
pub struct PixelSampler {
    points: Vec<[u32; 2]>,
}

/// 2⁻³¹
const UNIT: f64 = 1.0 / 2_147_483_648.0;

impl PixelSampler {
    /// A sampler for `spp` ≥ 1 samples a pixel.
    pub fn new(spp: u32) -> Self {
        Self { points: (0..spp).map(sobol).collect() }
    }

    /// Samples a pixel.
    pub fn spp(&self) -> u32 {
        self.points.len() as u32
    }

    /// Writes positions in (0, 1)² of a pixel's samples, the `first`-th and those after it, plus the
    /// pixel's corner, until `x` and `y` (of one length) are full. `stream` tells pixels, replicates and
    /// seeds apart; see [`stream`]. A single sample is the pixel's centre, as a renderer without
    /// supersampling has it.
    ///
    /// # Panics
    /// If there are not so many samples.
    #[inline]
    pub fn fill(&self, stream: u64, first: usize, corner: [f64; 2], x: &mut [f64], y: &mut [f64]) {
        if self.points.len() == 1 {
            (x[0], y[0]) = (corner[0] + 0.5, corner[1] + 0.5);
            return;
        }
        let masks = mix(stream);
        let (across, down) = (masks as u32, (masks >> 32) as u32);
        let points = &self.points[first..first + x.len()];
        for ((point, x), y) in points.iter().zip(x).zip(y) {
            *x = corner[0] + fraction(point[0] ^ across);
            *y = corner[1] + fraction(point[1] ^ down);
        }
    }

    /// The positions in (0, 1)² of a pixel's samples; see [`PixelSampler::fill`].
    pub fn positions(&self, stream: u64) -> Vec<[f64; 2]> {
        let (mut x, mut y) = (vec![0.0; self.points.len()], vec![0.0; self.points.len()]);
        self.fill(stream, 0, [0.0; 2], &mut x, &mut y);
        x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
    }
}

/// Three further numbers a sample, for choices other than its position: dimensions 3 to 5 of the same
/// sequence (Joe and Kuo 2008), scrambled in the same way by masks of their own.
#[derive(Clone, Debug)]
pub struct Choices {
    points: Vec<[u32; 3]>,
}

/// Degree, coefficients and first direction numbers of the polynomials of dimensions 3 to 5.
const POLYNOMIALS: [(usize, u32, [u32; 3]); 3] =
    [(2, 1, [1, 3, 0]), (3, 1, [1, 3, 1]), (3, 2, [1, 1, 1])];

impl Choices {
    /// Choices for `spp` ≥ 1 samples a pixel.
    pub fn new(spp: u32) -> Self {
        let directions = POLYNOMIALS.map(directions);
        let point = |index: u32| {
            directions.map(|numbers| {
                let bits = (0..32).filter(|k| index >> k & 1 == 1);
                bits.fold(0, |sum, k| sum ^ numbers[k])
            })
        };
        Self { points: (0..spp).map(point).collect() }
    }

    /// The numbers, in (0, 1), of sample `index` of a pixel; see [`PixelSampler::fill`].
    ///
    /// # Panics
    /// If there are not so many samples.
    #[inline]
    pub fn of(&self, stream: u64, index: usize) -> [f64; 3] {
        let (first, second) =
            (mix(stream ^ 0x5851_f42d_4c95_7f2d), mix(stream ^ 0x1405_7b7e_f767_814f));
        let masks = [first as u32, (first >> 32) as u32, second as u32];
        [0, 1, 2].map(|c| fraction(self.points[index][c] ^ masks[c]))
    }
}

/// The 32 direction numbers of a primitive polynomial, as binary fractions.
fn directions((degree, coefficients, first): (usize, u32, [u32; 3])) -> [u32; 32] {
    let mut numbers = [0u32; 32];
    for k in 0..32 {
        numbers[k] = if k < degree {
            first[k] << (31 - k)
        } else {
            let inner = (1..degree).filter(|j| coefficients >> (degree - 1 - j) & 1 == 1);
            let start = numbers[k - degree] ^ (numbers[k - degree] >> degree);
            inner.fold(start, |sum, j| sum ^ numbers[k - j])
        };
    }
    numbers
}

/// The upper 31 bits as a binary fraction, half a unit in the last place added: inside (0, 1).
#[inline(always)]
fn fraction(bits: u32) -> f64 {
    (f64::from((bits >> 1) as i32) + 0.5) * UNIT
}

/// A number that tells a pixel's random choices from all others of the experiment.
pub fn stream(seed: u64, replicate: u32, pixel: usize) -> u64 {
    mix(mix(seed ^ 0x9e37_79b9_7f4a_7c15).wrapping_add(u64::from(replicate) << 40))
        .wrapping_add(pixel as u64)
}

/// SplitMix64's finaliser (Steele et al. 2014): every input bit flips each output bit half the time.
fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Point `index` of the two-dimensional Sobol sequence as binary fractions: van der Corput's sequence,
/// and the direction numbers of the polynomial x + 1.
fn sobol(index: u32) -> [u32; 2] {
    let (mut second, mut direction, mut bits) = (0, 1u32 << 31, index);
    while bits != 0 {
        if bits & 1 == 1 {
            second ^= direction;
        }
        bits >>= 1;
        direction ^= direction >> 1;
    }
    [index.reverse_bits(), second]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_to_the_k_points_form_a_net() {
        let sampler = PixelSampler::new(256);
        let points = sampler.positions(stream(7, 0, 123));
        // Every split of 256 boxes into 2^a × 2^(8−a) holds one point each.
        for a in 0..=8u32 {
            let (across, down) = (1usize << a, 1usize << (8 - a));
            let mut seen = vec![0; 256];
            for [x, y] in &points {
                seen[(x * across as f64) as usize * down + (y * down as f64) as usize] += 1;
            }
            assert!(seen.iter().all(|&n| n == 1), "{across} × {down}");
        }
    }

    #[test]
    fn a_pixels_first_point_is_uniform() {
        // Mean of n uniform numbers: 1/2 ± 4σ, σ = 1/√(12 n). Seed 1, n = 20 000; the chance of a
        // false alarm in either coordinate is 1.3·10⁻⁴.
        let sampler = PixelSampler::new(2);
        let n = 20_000;
        for c in 0..2 {
            let sum: f64 = (0..n).map(|pixel| sampler.positions(stream(1, 0, pixel))[0][c]).sum();
            let off = (sum / n as f64 - 0.5).abs();
            assert!(off < 4.0 / (12.0 * n as f64).sqrt(), "coordinate {c}: {off}");
        }
    }

    #[test]
    fn choices_are_even_and_differ_from_pixel_to_pixel() {
        let choices = Choices::new(4096);
        let points: Vec<[f64; 3]> = (0..4096).map(|i| choices.of(stream(3, 1, 9), i)).collect();
        // Each number alone: one in each of 4096 intervals.
        for c in 0..3 {
            let mut cells: Vec<usize> = points.iter().map(|p| (p[c] * 4096.0) as usize).collect();
            cells.sort_unstable();
            assert!(cells.iter().enumerate().all(|(k, &cell)| k == cell), "number {c}");
        }
        // All three together: 8 in each of 8 × 8 × 8 boxes, give or take the sequence's quality t ≤ 3.
        let mut boxes = [0; 512];
        for p in &points {
            let [a, b, c] = p.map(|x| (x * 8.0) as usize);
            boxes[(a * 8 + b) * 8 + c] += 1;
        }
        assert!(boxes.iter().all(|&n| n == 8), "{boxes:?}");
        assert_ne!(choices.of(stream(3, 1, 9), 0), choices.of(stream(3, 1, 10), 0));
    }

    #[test]
    fn one_sample_is_the_centre_and_streams_differ() {
        assert_eq!(PixelSampler::new(1).positions(5), [[0.5, 0.5]]);
        let two = PixelSampler::new(2);
        let first = |s| two.positions(s)[0];
        assert_ne!(first(stream(1, 0, 0)), first(stream(1, 0, 1)));
        assert_ne!(first(stream(1, 0, 0)), first(stream(1, 1, 0)));
        assert_ne!(first(stream(1, 0, 0)), first(stream(2, 0, 0)));
    }
}
