//! What is seen of a surface beside its highlights: grey, by Lambert's law.

use rayon::prelude::*;

use crate::geometry::Vec3;
use crate::render::{Film, View};

/// Points along a pixel's side.
const POINTS: usize = 4;

/// `highlights` on a body whose albedo at texture coordinates (u, v) is `albedo`, as bright as `part` of the
/// brightest highlight where albedo and cosine are 1. Its normals are those of the surface without a map; `to_light`
/// is the unit direction to the light.
pub fn on_body(
    highlights: &Film,
    view: &View,
    to_light: Vec3,
    part: f32,
    albedo: impl Fn([f64; 2]) -> f64 + Sync,
) -> Film {
    let (width, height) = (highlights.width(), highlights.height());
    let scale = part * highlights.pixels().iter().copied().fold(0.0, f32::max);
    let lit = |x: f64, y: f64| {
        let ray = view.camera.ray(x, y);
        let hit = view.surface.intersect(view.camera.origin(), ray)?;
        Some(albedo(hit.uv) * hit.frame.normal.dot(&to_light).max(0.0))
    };
    let pixel = |i: usize| {
        let corner = [(i % width) as f64, (i / width) as f64];
        let at = |k: usize| (k as f64 + 0.5) / POINTS as f64;
        let points = (0..POINTS * POINTS).map(|k| [at(k % POINTS), at(k / POINTS)]);
        let sum: f64 = points.filter_map(|[x, y]| lit(corner[0] + x, corner[1] + y)).sum();
        highlights.pixels()[i] + scale * (sum / (POINTS * POINTS) as f64) as f32
    };
    Film::new(width, height, (0..width * height).into_par_iter().map(pixel).collect())
}
