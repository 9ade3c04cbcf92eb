//! What several rows use: tables, pictures of them, and how far their normals lean.

use std::sync::Arc;

use crate::evidence::{Field, Halted, Images, Panel, Stroke, Task};
use crate::geometry::Vec3;
use crate::light::Light;
use crate::lobe::{BaseLobe, Shading};
use crate::method::{Silent, brute_force};
use crate::parameter::{Value, Values};
use crate::pattern;
use crate::render::{Camera, Film, PixelSampler, View, direction, render};
use crate::surface::{Plane, Shape, Sphere, Surface, bent_patch, ribbon};
use crate::texture::{HeightMap, Lookup, NormalMap, Wrap};

/// Entries along a side of the paper's table.
pub const SIDE: usize = 64;

/// Height of the ribbon, scene units.
const RIBBON: f64 = 0.6;

/// Samples a pixel of the pictures: they are to show bumps, not how they alias.
const SPP: u32 = 16;

/// A pattern of the program's on a square map, with its heights.
pub fn table(name: &str, side: usize, set: &[(&'static str, Value)], seed: u64) -> Arc<NormalMap> {
    oblong(name, [side, side], set, seed)
}

/// The same on a map of `width` × `height` texels.
pub fn oblong(
    name: &str,
    [width, height]: [usize; 2],
    set: &[(&'static str, Value)],
    seed: u64,
) -> Arc<NormalMap> {
    let entry = pattern::find(name).expect("a pattern of the program's own");
    let values = Values::defaults(entry.parameters).with(set);
    let bumps = (entry.build)(width, height, &values, seed);
    let heights = bumps.heights.map(Arc::new);
    Arc::new(match heights {
        Some(heights) => bumps.normals.with_heights(heights),
        None => bumps.normals,
    })
}

/// What is seen, and in which light.
pub struct Scene {
    /// The surface, tiled.
    pub shape: Shape,
    /// The camera.
    pub camera: Camera,
    /// Unit direction to the light, world space.
    pub light: Vec3,
    /// Exponent of the base lobe; a low one looks dull.
    pub exponent: f32,
}

impl Scene {
    /// A tile of one unit on the plane about the origin, seen from `elevation` degrees above it.
    pub fn plane(elevation: f64, [width, height]: [usize; 2]) -> Self {
        Self {
            shape: Shape::Plane(Plane::new().tiled(1.0, 1.0)),
            camera: Camera::look_at(
                Vec3::new(0.5, 0.5, 0.0) + direction(elevation, -90.0) * 3.2,
                Vec3::new(0.5, 0.5, 0.0),
                18.0,
                width,
                height,
            ),
            light: direction(40.0, 150.0),
            exponent: 10.0,
        }
    }

    /// The flat patch with a corner bent back, a table on it `repeat` times along each side.
    pub fn bent(repeat: f64, [width, height]: [usize; 2]) -> Self {
        Self {
            shape: Shape::Patches(bent_patch().tiled(0.5 * repeat, 1.0)),
            camera: Camera::orbiting(6.0, 42.0, -105.0, 24.0, width, height),
            light: direction(45.0, 150.0),
            exponent: 8.0,
        }
    }

    /// The ribbon, with a table whose height is `aspect` of its width over all of its height.
    pub fn ribbon(aspect: f64, [width, height]: [usize; 2]) -> Self {
        Self {
            shape: Shape::Patches(ribbon().tiled(aspect / RIBBON, aspect)),
            camera: Camera::orbiting(5.0, 8.0, -90.0, 11.0, width, height),
            light: direction(40.0, -95.0),
            exponent: 8.0,
        }
    }

    /// The sphere, with `tiles` square tables around its equator.
    pub fn ball(tiles: f64, [width, height]: [usize; 2]) -> Self {
        Self {
            shape: Shape::Sphere(Sphere::new().tiled(tiles / std::f64::consts::TAU, 1.0)),
            camera: Camera::orbiting(5.0, 20.0, -90.0, 25.0, width, height),
            light: direction(45.0, -140.0),
            exponent: 8.0,
        }
    }

    /// What of it is seen by a renderer.
    pub fn view(&self, wrap: Wrap) -> View {
        View {
            camera: self.camera,
            surface: self.shape.clone(),
            light: Light::Directional { direction: self.light, irradiance: 1.0 },
            shading: Shading::Ndf,
            wrap,
            lookup: Lookup::default(),
        }
    }

    /// Its picture with bumps.
    ///
    /// # Errors
    /// [`Halted`] if the work should stop.
    pub fn picture(&self, map: &Arc<NormalMap>, task: &Task) -> Result<Arc<Film>, Halted> {
        let base = BaseLobe::BlinnPhong { exponent: self.exponent.into() };
        let bumps = brute_force().prefilter(map, &base, &Silent).map_err(|_| Halted)?;
        let cancelled = || task.progress.cancelled();
        let (view, sampler) = (self.view(map.wrap()), PixelSampler::new(SPP));
        Ok(Arc::new(render(&view, bumps.as_ref(), &sampler, task.seed, 0, &cancelled)?))
    }
}

/// Pictures side by side, each on the exposure of the first.
pub fn side_by_side(panels: Vec<Panel>, across: usize) -> Images {
    Images { panels, white: None, reference: None, across }
}

/// A map's heights as a figure's field; `label` names it.
pub fn field(label: &str, heights: &HeightMap) -> Field {
    Field { label: label.into(), width: heights.width(), values: heights.values().to_vec() }
}

/// A line of a diagram.
pub fn line(points: Vec<[f64; 2]>, ink: usize) -> Stroke {
    Stroke { points, arrow: false, name: String::new(), ink }
}

/// An arrow of a diagram.
pub fn arrow(from: [f64; 2], along: [f64; 2], name: &str, ink: usize) -> Stroke {
    let points = vec![from, [from[0] + along[0], from[1] + along[1]]];
    Stroke { points, arrow: true, name: name.into(), ink }
}
