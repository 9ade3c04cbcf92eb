//! Floor 2: parametric surfaces.
//!
//! A surface answers, for a ray, where it is hit, the texture coordinates there, how they change over
//! the surface, and the tangent frame.

mod axes;
mod drapery;
mod mesh;
mod perturbation;
mod plane;
mod sphere;
mod wavy_sphere;

pub use axes::{Axes, MainDirection, along_main_direction};
pub use drapery::drapery;
pub use mesh::{Mesh, Vertex};
pub use perturbation::{Derivatives, Perturbation, Perturbed};
pub use plane::Plane;
pub use sphere::Sphere;
pub use wavy_sphere::{WavyFrame, WavySphere};

use crate::geometry::{Frame, Vec3};
use crate::texture::Bend;

/// A point of a surface that a ray hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in units of its direction's length.
    pub t: f64,
    /// The point, world space.
    pub point: Vec3,
    /// Tangent, bitangent, normal; world space.
    pub frame: Frame,
    /// Unit normal of the surface's own tangent plane, which [`Hit::frame`] may smooth; world space.
    pub plane: Vec3,
    /// Texture coordinates (u, v); one unit is one tile of the map.
    pub uv: [f64; 2],
    /// ∇u and ∇v: how u and v change with a step in the tangent plane, per scene unit, world space.
    pub gradient: [Vec3; 2],
}

impl Hit {
    /// The numbers of a ray that hits nothing: finite and of no meaning.
    pub fn nowhere() -> Self {
        let (point, plane) = (Vec3::zeros(), Vec3::z());
        let frame = Frame { tangent: Vec3::x(), bitangent: Vec3::y(), normal: Vec3::z() };
        Self { t: 1.0, point, frame, plane, uv: [0.0; 2], gradient: [Vec3::x(), Vec3::y()] }
    }
}

/// A surface with texture coordinates.
pub trait Surface: Clone + Send + Sync + std::fmt::Debug {
    /// The first hit at t > 0 of the ray `origin` + t·`direction` (any length), seen from outside, and
    /// whether there is one; if not, the hit holds numbers of no meaning. Without a branch, so that a
    /// loop over rays can become vector code.
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool);

    /// [`Surface::trace`] for a single ray.
    fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        let (hit, hits) = self.trace(origin, direction);
        hits.then_some(hit)
    }

    /// The same surface with `tiles` map tiles per scene unit along u (and as many along v, corrected
    /// for the map's `aspect` = height/width in texels, so that texels stay square). A surface that
    /// closes on itself takes the nearest tiling that fits.
    fn tiled(&self, tiles: f64, aspect: f64) -> Self;

    /// Tiles per scene unit along u, as they are.
    fn tiles_across(&self) -> f64;
}

/// Any surface. The renderer chooses once a batch, so that its inner loop knows the kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The tiled plane.
    Plane(Plane),
    /// The sphere.
    Sphere(Sphere),
    /// The hanging cloth.
    Drapery(Mesh),
    /// The rippled sphere.
    WavySphere(WavySphere),
    /// Any of these with a main direction for its bumps.
    MainDirection(MainDirection),
    /// Any of these on which bumps are displacements, or as steep as them.
    Perturbed(Perturbed),
}

/// Does the same with whichever surface a shape is.
macro_rules! with {
    ($shape:expr, $surface:ident => $does:expr) => {
        match $shape {
            Shape::Plane($surface) => $does,
            Shape::Sphere($surface) => $does,
            Shape::Drapery($surface) => $does,
            Shape::WavySphere($surface) => $does,
            Shape::MainDirection($surface) => $does,
            Shape::Perturbed($surface) => $does,
        }
    };
}

