//! What a pixel really sees: the distribution of normals under its footprint.

use rayon::prelude::*;

use super::{PixelSampler, View, stream};
use crate::geometry::HemisphereGrid;
use crate::lobe::{BaseLobe, EllipticLobe, Spread};
use crate::texture::NormalMap;

/// The true distribution of a pixel, as densities on `grid`: the mean of the base lobes about the
/// normals at `points` positions spread evenly over the pixel, each traced to the surface (so the
/// footprint is the true one, not its parallelogram). None if the pixel's centre misses.
pub fn true_distribution(
    view: &View,
    map: &NormalMap,
    base: &BaseLobe,
    pixel: [usize; 2],
    points: u32,
    grid: &HemisphereGrid,
) -> Option<Vec<f32>> {
    let [x, y] = pixel.map(|p| p as f64);
    view.footprint(x + 0.5, y + 0.5)?;
    let sampler = PixelSampler::new(points);
    let lobes: Vec<EllipticLobe> = sampler
        .positions(stream(0, 0, 0))
        .into_iter()
        .filter_map(|[dx, dy]| view.footprint(x + dx, y + dy))
        .map(|at| {
            let [x, y, z, weight] = map.sample(at.u, at.v);
            base.about(at.bend.turn([x, y, z]), weight)
        })
        .collect();
    let density = |h: [f32; 3]| {
        let total: f64 = lobes.iter().map(|lobe| f64::from(lobe.density(h))).sum();
        (total / f64::from(points)) as f32
    };
    // One direction a task: sums stay in the order of the lobes.
    Some(
        grid.samples()
            .par_iter()
            .map(|s| density([s.direction.x as f32, s.direction.y as f32, s.direction.z as f32]))
            .collect(),
    )
}
