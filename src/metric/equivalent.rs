//! How many unfiltered samples a pixel an error is worth.

use crate::geometry::elementary::{exp64, ln64};

/// Samples a pixel at which the brute-force curve reaches an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Equivalent {
    /// So many, within the measured counts.
    Samples(f64),
    /// The curve is still above the error at its last count.
    MoreThan(u32),
    /// The curve is already below the error at its first count.
    FewerThan(u32),
}

/// How many times faster than brute force, at equal error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedUp {
    /// So many times.
    Times(f64),
    /// More than so many times: the error is below all that brute force was measured at.
    MoreThan(f64),
    /// Fewer than so many times: the error is above all that brute force was measured at.
    FewerThan(f64),
}

impl Equivalent {
    /// How many times longer brute force takes to the same error than the `cost` of what reached it, if
    /// a brute-force sample costs `cost_per_sample` > 0 in the same unit. `None` if a cost is not
    /// above 0.
    pub fn speed_up(self, cost_per_sample: f64, cost: f64) -> Option<SpeedUp> {
        let times = |samples: f64| samples * cost_per_sample / cost;
        (cost_per_sample > 0.0 && cost > 0.0).then(|| match self {
            Self::Samples(samples) => SpeedUp::Times(times(samples)),
            Self::MoreThan(samples) => SpeedUp::MoreThan(times(samples.into())),
            Self::FewerThan(samples) => SpeedUp::FewerThan(times(samples.into())),
        })
    }
}

/// Where a curve of (samples a pixel, error), in rising order of samples, falls to `error` for the
/// first time: linear between its points in log-log coordinates, so exact for any power law. `None` if
/// the curve is empty or the error is not a number.
pub fn equivalent_samples(curve: &[(u32, f64)], error: f64) -> Option<Equivalent> {
    let (&(first, highest), &(last, _)) = (curve.first()?, curve.last()?);
    if error.is_nan() {
        return None;
    }
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
    use proptest::prelude::*;

    fn power_law() -> Vec<(u32, f64)> {
        [1, 4, 16, 64].map(|n| (n, 0.8 / f64::from(n).sqrt())).to_vec()
    }

    proptest! {
        #[test]
        fn exact_on_any_power_law(wanted in 1.0f64..64.0, power in 0.1f64..2.0, scale in 1e-6f64..1e3) {
            let curve = [1u32, 4, 16, 64].map(|n| (n, scale * f64::from(n).powf(-power)));
            match equivalent_samples(&curve, scale * wanted.powf(-power)) {
                Some(Equivalent::Samples(found)) => prop_assert!((found / wanted - 1.0).abs() < 1e-9),
                // Rounding at the ends.
                Some(Equivalent::FewerThan(1)) => prop_assert!(wanted < 1.0 + 1e-9),
                Some(Equivalent::MoreThan(64)) => prop_assert!(wanted > 64.0 - 1e-9),
                other => prop_assert!(false, "{other:?}"),
            }
        }

        #[test]
        fn a_lower_error_is_never_worth_fewer_samples(errors in prop::collection::vec(0.0f64..1.0, 1..8), one in 0.0f64..1.2, two in 0.0f64..1.2) {
            let curve: Vec<(u32, f64)> = errors.iter().enumerate().map(|(i, e)| (1 << i, *e)).collect();
            let rank = |error: f64| match equivalent_samples(&curve, error).unwrap() {
                Equivalent::FewerThan(_) => 0.0,
                Equivalent::Samples(n) => n,
                Equivalent::MoreThan(_) => f64::INFINITY,
            };
            prop_assert!(rank(one.min(two)) >= rank(one.max(two)) * (1.0 - 1e-12));
        }
    }

    #[test]
    fn says_when_it_is_outside() {
        assert_eq!(equivalent_samples(&power_law(), 0.9), Some(Equivalent::FewerThan(1)));
        assert_eq!(equivalent_samples(&power_law(), 0.05), Some(Equivalent::MoreThan(64)));
        assert_eq!(equivalent_samples(&[], 0.05), None);
        assert_eq!(equivalent_samples(&power_law(), f64::NAN), None);
    }

    #[test]
    fn zero_errors_are_no_trouble() {
        assert_eq!(equivalent_samples(&[(1, 0.0)], 0.0), Some(Equivalent::Samples(1.0)));
        assert_eq!(equivalent_samples(&[(1, 0.5), (2, 0.0)], 0.0), Some(Equivalent::Samples(2.0)));
        assert_eq!(equivalent_samples(&[(1, 0.5), (2, 0.1)], 0.0), Some(Equivalent::MoreThan(2)));
    }

    #[test]
    fn speed_up_at_equal_error() {
        assert_eq!(Equivalent::Samples(30.0).speed_up(2.0, 5.0), Some(SpeedUp::Times(12.0)));
        assert_eq!(Equivalent::MoreThan(64).speed_up(2.0, 4.0), Some(SpeedUp::MoreThan(32.0)));
        assert_eq!(Equivalent::FewerThan(1).speed_up(2.0, 4.0), Some(SpeedUp::FewerThan(0.5)));
        assert_eq!(Equivalent::Samples(30.0).speed_up(2.0, 0.0), None);
    }
}
