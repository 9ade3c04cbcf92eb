//! Peaks and directions at random, the same at every run.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::fit::Peak;
use crate::geometry::Vec3;

/// Numbers evenly spread over [0, 1).
pub(super) struct Random(Pcg64Mcg);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    pub(super) fn next(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Even over the hemisphere above a height z.
    pub(super) fn direction(&mut self, above: f64) -> Vec3 {
        let z = above + (1.0 - above) * self.next();
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * self.next());
        let across = (1.0 - z * z).sqrt();
        Vec3::new(across * cos, across * sin, z)
    }

    /// Amplitude 0.3 to 1, up to 78° from the normal, exponent `from` to `to`, even in its logarithm.
    pub(super) fn peak(&mut self, from: f64, to: f64) -> Peak {
        let exponent = from * libm::exp(self.next() * libm::log(to / from));
        Peak { amplitude: 0.3 + 0.7 * self.next(), direction: self.direction(0.2), exponent }
    }

    /// Peaks that are 1½ times the sum of their widths 1/√n apart, a width being 18° at most.
    pub(super) fn separate(&mut self, count: usize, from: f64, to: f64) -> Vec<Peak> {
        let width = |p: &Peak| 1.0 / p.exponent.max(10.0).sqrt();
        let mut peaks: Vec<Peak> = Vec::new();
        while peaks.len() < count {
            let one = self.peak(from, to);
            let apart = |p: &Peak| {
                let angle = libm::acos(p.direction.dot(&one.direction).min(1.0));
                angle > 1.5 * (width(p) + width(&one))
            };
            if peaks.iter().all(apart) {
                peaks.push(one);
            }
        }
        peaks
    }

    /// As likely to be above 0 as below, of variance 1.
    pub(super) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.next())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.next())
    }
}
