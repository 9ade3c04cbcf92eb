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
use crate::surface::{Plane, Shape, Surface};
use crate::texture::{HeightMap, Lookup, NormalMap, Wrap};

/// Entries along a side of the paper's table.
pub const SIDE: usize = 64;

/// Samples a pixel of the pictures: they are to show bumps, not how they alias.
const SPP: u32 = 64;

/// A pattern of the program's on a square map, with its heights.
pub fn table(name: &str, side: usize, set: &[(&'static str, Value)], seed: u64) -> Arc<NormalMap> {
    let entry = pattern::find(name).expect("a pattern of the program's own");
    let values = Values::defaults(entry.parameters).with(set);
    let bumps = (entry.build)(side, side, &values, seed);
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
