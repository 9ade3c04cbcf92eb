//! What is seen: a surface under a light before a camera.

use crate::geometry::{Frame, Kernel, Vec3, vectorised};
use crate::light::Light;
use crate::lobe::Shading;
use crate::method::{BATCH, Batch, Bends};
use crate::surface::{Hit, Shape, Surface, displacement};
use crate::texture::{Footprint, Lookup, Wrap};

use super::Camera;

/// A surface under a light before a camera. What is *on* the surface, the prefiltered map, comes
/// apart.
#[derive(Clone, Debug)]
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
    /// How what lies under a footprint is averaged.
    pub lookup: Lookup,
}

impl View {
    /// The footprint of a whole pixel at image point (x, y); None where the ray misses.
    pub fn footprint(&self, x: f64, y: f64) -> Option<Footprint> {
        self.sight(x, y, 1.0).map(|sight| sight.footprint)
    }

    /// What the ray through image point (x, y) meets, for a sample that stands for the part `spacing` of a
    /// pixel's side; None where it misses.
    pub(super) fn sight(&self, x: f64, y: f64, spacing: f64) -> Option<Sight> {
        let (camera, ray) = (&self.camera, self.camera.ray(x, y));
        let hit = self.surface.intersect(camera.origin(), ray)?;
        let [along_x, along_y] = camera.ray_steps().map(|step| {
            let moved = displacement(ray, step, hit.t, hit.plane) * spacing;
            hit.gradient.map(|g| held(g.dot(&moved)))
        });
        let [u, v] = hit.uv.map(|c| self.wrap.fold(c) as f32);
        let bend = self.surface.bend(&hit).unwrap_or_default();
        let footprint = Footprint { u, v, along_x, along_y, lookup: self.lookup, bend };
        Some(Sight { footprint, point: hit.point, frame: hit.frame, view: -ray.normalize() })
    }

    /// Fills `batch` with the shading points under the first `len` image points (`x`, `y`). With
    /// `spacing`, the part of a pixel's side that a sample stands for, it fills in footprints too;
    /// `directions` to light and eye if asked, or if the shading needs them.
    ///
    /// What differs from batch to batch is decided here, once, and not within the loop.
    pub(super) fn fill(
        &self,
        x: &[f64; BATCH],
        y: &[f64; BATCH],
        len: usize,
        spacing: Option<f64>,
        directions: bool,
        batch: &mut Batch,
    ) {
        batch.len = len;
        batch.lookup = self.lookup;
        let points = Points { view: self, x, y, spacing: spacing.unwrap_or(0.0), batch };
        match (directions || self.shading.needs_directions(), spacing) {
            (false, None) => points.fill::<false, false>(),
            (false, Some(_)) => points.fill::<false, true>(),
            (true, None) => points.fill::<true, false>(),
            (true, Some(_)) => points.fill::<true, true>(),
        }
        batch.bends = self.bends(x, y, len);
    }

    /// What becomes of the map's slopes at image points; None where they are slopes on the surface. Only then are
    /// the points traced once more.
    fn bends(&self, x: &[f64; BATCH], y: &[f64; BATCH], len: usize) -> Option<Bends> {
        let of = |i: usize| {
            let (hit, _) = self.surface.trace(self.camera.origin(), self.camera.ray(x[i], y[i]));
            self.surface.bend(&hit)
        };
        let keeps_angle = of(0)?.keeps_angle;
        let mut bends = Bends { matrix: [[0.0; BATCH]; 4], keeps_angle };
        for i in 0..len {
            let matrix = of(i)?.matrix;
            (0..4).for_each(|k| bends.matrix[k][i] = matrix[k]);
        }
        Some(bends)
    }
}

/// A point that a ray met.
pub(super) struct Sight {
    /// What the sample covers of the map.
    pub footprint: Footprint,
    /// The point, world space.
    pub point: Vec3,
    /// The tangent space there, in the world.
    pub frame: Frame,
    /// Unit direction to the eye, world space.
    pub view: Vec3,
}

/// Image points on their way to a batch.
struct Points<'a> {
    view: &'a View,
    x: &'a [f64; BATCH],
    y: &'a [f64; BATCH],
    spacing: f64,
    batch: &'a mut Batch,
}

