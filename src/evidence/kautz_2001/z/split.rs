//! A reading under which the look does not change: what octaves show as bumps, shading no longer has.

use crate::evidence::{Axis, Chart, Claim, Drawing, Figure, Halted, Series, Table, Task};
use crate::lobe::vector::V3;
use crate::lobe::{EllipticLobe, MultipleSurface, NdfImage, Profile, Spread};
use crate::synthesis::{Noise, Synthesis};

use super::super::common::{SIDE, synthesis};
use super::{CELLS, Shaped, places};

/// Octaves that are in.
const OCTAVES: [u32; 4] = [0, 1, 2, 3];
/// Random places, for each of [`PLACES`](super::PLACES) of the row: the narrower the lobes, the fewer share a half vector.
const TIMES: u64 = 8;

/// What the reading gives.
pub(super) struct Split {
    /// The look by octaves, shaded about each microfacet.
    shapes: Vec<Shaped>,
    /// The same, shaded about each slope.
    of_slopes: Vec<Shaped>,
}

/// Tries it: the NDF is Gaussian in slopes, of a variance v along each axis. k octaves of gain g have a part 1 − g²ᵏ of the
/// variance of all; a lobe of the rest, g²ᵏ v, shades them.
pub(super) fn split(exponent: f64, task: &Task) -> Result<Split, Halted> {
    let variance = 1.0 / exponent;
    let surface: MultipleSurface = [lobe([0.0, 0.0, 1.0], variance)].into_iter().collect();
    let ndf = NdfImage::of_surface(&surface, SIDE).expect("a lobe has density");
    let synthesis = synthesis(ndf, CELLS, task.seed);
    let places: Vec<[f64; 2]> =
        (0..TIMES).flat_map(|k| places(task.seed.wrapping_add(k))).collect();
    let (mut shapes, mut of_slopes) = (vec![], vec![]);
    for octaves in OCTAVES {
        task.go_on()?;
        let gain = Noise::default().gain;
        let rest = (0..octaves).fold(variance, |rest, _| rest * gain * gain);
        let normals = normals(&synthesis, &places, octaves);
        shapes.push(Shaped::by(|h| mean(&normals, h, |n| lobe(n, rest))));
        of_slopes.push(Shaped::by(|h| {
            mean(&normals, h, |[x, y, z]| lobe([0.0, 0.0, 1.0], rest).with_mean([x / z, y / z]))
        }));
    }
    Ok(Split { shapes, of_slopes })
}

fn normals(synthesis: &Synthesis, places: &[[f64; 2]], octaves: u32) -> Vec<V3> {
    let indices = |[u, v]: &[f64; 2]| synthesis.indices(*u, *v, octaves.into());
    places.iter().map(|place| synthesis.normals.at(indices(place))).collect()
}

fn lobe(about: V3, variance: f64) -> EllipticLobe {
    EllipticLobe::new(about, [variance as f32, 0.0, variance as f32], 1.0, Profile::Gaussian)
}

/// The mean density at a half vector of a lobe for each normal.
fn mean(normals: &[V3], h: V3, lobe: impl Fn(V3) -> EllipticLobe) -> f64 {
    let sum: f64 = normals.iter().map(|n| f64::from(lobe(*n).density(h))).sum();
    sum / normals.len() as f64
}

impl Split {
    /// Whether the look stays.
    pub fn claim(&self) -> Claim {
        let first = &self.shapes[0];
        let drift = |shaped: &Shaped| (shaped.peak() / first.peak() - 1.0).abs();
        let most = self.shapes.iter().map(drift).fold(0.0, f64::max);
        Claim::at_most(
            "change of the peak with up to 3 octaves, at most, if octaves that are in are taken out of the lobe that shades",
            "the shading of such a surface is consistent when displayed at different distances (abstract)",
            0.1,
            most,
        )
        .because("turbulence of few octaves is not normal, and lobes about leaning microfacets are not those of slopes")
    }

    pub fn table(&self) -> Table {
        let caption = "A reading: the NDF is Gaussian in slopes, and k octaves, which have 1 − 4⁻ᵏ of its variance, are shaded \
                       by a lobe of the rest, about each microfacet or about its slope. Differences are the greatest, over \
                       the peak without octaves.";
        let head = [
            "octaves",
            "variance that shades, of the NDF's",
            "peak",
            "half width, degrees",
            "difference",
            "difference, about slopes",
        ];
        let mut table = Table::new("split", caption, &head);
        for (k, (shaped, of_slopes)) in self.shapes.iter().zip(&self.of_slopes).enumerate() {
            let rest = OCTAVES[..k].iter().fold(1.0, |rest, _| 0.25 * rest);
            table.push(vec![
                (OCTAVES[k] as usize).into(),
                rest.into(),
                shaped.peak().into(),
                shaped.half_width().into(),
                shaped.apart(&self.shapes[0]).into(),
                of_slopes.apart(&self.of_slopes[0]).into(),
            ]);
        }
        table
    }

    pub fn figure(&self) -> Figure {
        let series = OCTAVES.iter().zip(&self.shapes).map(|(octaves, shaped)| Series {
            label: format!("{octaves} octave{}", if *octaves == 1 { "" } else { "s" }),
            points: shaped.curve.clone(),
            joined: true,
        });
        let chart = Chart {
            x: Axis::linear("half vector, degrees from the normal"),
            y: Axis::linear("mean D"),
            series: series.collect(),
        };
        let caption =
            "The highlight's shape as octaves are added and taken out of the lobe that shades.";
        Figure::new("split", caption, Drawing::Chart(chart))
    }
}
