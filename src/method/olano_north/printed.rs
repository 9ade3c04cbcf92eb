//! The unnormalised density of the paper's pictures.

use super::family::Family;
use super::moments::{Gaussian3, NineNumbers};
use crate::lobe::vector::Sym2;
use crate::lobe::{Generator, RestrictedLobe};
use crate::method::one_lobe::OneLobe;
use crate::texture::{Moments, Texel};

pub struct Printed {
    nine: NineNumbers,
    generator: Generator,
    /// The amplitude that gives a single normal unit energy.
    unit_peak: f32,
}

impl Printed {
    pub fn new(nine: NineNumbers, generator: Generator, variance: f64) -> Self {
        let unit_peak = Family::Restricted(generator).peak(variance) as f32;
        Self { nine, generator, unit_peak }
    }
}

impl Moments<9> for Printed {
    #[inline(always)]
    fn encode(&self, texel: Texel) -> [f32; 9] {
        self.nine.encode(texel)
    }

    #[inline(always)]
    fn store(&self, moments: [f32; 9]) -> [f32; 9] {
        self.nine.round(moments)
    }
}

impl OneLobe<9> for Printed {
    type Lobe = RestrictedLobe;

    #[inline(always)]
    fn lobe(&self, channels: [f32; 9]) -> RestrictedLobe {
        let Gaussian3 { weight, cut } = self.nine.gaussian(channels);
        let v = self.nine.variance;
        let narrower = (v / cut.radial).sqrt() * v * per_root_determinant(cut.across);
        RestrictedLobe::new(cut, weight * self.unit_peak * narrower, self.generator)
    }
}

/// 1/√det C, of a C whose eigenvalues are above 0.
#[inline(always)]
pub fn per_root_determinant([a, b, c]: Sym2) -> f32 {
    1.0 / (a * c - b * b).max(f32::MIN_POSITIVE).sqrt()
}
