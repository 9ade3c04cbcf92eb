//! What the rows share: distributions, views, pictures.

use std::sync::Arc;

use crate::evidence::{Drawing, Field, Figure, Halted, Images, Panel, Task};
use crate::geometry::Vec3;
use crate::light::Light;
use crate::lobe::{BaseLobe, EllipticLobe, MultipleSurface, NdfImage, Profile, Shading};
use crate::method::Prefiltered;
use crate::render::{Camera, Film, PixelSampler, View, render};
use crate::surface::Shape;
use crate::synthesis::{Noise, Synthesis};
use crate::texture::{Lookup, Wrap};

/// Pixels along a side of NDFs.
pub const SIDE: usize = 256;
/// Octaves that are more than any picture shows.
pub const ALL: f64 = 20.0;

fn up(lobes: impl IntoIterator<Item = EllipticLobe>) -> NdfImage {
    let surface: MultipleSurface = lobes.into_iter().collect();
    NdfImage::of_surface(&surface, SIDE).expect("lobes have density")
}

/// A round one: a Blinn-Phong lobe.
pub fn isotropic(exponent: f64) -> NdfImage {
    up([BaseLobe::BlinnPhong { exponent }.about([0.0, 0.0, 1.0], 1.0)])
}

/// One much wider along x than along y, turned a little so that x and y are not independent.
pub fn anisotropic() -> NdfImage {
    up([EllipticLobe::new([0.0, 0.0, 1.0], [0.09, 0.02, 0.012], 1.0, Profile::Gaussian)])
}

/// One of three lobes.
pub fn several() -> NdfImage {
    let base = BaseLobe::BlinnPhong { exponent: 40.0 };
    up([([0.45, 0.0, 0.89], 0.4), ([-0.25, 0.4, 0.88], 0.35), ([-0.2, -0.4, 0.89], 0.25)]
        .map(|(normal, part)| base.about(normal, part)))
}

/// An NDF to shade by: "a diffuse component (although not a Lambertian diffuse component) can be incorporated directly
/// into the NDF" (§6).
pub fn with_diffuse(ndf: &NdfImage) -> Arc<NdfImage> {
    Arc::new(ndf.with_floor(0.4))
}

/// The synthesis from an NDF, with so many lattice cells a tile.
pub fn synthesis(ndf: NdfImage, cells: u32, seed: u64) -> Arc<Synthesis> {
    Arc::new(Synthesis::new(ndf, Noise { cells: [cells; 2], seed, ..Noise::default() }))
}

/// A surface under a light from far away, shaded by the bare distribution as the paper's pictures are.
pub fn view(camera: Camera, surface: Shape, to_light: Vec3) -> View {
    View {
        camera,
        surface,
        light: Light::Directional { direction: to_light, irradiance: 1.0 },
        shading: Shading::Ndf,
        wrap: Wrap::Repeat,
        lookup: Lookup::default(),
    }
}

/// Its picture.
///
/// # Errors
/// [`Halted`] if the work should stop.
pub fn shot(view: &View, of: &dyn Prefiltered, spp: u32, task: &Task) -> Result<Film, Halted> {
    let cancelled = || task.progress.cancelled();
    Ok(render(view, of, &PixelSampler::new(spp), task.seed, 0, &cancelled)?)
}

/// NDFs on the (x, y) map, each in parts of its own greatest value.
pub fn maps(name: &str, caption: &str, all: &[(&str, &NdfImage)]) -> Figure {
    let field = |(label, ndf): &(&str, &NdfImage)| {
        let most = ndf.values().iter().fold(f32::MIN_POSITIVE, |most, d| most.max(*d));
        let values = ndf.values().iter().map(|d| f64::from(d / most)).collect();
        Field { label: (*label).into(), width: ndf.side(), values }
    };
    Figure::new(name, caption, Drawing::Fields(all.iter().map(field).collect()))
}

/// Pictures in a row, on one exposure.
pub fn pictures(name: &str, caption: &str, panels: Vec<Panel>) -> Figure {
    let across = panels.len().min(4);
    let images = Images { panels, white: None, reference: None, across };
    Figure::new(name, caption, Drawing::Images(images))
}

/// The mean of a film.
pub fn mean(film: &Film) -> f64 {
    film.pixels().iter().map(|p| f64::from(*p)).sum::<f64>() / film.pixels().len() as f64
}

/// The root mean square difference of two films, over the mean of the second.
pub fn apart(film: &Film, truth: &Film) -> f64 {
    let squares = film.pixels().iter().zip(truth.pixels()).map(|(a, b)| f64::from(a - b).powi(2));
    (squares.sum::<f64>() / film.pixels().len() as f64).sqrt() / mean(truth)
}
