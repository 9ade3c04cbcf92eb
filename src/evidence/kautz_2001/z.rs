//! How consistent the look is over zoom.

mod split;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use std::sync::Arc;

use super::common::{ALL, isotropic, pictures, shot, synthesis, view};
use crate::evidence::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Series, Table, Task,
};
use crate::geometry::Vec3;
use crate::lobe::NdfImage;
use crate::lobe::sampled::in_frame;
use crate::lobe::vector::V3;
use crate::method::kautz::Synthesised;
use crate::parameter::{Domain, Parameter};
use crate::render::{Camera, direction};
use crate::surface::{Plane, Shape};
use crate::synthesis::{Synthesis, frame_about};

/// The row.
pub const ROW: Row = Row {
    name: "kautz-z",
    title: "Consistency over a zoom of 1000 times: mean radiance and the highlight's shape as octaves are added",
    parts: &[],
    parameters: &[Parameter {
        name: "exponent",
        meaning: "exponent of the isotropic NDF",
        domain: Domain::Real { default: 30.0, min: 2.0, max: 500.0 },
    }],
    secs: 5.0,
    make,
};

/// Zooms run to 2¹⁰, four steps a doubling.
const STEPS: usize = 41;
const PER_DOUBLING: f64 = 4.0;
/// Where the first octave begins to be seen.
const FIRST: f64 = 2.0;
/// Random places that a mean is taken over.
const PLACES: usize = 1 << 14;
/// Half vectors, degrees from the normal.
const ANGLES: [f64; 4] = [0.0, 10.0, 20.0, 35.0];
/// Lattice cells a tile.
const CELLS: u32 = 1 << 10;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let exponent = task.values.number("exponent");
    let synthesis = synthesis(isotropic(exponent), CELLS, task.seed);
    let places = places(task.seed);
    let mut means: Vec<[f64; 4]> = vec![];
    for step in 0..STEPS {
        task.go_on()?;
        means.push(ANGLES.map(|angle| radiance(&synthesis, &places, octaves(step), angle)));
    }
    let (before, after) = (means[0], means[STEPS - 1]);
    let shapes =
        [0.0, 1.0, 3.0, 8.0].map(|octaves| (octaves, Shaped::of(&synthesis, &places, octaves)));
    let convolved = Shaped::convolved(&synthesis);
    let spreads = spreads(&synthesis, &places);
    let mut exhibit = ROW.exhibit();
    exhibit.claims = claims(&means, before, after, &shapes, &convolved);
    exhibit.claims.push(same_at_every_zoom(&spreads));
    let split = split::split(exponent, task)?;
    exhibit.claims.push(split.claim());
    exhibit.tables = vec![table(&shapes, &convolved), split.table(), spread_table(&spreads)];
    exhibit.figures = vec![
        chart(&means),
        highlight(&shapes, &convolved),
        split.figure(),
        zoom(&synthesis, task)?,
    ];
    exhibit.remarks = vec![
        "If normals m follow p and each is shaded by p about itself, the whole sends p convolved with p. For a narrow \
         Gaussian p that has twice the variance and half the height; only a p that is a spike, a mirror, is left as it is. \
         \"(Almost) correct\" (§1) then holds of each zoom from the first whole octave on, but not between none and one."
            .into(),
        "There is a reading under which it holds of every zoom: the lobe that shades is what of the NDF is not yet seen as \
         bumps, so that bumps convolved with shading are the NDF. The paper shades \"always with the original shading \
         model\" (§1); fractal microfacets that \"themselves consist of microfacets\" (§3.2) may be taken either way. For \
         Gaussian slopes the variance is split: k octaves of gain ½ have 1 − 4⁻ᵏ of it, and 4⁻ᵏ is left to shading. With all \
         octaves a mirror is left. The tables have both."
            .into(),
    ];
    Ok(exhibit)
}

/// Side of the picture at zoom 1, in lattice cells of the first octave.
const ACROSS: f64 = 64.0;

/// How normals spread within a picture: [zoom, the root mean square of (x, y) away from the picture's own mean].
fn spreads(synthesis: &Synthesis, places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const WINDOWS: usize = 64;
    let within = PLACES / WINDOWS;
    let of = |step: usize| {
        let zoom = libm::exp2(step as f64 / PER_DOUBLING);
        let side = ACROSS / f64::from(CELLS) / zoom;
        let mut sum = 0.0;
        for window in 0..WINDOWS {
            let [u0, v0] = places[window];
            let normals: Vec<V3> = places[window * within..][..within]
                .iter()
                .map(|[u, v]| synthesis.indices(u0 + side * u, v0 + side * v, octaves(step)))
                .map(|r| synthesis.normals.at(r))
                .collect();
            for c in 0..2 {
                let all = normals.iter().map(|n| f64::from(n[c]));
                let mean = all.clone().sum::<f64>() / within as f64;
                sum += all.map(|x| (x - mean) * (x - mean)).sum::<f64>();
            }
        }
        [zoom, (sum / PLACES as f64).sqrt()]
    };
    (0..STEPS).step_by(8).map(of).collect()
}

