//! Multiple surfaces that are written down and not filtered from a map (Fournier 1992 §4).

use super::{MultipleSurface, PhongPeak};

/// A multiple surface with a name.
#[derive(Clone, Copy, Debug)]
pub struct NamedSurface {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, and how print was read where it leaves a choice.
    pub meaning: &'static str,
    /// Where its numbers are printed.
    pub source: &'static str,
    peaks: fn() -> Vec<PhongPeak>,
}

impl NamedSurface {
    /// Its peaks: amplitude · cosⁿ, not normalised, as printed; directions of unit length.
    pub fn peaks(&self) -> Vec<PhongPeak> {
        (self.peaks)()
    }

    /// The multiple surface.
    pub fn surface(&self) -> MultipleSurface {
        self.peaks().into_iter().collect()
    }
}

/// All of them.
pub fn named() -> &'static [NamedSurface] {
    NAMED
}

/// The one of this name.
pub fn find_named(name: &str) -> Option<&'static NamedSurface> {
    NAMED.iter().find(|surface| surface.name == name)
}

const TABLE: &str = "Fournier 1992, §4, the table";

const NAMED: &[NamedSurface] = &[
    NamedSurface {
        name: "velvet",
        meaning: "a wide lobe about the normal and six at the horizon, 60° apart; the first number \
                  of their vectors is read as the one along the normal",
        source: TABLE,
        peaks: || read(VELVET, Reading::FirstAlongNormal),
    },
    NamedSurface {
        name: "velvet-printed",
        meaning: "the same table with the third number along the normal in every row: the six lobes \
                  lie in a plane, two of them below the horizon",
        source: TABLE,
        peaks: || read(VELVET, Reading::ThirdAlongNormal),
    },
    NamedSurface {
        name: "silk",
        meaning: "a wide lobe about the normal and three in each of four directions across it; the \
                  first number of their vectors is read as the one along the normal",
        source: TABLE,
        peaks: || read(SILK, Reading::FirstAlongNormal),
    },
    NamedSurface {
        name: "silk-printed",
        meaning: "the same table with the third number along the normal in every row",
        source: TABLE,
        peaks: || read(SILK, Reading::ThirdAlongNormal),
    },
    NamedSurface {
        name: "three-normals",
        meaning: "the geometric normal and one either side of it; the first one's exponent is not \
                  printed and is taken to be that of the others",
        source: "Fournier 1992, §4, text on Figure 9",
        peaks: || read(THREE_NORMALS, Reading::ThirdAlongNormal),
    },
    NamedSurface {
        name: "anisotropic",
        meaning: "grooves along y: peaks of equal height spread evenly over the normals of a half \
                  cylinder; no numbers are printed, these are 18 peaks 10° apart of exponent 100",
        source: "Fournier 1992, §4, Figure 9: no numbers",
        peaks: anisotropic,
    },
];

/// Which number of a printed vector is the one along the geometric normal. The text on Figure 9 calls
/// (0, 0, 1) the geometric normal, and so does the first row of each material; but the other rows lie
/// around the normal, as the named materials ask for, only if their *first* number is along it.
#[derive(Clone, Copy, PartialEq)]
enum Reading {
    /// The third, in every row.
    ThirdAlongNormal,
    /// The first, in all rows but (0, 0, 1).
    FirstAlongNormal,
}

/// Amplitude, vector, exponent, as printed.
type Row = (f64, [f64; 3], f64);

const VELVET: &[Row] = &[
    (0.1, [0.0, 0.0, 1.0], 1.0),
    (0.6, [0.01, 1.0, 0.0], 20.0),
    (0.6, [0.01, 0.5, 0.866], 20.0),
    (0.6, [0.01, -0.5, 0.866], 20.0),
    (0.6, [0.01, -1.0, 0.0], 20.0),
    (0.6, [0.01, -0.5, -0.866], 20.0),
    (0.6, [0.01, 0.5, -0.866], 20.0),
];

