//! Normals of triangles, and of the corners that they share.

use std::collections::HashMap;

use super::Point;
use crate::geometry::Vec3;

/// (B − A) × (C − A).
fn cross(positions: &[Vec3], corners: [u32; 3]) -> Vec3 {
    let [a, b, c] = corners.map(|corner| positions[corner as usize]);
    (b - a).cross(&(c - a))
}

/// The area of a triangle; 0 if it is no more than a line has by rounding.
pub(super) fn area(positions: &[Vec3], corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| positions[corner as usize]);
    let longest = (b - a).norm_squared().max((c - a).norm_squared()).max((c - b).norm_squared());
    let twice = cross(positions, corners).norm();
    if twice > 1e-12 * longest { 0.5 * twice } else { 0.0 }
}

/// The unit normal at each point: the file's, or where there is none the mean of the triangles that meet at its
/// position, each by its angle there (Thürmer and Wüthrich 1998), whatever their texture coordinates.
pub(super) fn normals(positions: &[Vec3], points: &[Point], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let given = |point: &Point| {
        let normal = Vec3::from(point.normal?.map(f64::from));
        normal.try_normalize(1e-30)
    };
    if points.iter().all(|point| given(point).is_some()) {
        return points.iter().filter_map(given).collect();
    }
    // Points at one place are one corner of the surface.
    let place = |point: &Point| point.position.map(|c| (c + 0.0).to_bits());
    let mut corners: HashMap<[u32; 3], usize> = HashMap::new();
    let of: Vec<usize> = points
        .iter()
        .map(|point| {
            let next = corners.len();
            *corners.entry(place(point)).or_insert(next)
        })
        .collect();
    let mut sums = vec![Vec3::zeros(); corners.len()];
    for &triangle in triangles {
        let Some(normal) = cross(positions, triangle).try_normalize(0.0) else { continue };
        for k in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|side| positions[triangle[(k + side) % 3] as usize]);
            let (one, other) = (b - a, c - a);
            let angle = libm::atan2(one.cross(&other).norm(), one.dot(&other));
            sums[of[triangle[k] as usize]] += normal * angle;
        }
    }
    let smooth = |k: usize| sums[of[k]].try_normalize(1e-12).unwrap_or(Vec3::z());
    points.iter().enumerate().map(|(k, point)| given(point).unwrap_or_else(|| smooth(k))).collect()
}
