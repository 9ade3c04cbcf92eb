//! Normal distribution mapping (Olano and North 1997).
//!
//! The distribution under a footprint is a 3D Gaussian restricted to the sphere: nine numbers, a mean
//! u and raw second moments E₂, which filter linearly; S = E₂ − uᵀu. A texel starts as a Gaussian of
//! mean n and isotropic covariance v·I, which restricted to the sphere is a von Mises-Fisher lobe.

mod factors;
mod family;
mod integral;
mod moments;
mod printed;
mod projected;

use std::sync::Arc;

use super::one_lobe::OneLobeMap;
use super::storage::{STORAGE, Storage};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::{BaseLobe, Generator};
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::NormalMap;
use factors::Factors;
use family::{Bottom, Family};
use moments::NineNumbers;
use printed::Printed;
use projected::Projected;

/// Olano and North's filter, shaded in one of the paper's three ways (§6).
///
/// - *Printed*, the way of its pictures: Pearson II, divided by √det S alone. Its constant is chosen so that a
///   single normal has unit energy.
/// - *Factors*: the same density, or the Gaussian itself, times a normalisation factor that is integrated
///   numerically for each cell of the pyramid and interpolated between them: exact in the middle of a cell.
/// - *Projected*: "re-approximate with a projected 2D Gaussian for rendering". The Gaussian restricted to the
///   plane that touches the sphere at the mean direction n, μ = Tᵀu + S_tr (1 − n·u)/S_rr,
///   C = S_tt − S_tr S_trᵀ/S_rr, projected onto the sphere; its integral is known in closed form, and its
///   amplitude is |u|, the footprint's own.
///
/// # Base lobe
/// The variance v of the bottom level stands for the base lobe. It is *fitted*: the one for which a single
/// normal comes nearest to the base lobe in total variation; or *matched*: the base lobe's own variance of
/// slopes. A Gaussian has no heavy tails to give a GGX lobe, and no variance matches an infinite one; but one
/// comes nearest to it as to any lobe, and how near that is is what [`Method::base_error`] tells.
///
/// # Storage
/// Written as whole numbers, u has the range of the map's largest weight, E₂ that times 1 + v: what a single
/// normal can have. With 8 bits the difference E₂ − uᵀu of most texels is no covariance, so what is read is
/// held to at least half of v in every direction. Normalisation factors stay in single precision.
#[derive(Clone, Copy, Debug)]
pub struct OlanoNorth {
    form: Form,
    matched: bool,
    storage: Storage,
}

/// How a 3D Gaussian is shaded.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Projected,
    Printed(Generator),
    Factors(Generator),
}

const CARDS: [Card; 3] = [
    Card {
        name: "olano-north",
        source: "Olano and North 1997, Normal Distribution Mapping, §6 (projected 2D Gaussian)",
        summary: "Nine linear moments of the normals; a Gaussian on the plane touching the mean.",
        formula: "N₂(Tᵀh/(n·h); μ, C)/(n·h)⁴ with S = E₂ − uᵀu cut by the plane n·x = 1",
        limits: "one Gaussian: several peaks become one hill, and heavy tails (GGX) are out of reach",
        normalised: true,
        keeps_roughness: true,
        fractal: false,
        precision: 1e-3,
    },
    Card {
        name: "olano-north-factors",
        source: "Olano and North 1997, Normal Distribution Mapping, §6 (normalisation factors)",
        summary: "The same nine moments, shaded by the restricted Gaussian itself, its integral a tenth.",
        formula: "F g(q)/√det S, q = (h − u) S⁻¹ (h − u)ᵀ, F = |u|/∫ g(q)/√det S (n·h) dω",
        limits: "factors are right in the middle of a cell and interpolated between; slower to build; one \
                 Gaussian: several peaks become one hill",
        normalised: true,
        keeps_roughness: true,
        fractal: false,
        precision: 1e-3,
    },
    Card {
        name: "olano-north-printed",
        source: "Olano and North 1997, Normal Distribution Mapping, §6 (as in its pictures)",
        summary: "The same nine moments, shaded by an unnormalised Pearson II.",
        formula: "(1 − q/2m)ᵐ/√det S, q = (h − u) S⁻¹ (h − u)ᵀ, m = 8",
        limits: "not normalised over the sphere: brightness drifts with roughness",
        normalised: false,
        keeps_roughness: true,
        fractal: false,
        precision: 1e-3,
    },
];

