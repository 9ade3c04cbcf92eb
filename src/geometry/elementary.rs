//! Exponential, logarithm, power and angle that give the same bits on every machine.
//!
//! The platform's libm picks its kernels by CPU, so two machines can differ in the last bit. These
//! are built from `+ − × ÷` and bit moves alone, which IEEE 754 fixes exactly. They have no branches,
//! so a loop over an array of lanes becomes vector code. For everything off the hot path the crate
//! [`libm`] serves (`sin`, `cos`, …), which is pure Rust too.
//!
//! Method: the argument reductions and rational approximations published with fdlibm (Sun
//! Microsystems, 1993), in the single-precision form with shorter series.

/// ln 2 split in two so that `n · LN2_HI` is exact for the exponents that occur.
const LN2_HI_32: f32 = 6.931_381e-1;
const LN2_LO_32: f32 = 9.058_001e-6;
const LN2_HI_64: f64 = 6.931_471_803_691_238e-1;
const LN2_LO_64: f64 = 1.908_214_929_270_587_7e-10;

/// Adding this to an `f32` of magnitude below 2²² rounds it to an integer held in the low bits.
const ROUND_32: f32 = 12_582_912.0;
/// The same for `f64`, below 2⁵¹.
const ROUND_64: f64 = 6_755_399_441_055_744.0;

/// eˣ in single precision; relative error below 2·10⁻⁷ on [−87, 88]. Smaller arguments give 0,
/// larger ones are held at 88.
#[inline(always)]
pub fn exp32(x: f32) -> f32 {
    let held = x.clamp(-87.0, 88.0);
    let shifted = held * std::f32::consts::LOG2_E + ROUND_32;
    let n = shifted - ROUND_32;
    let hi = held - n * LN2_HI_32;
    let lo = n * LN2_LO_32;
    let r = hi - lo;
    let rr = r * r;
    let c = r - rr * (1.666_662_5e-1 + rr * -2.766_733_3e-3);
    let y = 1.0 + (r * c / (2.0 - c) - lo + hi);
    // The low bits of `shifted` hold n as an integer: move them into the exponent field.
    let scale = f32::from_bits((shifted.to_bits() << 23).wrapping_add(127 << 23));
    if x < -87.0 { 0.0 } else { y * scale }
}

/// ln x in single precision for positive normal x; relative error below 2·10⁻⁷ away from 1 and
/// absolute error below 10⁻⁷ near it.
#[inline(always)]
pub fn ln32(x: f32) -> f32 {
    // Bias the bits so that the mantissa lands in [√½, √2).
    let bits = x.to_bits().wrapping_add(0x3f80_0000 - 0x3f35_04f3);
    let k = ((bits >> 23) as i32 - 127) as f32;
    let f = f32::from_bits((bits & 0x007f_ffff) + 0x3f35_04f3) - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let r = z * (0.666_666_6 + w * 0.284_987_87) + w * (0.400_009_72 + w * 0.242_790_79);
    let half_square = 0.5 * f * f;
    s * (half_square + r) + k * LN2_LO_32 - half_square + f + k * LN2_HI_32
}

/// ln(1 + t) for t ≥ 0 in single precision, accurate for small t too.
#[inline(always)]
pub fn ln_1p32(t: f32) -> f32 {
    let u = 1.0 + t;
    // What rounding took from 1 + t, put back to first order.
    ln32(u) + (t - (u - 1.0)) / u
}

/// eˣ in double precision; relative error below 10⁻¹⁵ on [−708, 709]. Smaller arguments give 0,
/// larger ones are held at 709.
#[inline(always)]
pub fn exp64(x: f64) -> f64 {
    let held = x.clamp(-708.0, 709.0);
    let shifted = held * std::f64::consts::LOG2_E + ROUND_64;
    let n = shifted - ROUND_64;
    let hi = held - n * LN2_HI_64;
    let lo = n * LN2_LO_64;
    let r = hi - lo;
    let rr = r * r;
    let series = rr
        * (1.666_666_666_666_660_2e-1
            + rr * (-2.777_777_777_701_559_3e-3
                + rr * (6.613_756_321_437_934e-5
                    + rr * (-1.653_390_220_546_525_2e-6 + rr * 4.138_136_797_057_238e-8))));
    let c = r - series;
    let y = 1.0 + (r * c / (2.0 - c) - lo + hi);
    let scale = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52));
    if x < -708.0 { 0.0 } else { y * scale }
}

