//! Bicubic Bézier patches.

use crate::geometry::Vec3;

/// A bicubic Bézier patch P(u, v) = Σ Bᵢ(u) Bⱼ(v) Pᵢⱼ over the unit square, Bᵢ(t) = (3 over i) tⁱ (1 − t)³⁻ⁱ.
/// Its front is the side that P_u × P_v points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bezier {
    /// Pᵢⱼ, world space: i along u, j along v.
    points: [[Vec3; 4]; 4],
    /// The length of its control net along an axis, at its longest: how large it is.
    size: f64,
}

/// A point of a parametric patch and its first derivatives, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// P.
    pub point: Vec3,
    /// P_u.
    pub along_u: Vec3,
    /// P_v.
    pub along_v: Vec3,
}

/// What the tangent plane at a point of a patch is, wherever it is: world space, all finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// The unit normal, P_u × P_v at unit length, or its limit.
    pub normal: Vec3,
    /// ∇u and ∇v: the dual basis of P_u and P_v in the tangent plane, per scene unit. Where a side of the
    /// patch is a single point they would be infinite, and are held to 10⁶ sizes of the patch.
    pub gradient: [Vec3; 2],
}

/// Shortest that a derivative is let be, sizes of the patch: so that ∇u and ∇v stay finite.
const SHORTEST: f64 = 1e-6;
/// Least sine of the angle between P_u and P_v at which they span a plane.
const LEAST_SINE: f64 = 1e-7;

impl Bezier {
    /// The patch of control points Pᵢⱼ, i along u and j along v, world space.
    pub fn new(points: [[Vec3; 4]; 4]) -> Self {
        let (mut low, mut high) = (points[0][0], points[0][0]);
        for point in points.iter().flatten() {
            (low, high) = (low.inf(point), high.sup(point));
        }
        Self { points, size: (high - low).amax() }
    }

    /// Pᵢⱼ, i along u and j along v.
    pub fn points(&self) -> &[[Vec3; 4]; 4] {
        &self.points
    }

    /// The length of the box around its control points along its longest side, scene units. The patch is
    /// within that box.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// P, P_u and P_v at (u, v).
    pub fn at(&self, u: f64, v: f64) -> PatchPoint {
        let (row, slope) = (bernstein(v), bernstein_slopes(v));
        let [a, b, c, d] = &self.points;
        let along = [weigh(a, &row), weigh(b, &row), weigh(c, &row), weigh(d, &row)];
        let change = |line| weigh(&differences(line), &slope);
        let across = [change(a), change(b), change(c), change(d)];
        let weights = bernstein(u);
        PatchPoint {
            point: weigh(&along, &weights),
            along_u: weigh(&differences(&along), &bernstein_slopes(u)),
            along_v: weigh(&across, &weights),
        }
    }

    /// P_uv at (u, v).
    pub fn twist(&self, u: f64, v: f64) -> Vec3 {
        let across = self.points.map(|line| weigh(&differences(&line), &bernstein_slopes(v)));
        weigh(&differences(&across), &bernstein_slopes(u))
    }

    /// The tangent plane at (u, v) in the unit square. Where P_u is nothing, since a side of the patch is a
    /// single point, its direction is the limit from within the patch, which P_uv tells; likewise P_v. Where
    /// even so no plane is found, it is that a step within the patch.
    pub fn tangents(&self, u: f64, v: f64) -> Tangents {
        let inwards = |step: f64| [u, v].map(|c| c + (0.5 - c) * step);
        let steps = [0.0, 1e-6, 1e-4, 1e-2, 0.5, 0.9];
        let found = steps.into_iter().find_map(|step| {
            let [u, v] = inwards(step);
            self.regular(u, v)
        });
        // A patch without area anywhere faces up.
        found.unwrap_or(Tangents { normal: Vec3::z(), gradient: [Vec3::x(), Vec3::y()] })
    }

    fn regular(&self, u: f64, v: f64) -> Option<Tangents> {
        let PatchPoint { along_u, along_v, .. } = self.at(u, v);
        let least = SHORTEST * self.size;
        let held = |along: Vec3, other: f64| -> Option<Vec3> {
            if along.norm() >= least {
                return Some(along);
            }
            // Coming from within the patch, P_u near v = 0 is v P_uv, and near v = 1 it is −(1 − v) P_uv.
            let twist = self.twist(u, v) * if other > 0.5 { -1.0 } else { 1.0 };
            let way = along.try_normalize(1e-14 * self.size).or_else(|| twist.try_normalize(least));
            way.map(|way| way * least)
        };
        let (along_u, along_v) = (held(along_u, v)?, held(along_v, u)?);
        let cross = along_u.cross(&along_v);
        let length = cross.norm();
        let plain = length > LEAST_SINE * along_u.norm() * along_v.norm();
        if !plain {
            return None;
        }
        let normal = cross / length;
        Some(Tangents {
            normal,
            gradient: [along_v.cross(&normal) / length, normal.cross(&along_u) / length],
        })
    }

