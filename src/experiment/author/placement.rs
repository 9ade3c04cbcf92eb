//! Where cameras and lights stand: every elevation by every scale, frame by frame.

use bevy_ecs::prelude::*;

use super::super::spec::{Pose, Scale, Spec};
use super::{Frame, spawn_light};
use crate::render::{Camera, direction};
use crate::scene::{CameraPose, MovedLight, Tiling};

/// A camera and a light, and how the texture is laid before the camera.
pub(super) struct Placement {
    pub camera: Entity,
    pub light: Entity,
    pub distance: f64,
    pub elevation: f64,
    pub tiling: Tiling,
    pub frame: Option<Frame>,
    /// The camera of its sequence's first frame.
    pub first: Entity,
}

/// The light of every frame; one if nothing moves. Turning the object is turning all else the other way, so
/// that surfaces need not know.
pub(super) fn spawn_lights(world: &mut World, spec: &Spec) -> Vec<Entity> {
    let rest = spawn_light(world, &spec.light);
    let Some(motion) = &spec.motion else { return vec![rest] };
    let moved = |frame| {
        let pose = motion.pose(frame);
        match pose.light - pose.object {
            0.0 => rest,
            degrees => world.spawn(MovedLight { of: rest, degrees }).id(),
        }
    };
    (0..motion.frames).map(moved).collect()
}

/// Every elevation by every scale, frame by frame.
pub(super) fn placements(world: &mut World, spec: &Spec, lights: &[Entity]) -> Vec<Placement> {
    let of_scale: Vec<(f64, Tiling)> = match &spec.sweep.scale {
        Scale::TexelsPerPixel(list) => {
            let tiled = |&texels| (spec.camera.distance, Tiling::TexelsPerPixel(texels));
            list.iter().map(tiled).collect()
        }
        Scale::Distance { distances, tiles } => {
            distances.iter().map(|&distance| (distance, Tiling::Tiles(*tiles))).collect()
        }
    };
    let mut all = Vec::new();
    for &elevation in &spec.sweep.elevations {
        for &(distance, tiling) in &of_scale {
            let mut first = None;
            for (&light, number) in lights.iter().zip(0..) {
                let pose = spec.motion.map(|motion| motion.pose(number));
                let frame = pose.map(|pose| Frame {
                    number,
                    pose,
                    rest: spec.motion.and_then(|m| m.pose(0).distance).unwrap_or(distance),
                });
                let pose = pose.unwrap_or_default();
                let distance = pose.distance.unwrap_or(distance);
                let camera = world.spawn(placed(spec, elevation, distance, pose)).id();
                let first = *first.get_or_insert(camera);
                all.push(Placement { camera, light, distance, elevation, tiling, frame, first });
            }
        }
    }
    all
}

fn placed(spec: &Spec, elevation: f64, distance: f64, pose: Pose) -> CameraPose {
    let (at, image) = (&spec.camera, &spec.image);
    let origin = direction(elevation, at.azimuth + pose.camera) * distance;
    let camera = Camera::look_at(origin, at.target.into(), at.fov, image.width, image.height);
    let camera = if pose.object == 0.0 { camera } else { camera.turned(-pose.object) };
    CameraPose { camera, distance }
}