/// ln x in double precision for positive normal x; relative error below 10⁻¹⁵ away from 1.
#[inline(always)]
pub fn ln64(x: f64) -> f64 {
    const SQRT_HALF_BITS: u64 = 0x3fe6_a09e_667f_3bcd;
    let bits = x.to_bits().wrapping_add(0x3ff0_0000_0000_0000 - SQRT_HALF_BITS);
    // The exponent as a number: set in the low bits of 2⁵² it is one. (A conversion from 64-bit
    // integers has no vector form before AVX-512.)
    let k =
        f64::from_bits(0x4330_0000_0000_0000 | (bits >> 52)) - (4_503_599_627_370_496.0 + 1023.0);
    let f = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) + SQRT_HALF_BITS) - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w
        * (3.999_999_999_940_942e-1
            + w * (2.222_219_843_214_978_4e-1 + w * 1.531_383_769_920_937_3e-1));
    let odd = z
        * (6.666_666_666_666_735e-1
            + w * (2.857_142_874_366_239e-1
                + w * (1.818_357_216_161_805e-1 + w * 1.479_819_860_511_658_6e-1)));
    let half_square = 0.5 * f * f;
    s * (half_square + even + odd) + k * LN2_LO_64 - half_square + f + k * LN2_HI_64
}

/// xʸ for x > 0 in double precision; 0 for x ≤ 0 (what a Phong lobe means below its horizon).
#[inline(always)]
pub fn pow64(x: f64, y: f64) -> f64 {
    let p = exp64(y * ln64(x.max(f64::MIN_POSITIVE)));
    if x > 0.0 { p } else { 0.0 }
}

/// The coefficients of (x − atan x)/x³ in powers of x², for |x| < 7/16 (fdlibm).
const ATAN: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932_4e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];

/// The angle from +x of the point (x, y), in [−π, π], in double precision: absolute error below 10⁻¹⁵
/// for coordinates below 10³⁰⁰. The sign of a zero x is not looked at: the origin has angle 0.
#[inline(always)]
pub fn atan2_64(y: f64, x: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    const TAN_PI_8: f64 = 0.414_213_562_373_095_03;
    let (across, along) = (x.abs(), y.abs());
    let (long, short) = (across.max(along), across.min(along));
    // Above π/8 the angle is taken from the diagonal: atan t = π/4 + atan((t − 1)/(t + 1)).
    let diagonal = short > TAN_PI_8 * long;
    let numerator = if diagonal { short - long } else { short };
    let denominator = if diagonal { short + long } else { long };
    let t = numerator / denominator.max(f64::MIN_POSITIVE);
    let z = t * t;
    let w = z * z;
    let [a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10] = ATAN;
    let even = z * (a0 + w * (a2 + w * (a4 + w * (a6 + w * (a8 + w * a10)))));
    let odd = w * (a1 + w * (a3 + w * (a5 + w * (a7 + w * a9))));
    let octant = (if diagonal { FRAC_PI_4 } else { 0.0 }) + (t - t * (even + odd));
    let quadrant = if along > across { FRAC_PI_2 - octant } else { octant };
    let upper = if x < 0.0 { PI - quadrant } else { quadrant };
    upper.copysign(y)
}

/// log₂ x for positive normal x in single precision: the level a footprint of x texels asks for.
#[inline(always)]
pub fn log2_32(x: f32) -> f32 {
    ln32(x) * std::f32::consts::LOG2_E
}

/// The largest whole number at or below x, for |x| < 2⁵¹. Unlike `f64::floor` it needs no instruction
/// beyond the baseline's, so it never becomes a call.
#[inline(always)]
pub fn floor64(x: f64) -> f64 {
    let nearest = (x + ROUND_64) - ROUND_64;
    if nearest > x { nearest - 1.0 } else { nearest }
}

