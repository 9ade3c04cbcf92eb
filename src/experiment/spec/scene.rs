//! What is seen and how: image, surface, camera, light.

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
    /// Degrees above the plane z = 0: in (0, 90] for a plane, (−90, 90) for a sphere.
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
const AZIMUTH: Limits = Limits::from_to(-360.0, 360.0).degrees();

impl CameraSpec {
    pub(super) fn read(reader: &Reader, shape: Shape) -> Self {
        let elevation = match shape {
            Shape::Plane => Limits::above(0.0, 90.0).degrees(),
            _ => Limits::between(-90.0, 90.0).degrees(),
        };
        Self {
            elevation: reader.real("elevation", 40.0, elevation),
            azimuth: reader.real("azimuth", -90.0, AZIMUTH),
            fov: reader.real("fov", 25.0, Limits::above(0.0, 120.0).degrees()),
            distance: reader.real("distance", 4.0, distance_limits(shape)),
            target: target(reader, shape),
        }
    }
}

/// What the camera looks at; checked to be where the image's middle shows the surface.
fn target(reader: &Reader, shape: Shape) -> [f64; 3] {
    let Some(item) = reader.item("target") else { return [0.0; 3] };
    let Some([x, y, z]) = item.point() else { return [0.0; 3] };
    let square = x * x + y * y + z * z;
    let message = match shape {
        Shape::Plane if z > 0.0 => format!("`target` is above the plane: z is {z}"),
        Shape::Drapery | Shape::WavySphere(_) if square > 0.25 => {
            "`target` is more than 0.5 from the origin".to_owned()
        }
        Shape::Sphere if square >= 1.0 => {
            "`target` is not inside the sphere of radius 1".to_owned()
        }
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
        Shape::Drapery | Shape::WavySphere(_) => Limits::above(2.0, 1e6),
    }
}

/// The one light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSpec {
    /// Light from very far away.
    Directional {
        /// Degrees above the plane z = 0 that it comes from: in (0, 90] for a plane, [−90, 90] for a
        /// sphere.
        elevation: f64,
        /// Degrees from +x towards +y that it comes from.
        azimuth: f64,
        /// Irradiance on a plane facing it.
        irradiance: f64,
    },
    /// Light from a point.
    Point {
        /// Where it is, scene units: above a plane, outside a sphere.
        position: [f64; 3],
        /// Radiant intensity: irradiance on a plane facing it at distance 1.
        intensity: f64,
    },
}

/// How strong a light may be.
const STRENGTH: Limits = Limits::above(0.0, 1e6);

impl LightSpec {
    /// Its name in specs and results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Directional { .. } => "directional",
            Self::Point { .. } => "point",
        }
    }

    pub(super) fn read(reader: &Reader, shape: Shape) -> Self {
        let point = reader.choice("kind", &[("directional", false), ("point", true)]);
        if point {
            Self::Point {
                position: position(reader, shape),
                intensity: reader.real("intensity", 1.0, STRENGTH),
            }
        } else {
            let elevation = match shape {
                Shape::Plane => Limits::above(0.0, 90.0),
                _ => Limits::from_to(-90.0, 90.0),
            };
            Self::Directional {
                elevation: reader.real("elevation", 40.0, elevation.degrees()),
                azimuth: reader.real("azimuth", 90.0, AZIMUTH),
                irradiance: reader.real("irradiance", 1.0, STRENGTH),
            }
        }
    }
}

/// Where a point light is; checked to be where it lights the surface.
fn position(reader: &Reader, shape: Shape) -> [f64; 3] {
    const DEFAULT: [f64; 3] = [0.0, 2.0, 2.0];
    let Some(item) = reader.item("position") else { return DEFAULT };
    let Some([x, y, z]) = item.point() else { return DEFAULT };
    match shape {
        Shape::Plane if z <= 0.0 => {
            item.error(format!("`position` is not above the plane: z is {z}"), None);
        }
        Shape::Sphere if x * x + y * y + z * z <= 1.0 => {
            item.error("`position` is inside the sphere of radius 1".to_owned(), None);
        }
        Shape::WavySphere(wavy) if x * x + y * y + z * z <= wavy.outside() * wavy.outside() => {
            let message = format!("`position` is not outside the crests, at {}", wavy.outside());
            item.error(message, None);
        }
        _ => {}
    }
    [x, y, z]
}
