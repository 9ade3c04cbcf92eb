//! What a single normal is shaded as, and the member of that family nearest to a base lobe.

use crate::geometry::elementary::exp64;
use crate::lobe::{BaseLobe, Generator};
use crate::method::nearness::{ERROR, energy, least, tan_squared, total_variation};

/// The lobes of a single normal, by their variance v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Family {
    /// A Gaussian in slopes: Beckmann's lobe.
    Projected,
    /// g(|h − n|²/v) on the sphere; von Mises-Fisher's if g is Gaussian.
    Restricted(Generator),
}

/// What stands for a base lobe at the bottom level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bottom {
    /// v.
    pub variance: f64,
    /// Its total variation distance from the base lobe.
    pub error: f64,
}

impl Family {
    /// The member whose variance is the base lobe's variance of slopes.
    pub fn matched(self, base: &BaseLobe) -> Bottom {
        self.member(base, base.spread())
    }

    /// The member nearest to the base lobe.
    pub fn fitted(self, base: &BaseLobe) -> Bottom {
        if matches!((self, base), (Self::Projected, BaseLobe::Beckmann { .. })) {
            return self.matched(base);
        }
        let spread = base.spread();
        let (variance, _) = least(spread / 16.0, spread * 16.0, |v| self.distance(base, v));
        self.member(base, variance)
    }

    fn member(self, base: &BaseLobe, variance: f64) -> Bottom {
        let exact = matches!((self, base), (Self::Projected, BaseLobe::Beckmann { .. }));
        let error = if exact { 0.0 } else { self.distance(base, variance) + ERROR };
        Bottom { variance, error }
    }

    /// How far the member of this variance is from the base lobe.
    pub fn distance(self, base: &BaseLobe, variance: f64) -> f64 {
        let peak = self.peak(variance);
        total_variation(base, |x| peak * self.shape(variance, x))
    }

    /// The value at the axis that gives a member unit energy.
    pub fn peak(self, variance: f64) -> f64 {
        match self {
            Self::Projected => 1.0 / (std::f64::consts::TAU * variance),
            Self::Restricted(_) => 1.0 / energy(|x| self.shape(variance, x)),
        }
    }

    /// A member where 1 − cos θ is `x`, over its value at the axis.
    fn shape(self, v: f64, x: f64) -> f64 {
        match self {
            Self::Projected if x >= 1.0 => 0.0,
            Self::Projected => {
                let t = tan_squared(x);
                exp64(-0.5 * t / v) * (1.0 + t) * (1.0 + t)
            }
            Self::Restricted(generator) => super::integral::fall(generator, 2.0 * x / v),
        }
    }
}
