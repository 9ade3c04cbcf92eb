//! One image of an experiment, without keeping or scoring anything.

use super::author::author;
use super::spec::{Scale, Spec, no_such};
use crate::method::{Method, Progress};
use crate::render::{self, Film, Filtered, PixelSampler};
use crate::scene::{Current, Failure, Halt, StagedScene, Stagehand, stage};

/// Which image of an experiment.
#[derive(Clone, Copy, Debug)]
pub struct Wish<'a> {
    /// The texture by name; the first if None.
    pub texture: Option<&'a str>,
    /// Texels across the pixel at the image's centre; the experiment's first scale if None.
    pub texels_per_pixel: Option<f64>,
    /// Samples a pixel, at least 1.
    pub spp: u32,
}

/// Why there is no image; a sentence.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct NoImage(String);

/// The scene of one image of an experiment, ready to render: its first lobe, and what `wish` chooses.
///
/// # Errors
/// If there is no such texture, or it cannot be loaded.
pub fn stage_one(spec: &Spec, wish: &Wish<'_>) -> Result<StagedScene, NoImage> {
    let mut one = spec.clone();
    one.sweep.methods.clear();
    if let Some(name) = wish.texture {
        one.sweep.textures.retain(|texture| texture.name == name);
        if one.sweep.textures.is_empty() {
            let known: Vec<&str> = spec.sweep.textures.iter().map(|t| t.name.as_str()).collect();
            return Err(NoImage(no_such("texture", name, &known)));
        }
    }
    if let Some(texels) = wish.texels_per_pixel {
        if !(texels > 0.0 && texels <= 65536.0) {
            let message =
                format!("{texels} texels across a pixel: give more than 0, at most 65536");
            return Err(NoImage(message));
        }
        one.sweep.scale = Scale::TexelsPerPixel(vec![texels]);
    }
    let mut hand = Stagehand::new(spec.seed, Halt::default());
    let plan = author(&one, &mut hand);
    let scene = plan.scenes.first().expect("a spec has a texture, a lobe and a scale");
    hand.world.insert_resource(Current(scene.entity));
    // With no method in the sweep, a tick loads texture and light; the rest is for others to do.
    hand.tick();
    if let Some(error) = hand.world.resource_mut::<Failure>().0.take() {
        return Err(NoImage(error.to_string()));
    }
    stage(&mut hand.world, scene.entity)
        .ok_or_else(|| NoImage("the scene could not be put together".into()))
}

/// Renders one image of an experiment through a method: the scene of [`stage_one`]. `progress` hears of
/// the prefilter.
///
/// # Errors
/// Those of [`stage_one`], or if the method refuses the base lobe.
pub fn render_one(
    spec: &Spec,
    method: &dyn Method,
    wish: &Wish<'_>,
    progress: &dyn Progress,
) -> Result<Film, NoImage> {
    let staged = stage_one(spec, wish)?;
    let prefiltered = method
        .prefilter(&staged.map, &staged.material.base, progress)
        .map_err(|error| NoImage(format!("{}: {error}", method.card().name)))?;
    let sampler = PixelSampler::new(wish.spp);
    let filtered =
        Filtered { map: &staged.map, card: method.card(), prefiltered: prefiltered.as_ref() };
    render::trial(&staged.view, &filtered, &sampler, spec.seed, 0, &|| false)
        .map_err(|error| NoImage(error.to_string()))
}
