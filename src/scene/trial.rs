//! Trials: a scene seen through a strategy at some number of samples.

use std::sync::Arc;
use std::time::Instant;

use bevy_ecs::prelude::*;
use bevy_ecs::system::{SystemParam, SystemState};

use super::{
    CameraPose, Current, Halt, LightSource, LookupBy, Map, Material, Prefilter, PrefilterOf,
    Progress, SceneOf, Seed, Stage, Strategy, SurfaceShape, TiledBefore, Tiling,
};
use crate::render::{self, Film, Filtered, PixelSampler, View};
use crate::texture::NormalMap;

/// A trial of a scene, through a prefilter (which names the strategy).
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct TrialOf {
    pub scene: Entity,
    pub prefilter: Entity,
}

/// Samples a pixel of a trial.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spp(pub u32);

/// What a trial's rendering gave.
#[derive(Component, Clone, Debug)]
pub struct Exposure {
    /// The image.
    pub film: Arc<Film>,
    /// CPU seconds it took: wall-clock time × threads.
    pub cpu_secs: f64,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(expose.in_set(Stage::Render));
}

/// A scene put together from its entities.
pub struct StagedScene {
    /// What is seen.
    pub view: View,
    /// The map on the surface.
    pub map: Arc<NormalMap>,
    /// What the surface is made of.
    pub material: Material,
}

/// The scene put together, if its texture is loaded.
pub fn stage(world: &mut World, scene: Entity) -> Option<StagedScene> {
    let mut state = SystemState::<SceneView>::new(world);
    state.get(world).ok()?.of(scene)
}

/// Puts scenes together.
#[derive(SystemParam)]
pub struct SceneView<'w, 's> {
    scenes: Query<'w, 's, (&'static SceneOf, &'static Tiling, Option<&'static TiledBefore>)>,
    maps: Query<'w, 's, &'static Map>,
    surfaces: Query<'w, 's, &'static SurfaceShape>,
    cameras: Query<'w, 's, &'static CameraPose>,
    lights: Query<'w, 's, &'static LightSource>,
    materials: Query<'w, 's, &'static Material>,
}

impl SceneView<'_, '_> {
    /// The scene, if its texture is loaded.
    pub fn of(&self, scene: Entity) -> Option<StagedScene> {
        let (of, tiling, before) = self.scenes.get(scene).ok()?;
        let map = Arc::clone(&self.maps.get(of.texture).ok()?.normals);
        let material = *self.materials.get(of.material).ok()?;
        let untiled = View {
            camera: self.cameras.get(of.camera).ok()?.camera,
            surface: self.surfaces.get(of.surface).ok()?.0.clone(),
            light: self.lights.get(of.light).ok()?.0.clone(),
            shading: material.shading,
            wrap: map.wrap(),
            lookup: crate::texture::Lookup::default(),
        };
        let view = match before {
            None => tiled(untiled, *tiling, &map),
            Some(before) => {
                let camera = self.cameras.get(before.0).ok()?.camera;
                let first = View { camera, ..untiled.clone() };
                View { surface: tiled(first, *tiling, &map).surface, ..untiled }
            }
        };
        Some(StagedScene { view, map, material })
    }
}

/// The view with its surface tiled.
pub(super) fn tiled(view: View, tiling: Tiling, map: &NormalMap) -> View {
    let aspect = map.height() as f64 / map.width() as f64;
    let tiles = match tiling {
        Tiling::Tiles(tiles) => tiles,
        Tiling::TexelsPerPixel(wanted) => {
            let one = View { surface: view.surface.tiled(1.0, aspect), ..view.clone() };
            let across = texels_across_centre(&one, map).unwrap_or(wanted);
            // A sphere rounds its tiling: compare with what one tile a unit came out as.
            wanted / across * one.surface.tiles_across()
        }
    };
    View { surface: view.surface.tiled(tiles, aspect), ..view }
}

/// Texels across the pixel at the image's centre, or where the surface is not there, across the nearest pixel that sees
/// it; `None` if none does.
pub fn texels_across_centre(view: &View, map: &NormalMap) -> Option<f64> {
    let (width, height) = (view.camera.width(), view.camera.height());
    let near = || {
        let [i, j] = view.seen_nearest([width / 2, height / 2])?;
        view.footprint(i as f64 + 0.5, j as f64 + 0.5)
    };
    let footprint = view.footprint(0.5 * width as f64, 0.5 * height as f64).or_else(near)?;
    Some(footprint.texels_across(map.width(), map.height()))
}

/// Renders one trial of the current scene that has no film yet.
#[allow(clippy::type_complexity)]
fn expose(
    mut commands: Commands,
    current: Res<Current>,
    (halt, seed): (Res<Halt>, Res<Seed>),
    view: SceneView,
    (prefilters, strategies): (Query<(&Prefilter, &PrefilterOf, &LookupBy)>, Query<&Strategy>),
    pending: Query<(Entity, &TrialOf, &Spp), Without<Exposure>>,
    mut progress: MessageWriter<Progress>,
) {
    let Some(staged) = view.of(current.0) else { return };
    let ready = |trial: &TrialOf| {
        let (prefilter, of, lookup) = prefilters.get(trial.prefilter).ok()?;
        let card = strategies.get(of.strategy).ok()?.0.card();
        Some((prefilter.0.as_ref().ok().cloned()?, card, lookup.0))
    };
    let next = pending
        .iter()
        .filter(|(_, trial, _)| trial.scene == current.0)
        .filter_map(|(entity, trial, spp)| Some((entity, ready(trial)?, spp.0)))
        .min_by_key(|(entity, ..)| *entity);
    let Some((trial, (prefiltered, card, lookup), spp)) = next else { return };
    let view = View { lookup, ..staged.view };
    let (sampler, start) = (PixelSampler::new(spp), Instant::now());
    let stop = || halt.now();
    let filtered = Filtered { map: &staged.map, card, prefiltered: prefiltered.as_ref() };
    if let Ok(film) = render::trial(&view, &filtered, &sampler, seed.0, 0, &stop) {
        let cpu_secs = start.elapsed().as_secs_f64() * rayon::current_num_threads() as f64;
        commands.entity(trial).insert(Exposure { film: Arc::new(film), cpu_secs });
        progress.write(Progress::Rendered { trial });
    }
}
