//! The cylinder.

use std::f64::consts::TAU;

use super::{Hit, Surface};
use crate::geometry::elementary::atan2_64;
use crate::geometry::{Frame, Vec3};

/// The cylinder of radius 1 about the z axis from z = −1 to z = 1, without lids. Both sides are seen; from within,
/// frames are turned about, and bumps are dents.
///
/// u grows eastwards, u = longitude/2π · tiles around, v upwards, v = (z + 1) · tiles a scene unit. On the outside
/// the tangent points east, the bitangent up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Tiles around, whole, so that the seam closes; and tiles a scene unit of height.
    tiles: [f64; 2],
}

impl Cylinder {
    /// A cylinder with 6 tiles around, square ones.
    pub fn new() -> Self {
        Self { tiles: [6.0, 6.0 / TAU] }
    }
}

impl Default for Cylinder {
    fn default() -> Self {
        Self::new()
    }
}

/// Half its height.
const HALF: f64 = 1.0;

impl Surface for Cylinder {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        // |(o + t d) without z|² = 1, by the half-coefficient form.
        let a = direction.x * direction.x + direction.y * direction.y;
        let b = origin.x * direction.x + origin.y * direction.y;
        let c = origin.x * origin.x + origin.y * origin.y - 1.0;
        let discriminant = b * b - a * c;
        let root = discriminant.max(0.0).sqrt();
        // The two roots without cancellation: one has the sum, the other follows from their product c/a.
        let sum = -(b + root.copysign(b));
        let (one, other) = (sum / a, c / sum);
        let meets = |t: f64| t > 0.0 && t.is_finite() && (origin.z + t * direction.z).abs() <= HALF;
        let (near, far) = if one < other { (one, other) } else { (other, one) };
        // A NaN misses.
        let hits = discriminant >= 0.0 && (meets(near) || meets(far));
        if !hits {
            return (Hit::nowhere(), false);
        }
        let t = if meets(near) { near } else { far };
        (self.hit(origin + direction * t, direction, t), true)
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        let around = (tiles * TAU).round().max(1.0);
        Self { tiles: [around, around / TAU / aspect] }
    }

    fn tiles_across(&self) -> f64 {
        self.tiles[0] / TAU
    }
}

impl Cylinder {
    fn hit(&self, met: Vec3, direction: Vec3, t: f64) -> Hit {
        let out = Vec3::new(met.x, met.y, 0.0).normalize();
        let point = Vec3::new(out.x, out.y, met.z);
        let east = Vec3::new(-out.y, out.x, 0.0);
        let [around, up] = self.tiles;
        let turned = if direction.dot(&out) < 0.0 { 1.0 } else { -1.0 };
        Hit {
            t,
            point,
            frame: Frame {
                tangent: east * turned,
                bitangent: Vec3::z() * turned,
                normal: out * turned,
            },
            plane: out * turned,
            uv: [atan2_64(out.y, out.x) * (around / TAU), (met.z + HALF) * up],
            gradient: [east * (around / TAU), Vec3::z() * up],
        }
    }
}
