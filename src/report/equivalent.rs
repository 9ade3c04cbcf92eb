//! How many unfiltered samples a pixel an error is worth.

use crate::geometry::elementary::{exp64, ln64};

/// Samples a pixel at which the brute-force curve reaches an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Equivalent {
    /// So many, between two measured counts.
    Samples(f64),
    /// The curve is still above the error at its last count.
    MoreThan(u32),
    /// The curve is already below the error at its first count.
    FewerThan(u32),
}

impl Equivalent {
    /// A key that orders equivalents from worst to best.
    pub(super) fn rank(self) -> f64 {
        match self {
            Self::FewerThan(_) => 0.0,
            Self::Samples(samples) => samples,
            Self::MoreThan(_) => f64::INFINITY,
        }
    }
}

/// Where a curve of (samples a pixel, error), in rising order of samples, falls to `error` for the
/// first time: linear between its points in log-log coordinates, so exact for any power law. `None`
/// if the curve is empty.
pub fn equivalent_samples(curve: &[(u32, f64)], error: f64) -> Option<Equivalent> {
    let (&(first, highest), &(last, _)) = (curve.first()?, curve.last()?);
    if highest < error {
        return Some(Equivalent::FewerThan(first));
    }
    let reached = curve.iter().position(|&(_, e)| e <= error);
    Some(match reached {
        None => Equivalent::MoreThan(last),
        Some(0) => Equivalent::Samples(f64::from(first)),
        Some(i) => Equivalent::Samples(between(curve[i - 1], curve[i], error)),
    })
}

/// The samples at which the power law through two points, the second one lower, reaches `error`.
fn between(above: (u32, f64), below: (u32, f64), error: f64) -> f64 {
    let (from, to) = (f64::from(above.0), f64::from(below.0));
    if below.1 <= 0.0 || error <= 0.0 {
        return to;
    }
    let along = ln64(above.1 / error) / ln64(above.1 / below.1);
    from * exp64(along * ln64(to / from))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn power_law() -> Vec<(u32, f64)> {
        [1, 4, 16, 64].map(|n| (n, 0.8 / f64::from(n).sqrt())).to_vec()
    }

    #[test]
    fn exact_on_a_power_law() {
        for wanted in [1.0, 2.0, 7.3, 16.0, 63.9] {
            let error = 0.8 / f64::sqrt(wanted);
            let Some(Equivalent::Samples(found)) = equivalent_samples(&power_law(), error) else {
                panic!("{wanted} is inside the curve");
            };
            assert!((found / wanted - 1.0).abs() < 1e-12, "{wanted}: {found}");
        }
    }

    #[test]
    fn says_when_it_is_outside() {
        assert_eq!(equivalent_samples(&power_law(), 0.9), Some(Equivalent::FewerThan(1)));
        assert_eq!(equivalent_samples(&power_law(), 0.05), Some(Equivalent::MoreThan(64)));
        assert_eq!(equivalent_samples(&[], 0.05), None);
    }

    #[test]
    fn zero_errors_are_no_trouble() {
        assert_eq!(equivalent_samples(&[(1, 0.0)], 0.0), Some(Equivalent::Samples(1.0)));
        assert_eq!(equivalent_samples(&[(1, 0.5), (2, 0.0)], 0.0), Some(Equivalent::Samples(2.0)));
        assert_eq!(equivalent_samples(&[(1, 0.5), (2, 0.1)], 0.0), Some(Equivalent::MoreThan(2)));
    }
}
