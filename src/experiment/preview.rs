//! One image of an experiment, without keeping or scoring anything.

use bevy_ecs::prelude::{Component, Entity, World};

use super::author::author;
use super::spec::{LightSpec, Scale, Spec, SurfaceSpec, TextureSpec, no_such};
use crate::method::{self, Method};
use crate::render::{self, Film, Filtered, PixelSampler};
use crate::scene::{
    Current, Failure, Halt, LightSource, Map, MovedLight, ProbePlan, Progress, ReferencePlan,
    SceneOf, StagedScene, Stagehand, SurfaceShape, stage,
};

/// Which image of an experiment.
#[derive(Clone, Copy, Debug)]
pub struct Wish<'a> {
    /// The texture by name; the first if None.
    pub texture: Option<&'a str>,
    /// Texels across the pixel at the image's centre; the experiment's first scale if None.
    pub texels_per_pixel: Option<f64>,
    /// Samples a pixel, at least 1.
    pub spp: u32,
    /// Which frame, where things move, the first being 0, which stands for those there are not.
    pub frame: u32,
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
    Stock::default().stage_one(spec, wish)
}

/// What scenes are made of, kept from one to the next: those that differ in camera or scale alone need not load and
/// build anew.
#[derive(Debug, Default)]
pub struct Stock {
    texture: Option<((TextureSpec, bool), Map)>,
    surface: Option<(SurfaceSpec, SurfaceShape)>,
    light: Option<(LightSpec, LightSource)>,
    /// What was told while the last scene's surface and light were made, if they were not kept.
    told: Vec<String>,
}

/// Ticks that load whatever there is: a light that moves is made after the one at rest.
const LOADS: usize = 2;

impl Stock {
    /// [`stage_one`], with what of the scene before is the same.
    ///
    /// # Errors
    /// Those of [`stage_one`].
    pub fn stage_one(&mut self, spec: &Spec, wish: &Wish<'_>) -> Result<StagedScene, NoImage> {
        let one = one_of(spec, wish)?;
        let mut hand = Stagehand::new(spec.seed, Halt::default());
        let plan = author(&one, &mut hand);
        let first = plan.scenes.first().expect("a spec has a texture, a lobe and a scale");
        let mut frames = plan.scenes.iter().take_while(|scene| scene.sequence == first.sequence);
        let scene = frames.nth(wish.frame as usize).unwrap_or(first);
        hand.world.insert_resource(Current(scene.entity));
        let of = *hand.world.get::<SceneOf>(scene.entity).expect("a scene names its parts");
        let texture = (one.sweep.textures[0].clone(), one.needs_heights());
        lend(&self.texture, &texture, &mut hand.world, of.texture);
        lend(&self.surface, &one.surface, &mut hand.world, of.surface);
        // A light that has moved is made of the one at rest.
        let light = hand.world.get::<MovedLight>(of.light).map_or(of.light, |moved| moved.of);
        lend(&self.light, &one.light, &mut hand.world, light);
        // With no method in the sweep, and neither reference nor probes, a tick loads what is missing and no more.
        hand.world.entity_mut(scene.entity).remove::<(ReferencePlan, ProbePlan)>();
        let told = (0..LOADS).flat_map(|_| hand.tick());
        let noted = told.filter_map(|progress| match progress {
            Progress::Noted { text } => Some(text),
            _ => None,
        });
        self.told = noted.collect();
        if let Some(error) = hand.world.resource_mut::<Failure>().0.take() {
            return Err(NoImage(error.to_string()));
        }
        let missing = || NoImage("the scene could not be put together".into());
        let staged = stage(&mut hand.world, scene.entity).ok_or_else(missing)?;
        let kept = &hand.world;
        self.texture = kept.get::<Map>(of.texture).cloned().map(|map| (texture, map));
        self.surface = kept.get::<SurfaceShape>(of.surface).cloned().map(|s| (one.surface, s));
        self.light = kept.get::<LightSource>(light).cloned().map(|light| (one.light, light));
        Ok(staged)
    }

    /// What is worth knowing about the texture of the last scene, a sentence each.
    pub fn notes(&self) -> &[String] {
        self.texture.as_ref().map_or(&[], |(_, map)| &map.notes)
    }
}

/// Puts a component that is kept beside the entity it is to be made for, if it was made of the same.
fn lend<K: PartialEq, C: Component + Clone>(
    kept: &Option<(K, C)>,
    key: &K,
    world: &mut World,
    entity: Entity,
) {
    if let Some((of, component)) = kept
        && of == key
    {
        world.entity_mut(entity).insert(component.clone());
    }
}

/// The spec with what `wish` chooses alone, and no method.
fn one_of(spec: &Spec, wish: &Wish<'_>) -> Result<Spec, NoImage> {
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
    Ok(one)
}

/// Frames that follow one another.
#[derive(Debug)]
pub struct Frames {
    /// One a frame.
    pub films: Vec<Film>,
    /// What is worth knowing about the texture, the surface and the light, a sentence each.
    pub notes: Vec<String>,
}

/// Renders `count` frames of an experiment from the one wished for on, through one prefiltered map: the scenes of
/// [`stage_one`]. `progress` hears of the prefilter, `rendered` how many frames there are.
///
/// # Errors
/// Those of [`stage_one`], or if the method refuses the base lobe.
pub fn render_frames(
    spec: &Spec,
    method: &dyn Method,
    wish: &Wish<'_>,
    count: u32,
    progress: &dyn method::Progress,
    rendered: &dyn Fn(u32),
) -> Result<Frames, NoImage> {
    let mut stock = Stock::default();
    let staged = stock.stage_one(spec, wish)?;
    let notes = [stock.notes(), &stock.told].concat();
    let prefiltered = method
        .prefilter(&staged.map, &staged.material.base, progress)
        .map_err(|error| NoImage(format!("{}: {error}", method.card().name)))?;
    let sampler = PixelSampler::new(wish.spp);
    let mut films = Vec::new();
    for (frame, number) in (wish.frame..wish.frame.saturating_add(count)).zip(1..) {
        let staged = stock.stage_one(spec, &Wish { frame, ..*wish })?;
        let filtered =
            Filtered { map: &staged.map, card: method.card(), prefiltered: prefiltered.as_ref() };
        let film = render::trial(&staged.view, &filtered, &sampler, spec.seed, 0, &|| false)
            .map_err(|error| NoImage(error.to_string()))?;
        films.push(film);
        rendered(number);
    }
    Ok(Frames { films, notes })
}
