//! Surfaces that take work to be had: models are read.

use bevy_ecs::prelude::*;

use super::{Current, Failure, LoadError, Progress, SceneOf, Stage, SurfaceShape, light};
use crate::surface::Shape;

/// What makes a surface: a [`SurfaceShape`] is put beside it when a scene needs it.
#[derive(Component)]
pub struct SurfaceOrigin(pub Box<dyn Fn() -> Result<Shaped, LoadError> + Send + Sync>);

/// A surface, and what is worth knowing about how it was had, a sentence each.
#[allow(missing_docs)]
pub struct Shaped {
    pub shape: Shape,
    pub notes: Vec<String>,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(shape.in_set(Stage::Texture).after(light::kindle));
}

/// Makes the current scene's surface if it is not there yet.
fn shape(
    mut commands: Commands,
    current: Res<Current>,
    scenes: Query<&SceneOf>,
    origins: Query<&SurfaceOrigin, Without<SurfaceShape>>,
    mut failure: ResMut<Failure>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok(scene) = scenes.get(current.0) else { return };
    let Ok(origin) = origins.get(scene.surface) else { return };
    match (origin.0)() {
        Ok(Shaped { shape, notes }) => {
            progress.write_batch(notes.into_iter().map(|text| Progress::Noted { text }));
            commands.entity(scene.surface).insert(SurfaceShape(shape));
            progress.write(Progress::Shaped { surface: scene.surface });
        }
        Err(error) => failure.0 = Some(error),
    }
}
