//! Bumps synthesised from a distribution of normals (Kautz et al. 2001).

use super::baked::{Family, SIDE, WrittenLobe, ndf_of, octaves};
use super::{Bumps, Card, Entry};
use crate::lobe::NdfImage;
use crate::parameter::{Domain, Parameter, Values};
use crate::synthesis::{Noise, Synthesis};

/// A map whose normals follow an elliptic NDF: turbulence, mapped through the inverse cumulative distributions of the NDF.
/// It repeats with the tile. Textures with the key `ndf`, and `wrinkle bake`, are such maps of any NDF.
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

fn build(width: usize, height: usize, values: &Values, seed: u64) -> Bumps {
    let mut notes = vec![];
    let ndf = ndf_of(&[lobe(values)], SIDE).unwrap_or_else(|_| {
        // A lobe narrower than a pixel of the image.
        notes.push(
            "the distribution is narrower than its image shows: all normals are alike".into(),
        );
        NdfImage::from_fn(SIDE, |[x, y]| f32::from(x * x + y * y < 1e-4)).expect("a pixel is set")
    });
    let size = [width, height];
    let cells = square_cells(size, values.whole("cells") as u32);
    let asked = Some(values.whole("octaves") as u32).filter(|asked| *asked > 0);
    let (octaves, more) = octaves(asked, size, cells);
    notes.extend(more);
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

fn lobe(values: &Values) -> WrittenLobe {
    WrittenLobe {
        share: 1.0,
        family: if values.word("profile") == "ggx" { Family::Ggx } else { Family::Beckmann },
        widths: ["alpha_u", "alpha_v"].map(|name| values.number(name)),
        direction: values.number("direction"),
        tilt: 0.0,
        azimuth: 0.0,
    }
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
