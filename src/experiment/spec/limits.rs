//! The numbers a key may have.

use std::fmt;

/// An interval of numbers and their unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    min: f64,
    max: f64,
    min_excluded: bool,
    max_excluded: bool,
    unit: &'static str,
}

impl Limits {
    /// [min, max].
    pub const fn from_to(min: f64, max: f64) -> Self {
        Self { min, max, min_excluded: false, max_excluded: false, unit: "" }
    }

    /// (min, max].
    pub const fn above(min: f64, max: f64) -> Self {
        Self { min_excluded: true, ..Self::from_to(min, max) }
    }

    /// (min, max).
    pub const fn between(min: f64, max: f64) -> Self {
        Self { max_excluded: true, ..Self::above(min, max) }
    }

    /// The same, in degrees.
    pub const fn degrees(self) -> Self {
        Self { unit: " degrees", ..self }
    }

    /// Whether `x` is one of the numbers. NaN is not.
    pub fn contain(&self, x: f64) -> bool {
        let above = if self.min_excluded { x > self.min } else { x >= self.min };
        let below = if self.max_excluded { x < self.max } else { x <= self.max };
        above && below
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { min, max, unit, .. } = self;
        match (self.min_excluded, self.max_excluded) {
            (false, false) => write!(f, "from {min} to {max}{unit}"),
            (true, false) => write!(f, "more than {min} and at most {max}{unit}"),
            (true, true) => write!(f, "more than {min} and less than {max}{unit}"),
            (false, true) => write!(f, "at least {min} and less than {max}{unit}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_in_or_out_as_said() {
        let limits = Limits::above(0.0, 120.0).degrees();
        assert!(!limits.contain(0.0) && limits.contain(1e-9) && limits.contain(120.0));
        assert!(!limits.contain(120.1) && !limits.contain(f64::NAN));
        assert_eq!(limits.to_string(), "more than 0 and at most 120 degrees");
        assert!(!Limits::between(-90.0, 90.0).contain(90.0));
        assert!(Limits::from_to(0.0, 1.0).contain(0.0));
    }
}
