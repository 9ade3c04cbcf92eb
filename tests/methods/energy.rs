//! The furnace: what a normalised method sends is what its normals send.

use std::sync::Arc;

use wrinkle::geometry::Vec3;
use wrinkle::texture::{NormalMap, Wrap};

use super::fixture::{
    Case, FINE, FINE_ERROR, bumps, cases, footprint, hemisphere, moments, top, weighted,
};

/// Σ wᵢ nᵢ / N: the vector moment of the base lobes about all normals of the map (see `lobe`).
fn mean_normal(map: &NormalMap) -> Vec3 {
    let mut sum = Vec3::zeros();
    for [x, y, z, w] in map.texels() {
        sum += Vec3::new(f64::from(*x), f64::from(*y), f64::from(*z)) * f64::from(*w);
    }
    sum / map.texels().len() as f64
}

fn maps() -> Vec<Arc<NormalMap>> {
    let gentle = bumps(8, 8, Wrap::Repeat);
    let steep = Arc::new(gentle.scaled(2.0));
    vec![gentle, steep, weighted(5, 3), weighted(9, 6), hemisphere(16)]
}

/// ∫ D(h) (h·a) dω at the top level, over what it should be; a is the axis it should lie along.
///
/// A method that keeps roughness stands for all normals: |Σ wᵢ nᵢ| / N along their mean. One that does
/// not draws a single smooth surface, whose lobe has its own axis and the mean weight.
fn gain(case: &Case, map: &Arc<NormalMap>) -> f64 {
    let surface = case.on(map).lobes_at(&footprint(map, 0.5, 0.5, top(map) as f32));
    let mean = mean_normal(map);
    let (axis, want) = if case.card.keeps_roughness {
        (mean.normalize(), mean.norm())
    } else {
        (Vec3::from(surface.lobes()[0].axis().map(f64::from)), f64::from(surface_weight(map, case)))
    };
    let pole = [axis.x, axis.y, axis.z].map(|c| c as f32);
    moments(&FINE, &surface, pole).1.dot(&axis) / want
}

/// The weight of the one normal shaded by a method that does not keep roughness: that of the point if
/// it looks at no footprint, else the mean.
fn surface_weight(map: &Arc<NormalMap>, case: &Case) -> f32 {
    if case.on(map).needs_footprint() {
        map.texels().iter().map(|t| t[3]).sum::<f32>() / map.texels().len() as f32
    } else {
        map.sample(0.5, 0.5)[3]
    }
}

#[test]
fn normalised_methods_keep_the_energy_and_others_do_not() {
    let mut wrong = vec![];
    for case in cases() {
        let gains: Vec<f64> = maps().iter().map(|map| gain(&case, map)).collect();
        let allowed = case.card.precision + FINE_ERROR;
        let kept = gains.iter().all(|g| (g - 1.0).abs() <= allowed);
        // The flag must be earned either way: without it, some map shows the loss or gain.
        if kept != case.card.normalised {
            wrong.push(format!("{}: {gains:?}", case.name));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
