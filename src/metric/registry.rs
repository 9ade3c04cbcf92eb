//! Every metric of images, with its variants: one table.
//!
//! # Variants
//! Tools agree on names and differ in formulas. `NAME:TOOL` is what that tool computes:
//! - **pbrt**: pbrt-v4's `imgtool diff` (`util/image.cpp`, `Image::MRSE`): (A − R)² / (R + 0.01)², ε within the
//!   square. Pixels whose error is infinite add nothing there; here they make the score infinite, and it is left out.
//! - **tev**: tev (`Common.h`, `applyMetric`): relative squared error (A − R)² / (R² + 0.01) and relative absolute
//!   error |A − R| / (R + 0.01), whose mean it shows. Early releases had 0.0001 in the first.
//! - **jeri**: JERI (`shaders/frag.glsl`): MRSE (A − R)² / (R² + 0.0001), MAPE |A − R| / (|R| + 0.01), SMAPE
//!   2 |A − R| / (|A| + |R| + 0.02). It holds what it reads to \[0, 1024\] first; here nothing is held.
//!
//! The metrics' own ε scale with the reference, so that they do not depend on exposure.

use super::pixelwise::{self as of, DARK, HIGHLIGHT, Level, Outer, Pixelwise};
use super::{Best, Measure, Metric, flip, luminance, ms_ssim, ssim};

/// Every metric, in the order tables show them.
pub fn entries() -> &'static [Metric] {
    ENTRIES
}

/// The metric of this name.
pub fn find(name: &str) -> Option<&'static Metric> {
    entries().iter().find(|metric| metric.name == name)
}

/// √[`DARK`].
const DIM: f64 = 0.1;

const MEAN_SQUARE: Pixelwise = Pixelwise::mean(of::squared);

