//! Ripples on a sphere.

use super::{Frame, Vec3};

/// A unit sphere whose radius ripples in rings about the x axis: r(n) = 1 + h cos(k α), α the angle between
/// the direction n and x.
///
/// cos(k α) is the Chebyshev polynomial T_k of x = n·x̂, so the surface is smooth everywhere, the two ends of
/// the axis and the poles of any coordinates included. The wavy sphere of Olano and North 1997, figures 1
/// and 2, is not described further in print; this one is chosen here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ripples {
    /// k: crests on a great circle through the ends of the axis.
    pub count: u32,
    /// h in [0, 1): half the difference between crests and troughs, radii.
    pub amplitude: f64,
}

impl Ripples {
    /// r at unit direction `n`.
    pub fn radius(&self, n: Vec3) -> f64 {
        1.0 + self.amplitude * chebyshev(self.count, n.x)[0]
    }

    /// The outward unit normal of the surface at unit direction `n`: n r − ∇r, ∇r along the unit sphere.
    pub fn normal(&self, n: Vec3) -> Vec3 {
        let [value, derivative] = chebyshev(self.count, n.x);
        let along = Vec3::x() - n * n.x;
        let normal = n * (1.0 + self.amplitude * value) - along * (self.amplitude * derivative);
        normal.normalize()
    }
}

/// [T_k(x), T_k′(x)] for x in [−1, 1], by the recurrence T_{k+1} = 2 x T_k − T_{k−1}.
fn chebyshev(k: u32, x: f64) -> [f64; 2] {
    let [mut before, mut now] = [[1.0, 0.0], [x, 1.0]];
    for _ in 0..k {
        let next = [2.0 * x * now[0] - before[0], 2.0 * (now[0] + x * now[1]) - before[1]];
        (before, now) = (now, next);
    }
    before
}

/// The frame of the unit sphere at a longitude and latitude, radians: tangent east, bitangent north. Both
/// keep their meaning at a pole, where the longitude says which way is east.
pub fn spherical_frame(longitude: f64, latitude: f64) -> Frame {
    let (sin_a, cos_a) = libm::sincos(longitude);
    let (sin_e, cos_e) = libm::sincos(latitude);
    Frame {
        tangent: Vec3::new(-sin_a, cos_a, 0.0),
        bitangent: Vec3::new(-sin_e * cos_a, -sin_e * sin_a, cos_e),
        normal: Vec3::new(cos_e * cos_a, cos_e * sin_a, sin_e),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn ripples_are_cosines_and_normals_are_of_the_surface(
            count in 0u32..40, amplitude in 0.0f64..0.5, a in -3.1f64..3.1, e in -1.5f64..1.5
        ) {
            let ripples = Ripples { count, amplitude };
            let place = |a, e| {
                let n = spherical_frame(a, e).normal;
                (n, n * ripples.radius(n))
            };
            let (n, here) = place(a, e);
            let want = 1.0 + amplitude * (f64::from(count) * n.x.clamp(-1.0, 1.0).acos()).cos();
            prop_assert!((ripples.radius(n) - want).abs() < 1e-9);
            // The normal is perpendicular to steps along the surface, to second order.
            let d = 1e-6;
            let normal = ripples.normal(n);
            prop_assert!(normal.dot(&n) > 0.0);
            for (da, de) in [(d, 0.0), (0.0, d)] {
                let step = place(a + da, e + de).1 - place(a - da, e - de).1;
                prop_assert!(step.dot(&normal).abs() < 1e-6 * step.norm().max(d * 0.1), "{}", step.dot(&normal));
            }
            prop_assert!((here.norm() - ripples.radius(n)).abs() < 1e-12);
        }

        #[test]
        fn spherical_frames_are_right_handed(a in -7.0f64..7.0, e in -1.6f64..1.6) {
            let frame = spherical_frame(a, e);
            prop_assert!((frame.tangent.cross(&frame.bitangent) - frame.normal).norm() < 1e-14);
        }
    }

    #[test]
    fn the_ends_of_the_axis_are_crests() {
        let ripples = Ripples { count: 12, amplitude: 0.1 };
        for end in [Vec3::x(), -Vec3::x()] {
            assert!((ripples.radius(end) - 1.1).abs() < 1e-12);
            assert!((ripples.normal(end) - end).norm() < 1e-12);
        }
    }
}
