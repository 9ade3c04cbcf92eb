//! Fournier's multiple surfaces (1992).

mod lookup;
mod pyramid;
mod shadow;

use std::sync::Arc;

pub use pyramid::{LevelCounts, count_fits};
pub use shadow::Shadowing;

use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::fit::{Directions, GreedyOptions};
use crate::geometry::HemisphereGrid;
use crate::lobe::BaseLobe;
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{HorizonMap, NormalMap};

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
/// # Masking and self-shadowing
/// With `shadowing` each peak carries the slopes of the horizon of its normals towards −x, +x, −y, +y, as
/// mean and standard deviation (§5), from the map's heights; where a map has none, from heights
/// integrated from its normals. See [`Shadowing`]. It changes what light a peak sends, not the peak.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fournier {
    /// When to stop adding peaks.
    pub greedy: GreedyOptions,
    /// Rings of the hemisphere grid.
    pub rings: usize,
    /// Directions in a ring.
    pub azimuths: usize,
    /// Whether fitted amplitudes are rescaled to keep the energy.
    pub rescaled: bool,
    /// What of a peak's light reaches the eye.
    pub shadowing: Shadowing,
}

impl Default for Fournier {
    /// As printed.
    fn default() -> Self {
        Self {
            greedy: GreedyOptions::default(),
            rings: 18,
            azimuths: 72,
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
    limits: "slow to build; a fit keeps energy within a percent or so, not exactly; Blinn-Phong base lobes only",
    normalised: true,
    keeps_roughness: true,
    precision: 0.05,
};

const PARAMETERS: &[Parameter] = &[
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
        name: "energy",
        meaning: "fitted: amplitudes as the fit gives them, as printed; rescaled: multiplied so that \
                  a cell's energy is that of its normals",
        domain: Domain::Choice { words: &["fitted", "rescaled"] },
    },
    Parameter {
        name: "shadowing",
        meaning: "none: every peak is seen and lit; printed: by the part of it that sees both light and                   eye over the horizon of its normals (§5); ratioed: what is seen then fills the pixel",
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
            greedy: GreedyOptions {
                max_peaks: values.whole("max_peaks"),
                stop: values.number("stop"),
                restarts: 0,
            },
            rings: values.whole("rings"),
            azimuths: values.whole("azimuths"),
            rescaled: values.word("energy") == "rescaled",
            shadowing: match values.word("shadowing") {
                "printed" => Shadowing::Printed,
                "ratioed" => Shadowing::Ratioed,
                _ => Shadowing::None,
            },
        }
    }
}

/// The exponent of a base lobe the method can take.
fn exponent(base: &BaseLobe) -> Result<f64, Refusal> {
    match *base {
        BaseLobe::BlinnPhong { exponent } if exponent.is_finite() && exponent > 0.0 => Ok(exponent),
        BaseLobe::BlinnPhong { exponent } => {
            Err(Refusal(format!("exponent {exponent} spreads no normal: it must be above 0")))
        }
        _ => Err(Refusal(format!(
            "Fournier's peaks are Phong lobes: a {} base lobe is none",
            base.name()
        ))),
    }
}

impl Method for Fournier {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal> {
        exponent(base).map(|_| 0.0)
    }

    fn needs_heights(&self) -> bool {
        self.shadowing != Shadowing::None
    }

    fn prefilter_work(&self) -> f64 {
        // A third of a cell is above each texel; a fit of one is a thousand samples, as measured.
        3000.0
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        let exponent = exponent(base)?;
        let levels = pyramid::build(self, map, exponent, progress)?;
        let stored = levels.iter().map(lookup::StoredLevel::new).collect();
        let peaks = lookup::PeakMap::new(Arc::clone(map), exponent, stored);
        if self.shadowing == Shadowing::None {
            return Ok(Box::new(peaks));
        }
        let grid = HemisphereGrid::new(self.rings, self.azimuths);
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
}

#[cfg(test)]
mod tests;