impl Points<'_> {
    fn fill<const DIRECTIONS: bool, const FOOTPRINTS: bool>(self) {
        match &self.view.surface {
            Shape::Plane(plane) => self.lit::<_, DIRECTIONS, FOOTPRINTS>(*plane),
            Shape::Sphere(sphere) => self.lit::<_, DIRECTIONS, FOOTPRINTS>(*sphere),
            // Those that search for their hits gain nothing by a loop of their own.
            any => self.lit::<_, DIRECTIONS, FOOTPRINTS>(any.clone()),
        }
    }

    fn lit<S: Surface, const DIRECTIONS: bool, const FOOTPRINTS: bool>(self, surface: S) {
        match &self.view.light {
            Light::Environment { .. } => {
                let light = |_: Vec3| (Vec3::z(), 0.0);
                vectorised(Fill::<_, _, DIRECTIONS, FOOTPRINTS> { points: self, surface, light });
            }
            &Light::Directional { direction, irradiance } => {
                let light = move |_: Vec3| (direction, irradiance);
                vectorised(Fill::<_, _, DIRECTIONS, FOOTPRINTS> { points: self, surface, light });
            }
            near @ Light::Point { .. } => {
                let light = move |point: Vec3| near.seen_from(point);
                vectorised(Fill::<_, _, DIRECTIONS, FOOTPRINTS> { points: self, surface, light });
            }
        }
    }
}

/// The loop that fills a batch, for one kind of surface and light.
struct Fill<'a, S, L, const DIRECTIONS: bool, const FOOTPRINTS: bool> {
    points: Points<'a>,
    surface: S,
    /// Unit direction to the light and irradiance at a point.
    light: L,
}

impl<S, L, const DIRECTIONS: bool, const FOOTPRINTS: bool> Kernel
    for Fill<'_, S, L, DIRECTIONS, FOOTPRINTS>
where
    S: Surface,
    L: Fn(Vec3) -> (Vec3, f64),
{
    #[inline(always)]
    fn run(self) {
        let Points { view, x, y, spacing, batch } = self.points;
        let (camera, wrap) = (view.camera, view.wrap);
        let steps = camera.ray_steps();
        // The whole width, whatever the length: lanes past it are filled with numbers of no use.
        let asked = if S::SEARCHES { batch.len } else { BATCH };
        for i in 0..BATCH {
            let ray = camera.ray(x[i], y[i]);
            let (hit, hits) = if i < asked {
                self.surface.trace(camera.origin(), ray)
            } else {
                (Hit::nowhere(), false)
            };
            let (light, irradiance) = (self.light)(hit.point);
            let view = ray * (-1.0 / ray.norm_squared().sqrt());
            let frame = &hit.frame;
            let lit = hits & (light.dot(&frame.normal) > 0.0);
            batch.irradiance[i] = if lit { irradiance as f32 } else { 0.0 };
            batch.u[i] = wrap.fold(hit.uv[0]) as f32;
            batch.v[i] = wrap.fold(hit.uv[1]) as f32;
            let (light, view) = (frame.local_from_world(light), frame.local_from_world(view));
            store(&mut batch.half, i, light + view);
            if DIRECTIONS {
                store(&mut batch.light, i, light);
                store(&mut batch.view, i, view);
            }
            if FOOTPRINTS {
                for (axis, step) in steps.iter().enumerate() {
                    let moved = displacement(ray, *step, hit.t, hit.plane) * spacing;
                    for c in 0..2 {
                        batch.jacobian[2 * axis + c][i] = held(hit.gradient[c].dot(&moved));
                    }
                }
            }
        }
    }
}

/// The side of a footprint, in tiles, held to what no map can tell from all of itself: near a horizon it grows
/// without bound, and products of sides must stay finite in single precision.
#[inline(always)]
fn held(tiles: f64) -> f32 {
    const WIDEST: f64 = 1e5;
    tiles.clamp(-WIDEST, WIDEST) as f32
}

/// Writes a vector into lane `i`.
#[inline(always)]
fn store(lanes: &mut [[f32; BATCH]; 3], i: usize, v: Vec3) {
    lanes[0][i] = v.x as f32;
    lanes[1][i] = v.y as f32;
    lanes[2][i] = v.z as f32;
}