impl Shape {
    /// Its name in specs and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Plane(_) => "plane",
            Self::Sphere(_) => "sphere",
            Self::Drapery(_) => "drapery",
            Self::WavySphere(_) => "wavy-sphere",
            Self::MainDirection(turned) => turned.shape().name(),
            Self::Perturbed(perturbed) => perturbed.shape().name(),
        }
    }

    /// See [`Surface::trace`].
    pub fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        with!(self, surface => surface.trace(origin, direction))
    }

    /// See [`Surface::intersect`].
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        with!(self, surface => surface.intersect(origin, direction))
    }

    /// See [`Surface::tiled`].
    pub fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        match self {
            Self::Plane(plane) => Self::Plane(plane.tiled(tiles, aspect)),
            Self::Sphere(sphere) => Self::Sphere(sphere.tiled(tiles, aspect)),
            Self::Drapery(mesh) => Self::Drapery(mesh.tiled(tiles, aspect)),
            Self::WavySphere(sphere) => Self::WavySphere(sphere.tiled(tiles, aspect)),
            Self::MainDirection(turned) => Self::MainDirection(turned.tiled(tiles, aspect)),
            Self::Perturbed(perturbed) => Self::Perturbed(perturbed.tiled(tiles, aspect)),
        }
    }

    /// What becomes of a map's slopes at a hit; None where they are slopes in its frame.
    pub fn bend(&self, hit: &Hit) -> Option<Bend> {
        match self {
            Self::Perturbed(perturbed) => Some(perturbed.bend(hit)),
            _ => None,
        }
    }

    /// See [`Surface::tiles_across`].
    pub fn tiles_across(&self) -> f64 {
        with!(self, surface => surface.tiles_across())
    }
}

/// Least sine of the angle between a ray and a tangent plane that counts: what is lower is taken for this, and
/// numbers stay finite.
const GRAZING: f64 = 1e-12;

/// How the point under a pixel moves when the ray's direction changes by `d_direction`: the ray
/// differential of Igehy 1999 on a plane across `normal`, which for a smooth surface is exact at the
/// pixel's centre. World space, scene units. Finite however nearly the ray grazes the plane.
#[inline(always)]
pub fn displacement(direction: Vec3, d_direction: Vec3, t: f64, normal: Vec3) -> Vec3 {
    let (cosine, least) = (direction.dot(&normal), GRAZING * direction.norm_squared().sqrt());
    let held = cosine.abs().max(least.max(f64::MIN_POSITIVE)).copysign(cosine);
    let slide = d_direction.dot(&normal) / held;
    (d_direction - direction * slide) * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn surfaces() -> [Shape; 2] {
        [Shape::Plane(Plane::new()), Shape::Sphere(Sphere::new())].map(|s| s.tiled(1.7, 0.5))
    }

    proptest! {
        #[test]
        fn differentials_match_finite_differences(
            azimuth in 0.0f64..6.2, elevation in 0.3f64..1.4, aim in -0.4f64..0.4
        ) {
            let (s, c) = libm::sincos(elevation);
            let (sa, ca) = libm::sincos(azimuth);
            let origin = Vec3::new(c * ca, c * sa, s) * 4.0;
            let direction = Vec3::new(aim, 0.2 * aim, 0.0) - origin;
            let step = Vec3::new(0.3, -0.2, 0.1);
            for surface in surfaces() {
                let hit = surface.intersect(origin, direction).expect("aimed at the surface");
                let moved = displacement(direction, step, hit.t, hit.frame.normal);
                let h = 1e-6;
                let near = surface.intersect(origin, direction + step * h).expect("still on it");
                let exact = (near.point - hit.point) / h;
                prop_assert!((moved - exact).norm() < 1e-4 * exact.norm().max(1.0));
                for c in 0..2 {
                    let d = (near.uv[c] - hit.uv[c]) / h;
                    // The seam of a closed surface is a jump of whole tiles.
                    if d.abs() < 1e3 {
                        let linear = hit.gradient[c].dot(&moved);
                        prop_assert!((linear - d).abs() < 1e-3 * d.abs().max(1.0), "{linear} {d}");
                    }
                }
            }
        }

        #[test]
        fn frames_are_right_handed_and_follow_u_and_v(x in -0.9f64..0.9, y in -0.9f64..0.9) {
            for surface in surfaces() {
                let origin = Vec3::new(x, y, 5.0);
                if let Some(hit) = surface.intersect(origin, -Vec3::z()) {
                    let frame = hit.frame;
                    let made = frame.tangent.cross(&frame.bitangent);
                    prop_assert!((made - frame.normal).norm() < 1e-12);
                    prop_assert!(frame.normal.z > 0.0);
                    prop_assert!(hit.gradient[0].dot(&frame.tangent) > 0.0);
                    prop_assert!(hit.gradient[1].dot(&frame.bitangent) > 0.0);
                }
            }
        }
    }
}
