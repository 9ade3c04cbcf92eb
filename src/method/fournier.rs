//! Fournier's multiple surfaces (1992).

mod counts;
mod lookup;
mod pyramid;
mod shadow;
mod stored;

use std::sync::Arc;

pub use counts::{LevelCounts, count_fits};
pub use shadow::Shadowing;

use super::{Card, Damaged, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::fit::{Directions, GreedyOptions};
use crate::geometry::HemisphereGrid;
use crate::lobe::BaseLobe;
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{HorizonMap, Lookup, NormalMap};

/// Up to 7 Phong peaks a cell of a pyramid, fitted to what the normals below spread to.
///
/// Each level is computed from the map itself, not from the level below (§2.4). A cell with at most
/// `max_peaks` distinct normals keeps them as they are; others are fitted, a peak more at a time (§2.3),
/// on the hemisphere grid of `rings` × `azimuths` directions.
///
/// # Narrow base lobes
/// The paper's grid has a direction every 5°. A base lobe of exponent s falls to half at an angle of
/// about √(2 ln 2 / s): 6.7° at s = 100, 4.8° at 200. From there on normals fall between the directions,
/// and a fit may set narrow peaks on single samples that look right at the grid and nowhere else. Give
/// more rings and azimuths then (36 × 144 for exponents up to 800); time grows with their product.
///
/// # Energy
/// A fit minimises squared differences of density, not of the integral: the printed method gains or
/// loses a little light (`energy = "fitted"`), less than its stopping rule lets the density differ. On
/// smooth bumps and on a hemisphere it is below half a percent. With `energy = "rescaled"` a fitted
/// cell's amplitudes are multiplied so that its vector moment along its mean normal is exactly that of
/// its normals.
///
/// # Fast
/// With `mode = "fast"` nothing is sampled: a cell's normals are gathered by direction and represented by
/// [`crate::fit::mixture`], whose integrals have closed forms. `max_peaks` and `stop` mean what they do in the
/// paper's mode, by those integrals; the energy is kept exactly; no grid can be too coarse for narrow lobes.
///
/// # Masking and self-shadowing
/// With `shadowing` each peak carries the slopes of the horizon of its normals towards −x, +x, −y, +y, as
/// mean and standard deviation (§5), from the map's heights; where a map has none, from heights
/// integrated from its normals. See [`Shadowing`]. It changes what light a peak sends, not the peak.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fournier {
    /// How a cell's peaks are found.
    pub mode: Mode,
    /// When to stop adding peaks.
    pub greedy: GreedyOptions,
    /// Rings of the hemisphere grid.
    pub rings: usize,
    /// Directions in a ring.
    pub azimuths: usize,
    /// How far directions are moved within their cells, 0 to 1.
    pub jitter: f64,
    /// Whether fitted amplitudes are rescaled to keep the energy.
    pub rescaled: bool,
    /// What of a peak's light reaches the eye.
    pub shadowing: Shadowing,
}

/// How a cell's peaks are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// As in the paper: a least-squares fit to the distribution sampled over the hemisphere.
    #[default]
    Paper,
    /// A mixture in closed form: [`crate::fit::mixture`].
    Fast,
}

impl Default for Fournier {
    /// As printed.
    fn default() -> Self {
        Self {
            mode: Mode::Paper,
            greedy: GreedyOptions::default(),
            rings: 18,
            azimuths: 72,
            jitter: 0.0,
            rescaled: false,
            shadowing: Shadowing::None,
        }
    }
}

/// The most peaks a cell may have.
pub(super) const MOST_PEAKS: usize = 12;

const CARD: Card = Card {
    name: "fournier",
    source: "Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces, §2",
    summary: "Fits up to 7 Phong peaks to the normals under each cell of a pyramid.",
    formula: "Σ aᵢ cosⁿⁱ over the peaks of 4 cells and 2 levels, amplitudes weighted, never averaged",
    limits: "slow to build as printed, and a fit then keeps energy within a percent or so, not exactly; the fast \
             mode is less close where normals lie near the horizon; Blinn-Phong base lobes only",
    normalised: true,
    keeps_roughness: true,
    fractal: false,
    precision: 0.05,
};

const PARAMETERS: &[Parameter] = &[
    Parameter {
        name: "mode",
        meaning: "paper: fits to the distribution sampled over the hemisphere; fast: mixtures in \
                  closed form, without samples, which keep energy exactly",
        domain: Domain::Choice { words: &["paper", "fast"] },
    },
    Parameter {
        name: "max_peaks",
        meaning: "the most peaks a cell may have; as many distinct normals are kept as they are",
        domain: Domain::Whole { default: 7, min: 1, max: MOST_PEAKS as u32 },
    },
    Parameter {
        name: "stop",
        meaning: "a fit is good enough when its residual's rms and maximum are both below this part \
                  of the distribution's",
        domain: Domain::Real { default: 0.05, min: 0.0, max: 1.0 },
    },
    Parameter {
        name: "rings",
        meaning: "rings of the hemisphere grid, 90°/rings apart; exponents above 200 need more than 18",
        domain: Domain::Whole { default: 18, min: 2, max: 180 },
    },
    Parameter {
        name: "azimuths",
        meaning: "directions in a ring of the hemisphere grid",
        domain: Domain::Whole { default: 72, min: 4, max: 720 },
    },
    Parameter {
        name: "jitter",
        meaning: "how far each direction of the grid is moved within its cell, at random but always the same",
        domain: Domain::Real { default: 0.0, min: 0.0, max: 1.0 },
    },
    Parameter {
        name: "energy",
        meaning: "fitted: amplitudes as the fit gives them, as printed; rescaled: multiplied so that \
                  a cell's energy is that of its normals",
        domain: Domain::Choice { words: &["fitted", "rescaled"] },
    },
    Parameter {
        name: "shadowing",
        meaning: "none: every peak is seen and lit; printed: by the part of it that sees both light and \
                  eye over the horizon of its normals (§5); ratioed: what is seen then fills the pixel",
        domain: Domain::Choice { words: &["none", "printed", "ratioed"] },
    },
];

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry { card: CARD, parameters: PARAMETERS, build: |values| Box::new(Fournier::new(values)) }
}

