//! The pinhole camera.

use crate::geometry::{Vec3, turned};

/// A pinhole camera. Image coordinates are in pixels, x to the right and y *down* from the top left
/// corner; pixel (i, j) covers [i, i+1] × [j, j+1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    origin: Vec3,
    /// Direction through the image's top left corner.
    corner: Vec3,
    /// Change of direction for one pixel to the right.
    right: Vec3,
    /// Change of direction for one pixel down.
    down: Vec3,
    width: usize,
    height: usize,
}

impl Camera {
    /// A camera at `origin` that looks at `target`, z up, with a vertical field of view of
    /// `fov_degrees` in (0, 180), and an image of `width` × `height` square pixels. Looking straight
    /// up or down, the top of the image is +y. A target where the camera is gives a camera that looks down.
    pub fn look_at(
        origin: Vec3,
        target: Vec3,
        fov_degrees: f64,
        width: usize,
        height: usize,
    ) -> Self {
        let forward = (target - origin).try_normalize(1e-12).unwrap_or(-Vec3::z());
        let level = forward.cross(&Vec3::z());
        let side = if level.norm() > 1e-9 { level.normalize() } else { Vec3::x() };
        let up = side.cross(&forward);
        let half = libm::tan(0.5 * fov_degrees.to_radians());
        let pixel = 2.0 * half / height as f64;
        let (right, down) = (side * pixel, up * -pixel);
        let corner = forward - right * (0.5 * width as f64) - down * (0.5 * height as f64);
        Self { origin, corner, right, down, width, height }
    }

    /// A camera that looks at the world's origin from `distance` away, `elevation` degrees above the
    /// plane z = 0 and at `azimuth` degrees from +x towards +y.
    pub fn orbiting(
        distance: f64,
        elevation: f64,
        azimuth: f64,
        fov_degrees: f64,
        width: usize,
        height: usize,
    ) -> Self {
        let origin = direction(elevation, azimuth) * distance;
        Self::look_at(origin, Vec3::zeros(), fov_degrees, width, height)
    }

    /// This camera moved round the vertical through the origin, by degrees from +x towards +y, what it looks at
    /// with it.
    pub fn turned(&self, degrees: f64) -> Self {
        let [origin, corner, right, down] =
            [self.origin, self.corner, self.right, self.down].map(|v| turned(v, degrees));
        Self { origin, corner, right, down, ..*self }
    }

    /// Where it is, world space.
    pub fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Pixels across.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Direction (not of unit length) of the ray through image point (x, y).
    #[inline(always)]
    pub fn ray(&self, x: f64, y: f64) -> Vec3 {
        self.corner + self.right * x + self.down * y
    }

    /// How a ray's direction changes over one pixel to the right, and one down; the same everywhere.
    pub fn ray_steps(&self) -> [Vec3; 2] {
        [self.right, self.down]
    }
}

/// The unit vector `elevation` degrees above the plane z = 0 and at `azimuth` degrees from +x towards
/// +y.
pub fn direction(elevation: f64, azimuth: f64) -> Vec3 {
    let (sin_e, cos_e) = libm::sincos(elevation.to_radians());
    let (sin_a, cos_a) = libm::sincos(azimuth.to_radians());
    Vec3::new(cos_e * cos_a, cos_e * sin_a, sin_e)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_centre_looks_at_the_target() {
        let camera = Camera::orbiting(4.0, 40.0, -90.0, 25.0, 160, 120);
        let ray = camera.ray(80.0, 60.0);
        assert!((ray.normalize() + camera.origin().normalize()).norm() < 1e-12);
    }

    #[test]
    fn right_is_right_and_down_is_down() {
        // From −y, looking north: right is +x, down is −z.
        let camera = Camera::orbiting(4.0, 0.0, -90.0, 60.0, 100, 100);
        let [right, down] = camera.ray_steps();
        assert!(right.x > 0.0 && right.yz().norm() < 1e-12);
        assert!(down.z < 0.0 && down.xy().norm() < 1e-12);
        let top = camera.ray(50.0, 0.0);
        let angle = libm::atan2(top.z, top.y).to_degrees();
        assert!((angle - 30.0).abs() < 1e-9);
    }

    #[test]
    fn straight_down_has_north_on_top() {
        let camera = Camera::orbiting(4.0, 90.0, -90.0, 60.0, 100, 100);
        assert!(camera.ray_steps()[1].y < 0.0);
    }
}
