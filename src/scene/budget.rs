//! The budget of an error: how much of it each part of a filter is answerable for.

use std::sync::atomic::{AtomicUsize, Ordering};

use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

use super::trial::{SceneView, StagedScene};
use super::{
    Current, Halt, LookupBy, Prefilter, PrefilterOf, Progress, ReferenceImage, ReferencePlan, Seed,
    Settled, Stage, Strategy, Watch,
};
use crate::method::{Prefiltered, Truth};
use crate::render::{Cancelled, Film, Part, PixelSampler, Subject, replaced};
use crate::texture::Lookup;

/// Asks for the budgets of some prefilters' errors in a scene.
#[derive(Component, Clone, Debug)]
pub struct BudgetPlan {
    /// The prefilters.
    pub prefilters: Vec<Entity>,
    /// Points a pixel that the truth is found from, a power of two.
    pub points: u32,
}

/// The budgets of a scene, of each prefilter of its plan that took the base lobe.
#[derive(Component, Clone, Debug)]
pub struct Budgets(pub Vec<(Entity, Balance)>);

/// The mean squared error of a filter's image at one sample a pixel, and what is left of it as part after part is
/// replaced by the truth ([`crate::render::replaced`]). All are against the scene's reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// The mean squared error of the filter as it is.
    pub whole: f64,
    /// The parts, in the order of [`Part::ALL`].
    pub entries: Vec<Entry>,
}

/// What a part is answerable for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The part.
    pub part: Part,
    /// The mean squared error with this part replaced and all before it.
    pub left: f64,
    /// The mean squared error with this part alone replaced.
    pub alone: f64,
    /// Why there is nothing to replace, as a sentence's end, if so: both figures are then those before it.
    pub nothing: Option<String>,
}

impl Balance {
    /// The part of the error that each entry takes away, in their order, below 0 where it adds to it; and last what
    /// remains, the noise of the truth. They sum to 1. Empty if there is no error.
    pub fn shares(&self) -> Vec<f64> {
        if !(self.whole > 0.0 && self.whole.is_finite()) {
            return Vec::new();
        }
        let mut before = self.whole;
        let mut shares = Vec::with_capacity(self.entries.len() + 1);
        for entry in &self.entries {
            shares.push((before - entry.left) / self.whole);
            before = entry.left;
        }
        shares.push(before / self.whole);
        shares
    }

    /// The part that takes away most.
    pub fn greatest(&self) -> Option<(Part, f64)> {
        let shares = self.shares();
        let all = self.entries.iter().zip(shares).map(|(entry, share)| (entry.part, share));
        all.reduce(|best, next| if next.1 > best.1 { next } else { best })
    }
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(draw_up.in_set(Stage::Budget));
}

/// A filter of the plan, ready.
struct Filter<'a> {
    entity: Entity,
    prefiltered: &'a dyn Prefiltered,
    lookup: Lookup,
    lookups: &'static [Lookup],
}

/// Draws up the budgets of the current scene, once its reference is settled and all their prefilters are there.
#[allow(clippy::type_complexity)]
fn draw_up(
    mut commands: Commands,
    (current, halt, seed, watch): (Res<Current>, Res<Halt>, Res<Seed>, Res<Watch>),
    view: SceneView,
    scenes: Query<
        (&BudgetPlan, &ReferencePlan, &ReferenceImage),
        (With<Settled>, Without<Budgets>),
    >,
    (prefilters, strategies): (Query<(&Prefilter, &PrefilterOf, &LookupBy)>, Query<&Strategy>),
    mut progress: MessageWriter<Progress>,
) {
    let Ok((plan, reference_plan, reference)) = scenes.get(current.0) else { return };
    let Some(staged) = view.of(current.0) else { return };
    if plan.prefilters.iter().any(|prefilter| prefilters.get(*prefilter).is_err()) {
        return;
    }
    let ready = |&entity: &Entity| {
        let (prefilter, of, lookup) = prefilters.get(entity).ok()?;
        let prefiltered = prefilter.0.as_ref().ok()?.as_ref();
        let lookups = strategies.get(of.strategy).ok()?.0.lookups();
        Some(Filter { entity, prefiltered, lookup: lookup.0, lookups })
    };
    let filters: Vec<Filter> = plan.prefilters.iter().filter_map(ready).collect();
    let work = Work {
        staged: &staged,
        truth: reference_plan.truth,
        reference: &reference.0.film,
        numbers: (seed.0, plan.points),
    };
    if let Ok(balances) = work.balances(&filters, &|| halt.now(), &|part| (watch.0)(part)) {
        let entities = filters.iter().map(|filter| filter.entity);
        commands.entity(current.0).insert(Budgets(entities.zip(balances).collect()));
        progress.write(Progress::Budgeted { scene: current.0 });
    }
}

