//! Rendering, whatever the light: a single direction, or everywhere.
//!
//! Where light comes from an environment, a pixel is Σ light / Σ area over its samples that hit the surface
//! ([`crate::light::mirrored`]), and what its other samples see, the background, is the environment
//! filtered to the pixel's width: found once a pixel, and so the same for trials and references.

mod filtered;
mod truth;

use std::sync::Arc;

use rayon::prelude::*;

use super::{Cancelled, Film, PixelSampler, View, render, stream};
use crate::light::environment::Environment;
use crate::light::{Light, Seen};
use crate::lobe::BaseLobe;
use crate::method::{self, Card, MeanNormals, Prefiltered, Truth};
use crate::texture::NormalMap;

/// A map and what a method has made of it.
pub struct Filtered<'a> {
    /// The map.
    pub map: &'a Arc<NormalMap>,
    /// The method's card.
    pub card: Card,
    /// The prefiltered map.
    pub prefiltered: &'a dyn Prefiltered,
}

/// Renders a filtered map in `view`, as [`render`] does where light comes from a single direction.
///
/// # Errors
/// [`Cancelled`] if `cancelled` says so; it is asked before each row.
pub fn trial(
    view: &View,
    filtered: &Filtered,
    sampler: &PixelSampler,
    seed: u64,
    replicate: u32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Film, Cancelled> {
    let Light::Environment { environment, filter } = &view.light else {
        return render(view, filtered.prefiltered, sampler, seed, replicate, cancelled);
    };
    let trial = filtered::Trial {
        view,
        environment,
        filter: *filter,
        prefiltered: filtered.prefiltered,
        means: MeanNormals::beside(&filtered.card, filtered.map),
        spacing: 1.0 / f64::from(sampler.spp()).sqrt(),
    };
    each_pixel(view, environment, sampler, (seed, replicate), cancelled, &|point| {
        trial.sees(point.x, point.y)
    })
}

/// Renders one replicate of what `view` shows of a map in truth. Under an environment that is always the
/// bumps' own normals, [`Truth::Bumps`]: a spec refuses the others there.
///
/// # Errors
/// [`Cancelled`], as [`trial`].
pub fn reference_replicate(
    view: &View,
    (truth, map, base): (Truth, &Arc<NormalMap>, &BaseLobe),
    sampler: &PixelSampler,
    seed: u64,
    replicate: u32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Film, Cancelled> {
    let Light::Environment { environment, .. } = &view.light else {
        let map = method::truth(truth, map, base);
        return render(view, map.as_ref(), sampler, seed, replicate, cancelled);
    };
    let brute = truth::BruteForce::new(view, environment, map, *base, sampler.spp());
    each_pixel(view, environment, sampler, (seed, replicate), cancelled, &|point| brute.sees(point))
}

/// A sample of a pixel.
struct Point {
    /// Image point.
    x: f64,
    y: f64,
    /// Tells its pixel's random choices from others'.
    stream: u64,
    /// Which sample of the pixel it is.
    index: usize,
}

/// A film of what `sees` says of each sample; None where it misses the surface.
fn each_pixel(
    view: &View,
    environment: &Environment,
    sampler: &PixelSampler,
    (seed, replicate): (u64, u32),
    cancelled: &(dyn Fn() -> bool + Sync),
    sees: &(dyn Fn(&Point) -> Option<Seen> + Sync),
) -> Result<Film, Cancelled> {
    let (width, height) = (view.camera.width(), view.camera.height());
    let mut pixels = vec![0.0f32; width * height];
    pixels.par_chunks_mut(width).enumerate().try_for_each(|(row, line)| {
        if cancelled() {
            return Err(Cancelled);
        }
        let count = sampler.spp() as usize;
        let (mut x, mut y) = (vec![0.0; count], vec![0.0; count]);
        for (column, pixel) in line.iter_mut().enumerate() {
            let stream = stream(seed, replicate, row * width + column);
            let corner = [column as f64, row as f64];
            sampler.fill(stream, 0, corner, &mut x, &mut y);
            let (mut seen, mut hits) = (Seen::default(), 0);
            for index in 0..count {
                let point = Point { x: x[index], y: y[index], stream, index };
                if let Some(part) = sees(&point) {
                    (seen.light, seen.area) = (seen.light + part.light, seen.area + part.area);
                    hits += 1;
                }
            }
            let covered = hits as f64 / count as f64;
            let surface = if seen.area > 0.0 { covered * seen.light / seen.area } else { 0.0 };
            let open = 1.0 - covered;
            let sky = if open > 0.0 { open * background(view, environment, corner) } else { 0.0 };
            *pixel = (surface + sky) as f32;
        }
        Ok(())
    })?;
    Ok(Film::new(width, height, pixels))
}

/// The environment behind a pixel, filtered to its width: a cone of the variance of a square of the pixel's
/// solid angle.
fn background(view: &View, environment: &Environment, [column, row]: [f64; 2]) -> f64 {
    let ray = view.camera.ray(column + 0.5, row + 0.5);
    let [right, down] = view.camera.ray_steps();
    let solid_angle = right.norm() * down.norm() / ray.norm_squared();
    environment.cone(&ray.normalize(), solid_angle / 12.0)
}
