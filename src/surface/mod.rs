//! Floor 2: parametric surfaces.
//!
//! A surface answers, for a ray, where it is hit, the texture coordinates there, how they change over
//! the surface, and the tangent frame.

mod axes;
mod bezier;
mod cylinder;
mod drapery;
mod facets;
mod hierarchy;
mod mesh;
mod model;
mod patches;
mod perturbation;
mod plane;
mod sphere;
mod wavy_sphere;

pub use axes::{Axes, MainDirection, along_main_direction};
pub use bezier::{Bezier, PatchPoint, Tangents};
pub use cylinder::Cylinder;
pub use drapery::drapery;
pub use mesh::{Mesh, Vertex};
pub use model::{MOST_TRIANGLES, Model, ModelError, Up, files_of, read_model};
pub use patches::{Chart, Charted, Patches, bent_patch, ribbon, teapot, teapot_mesh};
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
    /// Whether [`Surface::trace`] searches: too dear for rays of which nobody asks, and no vector code anyway.
    const SEARCHES: bool = false;

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
    /// A cylinder.
    Cylinder(Cylinder),
    /// Triangles: the hanging cloth, the model of a file.
    Mesh(Mesh),
    /// Bézier patches: the teapot, the bent patch, the ribbon.
    Patches(Patches),
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
            Shape::Cylinder($surface) => $does,
            Shape::Mesh($surface) => $does,
            Shape::Patches($surface) => $does,
            Shape::WavySphere($surface) => $does,
            Shape::MainDirection($surface) => $does,
            Shape::Perturbed($surface) => $does,
        }
    };
}

impl Shape {
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
            Self::Cylinder(cylinder) => Self::Cylinder(cylinder.tiled(tiles, aspect)),
            Self::Mesh(mesh) => Self::Mesh(mesh.tiled(tiles, aspect)),
            Self::Patches(patches) => Self::Patches(patches.tiled(tiles, aspect)),
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

/// The same, for code that takes any surface.
impl Surface for Shape {
    const SEARCHES: bool = true;

    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        Shape::trace(self, origin, direction)
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        Shape::tiled(self, tiles, aspect)
    }

    fn tiles_across(&self) -> f64 {
        Shape::tiles_across(self)
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
mod tests;
