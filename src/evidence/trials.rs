//! Images of a sweep that a row shows.

use super::Claim;
use crate::experiment::results::{SceneResult, TrialResult};

/// Trials of a scene, each by its method's label and samples a pixel.
///
/// # Errors
/// If one is missing (a sweep may leave a method out, and a method may refuse a base lobe), the claim that
/// nothing can be held against anything here.
pub fn trials<'a, const N: usize>(
    scene: &'a SceneResult,
    wanted: [(&str, u32); N],
) -> Result<[&'a TrialResult; N], Box<Claim>> {
    let found = wanted
        .map(|(method, spp)| scene.trials.iter().find(|t| t.method == method && t.spp == spp));
    if let Some(missing) = found.iter().position(Option::is_none) {
        let (method, spp) = wanted[missing];
        let what =
            format!("{} at {} texels a pixel", scene.key.texture, scene.key.texels_per_pixel);
        let why = format!("the sweep has no image of {method} at {spp} samples a pixel");
        return Err(Box::new(Claim::not_applicable(what, "", why)));
    }
    Ok(found.map(|trial| trial.expect("none is missing")))
}

/// A trial's root mean square error.
pub fn rmse(trial: &TrialResult) -> f64 {
    trial.score("rmse").unwrap_or(f64::NAN)
}