impl Fournier {
    fn new(values: &Values) -> Self {
        Self {
            mode: if values.word("mode") == "fast" { Mode::Fast } else { Mode::Paper },
            greedy: GreedyOptions {
                max_peaks: values.whole("max_peaks"),
                stop: values.number("stop"),
                restarts: 0,
            },
            rings: values.whole("rings"),
            azimuths: values.whole("azimuths"),
            jitter: values.number("jitter"),
            rescaled: values.word("energy") == "rescaled",
            shadowing: match values.word("shadowing") {
                "printed" => Shadowing::Printed,
                "ratioed" => Shadowing::Ratioed,
                _ => Shadowing::None,
            },
        }
    }
}

/// The largest exponent of a base lobe whose normals can be fitted, and of a peak that can come of them.
const FITTED: f64 = 1e4;
/// The largest exponent of a base lobe in the fast mode: single precision resolves no narrower lobe.
const MIXED: f64 = 1e6;

/// What the exponents of peaks may be, for normals spread with this base exponent.
fn widest_range(exponent: f64) -> std::ops::RangeInclusive<f32> {
    0.0..=exponent.max(FITTED) as f32
}

impl Fournier {
    /// The directions in which distributions are sampled.
    fn grid(&self) -> HemisphereGrid {
        HemisphereGrid::jittered(self.rings, self.azimuths, self.jitter, 0)
    }

    /// The exponent of a base lobe the method can take.
    fn exponent(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        let BaseLobe::BlinnPhong { exponent } = *base else {
            let name = base.name();
            return refused(format!(
                "Fournier's peaks are Phong lobes: a {name} base lobe is none"
            ));
        };
        let most = if self.mode == Mode::Fast { MIXED } else { FITTED };
        if exponent.is_nan() || exponent <= 0.0 {
            refused(format!("exponent {exponent} spreads no normal: it must be above 0"))
        } else if exponent > most {
            let other =
                if self.mode == Mode::Fast { "" } else { ", or to 1000000 with mode = \"fast\"" };
            refused(format!("exponent {exponent} is out of reach: fits go up to {most}{other}"))
        } else {
            Ok(exponent)
        }
    }
}

fn refused<T>(why: String) -> Result<T, Refusal> {
    Err(Refusal(why))
}

impl Method for Fournier {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        self.exponent(base).map(|_| 0.0)
    }

    fn lookups(&self) -> &'static [Lookup] {
        // Peaks made for a footprint alone have no horizons: those are of cells.
        let all = &Lookup::ALL;
        if self.shadowing == Shadowing::None { all } else { &all[..all.len() - 1] }
    }

    fn needs_heights(&self) -> bool {
        self.shadowing != Shadowing::None
    }

    fn prefilter_work(&self) -> f64 {
        // As measured: a third of a cell is above each texel, and a fit is a thousand samples' work and more.
        match self.mode {
            Mode::Paper => 3000.0,
            Mode::Fast => 300.0,
        }
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        let exponent = self.exponent(base)?;
        let levels = pyramid::build(self, map, exponent, progress)?;
        let stored = levels.iter().map(lookup::StoredLevel::new).collect();
        let peaks = lookup::PeakMap::new(Arc::clone(map), *self, exponent, stored);
        if self.shadowing == Shadowing::None {
            return Ok(Box::new(peaks));
        }
        let grid = self.grid();
        let collector = shadow::Collector {
            map,
            texels: HorizonMap::of(&map.heights_or_integrated()),
            exponent,
            directions: Directions::new(grid.clone()),
            grid,
            max_peaks: self.greedy.max_peaks,
            cancelled: &|| progress.cancelled(),
        };
        let ratioed = self.shadowing == Shadowing::Ratioed;
        let shadowed = shadow::shadowed(peaks, collector, ratioed);
        Ok(Box::new(shadowed.ok_or(PrefilterError::Cancelled)?))
    }

    fn restore(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        bytes: &[u8],
    ) -> Result<Box<dyn Prefiltered>, Damaged> {
        let exponent = self.exponent(base).map_err(|refusal| Damaged(refusal.0))?;
        let stored = stored::from_bytes(map, exponent, self.shadowing != Shadowing::None, bytes)?;
        let peaks = lookup::PeakMap::new(Arc::clone(map), *self, exponent, stored.levels);
        if self.shadowing == Shadowing::None {
            return Ok(Box::new(peaks));
        }
        let texels = HorizonMap::of(&map.heights_or_integrated());
        let (levels, ratioed) = (stored.horizons, self.shadowing == Shadowing::Ratioed);
        Ok(Box::new(shadow::ShadowedPeakMap { peaks, texels, levels, ratioed }))
    }
}

#[cfg(test)]
mod tests;