/// The last two amplitudes stand the other way round in print than those of the other three directions.
const SILK: &[Row] = &[
    (0.6, [0.0, 0.0, 1.0], 1.0),
    (0.1, [0.1, 1.0, 0.0], 32.0),
    (0.6, [0.8, 1.0, 0.0], 32.0),
    (0.4, [0.5, 1.0, 0.0], 32.0),
    (0.1, [0.1, 0.0, 1.0], 32.0),
    (0.6, [0.8, 0.0, 1.0], 32.0),
    (0.4, [0.5, 0.0, 1.0], 32.0),
    (0.1, [0.1, -1.0, 0.0], 32.0),
    (0.6, [0.8, -1.0, 0.0], 32.0),
    (0.4, [0.5, -1.0, 0.0], 32.0),
    (0.1, [0.1, 0.0, -1.0], 32.0),
    (0.4, [0.8, 0.0, -1.0], 32.0),
    (0.6, [0.5, 0.0, -1.0], 32.0),
];

const THREE_NORMALS: &[Row] =
    &[(0.4, [0.6, 0.0, 0.8], 100.0), (0.4, [-0.6, 0.0, 0.8], 100.0), (0.4, [0.0, 0.0, 1.0], 100.0)];

fn read(rows: &[Row], reading: Reading) -> Vec<PhongPeak> {
    let peak = |&(amplitude, vector, exponent): &Row| {
        let [x, y, z] = vector;
        let first = reading == Reading::FirstAlongNormal && vector != [0.0, 0.0, 1.0];
        let local = if first { [y, z, x] } else { vector };
        let length = (x * x + y * y + z * z).sqrt();
        PhongPeak {
            amplitude: amplitude as f32,
            direction: local.map(|part| (part / length) as f32),
            exponent: exponent as f32,
        }
    };
    rows.iter().map(peak).collect()
}

/// Peaks of exponent 100 fall to half at 6.7°, so that those 10° apart run together into a ridge.
fn anisotropic() -> Vec<PhongPeak> {
    const COUNT: usize = 18;
    let peak = |i: usize| {
        let turn = (i as f64 + 0.5) / COUNT as f64 * std::f64::consts::PI;
        let (sin, cos) = libm::sincos(turn - std::f64::consts::FRAC_PI_2);
        PhongPeak { amplitude: 0.4, direction: [sin as f32, 0.0, cos as f32], exponent: 100.0 }
    };
    (0..COUNT).map(peak).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::CAPACITY;
    use crate::lobe::vector::{dot, unit};

    fn density(name: &str, h: [f32; 3]) -> f32 {
        find_named(name).unwrap().surface().density(unit(h))
    }

    #[test]
    fn directions_are_unit_and_lists_fit() {
        for surface in named() {
            let peaks = surface.peaks();
            assert!(!peaks.is_empty() && peaks.len() <= CAPACITY);
            for peak in peaks {
                let off = dot(peak.direction, peak.direction) - 1.0;
                assert!(off.abs() < 1e-6, "{}", surface.name);
            }
        }
    }

    #[test]
    fn velvet_is_brightest_at_the_horizon() {
        let above = density("velvet", [0.0, 0.0, 1.0]);
        let rim: Vec<f32> = (0..36)
            .map(|i| f64::from(10 * i).to_radians().sin_cos())
            .map(|(sin, cos)| density("velvet", [cos as f32, sin as f32, 0.02]))
            .collect();
        // The mean over azimuths of six cos²⁰ is 6 · 0.0881 of one's height, 0.6.
        let mean = rim.iter().sum::<f32>() / 36.0;
        assert!((mean - 0.317).abs() < 0.01 && mean > 3.0 * above, "{mean} {above}");
        // Read as printed there is no light at the horizon along x.
        assert!(density("velvet-printed", [1.0, 0.0, 0.02]) < 0.1 * above);
    }

    #[test]
    fn grooves_look_the_same_all_along_their_arc() {
        let at = |degrees: f32| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            density("anisotropic", [sin, 0.0, cos])
        };
        for degrees in -60..=60 {
            let ratio = at(degrees as f32) / at(0.0);
            assert!((ratio - 1.0).abs() < 0.1, "{degrees}°: {ratio}");
        }
        assert!(density("anisotropic", [0.0, 0.5, 1.0]) < 0.01 * at(0.0));
    }

    #[test]
    fn names_are_unique() {
        let mut names: Vec<_> = named().iter().map(|surface| surface.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), named().len());
        let manual = include_str!("../../docs/surfaces.md");
        for name in names {
            assert!(manual.contains(&format!("`{name}`")), "{name} is not in the manual");
        }
    }
}
