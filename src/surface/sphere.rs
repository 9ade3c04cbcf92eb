//! The sphere.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Hit, Surface};
use crate::geometry::elementary::atan2_64;
use crate::geometry::{Frame, Vec3};

/// The unit sphere about the origin in spherical coordinates, its poles on the z axis.
///
/// u grows eastwards with longitude, v northwards with latitude: u = longitude/2π · tiles round the
/// equator, v = (latitude + π/2)/π · tiles from pole to pole. The tangent points east, the bitangent
/// north. At the poles, where east has no meaning, the tangent is x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Tiles round the equator (whole, so that the seam closes) and from pole to pole.
    tiles: [f64; 2],
}

impl Sphere {
    /// A sphere with 2 × 1 tiles.
    pub fn new() -> Self {
        Self { tiles: [2.0, 1.0] }
    }
}

impl Default for Sphere {
    fn default() -> Self {
        Self::new()
    }
}

/// Nearest the pole that ∇u is let grow: cos latitude ≥ 10⁻⁶ keeps footprints finite.
const SMALLEST_RADIUS: f64 = 1e-6;

/// The frame at a point of the sphere `radius` from the axis; at a pole the tangent is x.
#[inline(always)]
fn eastward(point: Vec3, radius: f64) -> Frame {
    let per = 1.0 / radius.max(f64::MIN_POSITIVE);
    let east = Vec3::new(-point.y * per, point.x * per, 0.0);
    let tangent = if radius > 0.0 { east } else { Vec3::x() };
    Frame { tangent, bitangent: point.cross(&tangent), normal: point }
}

impl Surface for Sphere {
    #[inline(always)]
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        // |o + t d|² = 1, by the half-coefficient form.
        let a = direction.norm_squared();
        let b = origin.dot(&direction);
        let c = origin.norm_squared() - 1.0;
        let discriminant = b * b - a * c;
        // From outside, moving inwards, and not missing (a NaN misses).
        let hits = c > 0.0 && b < 0.0 && discriminant >= 0.0;
        // c/(−b + √) is the nearer root without cancellation.
        let t = c / (-b + discriminant.max(0.0).sqrt());
        let point = (origin + direction * t).normalize();
        let radius = (point.x * point.x + point.y * point.y).sqrt();
        let frame = eastward(point, radius);
        let longitude = atan2_64(point.y, point.x);
        let latitude = atan2_64(point.z, radius);
        let [round, up] = [self.tiles[0] / TAU, self.tiles[1] / PI];
        let hit = Hit {
            t,
            point,
            frame,
            plane: frame.normal,
            uv: [longitude * round, (latitude + FRAC_PI_2) * up],
            gradient: [frame.tangent * (round / radius.max(SMALLEST_RADIUS)), frame.bitangent * up],
        };
        (hit, hits)
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        // 2π scene units round the equator.
        let around = (tiles * TAU).round().max(1.0);
        Self { tiles: [around, 0.5 * around / aspect] }
    }
    fn tiles_across(&self) -> f64 {
        self.tiles[0] / TAU
    }
}
