//! Lights that take work to be had: environments are read or made, and blurred.

use bevy_ecs::prelude::*;

use super::{Current, Failure, LightSource, LoadError, Progress, SceneOf, Stage, texture};
use crate::light::Light;

/// What makes a light: a [`LightSource`] is put beside it when a scene needs it.
#[derive(Component)]
pub struct LightOrigin(pub Box<dyn Fn() -> Result<Kindled, LoadError> + Send + Sync>);

/// A light that is another one, moved round the vertical through the origin: a [`LightSource`] is put beside it
/// when a scene needs it.
#[derive(Component, Clone, Copy, Debug)]
pub struct MovedLight {
    /// The light it is when nothing has moved.
    pub of: Entity,
    /// Degrees from +x towards +y.
    pub degrees: f64,
}

/// A light, and what is worth knowing about how it was had, a sentence each.
#[allow(missing_docs)]
pub struct Kindled {
    pub light: Light,
    pub notes: Vec<String>,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(kindle.in_set(Stage::Texture).after(texture::load));
}

/// Makes the current scene's light if it is not there yet, or the one that it is, moved.
pub(super) fn kindle(
    mut commands: Commands,
    current: Res<Current>,
    scenes: Query<&SceneOf>,
    origins: Query<&LightOrigin, Without<LightSource>>,
    (moved, sources): (Query<&MovedLight, Without<LightSource>>, Query<&LightSource>),
    mut failure: ResMut<Failure>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok(scene) = scenes.get(current.0) else { return };
    let mut light = scene.light;
    if let Ok(moved) = moved.get(light) {
        if let Ok(source) = sources.get(moved.of) {
            commands.entity(light).insert(LightSource(source.0.turned(moved.degrees)));
            progress.write(Progress::Lit { light });
            return;
        }
        light = moved.of;
    }
    let Ok(origin) = origins.get(light) else { return };
    match (origin.0)() {
        Ok(Kindled { light: kindled, notes }) => {
            progress.write_batch(notes.into_iter().map(|text| Progress::Noted { text }));
            commands.entity(light).insert(LightSource(kindled));
            progress.write(Progress::Lit { light });
        }
        Err(error) => failure.0 = Some(error),
    }
}
