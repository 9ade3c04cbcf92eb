//! What is seen and how: image, surface, camera.

use super::limits::Limits;
use super::reader::Reader;

/// The size of every image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageSpec {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

impl ImageSpec {
    pub(super) fn read(reader: &Reader) -> Self {
        let side = |key, default| reader.whole(key, default, 1, 4096) as usize;
        Self { width: side("width", 160), height: side("height", 120) }
    }
}

/// The surface that carries the bumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// The plane z = 0.
    Plane,
    /// The sphere of radius 1 about the origin.
    Sphere,
    /// A cloth that hangs in folds about the origin and faces −y.
    Drapery,
}

impl Shape {
    /// Its name in specs and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Sphere => "sphere",
            Self::Drapery => "drapery",
        }
    }
}

/// Where the camera stands. It looks at the origin, with z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSpec {
    /// Degrees above the plane z = 0: in (0, 90] for a plane, (−90, 90) for a sphere.
    pub elevation: f64,
    /// Degrees from +x towards +y.
    pub azimuth: f64,
    /// Vertical field of view, degrees, in (0, 120].
    pub fov: f64,
    /// Distance from the origin, scene units; a sweep over distances takes its place.
    pub distance: f64,
}

/// Any direction around the vertical, degrees.
pub(super) const AZIMUTH: Limits = Limits::from_to(-360.0, 360.0).degrees();

impl CameraSpec {
    pub(super) fn read(reader: &Reader, shape: Shape) -> Self {
        let elevation = match shape {
            Shape::Plane => Limits::above(0.0, 90.0).degrees(),
            Shape::Sphere | Shape::Drapery => Limits::between(-90.0, 90.0).degrees(),
        };
        Self {
            elevation: reader.real("elevation", 40.0, elevation),
            azimuth: reader.real("azimuth", -90.0, AZIMUTH),
            fov: reader.real("fov", 25.0, Limits::above(0.0, 120.0).degrees()),
            distance: reader.real("distance", 4.0, distance_limits(shape)),
        }
    }
}

/// How far a camera may be from the origin: outside the surface.
pub(super) fn distance_limits(shape: Shape) -> Limits {
    match shape {
        Shape::Plane => Limits::above(0.0, 1e6),
        Shape::Sphere => Limits::above(1.0, 1e6),
        Shape::Drapery => Limits::above(2.0, 1e6),
    }
}
