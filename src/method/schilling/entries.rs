//! What the forms are called, and their options.

use super::Schilling;
use super::printed::{Reading, TRIANGULAR};
use crate::method::storage::STORAGE;
use crate::method::{Card, Entry};
use crate::parameter::{Domain, Parameter};

const SOURCE: &str = "Schilling 1997, Antialiasing of Bump-Maps, appendix A";

pub const CARDS: [Card; 4] = [
    Card {
        name: "schilling-isotropic",
        source: SOURCE,
        summary: "Mean slope and the largest slope variance of the footprint, one round lobe.",
        formula: "the base lobe's profile about the mean normal, variance σ₁² + 1/s in every direction",
        limits: "one round lobe: directional bumps blur to both sides, and widths do not pool: cells \
                 rough in different directions get wider lobes than all of them together",
        normalised: true,
        keeps_roughness: true,
        fractal: false,
        precision: 1e-3,
    },
    Card {
        name: "schilling-anisotropic",
        source: SOURCE,
        summary: "Mean slope and slope covariance of the footprint, one elliptical lobe.",
        formula: "the base lobe's profile about the mean normal, slope covariance K + I/s",
        limits: "one lobe: distributions with several peaks become one broad hill",
        normalised: true,
        keeps_roughness: true,
        fractal: false,
        precision: 1e-3,
    },
    Card {
        name: "schilling-isotropic-printed",
        source: SOURCE,
        summary: "The isotropic form with the paper's own lobe, which is not normalised.",
        formula: "cosᵐα′, cos²α′ = σ₁²cos²α / (1 − cos²α + σ₁²cos²α); σ₁² is m times the variance",
        limits: "not normalised: rough footprints shine too brightly, and widths do not pool",
        normalised: false,
        keeps_roughness: true,
        fractal: false,
        precision: 1e-3,
    },
    Card {
        name: "schilling-anisotropic-printed",
        source: SOURCE,
        summary: "The anisotropic form with the paper's own lobe, which is not normalised.",
        formula: "cosᵐα′, cos²α′ = cos²α / (d⁴/q + cos²α), q = |Dᵀd|² unless read otherwise; D Dᵀ is m \
                  times K + I/s",
        limits: "not normalised: rough footprints shine too brightly, and widths do not pool; read \
                 literally it is widest along a wrong axis",
        normalised: false,
        keeps_roughness: true,
        fractal: false,
        precision: TRIANGULAR,
    },
];

pub const EXPONENT: Parameter = Parameter {
    name: "exponent",
    meaning: "the constant exponent m, which shapes the highlight's border while roughness alone says how wide \
              it is; 0: the base lobe's",
    domain: Domain::Real { default: 0.0, min: 0.0, max: 1e6 },
};

pub const FALL: Parameter = Parameter {
    name: "fall",
    meaning: "how brightness falls with α′: power: cosᵐα′; gaussian: exp(−½ tan²α′), a fixed function of cos²α′ \
              with no exponent",
    domain: Domain::Choice { words: &["power", "gaussian"] },
};

const READING: Parameter = Parameter {
    name: "reading",
    meaning: "what q is: deviation: |Dᵀd|², the variance in the direction of d, as is evidently meant; literal: \
              |Dd|² as printed, widest along a wrong axis where slopes correlate; elliptical: d⁴/|D⁻¹d|², whose \
              contours are the ellipses of K",
    domain: Domain::Choice { words: &["deviation", "literal", "elliptical"] },
};

/// The registry's lines.
pub fn entries() -> [Entry; 4] {
    [
        Entry {
            card: CARDS[0],
            parameters: const { &[STORAGE] },
            build: |values| Box::new(Schilling::normalised(false, values)),
        },
        Entry {
            card: CARDS[1],
            parameters: const { &[STORAGE] },
            build: |values| Box::new(Schilling::normalised(true, values)),
        },
        Entry {
            card: CARDS[2],
            parameters: const { &[EXPONENT, FALL, STORAGE] },
            build: |values| Box::new(Schilling::printed(false, Reading::Deviation, values)),
        },
        Entry {
            card: CARDS[3],
            parameters: const { &[READING, EXPONENT, FALL, STORAGE] },
            build: |values| {
                let reading = match values.word(READING.name) {
                    "literal" => Reading::Literal,
                    "elliptical" => Reading::Elliptical,
                    _ => Reading::Deviation,
                };
                Box::new(Schilling::printed(true, reading, values))
            },
        },
    ]
}
