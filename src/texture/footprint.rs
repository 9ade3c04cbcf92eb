//! The part of a map that a pixel covers.

use super::{Bend, Lookup};
use crate::geometry::elementary::log2_32;

/// A pixel's (or a sample's) footprint: a parallelogram of the map about a point.
///
/// (u, v) are folded texture coordinates (see [`super::Wrap::fold`]). The sides are the derivatives of
/// (u, v) along the pixel's x and y, times the pixel's width: the parallelogram
/// (u, v) + a·`along_x` + b·`along_y`, a and b in [−½, ½], is what the pixel sees, to first order.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// Texture coordinate across the map.
    pub u: f32,
    /// Texture coordinate along the map.
    pub v: f32,
    /// (∂u/∂x, ∂v/∂x) for one sample spacing, in map widths and heights.
    pub along_x: [f32; 2],
    /// (∂u/∂y, ∂v/∂y) for one sample spacing.
    pub along_y: [f32; 2],
    /// How what lies under it is averaged.
    pub lookup: Lookup,
    /// What becomes of the map's slopes there.
    pub bend: Bend,
}

impl Footprint {
    /// The whole map, looked up trilinearly.
    pub fn whole() -> Self {
        let (along_x, along_y) = ([1.0, 0.0], [0.0, 1.0]);
        let (lookup, bend) = (Lookup::Trilinear, Bend::default());
        Self { u: 0.5, v: 0.5, along_x, along_y, lookup, bend }
    }

    /// The pyramid level for a map of `width` × `height` texels: log₂ of the footprint's longer side in
    /// texels (Williams 1983). Below 0 the map is magnified. A footprint of no size gives a very low,
    /// finite level; one that is not finite, the coarsest there is.
    #[inline(always)]
    pub fn level(&self, width: usize, height: usize) -> f32 {
        let (w, h) = (width as f32, height as f32);
        let square = |[u, v]: [f32; 2]| (u * w) * (u * w) + (v * h) * (v * h);
        let longest = square(self.along_x).max(square(self.along_y));
        0.5 * log2_32(longest.clamp(1e-20, 1e20))
    }

    /// How many texels of a `width` × `height` map it is across: the square root of its area.
    pub fn texels_across(&self, width: usize, height: usize) -> f64 {
        let [ux, vx] = self.along_x.map(f64::from);
        let [uy, vy] = self.along_y.map(f64::from);
        ((ux * vy - uy * vx).abs() * width as f64 * height as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f32) -> Footprint {
        Footprint {
            u: 0.5,
            v: 0.5,
            along_x: [side, 0.0],
            along_y: [0.0, side],
            ..Footprint::default()
        }
    }

    #[test]
    fn level_is_the_logarithm_of_texels() {
        assert_eq!(square(1.0 / 64.0).level(64, 64), 0.0);
        assert_eq!(square(8.0 / 64.0).level(64, 64), 3.0);
        assert_eq!(square(0.5 / 64.0).level(64, 64), -1.0);
        assert!((square(8.0 / 64.0).texels_across(64, 64) - 8.0).abs() < 1e-6);
    }

    #[test]
    fn extreme_footprints_stay_finite() {
        assert!(square(0.0).level(64, 64) < -20.0);
        assert!(square(f32::INFINITY).level(64, 64).is_finite());
        assert!(square(f32::NAN).level(64, 64).is_finite());
    }
}