const VARIANCE: Parameter = Parameter {
    name: "variance",
    meaning: "the variance that stands for the base lobe: fitted: the one that comes nearest to it; matched: its \
              own slope variance",
    domain: Domain::Choice { words: &["fitted", "matched"] },
};

const M: Parameter = Parameter {
    name: "m",
    meaning: "Pearson II's constant: the larger, the nearer to a Gaussian",
    domain: Domain::Whole { default: 8, min: 1, max: Generator::MOST },
};

const DENSITY: Parameter = Parameter {
    name: "density",
    meaning: "gaussian: e^(−q/2); pearson: (1 − q/2m)ᵐ",
    domain: Domain::Choice { words: &["gaussian", "pearson"] },
};

/// The registry's lines.
pub(super) fn entries() -> [Entry; 3] {
    [
        Entry {
            card: CARDS[0],
            parameters: const { &[VARIANCE, STORAGE] },
            build: |values| Box::new(OlanoNorth::new(Form::Projected, values)),
        },
        Entry {
            card: CARDS[1],
            parameters: const { &[DENSITY, M, VARIANCE, STORAGE] },
            build: |values| {
                let generator = match values.word(DENSITY.name) {
                    "pearson" => pearson(values),
                    _ => Generator::Gaussian,
                };
                Box::new(OlanoNorth::new(Form::Factors(generator), values))
            },
        },
        Entry {
            card: CARDS[2],
            parameters: const { &[M, VARIANCE, STORAGE] },
            build: |values| Box::new(OlanoNorth::new(Form::Printed(pearson(values)), values)),
        },
    ]
}

fn pearson(values: &Values) -> Generator {
    Generator::Pearson { m: values.whole(M.name) as u32 }
}

impl OlanoNorth {
    fn new(form: Form, values: &Values) -> Self {
        let matched = values.word(VARIANCE.name) == "matched";
        Self { form, matched, storage: Storage::of(values) }
    }

    fn family(&self) -> Family {
        match self.form {
            Form::Projected => Family::Projected,
            Form::Printed(generator) | Form::Factors(generator) => Family::Restricted(generator),
        }
    }

    /// What stands for the base lobe at the bottom level.
    fn bottom(&self, base: &BaseLobe) -> Result<Bottom, Refusal> {
        match base {
            BaseLobe::Ggx { .. } if self.matched => Err(Refusal(
                "a GGX lobe has no variance of slopes to match, it is infinite: `variance = \"fitted\"` \
                 takes the Gaussian nearest to it"
                    .into(),
            )),
            _ if self.matched => Ok(self.family().matched(base)),
            _ => Ok(self.family().fitted(base)),
        }
    }

    /// What rounding adds to the distance from the base lobe at a single normal, of a map of unit weights,
    /// as measured: S is off by up to two half steps of u and one of E₂ in every element.
    fn rounding(&self, variance: f64) -> f64 {
        2.0 * self.storage.half_step() / variance
    }
}

impl Method for OlanoNorth {
    fn card(&self) -> Card {
        let card = match self.form {
            Form::Projected => CARDS[0],
            Form::Factors(_) => CARDS[1],
            Form::Printed(_) => CARDS[2],
        };
        // A half step of u, of weights up to some times the mean's.
        let rounding = 10.0 * self.storage.half_step();
        Card { precision: card.precision.max(rounding), ..card }
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        let Bottom { variance, error } = self.bottom(base)?;
        Ok(error + self.rounding(variance))
    }

    fn prefilter_work(&self) -> f64 {
        // As measured: integrals of a third of a cell a texel.
        if matches!(self.form, Form::Factors(_)) { 100.0 } else { 1.0 }
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        let Bottom { variance, .. } = self.bottom(base)?;
        let nine = NineNumbers::new(variance, self.storage, map);
        Ok(match self.form {
            Form::Projected => {
                let built = OneLobeMap::build(map, base, Projected { nine });
                self.storage.sized(built, map, 9, 0)
            }
            Form::Printed(generator) => {
                let built = OneLobeMap::build(map, base, Printed::new(nine, generator, variance));
                self.storage.sized(built, map, 9, 0)
            }
            Form::Factors(generator) => {
                let built = OneLobeMap::build(map, base, Factors::new(nine, generator));
                self.storage.sized(built, map, 9, 1)
            }
        })
    }
}

#[cfg(test)]
mod tests;
