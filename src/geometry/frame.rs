//! Orthonormal frames.

use super::Vec3;

/// An orthonormal frame, right-handed (`tangent × bitangent = normal`) but for where a surface mirrors its texture
/// coordinates or is seen from behind: there its bitangent is turned about, and still on the side of growing v, or
/// all three are.
///
/// On a surface the tangent follows increasing u, the bitangent completes the frame on the side of
/// increasing v, and the normal points out. A vector's coordinates in it are (x, y, z) along
/// (tangent, bitangent, normal); for a surface's own frame they are called *tangent space*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Unit vector along increasing u.
    pub tangent: Vec3,
    /// Unit vector on the side of increasing v, perpendicular to the other two.
    pub bitangent: Vec3,
    /// Unit normal.
    pub normal: Vec3,
}

impl Frame {
    /// The frame with this unit `normal` whose tangent is as near to `tangent` as it can be; any
    /// perpendicular direction if the two are parallel (a sphere's pole).
    pub fn new(normal: Vec3, tangent: Vec3) -> Self {
        let flat = tangent - normal * normal.dot(&tangent);
        let length = flat.norm();
        if length <= 1e-12 * tangent.norm() || length == 0.0 {
            return Self::about(normal);
        }
        let tangent = flat / length;
        Self { tangent, bitangent: normal.cross(&tangent), normal }
    }

    /// Some frame about a unit `normal`, continuous everywhere but at (0, 0, −1) (Duff et al. 2017,
    /// *Building an Orthonormal Basis, Revisited*). About (0, 0, 1) it is the identity.
    pub fn about(normal: Vec3) -> Self {
        let sign = 1.0_f64.copysign(normal.z);
        let a = -1.0 / (sign + normal.z);
        let b = normal.x * normal.y * a;
        Self {
            tangent: Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
            bitangent: Vec3::new(b, sign + normal.y * normal.y * a, -normal.y),
            normal,
        }
    }

    /// Coordinates of `v` in this frame.
    pub fn local_from_world(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(&self.tangent), v.dot(&self.bitangent), v.dot(&self.normal))
    }

    /// The vector whose coordinates in this frame are `v`.
    pub fn world_from_local(&self, v: Vec3) -> Vec3 {
        self.tangent * v.x + self.bitangent * v.y + self.normal * v.z
    }
}

/// A vector turned about z by degrees, from x towards y.
pub fn turned(v: Vec3, degrees: f64) -> Vec3 {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    Vec3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn direction() -> impl Strategy<Value = Vec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0)
            .prop_map(|(x, y, z)| Vec3::new(x, y, z))
            .prop_filter("long enough to have a direction", |v| v.norm() > 1e-3)
            .prop_map(|v| v.normalize())
    }

    fn assert_orthonormal(frame: &Frame) {
        assert!((frame.tangent.cross(&frame.bitangent) - frame.normal).norm() < 1e-12);
        for axis in [frame.tangent, frame.bitangent, frame.normal] {
            assert!((axis.norm() - 1.0).abs() < 1e-12);
        }
    }

    proptest! {
        #[test]
        fn frames_are_orthonormal_and_invert(n in direction(), t in direction(), v in direction()) {
            for frame in [Frame::about(n), Frame::new(n, t)] {
                assert_orthonormal(&frame);
                let back = frame.world_from_local(frame.local_from_world(v));
                prop_assert!((back - v).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn parallel_tangent_still_gives_a_frame() {
        assert_orthonormal(&Frame::new(Vec3::z(), Vec3::z()));
        assert_orthonormal(&Frame::new(-Vec3::z(), Vec3::zeros()));
        assert_eq!(Frame::about(Vec3::z()).tangent, Vec3::x());
    }
}