/// The largest whole number at or below x, for |x| < 2²², as an integer and as a float; some integer
/// for any other x. The integer is
/// read off the bits of a shifted sum: a cast would check for overflow lane by lane, which vector
/// code cannot.
#[inline(always)]
pub fn floor32(x: f32) -> (i32, f32) {
    let shifted = x + ROUND_32;
    let nearest = shifted - ROUND_32;
    let integer = (shifted.to_bits() as i32).wrapping_sub(ROUND_32.to_bits() as i32);
    if nearest > x { (integer.wrapping_sub(1), nearest - 1.0) } else { (integer, nearest) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Geometric sweep of positive arguments, `count` values from `low` to `high`.
    fn sweep(low: f64, high: f64, count: usize) -> impl Iterator<Item = f64> {
        let ratio = libm::log(high / low) / (count - 1) as f64;
        (0..count).map(move |i| low * libm::exp(ratio * i as f64))
    }

    #[test]
    fn exponentials_agree_with_libm() {
        for i in 0..20_000 {
            let x = -80.0 + 160.0 * f64::from(i) / 20_000.0;
            let wide = libm::exp(x);
            assert!((exp64(x) / wide - 1.0).abs() < 1e-15, "exp64({x})");
            let narrow = libm::exp(f64::from(x as f32));
            assert!((f64::from(exp32(x as f32)) / narrow - 1.0).abs() < 2e-7, "exp32({x})");
        }
        assert_eq!(exp32(-1e30), 0.0);
        assert_eq!(exp64(f64::NEG_INFINITY), 0.0);
        assert_eq!(exp32(0.0), 1.0);
    }

    #[test]
    fn logarithms_agree_with_libm() {
        for x in sweep(1e-30, 1e30, 20_000) {
            let wide = libm::log(x);
            assert!((ln64(x) - wide).abs() <= 1e-15 * wide.abs().max(1.0), "ln64({x})");
            let narrow = libm::log(f64::from(x as f32));
            let got = f64::from(ln32(x as f32));
            assert!((got - narrow).abs() <= 2e-7 * narrow.abs().max(0.5), "ln32({x})");
        }
        for t in sweep(1e-12, 1e6, 20_000) {
            let exact = libm::log1p(f64::from(t as f32));
            assert!((f64::from(ln_1p32(t as f32)) / exact - 1.0).abs() < 4e-7, "ln_1p32({t})");
        }
        assert_eq!(ln64(1.0), 0.0);
        assert_eq!(log2_32(8.0), 3.0);
    }

    #[test]
    fn angles_agree_with_libm() {
        for i in 0..40_000 {
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * f64::from(i) / 40_000.0);
            for length in [1e-290, 0.3, 1.0, 7e290] {
                let (x, y) = (cosine * length, sine * length);
                let far = (atan2_64(y, x) - libm::atan2(y, x)).abs();
                assert!(far < 1e-15, "atan2_64({y}, {x}) is off by {far}");
            }
        }
        for x in sweep(1e-20, 1e20, 20_000) {
            for (y, x) in [(1.0, x), (-1.0, x), (1.0, -x), (-1.0, -x)] {
                assert!((atan2_64(y, x) - libm::atan2(y, x)).abs() < 1e-15, "atan2_64({y}, {x})");
            }
            // Small angles keep their digits.
            assert!((atan2_64(1.0, x) / libm::atan2(1.0, x) - 1.0).abs() < 1e-15);
        }
        for (y, x) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-0.0, -1.0), (-1.0, 0.0)] {
            assert_eq!(atan2_64(y, x), libm::atan2(y, x), "atan2_64({y}, {x})");
        }
    }

    #[test]
    fn floors_are_floors() {
        for i in -4000..4000 {
            let x = f64::from(i) * 0.25;
            assert_eq!(floor64(x), x.floor());
            let floor = (x as f32).floor();
            assert_eq!(floor32(x as f32), (floor as i32, floor));
        }
        assert_eq!(floor64(-1e-300), -1.0);
        assert_eq!(floor64(1e12 + 0.75), 1e12);
    }

    #[test]
    fn power_is_zero_below_the_horizon() {
        assert_eq!(pow64(-0.5, 3.0), 0.0);
        assert_eq!(pow64(0.0, 3.0), 0.0);
        assert!((pow64(0.25, 1.5) - 0.125).abs() < 1e-16);
    }
}
