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

    /// The pixel nearest to `pixel`, itself first, whose centre sees the surface; of equally near ones the first in
    /// reading order. `None` if none does.
    pub fn seen_nearest(&self, pixel: [usize; 2]) -> Option<[usize; 2]> {
        let seen = |[i, j]: [usize; 2]| self.footprint(i as f64 + 0.5, j as f64 + 0.5).is_some();
        if seen(pixel) {
            return Some(pixel);
        }
        let (width, height) = (self.camera.width(), self.camera.height());
        // Its square distance, row and column.
        let mut nearest: Option<[usize; 3]> = None;
        for ring in 1..width.max(height) {
            if nearest.is_some_and(|[square, ..]| square < ring * ring) {
                break;
            }
            for [i, j] in around(pixel, ring, [width, height]) {
                let square = i.abs_diff(pixel[0]).pow(2) + j.abs_diff(pixel[1]).pow(2);
                if nearest.is_none_or(|least| [square, j, i] < least) && seen([i, j]) {
                    nearest = Some([square, j, i]);
                }
            }
        }
        nearest.map(|[_, j, i]| [i, j])
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

/// The pixels of an image on the square of this half side about one of them, in reading order.
fn around(
    [x, y]: [usize; 2],
    ring: usize,
    [width, height]: [usize; 2],
) -> impl Iterator<Item = [usize; 2]> {
    let within = move |c: usize, side: usize| c.saturating_sub(ring)..(c + ring + 1).min(side);
    let on = move |[i, j]: &[usize; 2]| i.abs_diff(x).max(j.abs_diff(y)) == ring;
    within(y, height).flat_map(move |j| within(x, width).map(move |i| [i, j])).filter(on)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec3;
    use crate::lobe::Shading;
    use crate::render::Camera;
    use crate::surface::{Shape, Sphere};

    fn sphere_beside(target: Vec3) -> View {
        View {
            camera: Camera::look_at(Vec3::new(0.0, -4.0, 0.0), target, 40.0, 24, 17),
            surface: Shape::Sphere(Sphere::new()),
            light: Light::Directional { direction: Vec3::z(), irradiance: 1.0 },
            shading: Shading::Ndf,
            wrap: Wrap::Repeat,
            lookup: Lookup::default(),
        }
    }

    #[test]
    fn the_nearest_pixel_that_sees_the_surface_is_found() {
        let targets = [[0.0, 0.0], [1.2, 0.0], [-1.3, 0.9], [0.2, -1.5]];
        for [x, z] in targets {
            let view = sphere_beside(Vec3::new(x, 0.0, z));
            for pixel in [[12, 8], [6, 4], [0, 0], [23, 16]] {
                let seen = (0..24 * 17)
                    .map(|k| [k % 24, k / 24])
                    .filter(|[i, j]| view.footprint(*i as f64 + 0.5, *j as f64 + 0.5).is_some());
                let away = |at: [usize; 2]| {
                    at[0].abs_diff(pixel[0]).pow(2) + at[1].abs_diff(pixel[1]).pow(2)
                };
                let want = seen.min_by_key(|at| away(*at));
                assert!(want.is_some());
                assert_eq!(view.seen_nearest(pixel), want, "{pixel:?} with the eye on {x} {z}");
            }
        }
        assert_eq!(sphere_beside(Vec3::new(0.0, -8.0, 0.0)).seen_nearest([3, 3]), None);
    }
}