static ENTRIES: &[Metric] = &[
    Metric {
        name: "rmse",
        meaning: "root mean square error",
        formula: "√ mean (A − R)²",
        best: Best::Lowest,
        swept: true,
        measure: Measure::Pixelwise(MEAN_SQUARE.outer(Outer::Root)),
    },
    Metric {
        name: "mse",
        meaning: "mean square error",
        formula: "mean (A − R)²",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(MEAN_SQUARE),
    },
    Metric {
        name: "mae",
        meaning: "mean absolute error",
        formula: "mean |A − R|",
        best: Best::Lowest,
        swept: true,
        measure: Measure::Pixelwise(Pixelwise::mean(of::absolute)),
    },
    Metric {
        name: "relmse",
        meaning: "mean square error relative to the reference",
        formula: "mean (A − R)² / (R² + ε), ε = 0.01 (mean R)²",
        best: Best::Lowest,
        swept: true,
        measure: Measure::Pixelwise(
            Pixelwise::mean(of::relative_squared).level(Level::OfSquaredMean(DARK)),
        ),
    },
    Metric {
        name: "relmse:pbrt",
        meaning: "mean relative square error as pbrt-v4 has it (MRSE)",
        formula: "mean (A − R)² / (R + ε)², ε = 0.01",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(Pixelwise::mean(of::shifted_squared).level(Level::Fixed(0.01))),
    },
    Metric {
        name: "relmse:tev",
        meaning: "mean relative square error as tev has it (RSE)",
        formula: "mean (A − R)² / (R² + ε), ε = 0.01",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(
            Pixelwise::mean(of::relative_squared).level(Level::Fixed(0.01)),
        ),
    },
    Metric {
        name: "relmse:jeri",
        meaning: "mean relative square error as JERI has it (MRSE)",
        formula: "mean (A − R)² / (R² + ε), ε = 0.0001",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(
            Pixelwise::mean(of::relative_squared).level(Level::Fixed(0.0001)),
        ),
    },
    Metric {
        name: "mape",
        meaning: "mean absolute error relative to the reference, 1 for 100 percent",
        formula: "mean |A − R| / (|R| + ε), ε = 0.1 mean R",
        best: Best::Lowest,
        swept: true,
        measure: Measure::Pixelwise(Pixelwise::mean(of::relative).level(Level::OfMean(DIM))),
    },
    Metric {
        name: "mape:tev",
        meaning: "mean relative absolute error as tev has it (RAE)",
        formula: "mean |A − R| / (R + ε), ε = 0.01",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(Pixelwise::mean(of::relative_signed).level(Level::Fixed(0.01))),
    },
    Metric {
        name: "mape:jeri",
        meaning: "mean absolute percentage error as JERI has it (MAPE)",
        formula: "mean |A − R| / (|R| + ε), ε = 0.01",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(Pixelwise::mean(of::relative).level(Level::Fixed(0.01))),
    },
    Metric {
        name: "smape",
        meaning: "mean absolute error relative to image and reference, from 0 to 2",
        formula: "mean 2 |A − R| / (|A| + |R| + 2 ε), ε = 0.1 mean R",
        best: Best::Lowest,
        swept: true,
        measure: Measure::Pixelwise(Pixelwise::mean(of::symmetric).level(Level::OfMean(DIM))),
    },
    Metric {
        name: "smape:jeri",
        meaning: "symmetric mean absolute percentage error as JERI has it (SMAPE)",
        formula: "mean 2 |A − R| / (|A| + |R| + 2 ε), ε = 0.01",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Pixelwise(Pixelwise::mean(of::symmetric).level(Level::Fixed(0.01))),
    },
    Metric {
        name: "psnr",
        meaning: "peak signal-to-noise ratio in decibels",
        formula: "10 log₁₀ (L² / mean (A − R)²), L = max R",
        best: Best::Highest,
        swept: true,
        measure: Measure::Pixelwise(MEAN_SQUARE.outer(Outer::Decibels).level(Level::Range)),
    },
    Metric {
        name: "psnr:unit",
        meaning: "peak signal-to-noise ratio in decibels, white taken as 1",
        formula: "10 log₁₀ (L² / mean (A − R)²), L = 1",
        best: Best::Highest,
        swept: false,
        measure: Measure::Pixelwise(MEAN_SQUARE.outer(Outer::Decibels).level(Level::Fixed(1.0))),
    },
    Metric {
        name: "ssim",
        meaning: "structural similarity (Wang et al. 2004), 1 for equal images",
        formula: "mean over windows of (2 μ_A μ_R + C₁)(2 σ_AR + C₂) / ((μ_A² + μ_R² + C₁)(σ_A² + σ_R² + C₂)); \
                  Gaussian window of 11 × 11 pixels, σ = 1.5, inside the image; C₁ = (0.01 L)², C₂ = (0.03 L)², \
                  L = max R",
        best: Best::Highest,
        swept: true,
        measure: Measure::Local(ssim::of_channels),
    },
    Metric {
        name: "ssim:luminance",
        meaning: "structural similarity of luminance",
        formula: "as ssim, of Y = 0.2126 R + 0.7152 G + 0.0722 B of the values as they are",
        best: Best::Highest,
        swept: false,
        measure: Measure::Local(luminance::structure),
    },
    Metric {
        name: "ms_ssim",
        meaning: "structural similarity at five scales (Wang et al. 2003); images of 176 pixels a side and more",
        formula: "product over scales of mean contrast and structure to the weights 0.0448, 0.2856, 0.3001, 0.2363, 0.1333, \
                  the last with luminance; scales by 2 × 2 means, windows as of ssim, means below 0 count as 0",
        best: Best::Highest,
        swept: true,
        measure: Measure::Whole(ms_ssim::ms_ssim),
    },
    Metric {
        name: "ms_ssim:luminance",
        meaning: "structural similarity of luminance at five scales",
        formula: "as ms_ssim, of Y = 0.2126 R + 0.7152 G + 0.0722 B of the values as they are",
        best: Best::Highest,
        swept: false,
        measure: Measure::Whole(luminance::structure_at_scales),
    },
    Metric {
        name: "flip",
        meaning: "how different the pictures look, flipped between (FLIP, Andersson et al. 2020), from 0 to 1",
        formula: "mean ΔE_c^(1 − ΔE_f), of pictures whose white is what 99.5 % of the reference do not exceed, at 67.02 pixels \
                  to a degree",
        best: Best::Lowest,
        swept: true,
        measure: Measure::Local(flip::flip),
    },
    Metric {
        name: "flip:hdr",
        meaning: "how different the pictures look at any exposure (HDR-FLIP, Andersson et al. 2021), from 0 to 1",
        formula: "mean over pixels of the greatest FLIP over exposures that take the reference's greatest and median \
                  luminance to 0.85 of the ACES tone curve, at 67.02 pixels to a degree",
        best: Best::Lowest,
        swept: false,
        measure: Measure::Local(flip::flip_hdr),
    },
    Metric {
        name: "energy",
        meaning: "the share of the reference's light that the image holds",
        formula: "Σ A / Σ R",
        best: Best::One,
        swept: true,
        measure: Measure::Pixelwise(Pixelwise::mean(of::light).over(of::true_light)),
    },
    Metric {
        name: "highlight_energy",
        meaning: "the share of the reference's light that the image holds in its highlights",
        formula: "Σ A / Σ R over the pixels with R > 0.5 max R",
        best: Best::One,
        swept: true,
        measure: Measure::Pixelwise(
            Pixelwise::mean(of::bright).over(of::truly_bright).level(Level::OfGreatest(HIGHLIGHT)),
        ),
    },
];
