//! Antialiasing of bump maps (Schilling 1997).
//!
//! A bump pyramid keeps the mean of the perturbation vectors (slopes), a roughness pyramid their
//! covariance K over each cell, both filtered like any mip map. Shading widens the lobe by K.
//!
//! The recursive rule of the paper, K_l = ¼ Σ K_{l−1} + ¼ Σ (xᵢ − x̄)(xᵢ − x̄)ᵀ, equals the covariance
//! over the whole cell, so the pyramid here averages raw moments and takes K at each level. The base
//! roughness, I/s, is folded in at the bottom. What is stored is central, so the *spread of the means*
//! of neighbouring cells is not part of an interpolated roughness.
//!
//! The paper stores, and lookups interpolate, D = (d₁ d₂; 0 d₃) with D Dᵀ = K, or σ₁ alone. Two cells whose
//! d₂ have opposite signs then lose d₂² of the variance along u, and none along v: between cells the result
//! depends on how the map is turned. The printed forms keep that; the normalised ones interpolate K
//! itself, whose interpolation is the mean of the cells' covariances.

mod entries;
mod normalised;
mod printed;
mod roughness;

use std::sync::Arc;

use super::nearness;
use super::one_lobe::OneLobeMap;
use super::storage::Storage;
use super::{Card, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::BaseLobe;
use crate::parameter::Values;
use crate::texture::NormalMap;
pub(super) use entries::entries;
use entries::{CARDS, EXPONENT, FALL};
use normalised::Normalised;
use printed::{Printed, Reading, Shape};
use roughness::Codes;

/// Schilling's filter in one of four forms.
///
/// *Anisotropic* uses all of K, *isotropic* its larger eigenvalue σ₁² alone, "a conservative
/// approximation". The *printed* form shades with the modified Blinn-Phong model of appendix A, which
/// is not normalised ([`crate::lobe::PedalLobe`]), in any of its readings. The *normalised* form puts the
/// same covariance into the base lobe's own slope profile ([`crate::lobe::EllipticLobe`]), exactly
/// elliptical and of unit integral:
/// - slopes are weighted by w·n_z, as the microfacet measure asks (see [`crate::lobe`]), so that the
///   mean slope is that of the mean normal and the amplitude that of the footprint;
/// - K, measured in the surface's tangent frame, is carried to the frame of the mean normal, where a
///   tilted normal's base lobe is round again.
///
/// # Storage
/// A cell keeps its weight, its mean slope, and D or σ₁ (d₂ with a sign, the others without). Written as whole
/// numbers, slopes have the range of the map's largest, deviations that of the largest of any cell, weights
/// that of the largest; a deviation that would be 0 is one step. Level 0 is read from the normal map and
/// rounded as it is read. In single precision the normalised forms keep K in place of D or σ₁.
#[derive(Clone, Copy, Debug)]
pub struct Schilling {
    anisotropic: bool,
    storage: Storage,
    /// The printed lobe, if not the normalised one.
    printed: Option<PrintedLobe>,
}

/// Which of the printed lobes.
#[derive(Clone, Copy, Debug)]
struct PrintedLobe {
    reading: Reading,
    /// The constant exponent m; None for the base lobe's own.
    exponent: Option<f64>,
    gaussian: bool,
}

impl Schilling {
    fn normalised(anisotropic: bool, values: &Values) -> Self {
        Self { anisotropic, storage: Storage::of(values), printed: None }
    }

    fn printed(anisotropic: bool, reading: Reading, values: &Values) -> Self {
        let exponent = values.number(EXPONENT.name);
        let printed = PrintedLobe {
            reading,
            exponent: (exponent > 0.0).then_some(exponent),
            gaussian: values.word(FALL.name) == "gaussian",
        };
        Self { anisotropic, storage: Storage::of(values), printed: Some(printed) }
    }

    /// Numbers of a cell as the paper has them.
    fn numbers(&self) -> usize {
        if self.anisotropic { 6 } else { 4 }
    }

    /// What rounding adds to the distance from the base lobe at a single normal, on maps whose slopes and
    /// deviations stay under 1: a lobe of deviation σ moved by δ is 0.5 δ/σ off at most, one widened by a
    /// part ε is 0.74 ε off.
    fn rounding(&self, base: &BaseLobe) -> f64 {
        let moved = 0.5 * std::f64::consts::SQRT_2;
        let widened = if self.printed.is_some() { 0.74 } else { 0.0 };
        (moved + widened) * self.storage.half_step() / base.spread().sqrt()
    }
}

impl PrintedLobe {
    /// The lobe's shape for a base lobe.
    fn shape(&self, base: &BaseLobe) -> Result<Shape, Refusal> {
        match (*base, self.exponent) {
            (BaseLobe::Ggx { .. }, _) => Err(Refusal(
                "the width of the paper's lobe is a variance, and that of a GGX lobe is infinite".into(),
            )),
            _ if self.gaussian => Ok(Shape::gaussian(base)),
            (_, Some(exponent)) => Ok(Shape::power(base, exponent)),
            (BaseLobe::BlinnPhong { exponent }, None) => Ok(Shape::power(base, exponent)),
            (BaseLobe::Beckmann { .. }, None) => Err(Refusal(
                "the paper's lobe is a modified Blinn-Phong, and a beckmann lobe has no exponent for it: \
                 give one, or `fall = \"gaussian\"`"
                    .into(),
            )),
        }
    }
}

impl Method for Schilling {
    fn card(&self) -> Card {
        let card = CARDS[usize::from(self.anisotropic) + 2 * usize::from(self.printed.is_some())];
        let reading = self.printed.map_or(0.0, |printed| printed.reading.precision());
        // Half steps of weight, slope and deviation, each up to a few parts of its range.
        let rounding = 6.0 * self.storage.half_step();
        Card { precision: card.precision.max(reading).max(rounding), ..card }
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        let shape = match self.printed {
            None => 0.0,
            Some(printed) => {
                let shape = printed.shape(base)?;
                if shape.is(base) {
                    0.0
                } else {
                    nearness::total_variation(base, |x| shape.density(x)) + nearness::ERROR
                }
            }
        };
        Ok(shape + self.rounding(base))
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        let (base, anisotropic) = (*base, self.anisotropic);
        Ok(match self.printed {
            None => {
                let float = Normalised { base, anisotropic, codes: None };
                let codes = Codes::of(self.storage, map, |cell| float.written(cell), &float);
                let built = OneLobeMap::build(map, &base, Normalised { codes, ..float });
                match self.storage {
                    Storage::Float => Box::new(built),
                    storage => storage.sized(built, map, self.numbers(), 0),
                }
            }
            Some(printed) => {
                let shape = printed.shape(&base)?;
                let reading = printed.reading;
                let float = Printed { shape, reading, anisotropic, codes: None };
                let codes = Codes::of(self.storage, map, |cell| float.written(cell), &float);
                let built = OneLobeMap::build(map, &base, Printed { codes, ..float });
                self.storage.sized(built, map, self.numbers(), 0)
            }
        })
    }
}

#[cfg(test)]
mod tests;