/// What budgets are drawn up from.
struct Work<'a> {
    staged: &'a StagedScene,
    truth: Truth,
    reference: &'a Film,
    /// The seed, and points a pixel.
    numbers: (u64, u32),
}

impl Work<'_> {
    fn balances(
        &self,
        filters: &[Filter],
        cancelled: &(dyn Fn() -> bool + Sync),
        watch: &(dyn Fn(f64) + Sync),
    ) -> Result<Vec<Balance>, Cancelled> {
        let StagedScene { view, map, material } = self.staged;
        let one = PixelSampler::new(1);
        let image = |filter: &Filter| {
            let view = crate::render::View { lookup: filter.lookup, ..view.clone() };
            crate::render::render(&view, filter.prefiltered, &one, self.numbers.0, 0, cancelled)
        };
        let images = filters.iter().map(image).collect::<Result<Vec<Film>, Cancelled>>()?;
        let subjects: Vec<Subject> = filters
            .iter()
            .zip(&images)
            .map(|(filter, image)| Subject {
                prefiltered: filter.prefiltered,
                lookup: filter.lookup,
                exact: self.nothing(filter, Part::Lookup).is_none(),
                image: image.pixels(),
            })
            .collect();
        let reference = self.reference.pixels();
        let (open, base) = (self.truth == Truth::Bumps, material.base);
        let scene = crate::render::Scene { view, map, base, reference, open };
        let (rows, done) = (view.camera.height() as f64, AtomicUsize::new(0));
        let row_done = || watch((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / rows);
        let pixels = replaced(&scene, &subjects, self.numbers, cancelled, &row_done)?;
        let balance = |(number, filter): (usize, &Filter)| {
            let whole = mean_square(images[number].pixels(), reference);
            let of = |k: usize, together: bool| {
                let values = pixels.iter().map(|all| {
                    let at = &all[number];
                    if together { at.together[k] } else { at.alone[k] }
                });
                mean_square_of(values.zip(reference.iter().copied()))
            };
            let mut left = whole;
            let entry = |(k, &part): (usize, &Part)| {
                let nothing = self.nothing(filter, part);
                let figures =
                    if nothing.is_some() { (left, whole) } else { (of(k, true), of(k, false)) };
                left = figures.0;
                Entry { part, left: figures.0, alone: figures.1, nothing }
            };
            Balance { whole, entries: Part::ALL.iter().enumerate().map(entry).collect() }
        };
        Ok(filters.iter().enumerate().map(balance).collect())
    }

    /// Why a part of a filter has nothing to replace.
    fn nothing(&self, filter: &Filter, part: Part) -> Option<String> {
        let why = match part {
            Part::Lookup if filter.lookups.is_empty() => "it looks at no footprint",
            Part::Lookup if filter.lookup == Lookup::Exact => "its lookup is the exact one",
            Part::Lookup if !filter.lookups.contains(&Lookup::Exact) => {
                "it has no exact lookup with these options"
            }
            Part::Shadowing
                if self.truth == Truth::Bumps && !filter.prefiltered.needs_directions() =>
            {
                "neither the reference nor the method has shadows"
            }
            _ => return None,
        };
        Some(why.to_owned())
    }
}

/// The mean of (a − b)², summed in order.
fn mean_square(a: &[f32], b: &[f32]) -> f64 {
    mean_square_of(a.iter().copied().zip(b.iter().copied()))
}

fn mean_square_of(pairs: impl Iterator<Item = (f32, f32)>) -> f64 {
    let (mut sum, mut count) = (0.0f64, 0.0f64);
    for (a, b) in pairs {
        let off = f64::from(a) - f64::from(b);
        (sum, count) = (sum + off * off, count + 1.0);
    }
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn balance(whole: f64, left: [f64; 8]) -> Balance {
        let entry =
            |(&part, &left): (&Part, &f64)| Entry { part, left, alone: left, nothing: None };
        Balance { whole, entries: Part::ALL.iter().zip(&left).map(entry).collect() }
    }

    #[test]
    fn shares_sum_to_the_whole_and_may_be_negative() {
        let balance = balance(4.0, [3.0, 3.0, 3.5, 1.0, 1.0, 0.5, 0.25, 0.25]);
        let shares = balance.shares();
        assert_eq!(shares, [0.25, 0.0, -0.125, 0.625, 0.0, 0.125, 0.0625, 0.0, 0.0625]);
        assert_eq!(shares.iter().sum::<f64>(), 1.0);
        assert_eq!(balance.greatest(), Some((Part::Width, 0.625)));
    }

    #[test]
    fn no_error_has_no_parts() {
        assert!(balance(0.0, [0.0; 8]).shares().is_empty());
        assert!(balance(f64::NAN, [0.0; 8]).greatest().is_none());
    }
}
