//! Masking and self-shadowing of a pyramid of peaks (Fournier 1992 §5): a table of horizons beside the
//! peaks, and how they shade.

mod collect;

pub(super) use collect::Collector;
use collect::collect;

use super::lookup::{PeakAt, PeakMap, Slots};
use super::stored;
use crate::lobe::{EllipticLobe, Horizon, MultipleSurface, PhongPeak, Shading, Spread, Visibility};
use crate::method::one_lobe::{filtered_share, unfiltered_lobe};
use crate::method::{Batch, Lane, Prefiltered};
use crate::texture::{Footprint, HorizonMap};

/// What of a peak's light reaches the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadowing {
    /// All of it.
    #[default]
    None,
    /// The part that sees both the light and the eye: the product of what its [`Horizon`] lets by.
    Printed,
    /// As printed, times the area of all peaks over that of their parts that the eye sees: what is seen
    /// fills the pixel (the paper's remark in parentheses). A peak's area is ∫ a cosⁿ · cos dω =
    /// 2π a / (n + 2), times its interpolation weight.
    Ratioed,
}

/// A pyramid of peaks, each behind its horizon.
pub(super) struct ShadowedPeakMap {
    pub peaks: PeakMap,
    /// Level 0: the slopes of the map itself, without deviation.
    pub texels: HorizonMap,
    /// Levels 1 and up: a horizon for each peak of the level's list.
    pub levels: Vec<Vec<Horizon>>,
    pub ratioed: bool,
}

impl ShadowedPeakMap {
    /// The horizon of a peak.
    #[inline(always)]
    fn horizon(&self, at: PeakAt) -> Horizon {
        match at.level.checked_sub(1) {
            Some(above) => self.levels[above][at.index],
            None => Horizon::sharp(self.texels.slopes()[at.index]),
        }
    }

    /// The horizon of a point between texels.
    #[inline(always)]
    fn horizon_between(&self, at: &Footprint) -> Horizon {
        Horizon::sharp(self.texels.sample(at.u, at.v))
    }
}

/// The area that a peak stands for (see [`Shadowing::Ratioed`]).
#[inline(always)]
fn area(peak: &PhongPeak) -> f32 {
    std::f32::consts::TAU * peak.amplitude / (peak.exponent + 2.0)
}

impl Prefiltered for ShadowedPeakMap {
    fn bytes(&self) -> usize {
        let table: usize = self.levels.iter().map(|level| size_of_val(level.as_slice())).sum();
        self.peaks.bytes() + self.texels.bytes() + table
    }

    fn store(&self) -> Option<Vec<u8>> {
        Some(stored::to_bytes(&self.peaks.levels, &self.levels))
    }

    fn needs_directions(&self) -> bool {
        true
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let map = &self.peaks.map;
        let level = at.level(map.width(), map.height());
        let share = filtered_share(level, at.lookup);
        let mut surface = MultipleSurface::new();
        self.peaks.each_peak(at, share, |peak, weight, k| {
            surface.add_behind(peak, weight, self.horizon(k), area(&peak));
        });
        let (lobe, area) = unfiltered_lobe_and_area(&self.peaks, at);
        surface.add_behind(lobe, 1.0 - share, self.horizon_between(at), area);
        if self.ratioed { surface.ratioed() } else { surface }
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        let mut slots = Slots::default();
        let map = &self.peaks.map;
        for (lane, out) in radiance.iter_mut().enumerate().take(batch.len) {
            *out = 0.0;
            if batch.irradiance[lane] <= 0.0 {
                continue;
            }
            let (half, light, view) = (batch.half(lane), batch.light(lane), batch.view(lane));
            let at = batch.footprint(lane);
            let level = at.level(map.width(), map.height());
            let share = filtered_share(level, at.lookup);
            let mut visibility = Visibility::default();
            slots.clear();
            self.peaks.each_peak(&at, share, |peak, weight, k| {
                let horizon = self.horizon(k);
                let part = visibility.of(&horizon, weight * area(&peak), light, view);
                slots.push(peak, weight * part);
            });
            let mut sum = slots.radiance(shading, half, light, view);
            if share < 1.0 {
                let (lobe, area) = unfiltered_lobe_and_area(&self.peaks, &at);
                let (rest, horizon) = (1.0 - share, self.horizon_between(&at));
                let part = visibility.of(&horizon, rest * area, light, view);
                sum += part * lobe.faded(rest).radiance(shading, half, light, view);
            }
            let ratio = if self.ratioed { visibility.ratio() } else { 1.0 };
            *out = batch.irradiance[lane] * sum * ratio;
        }
    }
}

/// The lobe between texels, and the area it stands for: its weight, as a base lobe of weight 1 has
/// moment 1.
#[inline(always)]
fn unfiltered_lobe_and_area(peaks: &PeakMap, at: &Footprint) -> (EllipticLobe, f32) {
    let [.., weight] = peaks.map.sample(at.u, at.v);
    (unfiltered_lobe(&peaks.map, &peaks.base, at), weight)
}

/// Puts a pyramid's peaks behind what they collect; `None` if cancelled.
pub(super) fn shadowed(
    peaks: PeakMap,
    collector: Collector,
    ratioed: bool,
) -> Option<ShadowedPeakMap> {
    let levels: Option<Vec<Vec<Horizon>>> =
        peaks.levels.iter().map(|level| collect(&collector, level)).collect();
    Some(ShadowedPeakMap { levels: levels?, texels: collector.texels, peaks, ratioed })
}

#[cfg(test)]
mod tests;
