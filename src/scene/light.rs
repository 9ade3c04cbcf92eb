//! Lights that take work to be had: environments are read or made, and blurred.

use bevy_ecs::prelude::*;

use super::{Current, Failure, LightSource, LoadError, Progress, SceneOf, Stage, texture};
use crate::light::Light;

/// What makes a light: a [`LightSource`] is put beside it when a scene needs it.
#[derive(Component)]
pub struct LightOrigin(pub Box<dyn Fn() -> Result<Kindled, LoadError> + Send + Sync>);

/// A light, and what is worth knowing about how it was had, a sentence each.
#[allow(missing_docs)]
pub struct Kindled {
    pub light: Light,
    pub notes: Vec<String>,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(kindle.in_set(Stage::Texture).after(texture::load));
}

/// Makes the current scene's light if it is not there yet.
pub(super) fn kindle(
    mut commands: Commands,
    current: Res<Current>,
    scenes: Query<&SceneOf>,
    origins: Query<&LightOrigin, Without<LightSource>>,
    mut failure: ResMut<Failure>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok(scene) = scenes.get(current.0) else { return };
    let Ok(origin) = origins.get(scene.light) else { return };
    match (origin.0)() {
        Ok(Kindled { light, notes }) => {
            progress.write_batch(notes.into_iter().map(|text| Progress::Noted { text }));
            commands.entity(scene.light).insert(LightSource(light));
            progress.write(Progress::Lit { light: scene.light });
        }
        Err(error) => failure.0 = Some(error),
    }
}
