//! Surfaces whose bump maps are offset vectors in any of the paper's local frames, drawn one normal at a time and
//! by the paper's mean and covariance.

use rayon::prelude::*;

use super::pyramids::{Cell, Level};
use crate::geometry::Vec3;
use crate::lobe::{BaseLobe, EllipticLobe, Spread};
use crate::render::{Camera, Film, PixelSampler, stream};
use crate::surface::{Axes, Hit, Shape, displacement};
use crate::texture::Wrap;

/// A bump-mapped surface under a directional light.
pub struct Bumped<'a> {
    /// The surface, tiled.
    pub shape: &'a Shape,
    /// The camera.
    pub camera: Camera,
    /// All levels of the map's pyramids; texels are facets.
    pub levels: &'a [Level],
    /// What the map's vectors stand in.
    pub axes: Axes,
    /// Length of a texel's side that the map's heights are in, scene units: of matter to
    /// [`Axes::Natural`] alone, where bumps keep their height.
    pub texel: f64,
    /// Unit direction to the light, world space.
    pub light: Vec3,
    /// Exponent of the Blinn-Phong base lobe.
    pub exponent: f64,
}

impl Bumped<'_> {
    /// Slopes (f_u, f_v) as the axes take them, of slopes as the map has them, heights per length.
    fn offsets(&self, slopes: [f64; 2]) -> [f64; 2] {
        match self.axes {
            // ∂F/∂u for F in scene units and u in tiles.
            Axes::Natural => slopes.map(|s| s * self.texel * self.levels[0].side as f64),
            Axes::Normalised | Axes::MainDirection(_) => slopes,
        }
    }

    fn hit(&self, x: f64, y: f64) -> Option<(Hit, Vec3)> {
        let ray = self.camera.ray(x, y);
        let hit = self.shape.intersect(self.camera.origin(), ray)?;
        let half = (self.light - ray.normalize()).normalize();
        (hit.frame.normal.dot(&self.light) > 0.0).then_some((hit, half))
    }

    /// Radiance of the facet at an image point.
    fn facet(&self, x: f64, y: f64) -> f64 {
        let Some((hit, half)) = self.hit(x, y) else { return 0.0 };
        let level = &self.levels[0];
        let [i, j] = hit.uv.map(|c| {
            let texel = Wrap::Repeat.fold(c) * level.side as f64;
            (texel as usize).min(level.side - 1)
        });
        let slopes = level.cells[j * level.side + i].mean;
        let normal = self.axes.perturbed(&hit, self.offsets(slopes));
        let cosine = normal.dot(&half);
        if cosine > 0.0 {
            BaseLobe::BlinnPhong { exponent: self.exponent }.density(1.0 / (cosine * cosine) - 1.0)
        } else {
            0.0
        }
    }

    /// Radiance of the pixel about an image point by the paper: mean and covariance of the footprint's vectors,
    /// carried to the surface by the matrix A of the axes, with the base lobe's variance added.
    fn filtered(&self, x: f64, y: f64) -> f64 {
        let Some((hit, half)) = self.hit(x, y) else { return 0.0 };
        let Cell { mean, roughness: [a, b, c] } = self.looked_up(&hit, x, y);
        // A with the units of the offsets in it.
        let unit = self.offsets([1.0, 1.0])[0];
        let m = self.axes.slopes(&hit).map(|row| row.map(|entry| entry * unit));
        let [s, t] = m.map(|row| row[0] * mean[0] + row[1] * mean[1]);
        let spread = |i: usize, j: usize| {
            let [p, q] = [m[i], m[j]];
            p[0] * (a * q[0] + b * q[1]) + p[1] * (b * q[0] + c * q[1])
        };
        let k = [spread(0, 0), spread(0, 1), spread(1, 1)];
        // The base lobe of a normal of slope (s, t), in slopes about the surface's own.
        let base = BaseLobe::BlinnPhong { exponent: self.exponent };
        let wide = base.spread() * (1.0 + s * s + t * t);
        let total = [k[0] + wide * (1.0 + s * s), k[1] + wide * s * t, k[2] + wide * (1.0 + t * t)];
        let amplitude = 1.0 / (1.0 + s * s + t * t + k[0] + k[2]).sqrt();
        let up = [0.0, 0.0, 1.0];
        let lobe = EllipticLobe::new(up, total.map(|v| v as f32), amplitude as f32, base.profile());
        let half = hit.frame.local_from_world(half);
        let half = [half.x, half.y, half.z].map(|c| c as f32);
        f64::from(lobe.with_mean([-s as f32, -t as f32]).density(half))
    }

    /// The cell at a footprint: bilinear in the two levels about its longer side, linear between them.
    fn looked_up(&self, hit: &Hit, x: f64, y: f64) -> Cell {
        let (ray, side) = (self.camera.ray(x, y), self.levels[0].side as f64);
        let longest = self.camera.ray_steps().map(|step| {
            let moved = displacement(ray, step, hit.t, hit.plane);
            let [u, v] = hit.gradient.map(|g| g.dot(&moved) * side);
            u * u + v * v
        });
        let most = (self.levels.len() - 1) as f64;
        let level = 0.5 * libm::log2(longest[0].max(longest[1]).clamp(1e-12, 1e12));
        let level = level.clamp(0.0, most);
        let (below, blend) = (level as usize, level - level.floor());
        let low = bilinear(&self.levels[below], hit.uv);
        let high = self.levels.get(below + 1).map_or(low, |level| bilinear(level, hit.uv));
        mixed([(low, 1.0 - blend), (high, blend)])
    }

    /// The image of the facets at `spp` samples a pixel.
    pub fn supersampled(&self, spp: u32, seed: u64) -> Film {
        let sampler = PixelSampler::new(spp);
        self.film(|x, y, pixel| {
            let points = sampler.positions(stream(seed, 0, pixel)).into_iter();
            points.map(|[dx, dy]| self.facet(x + dx, y + dy)).sum::<f64>() / f64::from(spp)
        })
    }

    /// The image by mean and covariance, one lookup a pixel.
    pub fn by_covariance(&self) -> Film {
        self.film(|x, y, _| self.filtered(x + 0.5, y + 0.5))
    }

    fn film(&self, pixel: impl Fn(f64, f64, usize) -> f64 + Sync) -> Film {
        let (width, height) = (self.camera.width(), self.camera.height());
        let at = |i: usize| pixel((i % width) as f64, (i / width) as f64, i) as f32;
        Film::new(width, height, (0..width * height).into_par_iter().map(at).collect())
    }
}

fn bilinear(level: &Level, uv: [f64; 2]) -> Cell {
    let taps = uv.map(|c| {
        let place = Wrap::Repeat.fold(c) * level.side as f64 - 0.5;
        let below = place.floor();
        let index = |i: f64| (i as isize).rem_euclid(level.side as isize) as usize;
        [(index(below), 1.0 - (place - below)), (index(below + 1.0), place - below)]
    });
    let [across, along] = taps;
    let corner = |a: usize, b: usize| {
        let ((i, p), (j, q)) = (across[a], along[b]);
        (level.cells[j * level.side + i], p * q)
    };
    mixed([corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)])
}

/// Cells by weight.
fn mixed<const N: usize>(cells: [(Cell, f64); N]) -> Cell {
    let mut sum = Cell::default();
    for (cell, weight) in cells {
        sum.mean.iter_mut().zip(cell.mean).for_each(|(s, c)| *s += weight * c);
        sum.roughness.iter_mut().zip(cell.roughness).for_each(|(s, c)| *s += weight * c);
    }
    sum
}