fn spread_table(spreads: &[[f64; 2]]) -> Table {
    let caption = format!(
        "Root mean square of the normals' x and y away from the mean of their picture, which is {ACROSS} cells of the first \
         octave across at zoom 1."
    );
    let mut table = Table::new("spreads", caption, &["zoom", "spread of normals"]);
    spreads.iter().for_each(|[zoom, spread]| table.push(vec![(*zoom).into(), (*spread).into()]));
    table
}

fn same_at_every_zoom(spreads: &[[f64; 2]]) -> Claim {
    let most = spreads.iter().fold(0.0f64, |most, s| most.max(s[1]));
    Claim::near(
        "spread of normals within the picture at the last zoom, of the greatest at any",
        1.0,
        spreads[spreads.len() - 1][1] / most,
        0.2,
    )
    .because(
        "no matter how close one zooms in, the microfacets always have the same distribution, says §1; but each octave is \
         half as high as the one before, so near by a picture holds little but the slope of one large bump",
    )
}

/// Octaves in at a step of the zoom.
fn octaves(step: usize) -> f64 {
    (step as f64 / PER_DOUBLING - FIRST).max(0.0)
}

fn places(seed: u64) -> Vec<[f64; 2]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut part = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    (0..PLACES).map(|_| [part(), part()]).collect()
}

fn half(degrees: f64) -> V3 {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    [sin as f32, 0.0, cos as f32]
}

/// The mean over many places of D at a half vector.
fn radiance(synthesis: &Synthesis, places: &[[f64; 2]], octaves: f64, degrees: f64) -> f64 {
    let sum: f64 = places
        .iter()
        .map(|[u, v]| {
            let normal = synthesis.normals.at(synthesis.indices(*u, *v, octaves));
            f64::from(in_frame(&synthesis.ndf, &frame_about(normal), half(degrees)))
        })
        .sum();
    sum / places.len() as f64
}

/// The look of a patch: D along a line through the normal.
struct Shaped {
    /// [degrees, D].
    curve: Vec<[f64; 2]>,
}

impl Shaped {
    fn by(density: impl Fn(V3) -> f64) -> Self {
        let at = |k: i32| [f64::from(2 * k), density(half(f64::from(2 * k)))];
        Self { curve: (0..=40).map(at).collect() }
    }

    fn of(synthesis: &Synthesis, places: &[[f64; 2]], octaves: f64) -> Self {
        let normals: Vec<V3> = places
            .iter()
            .map(|[u, v]| synthesis.normals.at(synthesis.indices(*u, *v, octaves)))
            .collect();
        Self::by(|h| mixture(&synthesis.ndf, &normals, h))
    }

    /// By normals that follow the NDF exactly: all on a regular grid of uniform numbers.
    fn convolved(synthesis: &Synthesis) -> Self {
        const GRID: usize = 128;
        let at = |k: usize| (k as f64 + 0.5) / GRID as f64;
        let normal = |k: usize| {
            let [x, y] = synthesis.normals.cumulative.place([at(k % GRID), at(k / GRID)]);
            let [x, y] = [2.0 * x - 1.0, 2.0 * y - 1.0];
            [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()].map(|c| c as f32)
        };
        let normals: Vec<V3> = (0..GRID * GRID).map(normal).collect();
        Self::by(|h| mixture(&synthesis.ndf, &normals, h))
    }

    fn peak(&self) -> f64 {
        self.curve[0][1]
    }

    /// Degrees at which it has fallen to half of its peak.
    fn half_width(&self) -> f64 {
        let half = 0.5 * self.peak();
        let crossing = self.curve.windows(2).find(|pair| pair[1][1] < half);
        crossing.map_or(f64::NAN, |pair| {
            let ([a, high], [b, low]) = (pair[0], pair[1]);
            a + (b - a) * (high - half) / (high - low)
        })
    }

    /// The greatest difference from another, over the peak of that.
    fn apart(&self, other: &Self) -> f64 {
        let pairs = self.curve.iter().zip(&other.curve);
        pairs.map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max) / other.peak()
    }
}

fn mixture(ndf: &NdfImage, normals: &[V3], h: V3) -> f64 {
    let sum: f64 = normals.iter().map(|n| f64::from(in_frame(ndf, &frame_about(*n), h))).sum();
    sum / normals.len() as f64
}

