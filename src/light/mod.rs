//! Floor 3: lights.

pub mod environment;
mod mirror;

use std::sync::Arc;

pub use mirror::{Filter, Seen, mirrored};

use crate::geometry::{Vec3, turned};
use environment::Environment;

/// Where light comes from. Light is not coloured: one number a ray.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// A light infinitely far away.
    Directional {
        /// Unit direction *to* the light, world space.
        direction: Vec3,
        /// Irradiance E on a plane that faces it.
        irradiance: f64,
    },
    /// A small light nearby, the same in all directions.
    Point {
        /// Where it is, world space.
        position: Vec3,
        /// Radiant intensity I: E = I / r² on a plane that faces it at distance r.
        intensity: f64,
    },
    /// Light from everywhere, mirrored by the facets of the surface ([`mirrored`]).
    Environment {
        /// Radiance by direction.
        environment: Arc<Environment>,
        /// How filtered lobes look it up.
        filter: Filter,
    },
}

impl Light {
    /// Its name in specs and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Directional { .. } => "directional",
            Self::Point { .. } => "point",
            Self::Environment { .. } => "environment",
        }
    }

    /// This light moved round the vertical through the origin, by degrees from +x towards +y.
    pub fn turned(&self, degrees: f64) -> Self {
        match *self {
            Self::Directional { direction, irradiance } => {
                Self::Directional { direction: turned(direction, degrees), irradiance }
            }
            Self::Point { position, intensity } => {
                Self::Point { position: turned(position, degrees), intensity }
            }
            Self::Environment { ref environment, filter } => {
                Self::Environment { environment: Arc::new(environment.turned(degrees)), filter }
            }
        }
    }

    /// The unit direction from `point` to the light, and the irradiance there on a plane facing it.
    /// At the light itself there is none; nor is there of an environment, which is no single direction.
    #[inline(always)]
    pub fn seen_from(&self, point: Vec3) -> (Vec3, f64) {
        match *self {
            Self::Directional { direction, irradiance } => (direction, irradiance),
            Self::Point { position, intensity } => {
                let to = position - point;
                let square = to.norm_squared();
                if square > 0.0 {
                    (to / square.sqrt(), intensity / square)
                } else {
                    (Vec3::z(), 0.0)
                }
            }
            Self::Environment { .. } => (Vec3::z(), 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_light_falls_with_the_square() {
        let light = Light::Point { position: Vec3::new(0.0, 0.0, 2.0), intensity: 8.0 };
        assert_eq!(light.seen_from(Vec3::zeros()), (Vec3::z(), 2.0));
        assert_eq!(light.seen_from(Vec3::new(0.0, 0.0, 2.0)).1, 0.0);
    }
}
