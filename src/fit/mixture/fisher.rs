//! Lobes of the von Mises-Fisher family, and the closed forms of their products.
//!
//! With η = κd a lobe is exp(λ − κ + η·ω). The product of two is exp(λ₁−κ₁ + λ₂−κ₂ + (η₁+η₂)·ω), and with
//! t = |η₁+η₂| its integrals over the sphere are derivatives of ∫ e^(η·ω) dω = 4π sinh t / t.

use std::f64::consts::TAU;

use crate::geometry::Vec3;
use crate::geometry::elementary::{exp64, ln64};

/// exp(λ + κ(d·ω − 1)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fisher {
    /// κd.
    pub natural: Vec3,
    /// κ > 1.
    pub kappa: f64,
    /// λ: the logarithm of the density at the peak.
    pub log_peak: f64,
}

/// e^−t times the integrals of e^(η·ω), |η| = t: over 1, and over (ω·η/t) and its square.
pub(super) struct Integrals {
    pub zeroth: f64,
    pub first: f64,
    pub second: f64,
}

/// Below this t the integrals are those at it: their series' next terms are 10⁻⁵, and what they stand
/// for, two equally wide lobes in opposite directions, does not meet.
pub(super) const LEAST: f64 = 1e-2;

impl Integrals {
    pub fn at(t: f64) -> Self {
        let t = t.max(LEAST);
        let (over, tail) = (1.0 / t, exp64(-2.0 * t));
        let (sinh, cosh) = (1.0 - tail, 1.0 + tail);
        Self {
            zeroth: TAU * over * sinh,
            first: TAU * over * (cosh - sinh * over),
            second: TAU * over * (sinh - 2.0 * over * (cosh - sinh * over)),
        }
    }
}

/// κ for the Phong peak of exponent n: of the peaks with the same vector moment the nearest in squared
/// difference has n between κ − 0.9 and κ − 1.25 for all κ; 1 keeps every n > 0 in range.
pub(super) fn kappa_of(exponent: f64) -> f64 {
    exponent + 1.0
}

impl Fisher {
    /// The lobe that stands for the Phong peak of this direction and exponent whose vector moment has
    /// length `strength` > 0.
    pub fn new(direction: Vec3, exponent: f64, strength: f64) -> Self {
        let kappa = kappa_of(exponent);
        let log_peak = ln64((strength / Integrals::at(kappa).first).max(f64::MIN_POSITIVE));
        Self { natural: direction * kappa, kappa, log_peak }
    }

    /// Length of the vector moment ∫ lobe(ω) ω dω.
    pub fn strength(&self) -> f64 {
        exp64(self.log_peak) * Integrals::at(self.kappa).first
    }

    /// Unit direction.
    pub fn direction(&self) -> Vec3 {
        self.natural / self.kappa
    }

    /// The vector moment.
    pub fn moment(&self) -> Vec3 {
        self.direction() * self.strength()
    }

    /// Exponent of the Phong peak it stands for.
    pub fn exponent(&self) -> f64 {
        self.kappa - 1.0
    }

    /// η₁+η₂, its length, and the product's scale exp(λ₁−κ₁ + λ₂−κ₂ + t), by which [`Integrals`] are to be
    /// multiplied.
    pub fn times(&self, other: &Self) -> (Vec3, f64, f64) {
        let sum = self.natural + other.natural;
        let t = sum.norm().max(LEAST);
        let log = self.log_peak + other.log_peak + t - self.kappa - other.kappa;
        (sum, t, exp64(log))
    }
}
