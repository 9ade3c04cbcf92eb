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

/// 2⁻³²
const UNIT: f64 = 1.0 / 4_294_967_296.0;

impl PixelSampler {
    /// A sampler for `spp` ≥ 1 samples a pixel.
    pub fn new(spp: u32) -> Self {
        Self { points: (0..spp).map(sobol).collect() }
    }

    /// Samples a pixel.
    pub fn spp(&self) -> u32 {
        self.points.len() as u32
    }

    /// The positions in [0, 1)² of a pixel's samples. `stream` tells pixels, replicates and seeds
    /// apart; see [`stream`]. A single sample is the pixel's centre, as a renderer without
    /// supersampling has it.
    #[inline]
    pub fn positions(&self, stream: u64) -> impl Iterator<Item = [f64; 2]> + '_ {
        let masks = mix(stream);
        let (across, down) = (masks as u32, (masks >> 32) as u32);
        let single = self.points.len() == 1;
        self.points.iter().map(move |&[x, y]| {
            if single {
                [0.5, 0.5]
            } else {
                // Half a unit in the last place keeps points inside the open square.
                [x ^ across, y ^ down].map(|bits| (f64::from(bits) + 0.5) * UNIT)
            }
        })
    }
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
        let points: Vec<[f64; 2]> = sampler.positions(stream(7, 0, 123)).collect();
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
            let sum: f64 = (0..n)
                .map(|pixel| sampler.positions(stream(1, 0, pixel)).next().expect("two points")[c])
                .sum();
            let off = (sum / n as f64 - 0.5).abs();
            assert!(off < 4.0 / (12.0 * n as f64).sqrt(), "coordinate {c}: {off}");
        }
    }

    #[test]
    fn one_sample_is_the_centre_and_streams_differ() {
        assert_eq!(PixelSampler::new(1).positions(5).collect::<Vec<_>>(), [[0.5, 0.5]]);
        let two = PixelSampler::new(2);
        let first = |s| two.positions(s).next().expect("two points");
        assert_ne!(first(stream(1, 0, 0)), first(stream(1, 0, 1)));
        assert_ne!(first(stream(1, 0, 0)), first(stream(1, 1, 0)));
        assert_ne!(first(stream(1, 0, 0)), first(stream(2, 0, 0)));
    }
}
