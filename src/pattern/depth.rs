//! A depth buffer: real solids, seen straight down (Blinn 1978 §3; Catmull 1975).

use super::Bumps;
use crate::geometry::Vec3;
use crate::texture::{HeightMap, NormalMap, Wrap};

/// All points within a distance of a line: a rod with round ends; a ball if it has no length. Texels, z up from
/// the ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rod {
    /// Ends of its line.
    pub ends: [Vec3; 2],
    /// Its radius.
    pub radius: f64,
}

impl Rod {
    /// A ball.
    pub fn ball(centre: Vec3, radius: f64) -> Self {
        Self { ends: [centre; 2], radius }
    }

    /// The highest point of it over (x, y).
    fn top(&self, x: f64, y: f64) -> Option<f64> {
        let [a, b] = self.ends;
        let balls = [a, b].map(|c| {
            let square = self.radius * self.radius - (x - c.x) * (x - c.x) - (y - c.y) * (y - c.y);
            (square >= 0.0).then(|| c.z + square.sqrt())
        });
        let wall = self.wall(Vec3::new(x, y, 0.0) - a, b - a).map(|z| z + a.z);
        [balls[0], balls[1], wall].into_iter().flatten().reduce(f64::max)
    }

    /// Where the upright line through `from` leaves the wall along `axis`, both seen from an end: its height
    /// above that end, if there the foot is between the ends.
    fn wall(&self, from: Vec3, axis: Vec3) -> Option<f64> {
        let length = axis.norm();
        let axis = axis.try_normalize(1e-12)?;
        let from = Vec3::new(from.x, from.y, 0.0);
        // |across + z up|² = r², both across the axis.
        let (across, up) = (from - axis * from.dot(&axis), Vec3::z() - axis * axis.z);
        let (a, b) = (up.norm_squared(), across.dot(&up));
        let square = b * b - a * (across.norm_squared() - self.radius * self.radius);
        if a < 1e-12 || square < 0.0 {
            return None;
        }
        let z = (square.sqrt() - b) / a;
        let foot = from.dot(&axis) + z * axis.z;
        (0.0..=length).contains(&foot).then_some(z)
    }
}

/// The highest surface over every texel of a tile that repeats, the ground to begin with.
pub(super) struct DepthBuffer {
    width: usize,
    height: usize,
    depth: Vec<f64>,
}

impl DepthBuffer {
    /// The bare ground.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, depth: vec![0.0; width * height] }
    }

    /// Keeps of a solid what stands above all that was there.
    pub fn render(&mut self, rod: &Rod) {
        let [a, b] = rod.ends;
        let span = |low: f64, high: f64| {
            let first = libm::floor(low - rod.radius - 0.5) as isize;
            first..=libm::ceil(high + rod.radius - 0.5) as isize
        };
        for j in span(a.y.min(b.y), a.y.max(b.y)) {
            for i in span(a.x.min(b.x), a.x.max(b.x)) {
                let top = rod.top(i as f64 + 0.5, j as f64 + 0.5);
                let (x, y) =
                    (i.rem_euclid(self.width as isize), j.rem_euclid(self.height as isize));
                let kept = &mut self.depth[y as usize * self.width + x as usize];
                *kept = kept.max(top.unwrap_or(0.0));
            }
        }
    }

    /// The buffer as a table of heights, its normals by differences.
    pub fn bumps(self) -> Bumps {
        let heights = HeightMap::new(self.width, self.height, Wrap::Repeat, self.depth);
        let normals = NormalMap::from_heights(&heights, 1.0);
        Bumps { normals, heights: Some(heights), notes: vec![] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Distance of a point from a rod's line.
    fn away(rod: &Rod, point: Vec3) -> f64 {
        let [a, b] = rod.ends;
        let along = b - a;
        let part = (point - a).dot(&along) / along.norm_squared().max(1e-300);
        (point - a - along * part.clamp(0.0, 1.0)).norm()
    }

    proptest! {
        #[test]
        fn the_top_is_on_the_skin_and_nothing_is_above(
            ends in prop::array::uniform6(-5.0f64..5.0), radius in 0.1f64..3.0,
            x in -8.0f64..8.0, y in -8.0f64..8.0,
        ) {
            let [a, b, c, d, e, f] = ends;
            let rod = Rod { ends: [Vec3::new(a, b, c), Vec3::new(d, e, f)], radius };
            match rod.top(x, y) {
                Some(z) => {
                    let off = away(&rod, Vec3::new(x, y, z)) - radius;
                    prop_assert!(off.abs() < 1e-6, "{off}");
                    for k in 1..20 {
                        let above = Vec3::new(x, y, z + 0.05 * f64::from(k));
                        prop_assert!(away(&rod, above) > radius - 1e-6);
                    }
                }
                None => {
                    for k in -100..100 {
                        let point = Vec3::new(x, y, 0.1 * f64::from(k));
                        prop_assert!(away(&rod, point) > radius - 1e-9);
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_lower_is_hidden_and_edges_meet() {
        let mut buffer = DepthBuffer::new(16, 8);
        buffer.render(&Rod::ball(Vec3::new(0.5, 0.5, 0.0), 3.0));
        buffer.render(&Rod::ball(Vec3::new(0.5, 0.5, -1.0), 3.0));
        assert_eq!(buffer.depth[0], 3.0);
        assert_eq!(buffer.depth[2], buffer.depth[14]);
        assert_eq!(buffer.depth[2 * 16], buffer.depth[6 * 16]);
        assert_eq!(buffer.depth[8], 0.0);
    }
}
