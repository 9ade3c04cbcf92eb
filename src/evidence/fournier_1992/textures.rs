//! The paper's bump maps: geometry seen from above, surface area as weight (§3).

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::fit::{Directions, Distribution, Fit, GreedyOptions, Peak, fit};
use crate::geometry::{HemisphereGrid, Vec3};
use crate::lobe::MultipleSurface;
use crate::parameter::{Parameter, Value, Values};
use crate::pattern;
use crate::texture::NormalMap;

use super::super::{Halted, Task};

/// One of the paper's maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A hemisphere inscribed in the map, nothing beside it: 32 × 32.
    Sphere,
    /// Half a cylinder as wide as the map: 64 × 64.
    Cylinder,
    /// A weave: 64 × 64. The paper's own is lost.
    Denim,
}

impl Subject {
    /// The paper's three, in the order of its figures.
    pub const ALL: [Self; 3] = [Self::Sphere, Self::Cylinder, Self::Denim];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Cylinder => "cylinder",
            Self::Denim => "denim",
        }
    }

    /// Texels along a side, as in the paper.
    pub fn side(self) -> usize {
        if self == Self::Sphere { 32 } else { 64 }
    }

    /// The map, with the readings that methods of the paper leave open at their defaults.
    pub fn map(self) -> NormalMap {
        self.read_as(&[])
    }

    /// The map under other readings: options of its pattern.
    pub fn read_as(self, readings: &[(&'static str, Value)]) -> NormalMap {
        let (pattern, own): (_, &[_]) = match self {
            Self::Sphere => ("hemispheres", &[("background", Value::Word("none"))]),
            Self::Cylinder => ("cylinders", &[]),
            Self::Denim => ("twill", &[]),
        };
        let entry = pattern::find(pattern).expect("a pattern of the program's own");
        let mut values = Values::defaults(entry.parameters);
        for (name, value) in own.iter().chain(readings) {
            debug_assert!(entry.parameters.iter().any(|p: &Parameter| p.name == *name));
            values.set(name, value.clone());
        }
        let bumps = (entry.build)(self.side(), self.side(), &values, 1);
        match bumps.heights {
            Some(heights) => bumps.normals.with_heights(Arc::new(heights)),
            None => bumps.normals,
        }
    }
}

/// All texels of a map as base lobes of exponent `exponent`, weighted to a mean: what stands under the
/// top of its pyramid.
pub fn normals_of(map: &NormalMap, exponent: f64) -> Vec<Peak> {
    let unit = (exponent + 2.0) / (TAU * map.texels().len() as f64);
    let peak = |&[x, y, z, weight]: &[f32; 4]| Peak {
        amplitude: unit * f64::from(weight),
        direction: Vec3::new(x.into(), y.into(), z.into()),
        exponent,
    };
    map.texels().iter().map(peak).collect()
}

/// A distribution with the paper's reconstruction of it.
pub struct Reconstructed {
    /// N(ω) on the paper's directions.
    pub truth: Distribution,
    /// The fit.
    pub fit: Fit,
    /// N(ω) − the fit.
    pub residual: Vec<f64>,
}

/// Spreads normals over the paper's 1297 directions and fits them.
///
/// # Errors
/// [`Halted`] if the work should stop.
pub fn reconstructed(
    normals: &[Peak],
    options: GreedyOptions,
    task: &Task,
) -> Result<Reconstructed, Halted> {
    let directions = Directions::new(HemisphereGrid::fournier());
    let cancelled = || task.progress.cancelled();
    let truth = Distribution::spread(normals, &directions, &cancelled).ok_or(Halted)?;
    let fit = fit(&truth, &directions, options, &cancelled).ok_or(Halted)?;
    let fitted = sampled(&fit.peaks);
    let residual = truth.values().iter().zip(&fitted).map(|(t, f)| t - f).collect();
    Ok(Reconstructed { truth, fit, residual })
}

/// Peaks on the paper's directions.
pub fn sampled(peaks: &[Peak]) -> Vec<f64> {
    let at = |direction: Vec3| peaks.iter().map(|peak| peak.value(direction)).sum();
    HemisphereGrid::fournier().samples().iter().map(|s| at(s.direction)).collect()
}

/// A multiple surface on the paper's directions.
pub fn on_grid(surface: &MultipleSurface) -> Vec<f64> {
    let at = |d: Vec3| f64::from(surface.density([d.x, d.y, d.z].map(|c| c as f32)));
    HemisphereGrid::fournier().samples().iter().map(|s| at(s.direction)).collect()
}

/// The axes of peaks.
pub fn axes(peaks: &[Peak]) -> Vec<[f64; 3]> {
    peaks.iter().map(|p| [p.direction.x, p.direction.y, p.direction.z]).collect()
}
