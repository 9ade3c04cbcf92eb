//! What is seen and how: image, surface, camera.

use super::limits::Limits;
use super::reader::Reader;
pub(super) use super::surface::Shape;

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

/// Where the camera stands, and what it looks at, with z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSpec {
    /// Degrees above the plane z = 0: in (0, 90] for a plane, (−90, 90) for a sphere; a sweep over elevations
    /// takes its place.
    pub elevation: f64,
    /// Degrees from +x towards +y.
    pub azimuth: f64,
    /// Vertical field of view, degrees, in (0, 120].
    pub fov: f64,
    /// Distance from the origin, scene units; a sweep over distances takes its place.
    pub distance: f64,
    /// The point it looks at, scene units: not above a plane, inside a sphere.
    pub target: [f64; 3],
}

/// Any direction around the vertical, degrees.
pub(super) const AZIMUTH: Limits = Limits::from_to(-360.0, 360.0).degrees();

impl CameraSpec {
    pub(super) fn read(reader: &Reader, shape: Shape) -> Self {
        Self {
            elevation: reader.real("elevation", 40.0, elevation_limits(shape)),
            azimuth: reader.real("azimuth", -90.0, AZIMUTH),
            fov: reader.real("fov", 25.0, Limits::above(0.0, 120.0).degrees()),
            distance: reader.real("distance", 4.0, distance_limits(shape)),
            target: target(reader, shape),
        }
    }
}

/// How far above the plane z = 0 a camera may stand, degrees.
pub(super) fn elevation_limits(shape: Shape) -> Limits {
    match shape {
        Shape::Plane => Limits::above(0.0, 90.0).degrees(),
        _ => Limits::between(-90.0, 90.0).degrees(),
    }
}

/// What the camera looks at; checked to be where the image's middle shows the surface.
fn target(reader: &Reader, shape: Shape) -> [f64; 3] {
    let Some(item) = reader.item("target") else { return [0.0; 3] };
    let Some([x, y, z]) = item.point() else { return [0.0; 3] };
    let square = x * x + y * y + z * z;
    let message = match shape {
        Shape::Plane if z > 0.0 => format!("`target` is above the plane: z is {z}"),
        Shape::Sphere if square >= 1.0 => {
            "`target` is not inside the sphere of radius 1".to_owned()
        }
        Shape::Plane | Shape::Sphere => return [x, y, z],
        _ if square > 0.25 => "`target` is more than 0.5 from the origin".to_owned(),
        _ => return [x, y, z],
    };
    item.error(message, Some("the middle of the image must show the surface".to_owned()));
    [0.0; 3]
}

/// How far a camera may be from the origin: outside the surface.
pub(super) fn distance_limits(shape: Shape) -> Limits {
    match shape {
        Shape::Plane => Limits::above(0.0, 1e6),
        Shape::Sphere => Limits::above(1.0, 1e6),
        _ => Limits::above(2.0, 1e6),
    }
}
