//! How many bits a prefiltered map's numbers have.

use super::{Batch, Lane, Prefiltered};
use crate::lobe::{MultipleSurface, Shading};
use crate::parameter::{Domain, Parameter, Values};
use crate::texture::{Footprint, NormalMap, level_sizes};

/// How a stored number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    /// In single precision.
    Float,
    /// As a whole number of so many bits, a part of a range that is the map's.
    Bits(u32),
}

/// The words of [`STORAGE`].
const WORDS: [&str; 3] = ["float", "16-bit", "8-bit"];

/// The option of that name.
pub(super) const STORAGE: Parameter = Parameter {
    name: "storage",
    meaning: "how a cell's numbers are written: in single precision, or as whole numbers of 16 or 8 bits",
    domain: Domain::Choice { words: &WORDS },
};

impl Storage {
    /// What the option says.
    pub(super) fn of(values: &Values) -> Self {
        match values.word(STORAGE.name) {
            "16-bit" => Self::Bits(16),
            "8-bit" => Self::Bits(8),
            _ => Self::Float,
        }
    }

    /// Bytes of a number.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::Float => 4,
            Self::Bits(bits) => bits as usize / 8,
        }
    }

    /// Half the distance of the numbers from −1 to 1 that can be told apart; 0 for floats, whose rounding is
    /// elsewhere.
    pub(super) fn half_step(self) -> f64 {
        match self {
            Self::Float => 0.0,
            Self::Bits(bits) => 0.5 / f64::from((1u32 << (bits - 1)) - 1),
        }
    }

    /// Numbers from −`range` to `range`.
    pub(super) fn signed(self, range: f32) -> Code {
        Code::new(self, range, 1)
    }

    /// Numbers from 0 to `range`.
    pub(super) fn unsigned(self, range: f32) -> Code {
        Code::new(self, range, 0)
    }

    /// `prefiltered`, its size that of `numbers` a cell written so (and `floats` more in single precision). What
    /// is in memory is floats all the same; their values are those that would be read.
    pub(super) fn sized(
        self,
        prefiltered: impl Prefiltered + 'static,
        map: &NormalMap,
        numbers: usize,
        floats: usize,
    ) -> Box<dyn Prefiltered> {
        let cells: usize =
            level_sizes(map.width(), map.height()).iter().skip(1).map(|(w, h)| w * h).sum();
        let bytes = cells * (numbers * self.bytes() + 4 * floats);
        Box::new(OfSize { inner: prefiltered, bytes })
    }
}

/// Rounds numbers to those that storage can hold. Zero and both ends of the range are held exactly, and a
/// number and its negative alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Code {
    /// The largest code; 0 for floats.
    most: f32,
    least: f32,
    range: f32,
}

impl Code {
    fn new(storage: Storage, range: f32, sign_bits: u32) -> Self {
        let most = match storage {
            Storage::Float => 0.0,
            Storage::Bits(bits) => ((1u32 << (bits - sign_bits)) - 1) as f32,
        };
        let least = if sign_bits == 1 { -most } else { 0.0 };
        Self { most, least, range: range.max(f32::MIN_POSITIVE) }
    }

    /// The same numbers without 0: what is smaller than the smallest is the smallest.
    pub(super) fn above_zero(self) -> Self {
        Self { least: self.most.min(1.0), ..self }
    }

    /// The number nearest to `x` that can be held.
    #[inline(always)]
    pub(super) fn round(self, x: f32) -> f32 {
        if self.most == 0.0 {
            return x;
        }
        let code = (x / self.range * self.most).round().clamp(self.least, self.most);
        code / self.most * self.range
    }
}

/// A prefiltered map whose size is not that of its floats.
struct OfSize<P> {
    inner: P,
    bytes: usize,
}

impl<P: Prefiltered> Prefiltered for OfSize<P> {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn lobes_at(&self, footprint: &Footprint) -> MultipleSurface {
        self.inner.lobes_at(footprint)
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        self.inner.shade(batch, shading, radiance);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rounding_is_odd_and_within_half_a_step(x in -3.0f32..3.0) {
            for bits in [8, 16] {
                let storage = Storage::Bits(bits);
                let code = storage.signed(3.0);
                let rounded = code.round(x);
                let half = 3.0 * storage.half_step() as f32;
                prop_assert!((rounded - x).abs() <= half * 1.01 + 1e-6, "{rounded}");
                prop_assert_eq!(code.round(-x), -rounded);
                prop_assert_eq!(code.round(rounded), rounded);
            }
            prop_assert_eq!(Storage::Float.signed(1.0).round(x), x);
        }
    }

    #[test]
    fn ends_and_zero_are_exact() {
        for bits in [8, 16] {
            let (signed, unsigned) =
                (Storage::Bits(bits).signed(0.7), Storage::Bits(bits).unsigned(0.7));
            for x in [0.0, 0.7] {
                assert_eq!((signed.round(x), unsigned.round(x)), (x, x));
            }
            assert_eq!((signed.round(9.0), unsigned.round(-9.0)), (0.7, 0.0));
            assert!(unsigned.above_zero().round(0.0) > 0.0);
        }
        assert_eq!(Storage::Float.unsigned(0.7).above_zero().round(0.0), 0.0);
        assert_eq!(Storage::Bits(8).signed(0.0).round(0.0), 0.0);
    }
}
