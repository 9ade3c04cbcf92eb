//! Distributions of normals, sampled.

use rayon::prelude::*;

use super::kernel::{CHUNK, spread_chunk};
use super::{Directions, InputError, Peak};

/// From this many normals on, a distribution is spread on all cores: below, regions are small and
/// many, and run beside each other.
const MANY_NORMALS: usize = 512;

/// N(ω) at every one of some directions: the density of normals of a region (Fournier 1992 §2.1).
#[derive(Clone, Debug)]
pub struct Distribution {
    /// One value a direction, then zeros to whole chunks.
    values: Vec<f64>,
    count: usize,
    maximum: f64,
    /// The rms in units of the maximum.
    relative_rms: f64,
}

impl Distribution {
    /// Spreads normals, each with an amplitude and an exponent of its own: N(ω) = Σ wᵢ max(0, ω·nᵢ)^eᵢ
    /// (§2.2). The sum at a direction is taken in the order of the normals, whatever the threads.
    /// `None` if `cancelled` says so.
    pub fn spread(
        normals: &[Peak],
        directions: &Directions,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let mut values = vec![0.0; directions.chunks() * CHUNK];
        let fill = |(k, out): (usize, &mut [f64])| {
            let out: &mut [f64; CHUNK] = out.try_into().expect("a whole chunk");
            for some in normals.chunks(MANY_NORMALS) {
                if cancelled() {
                    return;
                }
                spread_chunk(directions.chunk(k), some, out);
            }
        };
        if normals.len() < MANY_NORMALS {
            values.chunks_mut(CHUNK).enumerate().for_each(fill);
        } else {
            values.par_chunks_mut(CHUNK).enumerate().for_each(fill);
        }
        (!cancelled()).then(|| Self::of(values, directions.count()))
    }

    /// A distribution from samples, one a direction, in the order of the directions.
    ///
    /// # Errors
    /// If there is not one sample a direction, or one is negative or not finite.
    pub fn from_samples(samples: &[f64], directions: &Directions) -> Result<Self, InputError> {
        let (got, want) = (samples.len(), directions.count());
        if got != want {
            return Err(InputError::Count { got, want });
        }
        if let Some(index) = samples.iter().position(|v| !(v.is_finite() && *v >= 0.0)) {
            return Err(InputError::Sample { index, value: samples[index] });
        }
        let mut values = samples.to_vec();
        values.resize(directions.chunks() * CHUNK, 0.0);
        Ok(Self::of(values, want))
    }

    fn of(values: Vec<f64>, count: usize) -> Self {
        let maximum = values.iter().fold(0.0, |m: f64, &v| m.max(v));
        // In units of the maximum, so that squares neither overflow nor vanish.
        let scale = if maximum > 0.0 { maximum } else { 1.0 };
        let relative: Vec<f64> = values[..count].iter().map(|v| v / scale).collect();
        let relative_rms = root_mean_square(&relative);
        Self { values, count, maximum, relative_rms }
    }

    /// The values, in the order of the directions.
    pub fn values(&self) -> &[f64] {
        &self.values[..self.count]
    }

    /// The values, and zeros to whole chunks.
    pub(super) fn padded(&self) -> &[f64] {
        &self.values
    }

    /// The largest value.
    pub fn maximum(&self) -> f64 {
        self.maximum
    }

    /// The root of the mean squared value.
    pub fn rms(&self) -> f64 {
        self.relative_rms * self.maximum
    }

    /// The root of the mean squared value, in units of the largest: from 0 to 1, however small or large
    /// the values are.
    pub fn relative_rms(&self) -> f64 {
        self.relative_rms
    }
}

/// √(Σ x² / n), summed in order; 0 for nothing.
pub(super) fn root_mean_square(values: &[f64]) -> f64 {
    let sum: f64 = values.iter().map(|v| v * v).sum();
    (sum / values.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{HemisphereGrid, Vec3};

    #[test]
    fn spreading_is_the_sum_of_peaks() {
        let directions = Directions::new(HemisphereGrid::fournier());
        let normals: Vec<Peak> = (0..700)
            .map(|i| {
                let t = f64::from(i);
                let direction =
                    Vec3::new((0.7 * t).sin(), (1.3 * t).cos(), 0.2 + t.sin()).normalize();
                Peak { amplitude: 0.1 + t % 3.0, direction, exponent: t % 90.0 }
            })
            .collect();
        let distribution = Distribution::spread(&normals, &directions, &|| false).unwrap();
        for (toward, got) in directions.iter().zip(distribution.values()) {
            let want: f64 = normals.iter().map(|p| p.value(toward)).sum();
            assert!((got - want).abs() <= 1e-12 * want, "{got} {want}");
        }
    }

    #[test]
    fn samples_are_checked() {
        let directions = Directions::new(HemisphereGrid::new(2, 3));
        let bad = Distribution::from_samples(&[1.0, 2.0], &directions);
        assert_eq!(bad.unwrap_err(), InputError::Count { got: 2, want: 7 });
        let mut samples = [1.0; 7];
        samples[4] = f64::NAN;
        let bad = Distribution::from_samples(&samples, &directions);
        assert!(matches!(bad, Err(InputError::Sample { index: 4, .. })));
    }

    #[test]
    fn a_cancelled_spread_gives_nothing() {
        let directions = Directions::new(HemisphereGrid::fournier());
        let normal = Peak { amplitude: 1.0, direction: Vec3::z(), exponent: 1.0 };
        assert!(Distribution::spread(&[normal], &directions, &|| true).is_none());
    }
}
