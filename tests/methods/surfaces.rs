//! Every method on every kind of surface.

use std::sync::LazyLock;

use wrinkle::light::Light;
use wrinkle::lobe::Shading;
use wrinkle::method::Prefiltered;
use wrinkle::render::{Camera, Film, PixelSampler, View, direction, render};
use wrinkle::surface::{Cylinder, Shape, Sphere, bent_patch, drapery, ribbon, teapot, teapot_mesh};
use wrinkle::texture::{Lookup, Wrap};

use super::fixture::{bumps, cases, single};

static SURFACES: LazyLock<[(&str, Shape); 7]> = LazyLock::new(|| {
    [
        ("sphere", Shape::Sphere(Sphere::new())),
        ("cylinder", Shape::Cylinder(Cylinder::new())),
        ("drapery", Shape::Mesh(drapery())),
        ("teapot", Shape::Patches(teapot())),
        ("teapot of triangles", Shape::Mesh(teapot_mesh(6))),
        ("bent patch", Shape::Patches(bent_patch())),
        ("ribbon", Shape::Patches(ribbon())),
    ]
});

/// A few pixels of a surface, from the front and above, lit from the left.
fn film(shape: &Shape, tiles: f64, shading: Shading, map: &dyn Prefiltered) -> Film {
    let view = View {
        camera: Camera::orbiting(4.0, 30.0, -90.0, 30.0, 14, 10),
        surface: shape.tiled(tiles, 1.0),
        light: Light::Directional { direction: direction(45.0, -130.0), irradiance: 1.0 },
        shading,
        wrap: Wrap::Repeat,
        lookup: Lookup::default(),
    };
    render(&view, map, &PixelSampler::new(1), 1, 0, &|| false).unwrap()
}

#[test]
fn light_is_finite_and_not_negative_and_there_is_some() {
    let map = bumps(8, 8, Wrap::Repeat);
    for case in cases() {
        let filtered = case.on(&map);
        for ((name, shape), shading) in
            SURFACES.iter().flat_map(|s| [(s, Shading::Ndf), (s, Shading::Microfacet)])
        {
            let film = film(shape, 3.0, shading, filtered.as_ref());
            let place = format!("{} on the {name}", case.name);
            assert!(film.pixels().iter().all(|p| p.is_finite() && *p >= 0.0), "{place}");
            assert!(film.pixels().iter().any(|p| *p > 0.0), "{place} is dark");
        }
    }
}

#[test]
fn a_flat_map_is_left_alone_however_it_is_laid() {
    let flat = single(4, [0.0, 0.0, 1.0]);
    for case in cases() {
        let filtered = case.on(&flat);
        for (name, shape) in SURFACES.iter() {
            // Footprints of 7 texels and more: smaller ones go over to the base lobe itself.
            let [wide, fine] =
                [8.0, 300.0].map(|tiles| film(shape, tiles, Shading::Ndf, filtered.as_ref()));
            for (a, b) in wide.pixels().iter().zip(fine.pixels()) {
                // As in `flat`: weights of a lookup add to 1 but for rounding.
                assert!((a - b).abs() <= 5e-5 * b + 1e-6, "{} on the {name}: {a} {b}", case.name);
            }
        }
    }
}
