//! Budgets of errors: from entities to records, and back.

use bevy_ecs::prelude::World;
use serde::{Deserialize, Serialize};

use super::author::PlannedScene;
use super::spec::Spec;
use crate::scene::{Balance, Budgets};

/// How much of a method's error in a scene each of its parts is answerable for, at one sample a pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// The method's label.
    pub method: String,
    /// The figures.
    pub balance: Balance,
}

/// The budgets of a scene, in the order of the spec's methods; none if they are not drawn up.
pub(super) fn budgets(spec: &Spec, scene: &PlannedScene, world: &World) -> Vec<Budget> {
    let Some(Budgets(found)) = world.get(scene.entity) else { return Vec::new() };
    let of = |(number, prefilter)| {
        let (_, balance) = found.iter().find(|(entity, _)| entity == prefilter)?;
        let method: &super::spec::MethodSpec = spec.sweep.methods.get::<usize>(number)?;
        Some(Budget { method: method.label.clone(), balance: balance.clone() })
    };
    scene.prefilters.iter().enumerate().filter_map(of).collect()
}

/// Budgets that an earlier run drew up, for the world; those of methods that the scene has.
pub(super) fn known(spec: &Spec, scene: &PlannedScene, budgets: Vec<Budget>) -> Budgets {
    let entity = |label: &str| {
        let number = spec.sweep.methods.iter().position(|method| method.label == label)?;
        scene.prefilters.get(number).copied()
    };
    let of = |budget: Budget| Some((entity(&budget.method)?, budget.balance));
    Budgets(budgets.into_iter().filter_map(of).collect())
}
