//! Bumps synthesised from a distribution of normals (Kautz et al. 2001).

use super::{Bumps, Card, Entry};
use crate::lobe::vector::turned;
use crate::lobe::{EllipticLobe, MultipleSurface, NdfImage, Profile};
use crate::parameter::{Domain, Parameter, Values};
use crate::synthesis::{Noise, Synthesis, octaves_for};

/// A map whose normals follow an elliptic NDF: turbulence, mapped through the inverse cumulative distributions of the NDF.
/// It repeats with the tile. `wrinkle bake` does the same for any NDF.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "synthesised",
        source: "Kautz, Heidrich and Seidel 2001, Real-Time Bump Map Synthesis",
        summary: "Fractal bumps whose normals follow a distribution.",
    },
    parameters: &[
        Parameter {
            name: "profile",
            meaning: "how the distribution's density falls with the slope",
            domain: Domain::Choice { words: &["gaussian", "ggx"] },
        },
        Parameter {
            name: "alpha_u",
            meaning: "its roughness along u: α, where α² is twice the variance of slopes (GGX's own α)",
            domain: Domain::Real { default: 0.3, min: 0.01, max: 2.0 },
        },
        Parameter {
            name: "alpha_v",
            meaning: "its roughness along v",
            domain: Domain::Real { default: 0.3, min: 0.01, max: 2.0 },
        },
        Parameter {
            name: "direction",
            meaning: "degrees by which both are turned, from u towards v",
            domain: Domain::Real { default: 0.0, min: -180.0, max: 180.0 },
        },
        Parameter {
            name: "cells",
            meaning: "lattice cells of the first octave along the tile's shorter side",
            domain: Domain::Whole { default: 8, min: 1, max: 65536 },
        },
        Parameter {
            name: "octaves",
            meaning: "octaves of noise; 0 for as many as the texels can show",
            domain: Domain::Whole { default: 0, min: 0, max: 24 },
        },
        Parameter {
            name: "gain",
            meaning: "height of each octave over that of the one before",
            domain: Domain::Real { default: 0.5, min: 0.05, max: 0.95 },
        },
    ],
    build,
};

/// Pixels a side of the NDF.
const SIDE: usize = 256;

fn build(width: usize, height: usize, values: &Values, seed: u64) -> Bumps {
    let mut notes = vec![];
    let surface: MultipleSurface = [lobe(values)].into_iter().collect();
    let ndf = NdfImage::of_surface(&surface, SIDE).unwrap_or_else(|_| {
        // A lobe narrower than a pixel of the image.
        notes.push(
            "the distribution is narrower than its image shows: all normals are alike".into(),
        );
        NdfImage::from_fn(SIDE, |[x, y]| f32::from(x * x + y * y < 1e-4)).expect("a pixel is set")
    });
    let cells = square_cells([width, height], values.whole("cells") as u32);
    let most = octaves_for([width, height], cells);
    let octaves = match values.whole("octaves") {
        0 => most,
        asked => {
            if asked as f64 > most {
                notes.push(format!(
                    "{asked} octaves are more than the {most} that its texels can show"
                ));
            }
            asked as f64
        }
    };
    if most == 0.0 {
        notes.push(
            "it has too few texels a lattice cell to show the noise: it is flat or aliased".into(),
        );
    }
    let noise = Noise { cells, gain: values.number("gain"), seed };
    let normals = Synthesis::new(ndf, noise).bake(width, height, octaves);
    Bumps { normals, heights: None, notes }
}

/// As many lattice cells along the longer side of a map as keep them square, for so many along the shorter.
pub fn square_cells([width, height]: [usize; 2], shorter: u32) -> [u32; 2] {
    let least = width.min(height).max(1);
    let along = |side: usize| (side as u64 * u64::from(shorter) + least as u64 / 2) / least as u64;
    [width, height].map(|side| along(side).clamp(1, 1 << 20) as u32)
}

fn lobe(values: &Values) -> EllipticLobe {
    // A Gaussian's spread is the variance, α²/2; GGX's is α².
    let (profile, part) = match values.word("profile") {
        "ggx" => (Profile::Ggx, 1.0),
        _ => (Profile::Gaussian, 0.5),
    };
    let spreads =
        ["alpha_u", "alpha_v"].map(|name| part * values.number(name) * values.number(name));
    let spread = turned(spreads, values.number("direction"));
    EllipticLobe::new([0.0, 0.0, 1.0], spread, 1.0, profile)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Value;

    #[test]
    fn slopes_have_the_variances_asked_for() {
        let mut values = Values::defaults(ENTRY.parameters);
        values.set("alpha_u", Value::Number(0.2));
        values.set("cells", Value::Number(32.0));
        // Normals of a tile are not independent: 32 cells a side hold 1024 bumps or so of the first octave, which has
        // three quarters of the variance: a standard error of about √(2/1024), 4 %.
        let map = build(256, 256, &values, 3).normals;
        let mut sums = [0.0f64; 2];
        for t in map.texels() {
            (0..2).for_each(|c| sums[c] += f64::from(t[c] / t[2]).powi(2) / 65536.0);
        }
        assert!(
            (sums[0] / 0.02 - 1.0).abs() < 0.16 && (sums[1] / 0.045 - 1.0).abs() < 0.16,
            "{sums:?}"
        );
    }

    #[test]
    fn cells_are_square_on_any_map() {
        assert_eq!(square_cells([256, 256], 8), [8, 8]);
        assert_eq!(square_cells([512, 128], 8), [32, 8]);
        assert_eq!(square_cells([1, 4096], 65536), [65536, 1 << 20]);
    }
}
