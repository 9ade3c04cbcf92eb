//! The table L(r₁, r₂): from indices to microfacet frames (Kautz et al. 2001 §4).

use super::Normals;
use crate::lobe::vector::{V3, tangents, unit};

/// Entries along either side of the table: "a full lookup table L(r1, r2) with 256×256 entries".
pub const ENTRIES: usize = 256;

/// A microfacet's tangent, bitangent and normal, of unit length, in tangent space.
pub type MicroFrame = [V3; 3];

/// For each entry a whole tangent frame, "needed for anisotropic NDFs". The tangent is u's, turned as the shortest
/// rotation from z to the normal turns it: the paper leaves it open.
#[derive(Clone, Debug, PartialEq)]
pub struct LookupTable {
    /// Row by row of r₂.
    frames: Vec<MicroFrame>,
}

/// The frame about a normal.
#[inline(always)]
pub fn frame_about(normal: V3) -> MicroFrame {
    let (tangent, bitangent) = tangents(normal);
    [tangent, bitangent, normal]
}

impl LookupTable {
    /// The table of these normals: entry (i, j) is that of r = ((i + ½)/256, (j + ½)/256).
    pub(super) fn of(normals: &Normals) -> Self {
        let at = |k: usize| (k as f64 + 0.5) / ENTRIES as f64;
        let frame = |k: usize| frame_about(normals.at([at(k % ENTRIES), at(k / ENTRIES)]));
        Self { frames: (0..ENTRIES * ENTRIES).map(frame).collect() }
    }

    /// The entry nearest to (r₁, r₂), as a dependent texture read without filtering has it.
    #[inline(always)]
    pub fn nearest(&self, [r1, r2]: [f32; 2]) -> &MicroFrame {
        let entry = |r: f32| ((r * ENTRIES as f32) as usize).min(ENTRIES - 1);
        &self.frames[entry(r2) * ENTRIES + entry(r1)]
    }

    /// The frame of the normal interpolated between the four entries around (r₁, r₂).
    #[inline]
    pub fn smooth(&self, [r1, r2]: [f32; 2]) -> MicroFrame {
        let place = |r: f32| {
            let at = (r * ENTRIES as f32 - 0.5).clamp(0.0, (ENTRIES - 1) as f32);
            let low = (at as usize).min(ENTRIES - 2);
            (low, at - low as f32)
        };
        let ((i, across), (j, along)) = (place(r1), place(r2));
        let normal = |i: usize, j: usize| self.frames[j * ENTRIES + i][2];
        let mut sum = [0.0; 3];
        for (row, wy) in [(j, 1.0 - along), (j + 1, along)] {
            for (column, wx) in [(i, 1.0 - across), (i + 1, across)] {
                let n = normal(column, row);
                (0..3).for_each(|c| sum[c] += wx * wy * n[c]);
            }
        }
        frame_about(unit(sum))
    }

    /// Memory, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.frames.as_slice())
    }
}
