//! Four numbers at once.

/// Four single-precision numbers in one vector register: the channels of a texel.
///
/// On x86-64 it is an SSE register, which every such CPU has; elsewhere the compiler finds its own way.
/// The bits are the same. It exists because the compiler, left alone, vectorises texel fetches across
/// lanes with gather instructions, which are several times slower than loading texels whole.
#[derive(Clone, Copy, Debug)]
pub struct Quad(Register);

#[cfg(target_arch = "x86_64")]
type Register = std::arch::x86_64::__m128;
#[cfg(not(target_arch = "x86_64"))]
type Register = [f32; 4];

impl From<[f32; 4]> for Quad {
    #[inline(always)]
    fn from(numbers: [f32; 4]) -> Self {
        Self(bytemuck::cast(numbers))
    }
}

impl From<Quad> for [f32; 4] {
    #[inline(always)]
    fn from(quad: Quad) -> Self {
        bytemuck::cast(quad.0)
    }
}

impl Quad {
    /// The first four of `numbers`.
    #[inline(always)]
    pub fn load(numbers: &[f32]) -> Self {
        let four: &[f32; 4] = numbers.first_chunk().expect("four numbers");
        Self::from(*four)
    }

    /// Writes the four numbers to the start of `out`.
    #[inline(always)]
    pub fn store(self, out: &mut [f32]) {
        out[..4].copy_from_slice(&<[f32; 4]>::from(self));
    }
}

#[cfg(target_arch = "x86_64")]
#[expect(unsafe_code, reason = "vector instructions; every x86-64 CPU has these")]
impl Quad {
    /// a + t · (b − a)
    #[inline(always)]
    pub fn lerp(a: Self, b: Self, t: f32) -> Self {
        use std::arch::x86_64::{_mm_add_ps, _mm_mul_ps, _mm_set1_ps, _mm_sub_ps};
        // SAFETY: every x86-64 CPU has SSE.
        Self(unsafe { _mm_add_ps(a.0, _mm_mul_ps(_mm_set1_ps(t), _mm_sub_ps(b.0, a.0))) })
    }

    /// Rows become columns.
    #[inline(always)]
    pub fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        use std::arch::x86_64::{_mm_movehl_ps, _mm_movelh_ps, _mm_unpackhi_ps, _mm_unpacklo_ps};
        // SAFETY: every x86-64 CPU has SSE.
        unsafe {
            let (ab_low, cd_low) = (_mm_unpacklo_ps(a.0, b.0), _mm_unpacklo_ps(c.0, d.0));
            let (ab_high, cd_high) = (_mm_unpackhi_ps(a.0, b.0), _mm_unpackhi_ps(c.0, d.0));
            [
                Self(_mm_movelh_ps(ab_low, cd_low)),
                Self(_mm_movehl_ps(cd_low, ab_low)),
                Self(_mm_movelh_ps(ab_high, cd_high)),
                Self(_mm_movehl_ps(cd_high, ab_high)),
            ]
        }
    }
}

#[cfg(not(target_arch = "x86_64"))]
impl Quad {
    /// a + t · (b − a)
    #[inline(always)]
    pub fn lerp(a: Self, b: Self, t: f32) -> Self {
        Self(std::array::from_fn(|i| a.0[i] + t * (b.0[i] - a.0[i])))
    }

    /// Rows become columns.
    #[inline(always)]
    pub fn transpose(rows: [Self; 4]) -> [Self; 4] {
        std::array::from_fn(|c| Self(std::array::from_fn(|r| rows[r].0[c])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lerps_as_scalars_do() {
        let (a, b) = ([1.0, -2.0, 0.3, 1e-9], [0.1, 5.0, -0.7, 3.0]);
        let got: [f32; 4] = Quad::lerp(a.into(), b.into(), 0.37).into();
        for i in 0..4 {
            assert_eq!(got[i], a[i] + 0.37 * (b[i] - a[i]));
        }
    }

    #[test]
    fn transposes() {
        let rows = [0, 1, 2, 3].map(|r| Quad::from([0, 1, 2, 3].map(|c| (4 * r + c) as f32)));
        for (c, column) in Quad::transpose(rows).into_iter().enumerate() {
            assert_eq!(<[f32; 4]>::from(column), [0, 1, 2, 3].map(|r| (4 * r + c) as f32));
        }
    }
}
