//! What surrounds a lobe: the slopes above which it sees light and eye.

use super::vector::V3;

/// The slopes of a horizon towards −x, +x, −y, +y of the texture, each a mean and a standard deviation
/// (Fournier 1992 §5), height per length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Horizon {
    /// Mean slopes, 0 or above.
    pub mean: [f32; 4],
    /// Standard deviations of the slopes; 0 where they are all the same.
    pub deviation: [f32; 4],
}

impl Horizon {
    /// A horizon of exact slopes.
    pub fn sharp(mean: [f32; 4]) -> Self {
        Self { mean, deviation: [0.0; 4] }
    }

    /// What part of the lobe sees in direction `d` (any length), from 0 to 1: the product of what it sees
    /// in the plane of x and z and in that of y and z, as the paper takes the two for independent.
    ///
    /// In each plane the slope of `d` is d_z / |d_x|, and the horizon is that of the side `d` leans to.
    /// Nothing is seen at the mean slope less the deviation, everything at the mean plus the deviation, and
    /// the part grows evenly between; without a deviation everything is seen from the mean on.
    #[inline(always)]
    pub fn visibility(&self, d: V3) -> f32 {
        let plane = |run: f32, low: usize| {
            let side = if run < 0.0 { low } else { low + 1 };
            visible(run.abs(), d[2], self.mean[side], self.deviation[side])
        };
        plane(d[0], 0) * plane(d[1], 2)
    }
}

/// The part seen along a direction that rises by `rise` over `run` ≥ 0.
#[inline(always)]
fn visible(run: f32, rise: f32, mean: f32, deviation: f32) -> f32 {
    let (above, spread) = (rise - mean * run, deviation * run);
    let part = (0.5 + 0.5 * above / spread.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    let step = if above >= 0.0 { 1.0 } else { 0.0 };
    if spread > 0.0 { part } else { step }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seen_from_mean_less_deviation_to_mean_plus_deviation() {
        let horizon = Horizon { mean: [2.0, 1.0, 0.0, 0.5], deviation: [0.0, 0.5, 0.0, 0.25] };
        for (slope, part) in
            [(0.4, 0.0), (0.5, 0.0), (0.75, 0.25), (1.0, 0.5), (1.5, 1.0), (9.0, 1.0)]
        {
            let seen = horizon.visibility([3.0, 0.0, 3.0 * slope]);
            assert!((seen - part).abs() < 1e-6, "slope {slope}: {seen}");
        }
        // A step on the side without a deviation; the other side does not matter.
        assert_eq!([1.99, 2.0].map(|z| horizon.visibility([-1.0, 0.0, z])), [0.0, 1.0]);
        // Both planes: half and half.
        assert!((horizon.visibility([1.0, 2.0, 1.0]) - 0.25).abs() < 1e-6);
    }

    #[test]
    fn over_a_flat_horizon_everything_above_it_is_seen() {
        let flat = Horizon::default();
        for d in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.3, -0.4, 1e-9], [-1.0, 1.0, 0.5]] {
            assert_eq!(flat.visibility(d), 1.0, "{d:?}");
        }
        assert_eq!(flat.visibility([0.0, 1.0, -0.1]), 0.0);
        assert_eq!(flat.visibility([0.0, 0.0, -1.0]), 0.0);
    }

    #[test]
    fn extremes_are_parts() {
        let horizon =
            Horizon { mean: [f32::MAX, 1e30, 0.0, 1.0], deviation: [f32::MAX, 1e30, 1e-38, 0.0] };
        for d in [[1.0, 0.0, 1.0], [-1.0, 1e-30, 1e-30], [0.0, 0.0, 0.0], [1e-38, 1e-38, 1e-38]] {
            let seen = horizon.visibility(d);
            assert!((0.0..=1.0).contains(&seen), "{d:?}: {seen}");
        }
    }
}
