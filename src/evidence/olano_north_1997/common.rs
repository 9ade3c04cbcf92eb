//! What the rows share: methods with options, maps, cells of a pyramid and the truth under them.

use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::{HemisphereGrid, Vec3};
use crate::lobe::{BaseLobe, MultipleSurface};
use crate::method::{self, Method, Prefiltered, Silent};
use crate::metric::total_variation;
use crate::parameter::{Domain, Parameter, Value, Values};
use crate::pattern;
use crate::texture::{Footprint, NormalMap};

/// The exponent of the base lobe, which the paper does not print.
pub const EXPONENT: Parameter = Parameter {
    name: "exponent",
    meaning: "exponent of the base lobe: the paper does not print its own",
    domain: Domain::Real { default: 50.0, min: 5.0, max: 1000.0 },
};

/// A method of the program's own with options other than their defaults.
pub fn method(name: &str, options: &[(&'static str, Value)]) -> Box<dyn Method> {
    let entry = method::find(name).expect("a method of the program's own");
    (entry.build)(&Values::defaults(entry.parameters).with(options))
}

/// A method's map, of a base lobe that it takes.
pub fn prefiltered(
    method: &dyn Method,
    map: &Arc<NormalMap>,
    base: &BaseLobe,
) -> Box<dyn Prefiltered> {
    method.prefilter(map, base, &Silent).expect("a base lobe it takes, and nothing cancels it")
}

/// Texels along a side of the maps.
pub const SIDE: usize = 32;

/// Patterns to try the method on, at their defaults.
pub fn maps(seed: u64) -> Vec<(&'static str, Arc<NormalMap>)> {
    let of = |name: &'static str| {
        let entry = pattern::find(name).expect("a pattern of the program's own");
        let bumps = (entry.build)(SIDE, SIDE, &Values::defaults(entry.parameters), seed);
        (name, Arc::new(bumps.normals))
    };
    ["waves", "gaussian", "bricks", "twill"].map(of).into()
}

/// A square part of a map: its first texels, and texels along a side.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    pub at: [usize; 2],
    pub side: usize,
}

/// Where a lookup is, and the texels whose mean it stands for.
#[derive(Clone, Copy, Debug)]
pub struct Probe {
    /// Whether it is in the middle of a cell; if not, at the corner of four, half of each.
    pub middle: bool,
    pub footprint: Footprint,
    pub block: Block,
}

/// Lookups at levels from `from` up to the top of a map of [`SIDE`], in the middle of cells and at their
/// corners, up to four a level of either.
pub fn probes(from: usize) -> Vec<Probe> {
    let top = SIDE.ilog2() as usize;
    let mut all = vec![];
    for level in from..=top {
        let (cell, cells) = (1 << level, SIDE >> level);
        for middle in [true, false] {
            if !middle && cells < 2 {
                continue;
            }
            // Spread over the map's diagonal.
            let count = cells.min(4);
            for k in 0..count {
                let (i, j) = (k * cells / count, (k * cells / count + k) % cells);
                let side = if middle { cell } else { 2 * cell };
                let centre = |c: usize| ((c * cell + side / 2) % SIDE) as f32 / SIDE as f32;
                let texels = cell as f32 / SIDE as f32;
                let footprint = Footprint {
                    u: centre(i),
                    v: centre(j),
                    along_x: [texels, 0.0],
                    along_y: [0.0, texels],
                    ..Footprint::whole()
                };
                let block = Block { at: [i * cell, j * cell], side };
                all.push(Probe { middle, footprint, block });
            }
        }
    }
    all
}

/// Directions that densities are compared on.
pub fn grid() -> HemisphereGrid {
    HemisphereGrid::new(36, 144)
}

/// The density of the base lobes under a block, and their mean normal.
pub fn truth(
    grid: &HemisphereGrid,
    map: &NormalMap,
    base: &BaseLobe,
    block: Block,
) -> (Vec<f32>, Vec3) {
    let texels: Vec<(Vec3, f64)> = (0..block.side * block.side)
        .map(|k| {
            let (i, j) = (block.at[0] + k % block.side, block.at[1] + k / block.side);
            let [x, y, z, w] = map.texel(i % map.width(), j % map.height()).map(f64::from);
            (Vec3::new(x, y, z), w / (block.side * block.side) as f64)
        })
        .collect();
    let density = |h: Vec3| {
        let of = |&(n, weight): &(Vec3, f64)| {
            let cosine = n.dot(&h);
            let tan_squared = (1.0 / (cosine * cosine) - 1.0).max(0.0);
            if cosine > 0.0 { weight * base.density(tan_squared) } else { 0.0 }
        };
        texels.iter().map(of).sum::<f64>() as f32
    };
    let densities = grid.samples().par_iter().map(|s| density(s.direction)).collect();
    (densities, texels.iter().map(|(n, weight)| n * *weight).sum())
}

/// A multiple surface on the directions of a grid.
pub fn sampled(grid: &HemisphereGrid, surface: &MultipleSurface) -> Vec<f32> {
    let at = |d: Vec3| surface.density([d.x, d.y, d.z].map(|c| c as f32));
    grid.samples().iter().map(|s| at(s.direction)).collect()
}

/// How a lookup compares with the truth under it.
#[derive(Clone, Copy, Debug)]
pub struct Compared {
    /// ½ ∫ |D − D_true| cos θ dω.
    pub distance: f64,
    /// The same of D scaled to the truth's energy: what its shape alone is off.
    pub shape: f64,
    /// ∫ D (h·n) dω over the truth's, n the direction of the mean normal.
    pub gain: f64,
}

/// Compares densities with the truth about a mean normal.
pub fn compare(grid: &HemisphereGrid, found: &[f32], truth: &[f32], mean: Vec3) -> Compared {
    let moment = |densities: &[f32]| {
        let terms = grid.samples().iter().zip(densities);
        terms.map(|(s, d)| f64::from(*d) * s.direction.dot(&mean) * s.solid_angle).sum::<f64>()
    };
    let gain = moment(found) / moment(truth);
    let scaled: Vec<f32> = found.iter().map(|d| (f64::from(*d) / gain) as f32).collect();
    Compared {
        distance: total_variation(grid, found, truth),
        shape: total_variation(grid, &scaled, truth),
        gain,
    }
}

/// The size of the light in an image, by its second moments.
pub fn highlight(film: &crate::render::Film) -> Highlight {
    let (mut total, mut x, mut y) = (0.0, 0.0, 0.0);
    let pixels = || {
        film.pixels().iter().enumerate().map(|(i, &r)| {
            let at = [(i % film.width()) as f64, (i / film.width()) as f64];
            (f64::from(r), at)
        })
    };
    for (weight, at) in pixels() {
        (total, x, y) = (total + weight, x + weight * at[0], y + weight * at[1]);
    }
    let mean = [x / total, y / total];
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (weight, at) in pixels() {
        let [dx, dy] = [at[0] - mean[0], mean[1] - at[1]];
        (xx, xy, yy) = (xx + weight * dx * dx, xy + weight * dx * dy, yy + weight * dy * dy);
    }
    let (middle, bend) = (0.5 * (xx + yy), (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt());
    let (length, width) = (((middle + bend) / total).sqrt(), ((middle - bend) / total).sqrt());
    let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy).to_degrees();
    Highlight { length, width, angle }
}

/// What [`highlight`] measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Highlight {
    /// Standard deviation along its longer axis, pixels.
    pub length: f64,
    /// The same along the other.
    pub width: f64,
    /// Of the longer axis from the image's horizontal, degrees within ±90.
    pub angle: f64,
}
