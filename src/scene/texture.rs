//! Textures: bump sources become normal maps.

use std::sync::Arc;

use bevy_ecs::prelude::*;

use super::{Current, Failure, Progress, SceneOf, Stage};
use crate::pattern::Bumps;
use crate::texture::NormalMap;

/// A texture, by its name in the experiment.
#[derive(Component, Clone, Debug)]
#[require(Name)]
pub struct Texture;

/// What makes a texture's bumps: a pattern with its options, or a file to read.
#[derive(Component)]
pub struct BumpSource(pub Box<dyn Fn() -> Result<Bumps, LoadError> + Send + Sync>);

/// Why a texture could not be had: a sentence that names the file and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct LoadError(pub String);

/// A texture that is there.
#[derive(Component, Clone, Debug)]
pub struct Map {
    /// Its normals.
    pub normals: Arc<NormalMap>,
    /// Things worth knowing about them.
    pub notes: Vec<String>,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(load.in_set(Stage::Texture));
}

/// Loads the current scene's texture if it is not there yet.
pub(super) fn load(
    mut commands: Commands,
    current: Res<Current>,
    scenes: Query<&SceneOf>,
    sources: Query<&BumpSource, Without<Map>>,
    mut failure: ResMut<Failure>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok(scene) = scenes.get(current.0) else { return };
    let Ok(source) = sources.get(scene.texture) else { return };
    match (source.0)() {
        Ok(bumps) => {
            let map = Map { normals: Arc::new(bumps.normals), notes: bumps.notes };
            commands.entity(scene.texture).insert(map);
            progress.write(Progress::Loaded { texture: scene.texture });
        }
        Err(error) => failure.0 = Some(error),
    }
}