fn claims(
    means: &[[f64; 4]],
    before: [f64; 4],
    after: [f64; 4],
    shapes: &[(f64, Shaped); 4],
    convolved: &Shaped,
) -> Vec<Claim> {
    // From three whole octaves on.
    let first = ((FIRST + 3.0) * PER_DOUBLING) as usize;
    let drift = (0..ANGLES.len())
        .map(|a| {
            let values = means[first..].iter().map(|m| m[a]);
            let (low, high) = values.fold((f64::MAX, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
            (high - low) / after[a]
        })
        .fold(0.0, f64::max);
    let jump = means
        .windows(2)
        .map(|pair| (pair[1][0] - pair[0][0]).abs() / before[0])
        .fold(0.0, f64::max);
    vec![
        Claim::at_most(
            "drift of mean radiance from 3 octaves to a zoom of 1024 times, over the last, at most over four angles",
            "consistent when displayed at different distances (abstract)",
            0.05,
            drift,
        ),
        Claim::near(
            "mean radiance at the normal with all octaves, of that with none",
            1.0,
            after[0] / before[0],
            0.1,
        )
        .because(
            "normals that follow the NDF are shaded by the NDF again: its convolution with itself",
        ),
        Claim::near(
            "half width of the highlight with 8 octaves, of that with none",
            1.0,
            shapes[3].1.half_width() / shapes[0].1.half_width(),
            0.1,
        )
        .because("a convolution of two lobes of one variance is √2 times as wide"),
        Claim::at_most(
            "difference of the look with 8 octaves from the NDF convolved with itself, over its peak",
            "the microfacets are distributed according to the same density function (§3.2)",
            0.03,
            shapes[3].1.apart(convolved),
        ),
        Claim::at_most(
            "greatest change of mean radiance in a quarter of a doubling, of that with no octaves",
            "blended in smoothly to avoid popping artifacts (§5.1)",
            0.25,
            jump,
        ),
    ]
}

fn table(shapes: &[(f64, Shaped); 4], convolved: &Shaped) -> Table {
    let caption =
        "The look of a patch over half vectors: its peak and where it has fallen to half of that.";
    let mut table = Table::new("looks", caption, &["octaves", "peak", "half width, degrees"]);
    for (octaves, shaped) in shapes {
        let row = vec![(*octaves).into(), shaped.peak().into(), shaped.half_width().into()];
        table.push(row);
    }
    let last = "the NDF convolved with itself";
    table.push(vec![last.into(), convolved.peak().into(), convolved.half_width().into()]);
    table
}

fn chart(means: &[[f64; 4]]) -> Figure {
    let series = ANGLES.iter().enumerate().map(|(a, angle)| Series {
        label: format!("{angle}° from the normal"),
        points: means
            .iter()
            .enumerate()
            .map(|(step, mean)| [libm::exp2(step as f64 / PER_DOUBLING), mean[a] / means[0][a]])
            .collect(),
        joined: true,
    });
    let chart = Chart {
        x: Axis::log("zoom"),
        y: Axis::linear("mean radiance, of that without bumps"),
        series: series.collect(),
    };
    let caption = format!(
        "Mean radiance over {PLACES} places while the eye comes nearer: octaves come in from a zoom of {} on, one each \
         doubling.",
        libm::exp2(FIRST)
    );
    Figure::new("zoom", caption, Drawing::Chart(chart))
}

fn highlight(shapes: &[(f64, Shaped); 4], convolved: &Shaped) -> Figure {
    let curve = |label: String, shaped: &Shaped| Series {
        label,
        points: shaped.curve.clone(),
        joined: true,
    };
    let mut series: Vec<Series> = shapes
        .iter()
        .map(|(octaves, shaped)| curve(format!("{octaves} octaves"), shaped))
        .collect();
    series.push(curve("convolved".into(), convolved));
    let chart = Chart {
        x: Axis::linear("half vector, degrees from the normal"),
        y: Axis::linear("mean D"),
        series,
    };
    Figure::new("highlight", "The highlight's shape as octaves are added.", Drawing::Chart(chart))
}

/// Pictures of one place on a plane, each four times nearer than the last.
fn zoom(synthesis: &Arc<Synthesis>, task: &Task) -> Result<Figure, Halted> {
    const PIXELS: usize = 128;
    let bumps = Synthesised::new(Arc::clone(synthesis), ALL);
    // The place lies near the map's corner, where single precision still tells the finest pixels apart.
    let middle = Vec3::new(0.011, 0.007, 0.0);
    let tiles = 1.0 / 16.0;
    let plane = Shape::Plane(Plane::new()).tiled(tiles, 1.0);
    let middle = middle / tiles;
    let mut panels = vec![];
    for power in 0..6 {
        let zoom = f64::from(1u32 << (2 * power));
        // From furthest away the image covers 64 lattice cells: two pixels each.
        let side = ACROSS / f64::from(CELLS) / tiles;
        let distance = side / (2.0 * libm::tan(5.0f64.to_radians())) / zoom;
        let camera = Camera::look_at(
            middle + direction(70.0, -90.0) * distance,
            middle,
            10.0,
            PIXELS,
            PIXELS,
        );
        let film = shot(&view(camera, plane.clone(), direction(75.0, 60.0)), &bumps, 4, task)?;
        panels.push(Panel::new(&format!("zoom-{zoom}"), format!("{zoom} times"), Arc::new(film)));
    }
    Ok(pictures(
        "pictures",
        "One place on a plane, each picture four times nearer than the last.",
        panels,
    ))
}
