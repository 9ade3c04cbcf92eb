//! A Phong peak in double precision, and lists of them.

use crate::geometry::Vec3;
use crate::geometry::elementary::pow64;

/// a · max(0, ω·d)ⁿ, in double precision (Fournier 1992 §2.2).
///
/// It is both what is fitted and what a normal of a bump map is spread into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Density at the peak, a ≥ 0.
    pub amplitude: f64,
    /// Unit direction d, in tangent space.
    pub direction: Vec3,
    /// Exponent n ≥ 0.
    pub exponent: f64,
}

/// Why normals or samples cannot be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InputError {
    /// A normal has a part that is not finite, a negative amplitude or exponent, or no direction.
    #[error(
        "normal {index} is not usable ({peak:?}): amplitude and exponent must be finite and at \
         least 0, and the direction finite and not zero"
    )]
    Normal {
        /// Which, from 0.
        index: usize,
        /// What it is.
        peak: Peak,
    },
    /// A sample of a distribution is negative or not finite.
    #[error("sample {index} is {value}: a density must be finite and at least 0")]
    Sample {
        /// Which, from 0, in the order of the directions.
        index: usize,
        /// What it is.
        value: f64,
    },
    /// The number of samples is not that of the directions.
    #[error("{got} samples for {want} directions: give one sample a direction")]
    Count {
        /// Samples given.
        got: usize,
        /// Directions.
        want: usize,
    },
    /// A direction is zero or not finite.
    #[error("direction {index} is {direction:?}: it must be finite and not zero")]
    Direction {
        /// Which, from 0.
        index: usize,
        /// What it is.
        direction: Vec3,
    },
}

impl Peak {
    /// Its value in a unit direction; 0 at and below its horizon.
    pub fn value(&self, toward: Vec3) -> f64 {
        self.amplitude * pow64(toward.dot(&self.direction), self.exponent)
    }

    /// Its vector moment ∫ value(ω) ω dω over its own hemisphere: 2π a / (n + 2) along d.
    pub fn moment(&self) -> Vec3 {
        self.direction * (std::f64::consts::TAU * self.amplitude / (self.exponent + 2.0))
    }

    fn usable(&self) -> bool {
        let length = self.direction.norm_squared();
        self.amplitude.is_finite()
            && self.amplitude >= 0.0
            && self.exponent.is_finite()
            && self.exponent >= 0.0
            && length.is_finite()
            && length > 0.0
    }
}

/// The distinct peaks of a list, directions brought to unit length: those of the same direction and
/// exponent merge, amplitudes added in order; those of amplitude 0 are left out. The result is in
/// order of direction, whatever the order of the input.
///
/// # Errors
/// [`InputError::Normal`] for the first peak that is not usable.
pub fn merged(peaks: &[Peak]) -> Result<Vec<Peak>, InputError> {
    if let Some(index) = peaks.iter().position(|peak| !peak.usable()) {
        return Err(InputError::Normal { index, peak: peaks[index] });
    }
    let key = |p: &Peak| [p.direction.x, p.direction.y, p.direction.z, p.exponent].map(ordered);
    let mut sorted: Vec<Peak> = peaks
        .iter()
        .filter(|p| p.amplitude > 0.0)
        .map(|p| Peak { direction: p.direction.normalize(), ..*p })
        .collect();
    sorted.sort_by_key(key); // stable: equal ones stay in order, so sums have one order
    sorted.dedup_by(|next, kept| {
        let same = key(next) == key(kept);
        if same {
            kept.amplitude += next.amplitude;
        }
        same
    });
    Ok(sorted)
}

/// The bits of a number, with one zero: a key under which equal numbers are equal.
fn ordered(x: f64) -> u64 {
    (x + 0.0).to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identical_normals_merge_and_order_does_not_matter() {
        let peak = |x: f64, amplitude| Peak {
            amplitude,
            direction: Vec3::new(x, 0.0, 1.0),
            exponent: 5.0,
        };
        let (a, b, none) = (peak(0.5, 1.0), peak(0.0, 2.0), peak(0.25, 0.0));
        let minus_zero = Peak { direction: Vec3::new(-0.0, 0.0, 1.0), ..b };
        let one = merged(&[a, b, none, minus_zero, a]).unwrap();
        assert_eq!(one, merged(&[minus_zero, a, a, b]).unwrap());
        assert_eq!(one.iter().map(|p| p.amplitude).collect::<Vec<_>>(), [4.0, 2.0]);
    }

    #[test]
    fn what_is_not_usable_is_named() {
        let good = Peak { amplitude: 1.0, direction: Vec3::z(), exponent: 1.0 };
        for bad in [
            Peak { amplitude: f64::NAN, ..good },
            Peak { amplitude: -1.0, ..good },
            Peak { exponent: f64::INFINITY, ..good },
            Peak { direction: Vec3::zeros(), ..good },
        ] {
            assert!(matches!(merged(&[good, bad]), Err(InputError::Normal { index: 1, .. })));
        }
    }

    #[test]
    fn the_moment_is_the_integral() {
        let peak = Peak { amplitude: 0.7, direction: Vec3::z(), exponent: 12.0 };
        let grid = crate::geometry::HemisphereGrid::new(900, 8);
        let sum = grid.integrate(|w| peak.value(w) * w.z);
        assert!((sum / peak.moment().z - 1.0).abs() < 1e-4);
    }
}