    /// The patch moved by `step`, then scaled by `scale` about the origin.
    pub fn placed(&self, step: Vec3, scale: f64) -> Self {
        Self::new(self.points.map(|line| line.map(|point| (point + step) * scale)))
    }
}

/// B₀ to B₃.
fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t]
}

/// What differences of neighbours count in the derivative: three times the quadratic polynomials.
fn bernstein_slopes(t: f64) -> [f64; 3] {
    let s = 1.0 - t;
    [3.0 * s * s, 6.0 * t * s, 3.0 * t * t]
}

#[inline(always)]
fn differences(line: &[Vec3; 4]) -> [Vec3; 3] {
    [line[1] - line[0], line[2] - line[1], line[3] - line[2]]
}

#[inline(always)]
fn weigh<const N: usize>(points: &[Vec3; N], weights: &[f64; N]) -> Vec3 {
    let mut sum = points[0] * weights[0];
    for k in 1..N {
        sum += points[k] * weights[k];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn patch() -> Bezier {
        let point = |i: usize, j: usize| {
            let (x, y) = (i as f64, j as f64);
            Vec3::new(x + 0.2 * y, y - 0.1 * x * x, 0.3 * x * y - 0.2 * y * y)
        };
        Bezier::new([0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| point(i, j))))
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_differences(u in 0.0f64..1.0, v in 0.0f64..1.0) {
            let (patch, h) = (patch(), 1e-4);
            let at = patch.at(u, v);
            let slope = |a: Vec3, b: Vec3| (a - b) / (2.0 * h);
            let along_u = slope(patch.at(u + h, v).point, patch.at(u - h, v).point);
            let along_v = slope(patch.at(u, v + h).point, patch.at(u, v - h).point);
            let twist = slope(patch.at(u, v + h).along_u, patch.at(u, v - h).along_u);
            // The error of central differences of a cubic is its third derivative times h²/6.
            prop_assert!((at.along_u - along_u).norm() < 1e-6 && (at.along_v - along_v).norm() < 1e-6);
            prop_assert!((patch.twist(u, v) - twist).norm() < 1e-6);
        }

        #[test]
        fn gradients_are_the_dual_basis(u in 0.0f64..1.0, v in 0.0f64..1.0) {
            let at = patch().at(u, v);
            let Tangents { normal, gradient: [du, dv] } = patch().tangents(u, v);
            prop_assert!((du.dot(&at.along_u) - 1.0).abs() < 1e-12 && du.dot(&at.along_v).abs() < 1e-12);
            prop_assert!((dv.dot(&at.along_v) - 1.0).abs() < 1e-12 && dv.dot(&at.along_u).abs() < 1e-12);
            prop_assert!(du.dot(&normal).abs() < 1e-12 && dv.dot(&normal).abs() < 1e-12);
            prop_assert!((at.along_u.cross(&at.along_v).normalize() - normal).norm() < 1e-12);
        }
    }

    #[test]
    fn a_side_that_is_a_point_has_the_limit_of_its_normals() {
        // A quarter of a dome: v = 1 is its top.
        let ring = |r: f64, z: f64| {
            [(1.0, 0.0), (1.0, 0.55), (0.55, 1.0), (0.0, 1.0)]
                .map(|(x, y)| Vec3::new(r * x, r * y, z))
        };
        let rings = [ring(1.0, 0.0), ring(1.0, 0.55), ring(0.55, 1.0), ring(0.0, 1.0)];
        let dome = Bezier::new([0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| rings[j][i])));
        for u in [0.0, 0.3, 1.0] {
            for v in [1.0, 1.0 - 1e-16, 1.0 - 1e-9, 1.0 - 1e-6] {
                let Tangents { normal, gradient } = dome.tangents(u, v);
                assert!((normal - Vec3::z()).norm() < 3e-6, "{normal} at {u} {v}");
                assert!(gradient[0].norm() <= 1.01e6 && (0.1..10.0).contains(&gradient[1].norm()));
                // East of the top, where it is approached from this u.
                assert!(gradient[0].dot(&dome.at(u, 0.5).along_u) > 0.0);
            }
        }
    }

    #[test]
    fn a_patch_that_is_a_point_or_a_line_has_a_normal_all_the_same() {
        for to in [Vec3::zeros(), Vec3::x(), Vec3::new(1e-300, 0.0, 0.0)] {
            let patch = Bezier::new([0.0, 1.0, 2.0, 3.0].map(|i| [to * i; 4]));
            let Tangents { normal, gradient } = patch.tangents(0.3, 1.0);
            assert!((normal.norm() - 1.0).abs() < 1e-12);
            assert!(gradient.iter().all(|g| g.iter().all(|c| c.is_finite())));
        }
    }
}
