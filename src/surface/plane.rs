//! The tiled plane.

use super::{Hit, Surface};
use crate::geometry::{Frame, Vec3};

/// The plane z = 0, tiled without end: u = x · tiles, v = y · tiles / aspect. Its tangent is x, its
/// bitangent y, its normal z; only its upper side is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Tiles per scene unit along x and y.
    tiles: [f64; 2],
}

impl Plane {
    /// A plane with one tile a scene unit.
    pub fn new() -> Self {
        Self { tiles: [1.0; 2] }
    }
}

impl Default for Plane {
    fn default() -> Self {
        Self::new()
    }
}

impl Surface for Plane {
    #[inline(always)]
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        let t = -origin.z / direction.z;
        let point = Vec3::new(origin.x + t * direction.x, origin.y + t * direction.y, 0.0);
        let [across, along] = self.tiles;
        let hit = Hit {
            t,
            point,
            frame: Frame { tangent: Vec3::x(), bitangent: Vec3::y(), normal: Vec3::z() },
            plane: Vec3::z(),
            uv: [point.x * across, point.y * along],
            gradient: [Vec3::x() * across, Vec3::y() * along],
        };
        (hit, origin.z > 0.0 && direction.z < 0.0)
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        Self { tiles: [tiles, tiles / aspect] }
    }
    fn tiles_across(&self) -> f64 {
        self.tiles[0]
    }
}
