//! Pictures of a multiple surface on its own, without a map.

use super::{Camera, Film, PixelSampler, View, direction, render};
use crate::light::Light;
use crate::lobe::{MultipleSurface, Shading};
use crate::method::Constant;
use crate::surface::{Plane, Shape, Sphere};
use crate::texture::Wrap;

/// How the picture is taken: one directional light of irradiance 1, a camera that looks at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Portrait {
    /// What the surface covers.
    pub shape: Shape,
    /// Where the camera is.
    pub camera: Camera,
    /// The one light.
    pub light: Light,
    /// How lobes become light.
    pub shading: Shading,
    /// Samples a pixel, at least 1.
    pub spp: u32,
    /// The seed of sample positions.
    pub seed: u64,
}

impl Portrait {
    /// A sphere seen from slightly above, lit from the upper left of the camera.
    pub fn sphere(width: usize, height: usize) -> Self {
        Self {
            shape: Shape::Sphere(Sphere::new()),
            camera: Camera::orbiting(6.0, 20.0, -90.0, 22.0, width, height),
            light: Light::Directional { direction: direction(45.0, -125.0), irradiance: 1.0 },
            shading: Shading::Ndf,
            spp: 16,
            seed: 1,
        }
    }

    /// A plane lit from beyond, as experiments have it by default.
    pub fn plane(width: usize, height: usize) -> Self {
        Self {
            shape: Shape::Plane(Plane::new()),
            camera: Camera::orbiting(4.0, 40.0, -90.0, 25.0, width, height),
            light: Light::Directional { direction: direction(40.0, 90.0), irradiance: 1.0 },
            ..Self::sphere(width, height)
        }
    }

    /// The picture of a surface that is `surface` everywhere.
    pub fn of(&self, surface: MultipleSurface) -> Film {
        let view = View {
            camera: self.camera,
            surface: self.shape.clone(),
            light: self.light.clone(),
            shading: self.shading,
            wrap: Wrap::Repeat,
            lookup: crate::texture::Lookup::default(),
        };
        let sampler = PixelSampler::new(self.spp);
        render(&view, &Constant(surface), &sampler, self.seed, 0, &|| false)
            .expect("nothing cancels it")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::{PhongPeak, find_named};

    #[test]
    fn a_sphere_of_one_peak_is_the_closed_form() {
        let exponent = 30.0;
        let mut surface = MultipleSurface::new();
        surface.add(PhongPeak { amplitude: 1.5, direction: [0.0, 0.0, 1.0], exponent }, 1.0);
        let portrait = Portrait { spp: 1, ..Portrait::sphere(41, 31) };
        let film = portrait.of(surface);
        let Light::Directional { direction: light, .. } = portrait.light else { unreachable!() };
        for (i, radiance) in film.pixels().iter().enumerate() {
            let ray = portrait.camera.ray((i % 41) as f64 + 0.5, (i / 41) as f64 + 0.5);
            let hit = portrait.shape.intersect(portrait.camera.origin(), ray);
            let want = hit.map_or(0.0, |hit| {
                let cosine = hit.frame.normal.dot(&(light - ray.normalize()).normalize());
                let lit = hit.frame.normal.dot(&light) > 0.0;
                if lit { 1.5 * cosine.max(0.0).powi(30) } else { 0.0 }
            });
            assert!((f64::from(*radiance) - want).abs() < 1e-4, "{i}: {radiance} {want}");
        }
    }

    #[test]
    fn velvet_is_brighter_at_its_rim_than_in_its_middle() {
        let portrait = Portrait {
            camera: Camera::orbiting(6.0, 0.0, -90.0, 22.0, 200, 200),
            light: Light::Directional { direction: direction(0.0, -90.0), irradiance: 1.0 },
            ..Portrait::sphere(200, 200)
        };
        let film = portrait.of(find_named("velvet").unwrap().surface());
        let row = &film.pixels()[100 * 200..101 * 200];
        let rim = row.iter().copied().fold(0.0, f32::max);
        assert!(rim > 2.0 * row[100], "{rim} {}", row[100]);
    }

    #[test]
    fn a_plane_is_lit() {
        let film = Portrait::plane(16, 12).of(find_named("three-normals").unwrap().surface());
        assert!(film.pixels().iter().all(|p| p.is_finite()) && film.white() > 0.0);
    }
}
