//! What a map is outside [0, 1]², and which texels a bilinear lookup reads.

use serde::{Deserialize, Serialize};

use crate::geometry::elementary::{floor32, floor64};

/// What lies beyond the edge of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The map again, for ever: a tile.
    #[default]
    Repeat,
    /// The edge texel, for ever.
    Clamp,
}

/// The two texels along one axis that a bilinear lookup blends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taps {
    /// Index of the texel at or below the point.
    pub first: usize,
    /// Index of the texel above it.
    pub second: usize,
    /// Weight of `second`, in [0, 1); `first` has the rest.
    pub blend: f32,
}

impl Wrap {
    /// Folds a texture coordinate so that single precision keeps its texel: into [0, 1) where the
    /// map repeats, held to [0, 1] where it does not.
    #[inline(always)]
    pub fn fold(self, coordinate: f64) -> f64 {
        match self {
            Self::Repeat => coordinate - floor64(coordinate),
            Self::Clamp => coordinate.clamp(0.0, 1.0),
        }
    }

    /// The texels along an axis of `size` texels around a folded coordinate. Texel i has its centre
    /// at (i + ½) / size. Indices are inside whatever the coordinate is, NaN included: rays that miss
    /// have no coordinates, and their lanes are looked up like any other.
    #[inline(always)]
    pub fn taps(self, coordinate: f32, size: usize) -> Taps {
        let position = coordinate * size as f32 - 0.5;
        let (below_index, below) = floor32(position);
        let last = size as i32 - 1;
        let above_index = below_index.wrapping_add(1);
        let (first, second) = match self {
            Self::Repeat => (
                if below_index < 0 { last } else { below_index.min(last) },
                if above_index > last { 0 } else { above_index.max(0) },
            ),
            Self::Clamp => (below_index.clamp(0, last), above_index.clamp(0, last)),
        };
        Taps { first: first as usize, second: second as usize, blend: position - below }
    }

    /// The texel index that stands for index `i` of an axis of `size` texels, where `i` may be
    /// anywhere.
    pub fn index(self, i: isize, size: usize) -> usize {
        let size = size as isize;
        let held = match self {
            Self::Repeat => i.rem_euclid(size),
            Self::Clamp => i.clamp(0, size - 1),
        };
        held as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn taps_stay_inside_and_repeat(size in 1usize..70, coordinate in -3.0f64..3.0) {
            for wrap in [Wrap::Repeat, Wrap::Clamp] {
                let taps = wrap.taps(wrap.fold(coordinate) as f32, size);
                prop_assert!(taps.first < size && taps.second < size);
                prop_assert!((0.0..=1.0).contains(&taps.blend));
                let expect = wrap.index(taps.first as isize + 1, size);
                if wrap == Wrap::Repeat {
                    prop_assert_eq!(taps.second, expect);
                }
            }
        }
    }

    #[test]
    fn a_texel_centre_reads_that_texel_alone() {
        for size in [1, 2, 5, 64] {
            for i in 0..size {
                let centre = (i as f32 + 0.5) / size as f32;
                let taps = Wrap::Repeat.taps(centre, size);
                let weight_of = |k: usize| {
                    let mut w = 0.0;
                    if taps.first == k {
                        w += 1.0 - taps.blend
                    }
                    if taps.second == k {
                        w += taps.blend
                    }
                    w
                };
                assert!(weight_of(i) > 1.0 - 1e-5, "texel {i} of {size}: {taps:?}");
            }
        }
    }

    #[test]
    fn no_coordinate_leads_outside() {
        for coordinate in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30, f32::MAX] {
            for wrap in [Wrap::Repeat, Wrap::Clamp] {
                let taps = wrap.taps(coordinate, 7);
                assert!(taps.first < 7 && taps.second < 7, "{coordinate}: {taps:?}");
            }
        }
    }

    #[test]
    fn edges() {
        assert_eq!(Wrap::Repeat.taps(0.0, 4), Taps { first: 3, second: 0, blend: 0.5 });
        assert_eq!(Wrap::Clamp.taps(0.0, 4), Taps { first: 0, second: 0, blend: 0.5 });
        assert_eq!(Wrap::Clamp.taps(1.0, 4), Taps { first: 3, second: 3, blend: 0.5 });
        assert_eq!(Wrap::Repeat.index(-1, 5), 4);
        assert_eq!(Wrap::Clamp.index(9, 5), 4);
    }
}
