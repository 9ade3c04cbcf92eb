//! What is seen: a surface under a light before a camera.

use crate::geometry::Vec3;
use crate::light::Light;
use crate::lobe::Shading;
use crate::method::{BATCH, Batch};
use crate::surface::{Shape, Surface, displacement};
use crate::texture::{Footprint, Wrap};

use super::Camera;

/// A surface under a light before a camera. What is *on* the surface, the prefiltered map, comes
/// apart.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// The surface, tiled.
    pub surface: Shape,
    /// The one light.
    pub light: Light,
    /// How lobes become light.
    pub shading: Shading,
    /// How the map on the surface wraps.
    pub wrap: Wrap,
}

impl View {
    /// The footprint of a whole pixel at image point (x, y); None where the ray misses.
    pub fn footprint(&self, x: f64, y: f64) -> Option<Footprint> {
        let (camera, ray) = (&self.camera, self.camera.ray(x, y));
        let hit = self.surface.intersect(camera.origin(), ray)?;
        let [along_x, along_y] = camera.ray_steps().map(|step| {
            let moved = displacement(ray, step, hit.t, hit.frame.normal);
            hit.gradient.map(|g| g.dot(&moved) as f32)
        });
        let [u, v] = hit.uv.map(|c| self.wrap.fold(c) as f32);
        Some(Footprint { u, v, along_x, along_y })
    }

    /// Fills `batch` with the shading points under the first `len` image points (`x`, `y`), a sample
    /// standing for `spacing` of a pixel's side.
    pub(super) fn fill(
        &self,
        x: &[f64; BATCH],
        y: &[f64; BATCH],
        len: usize,
        needs: Needs,
        batch: &mut Batch,
    ) {
        batch.len = len;
        match &self.surface {
            Shape::Plane(plane) => self.fill_from(plane, x, y, needs, batch),
            Shape::Sphere(sphere) => self.fill_from(sphere, x, y, needs, batch),
        }
    }

    /// [`View::fill`] for one kind of surface.
    fn fill_from<S: Surface>(
        &self,
        surface: &S,
        x: &[f64; BATCH],
        y: &[f64; BATCH],
        needs: Needs,
        batch: &mut Batch,
    ) {
        let origin = self.camera.origin();
        let steps = self.camera.ray_steps();
        for i in 0..batch.len {
            let ray = self.camera.ray(x[i], y[i]);
            let Some(hit) = surface.intersect(origin, ray) else {
                batch.irradiance[i] = 0.0;
                continue;
            };
            let (light, irradiance) = self.light.seen_from(hit.point);
            let view = ray / -ray.norm();
            let frame = &hit.frame;
            let lit = light.dot(&frame.normal) > 0.0;
            batch.irradiance[i] = if lit { irradiance as f32 } else { 0.0 };
            batch.u[i] = self.wrap.fold(hit.uv[0]) as f32;
            batch.v[i] = self.wrap.fold(hit.uv[1]) as f32;
            let (light, view) = (frame.local_from_world(light), frame.local_from_world(view));
            store(&mut batch.half, i, light + view);
            if self.shading == Shading::Microfacet {
                store(&mut batch.light, i, light);
                store(&mut batch.view, i, view);
            }
            if let Some(spacing) = needs.footprint {
                for (axis, step) in steps.iter().enumerate() {
                    let moved = displacement(ray, *step, hit.t, frame.normal) * spacing;
                    for c in 0..2 {
                        batch.jacobian[2 * axis + c][i] = hit.gradient[c].dot(&moved) as f32;
                    }
                }
            }
        }
    }
}

/// What a batch must hold beyond positions and directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    /// Footprints, of samples that stand for this part of a pixel's side.
    pub footprint: Option<f64>,
}

/// Writes a vector into lane `i`.
#[inline(always)]
fn store(lanes: &mut [[f32; BATCH]; 3], i: usize, v: Vec3) {
    lanes[0][i] = v.x as f32;
    lanes[1][i] = v.y as f32;
    lanes[2][i] = v.z as f32;
}
