//! The tiled plane.

use super::{GRAZING, Hit, Surface};
use crate::geometry::{Frame, Vec3};

/// The plane z = 0, tiled without end: u = x · tiles, v = y · tiles / aspect. Its tangent is x, its
/// bitangent y, its normal z; only its upper side is seen.
///
/// It reaches the horizon: a ray that sinks, however slowly, meets it. Where the hit is so far off that double
/// precision no longer tells tiles apart, distance and texture coordinates stop growing; a pixel's footprint
/// there is wider than any map.
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

/// Texture coordinates grow no further than this: with 2 more bits, [`crate::texture::Wrap::fold`] could not fold
/// them.
const FARTHEST: f64 = (1u64 << 49) as f64;

impl Surface for Plane {
    #[inline(always)]
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        let fall = (-direction.z).max(GRAZING * direction.norm_squared().sqrt());
        let t = origin.z / fall.max(f64::MIN_POSITIVE);
        let point = Vec3::new(origin.x + t * direction.x, origin.y + t * direction.y, 0.0);
        let [across, along] = self.tiles;
        let hit = Hit {
            t,
            point,
            frame: Frame { tangent: Vec3::x(), bitangent: Vec3::y(), normal: Vec3::z() },
            plane: Vec3::z(),
            uv: [point.x * across, point.y * along].map(|c| c.clamp(-FARTHEST, FARTHEST)),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::displacement;
    use proptest::prelude::*;

    /// All numbers of a hit, and of the footprint of a step.
    fn numbers(hit: &Hit, direction: Vec3, step: Vec3) -> Vec<f64> {
        let moved = displacement(direction, step, hit.t, hit.plane);
        let mut all = vec![hit.t, hit.uv[0], hit.uv[1]];
        all.extend(
            [hit.point, moved, hit.gradient[0], hit.gradient[1]].iter().flat_map(|v| v.iter()),
        );
        all
    }

    proptest! {
        #[test]
        fn everything_is_finite_at_the_horizon(
            height in prop_oneof![Just(1e-9), Just(1.0), Just(1e6)],
            tiles in prop_oneof![Just(1e-6), Just(1.0), Just(1e6)],
            sink in prop_oneof![Just(0.0), Just(-0.0), Just(1e-300), Just(1e-20), Just(1e-9), -1.0f64..1.0],
            azimuth in 0.0f64..6.3,
        ) {
            let plane = Plane::new().tiled(tiles, 0.7);
            let direction = Vec3::new(azimuth.cos(), azimuth.sin(), -sink);
            let (hit, hits) = plane.trace(Vec3::new(3.0, -2.0, height), direction);
            for step in [Vec3::z(), Vec3::new(-azimuth.sin(), azimuth.cos(), 0.1)] {
                prop_assert!(numbers(&hit, direction, step * 0.01).iter().all(|x| x.is_finite()));
            }
            prop_assert_eq!(hits, sink > 0.0);
            let folded = hit.uv.map(|c| crate::texture::Wrap::Repeat.fold(c));
            prop_assert!(folded.iter().all(|c| (0.0..=1.0).contains(c)), "{folded:?}");
        }

        #[test]
        fn far_away_coordinates_keep_their_texel(tile in 0u32..1_000_000_000, within in 0.001f64..0.999) {
            // Double precision has 53 bits; the tile takes at most 30 of them, a texel of 4096 another 12.
            let (origin, aim) = (Vec3::new(0.25, 0.0, 2.0), f64::from(tile) + within);
            let hit = Plane::new().intersect(origin, Vec3::new(aim, 0.0, 0.0) - origin).unwrap();
            let folded = crate::texture::Wrap::Repeat.fold(hit.uv[0]);
            prop_assert!((folded - within).abs() < 0.01 / 4096.0, "{folded} {within}");
        }
    }

    #[test]
    fn the_horizon_is_seen_up_to_its_last_ray() {
        let eye = Vec3::new(0.0, 0.0, 1.0);
        assert!(Plane::new().intersect(eye, Vec3::new(1.0, 0.0, -1e-300)).is_some());
        assert!(Plane::new().intersect(eye, Vec3::new(1.0, 0.0, 0.0)).is_none());
        assert!(Plane::new().intersect(-eye, Vec3::new(1.0, 0.0, 1.0)).is_none(), "from below");
        assert!(Plane::new().intersect(eye, Vec3::zeros()).is_none(), "no direction");
    }
}
