//! The few single-precision vector operations that lobes need, written so that a loop over lanes
//! becomes vector code.

/// A vector in tangent space, single precision.
pub type V3 = [f32; 3];

/// a · b
#[inline(always)]
pub fn dot(a: V3, b: V3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b
#[inline(always)]
pub fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a · s
#[inline(always)]
pub fn scale(a: V3, s: f32) -> V3 {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// a at unit length; (0, 0, 1) for the zero vector.
#[inline(always)]
pub fn unit(a: V3) -> V3 {
    let length = dot(a, a).sqrt();
    let inverse = 1.0 / length.max(f32::MIN_POSITIVE);
    if length > 0.0 { scale(a, inverse) } else { [0.0, 0.0, 1.0] }
}

/// tan² of the angle between two vectors of any length, accurate for small angles (through the cross
/// product, not through 1 − cos²).
#[inline(always)]
pub fn tan_squared(a: V3, b: V3) -> f32 {
    let (c, s) = (dot(a, b), cross(a, b));
    dot(s, s) / (c * c).max(f32::MIN_POSITIVE)
}

/// Two unit vectors that complete a unit `axis` to a right-handed frame: the axes x and y carried
/// along by the smallest rotation from z to `axis` (Duff et al. 2017). The rotation commutes with
/// turns about z, so a method that uses it treats all directions of a map alike.
#[inline(always)]
pub fn tangents(axis: V3) -> (V3, V3) {
    let [x, y, z] = axis;
    let sign = 1.0_f32.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    ([1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y])
}

/// A symmetric 2×2 matrix (a b; b c) as [a, b, c].
pub type Sym2 = [f32; 3];

/// The matrix of spreads `along` and `across`, turned by an angle in degrees from x towards y.
pub fn turned([along, across]: [f64; 2], degrees: f64) -> Sym2 {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let matrix = [
        along * cos * cos + across * sin * sin,
        (along - across) * sin * cos,
        along * sin * sin + across * cos * cos,
    ];
    matrix.map(|entry| entry as f32)
}

/// M · s
#[inline(always)]
pub fn times(m: Sym2, s: f32) -> Sym2 {
    [m[0] * s, m[1] * s, m[2] * s]
}

/// C M C of two symmetric matrices.
#[inline(always)]
pub fn sandwich([a, b, c]: Sym2, [x, y, z]: Sym2) -> Sym2 {
    // C M, row by row.
    let (top, bottom) = ([a * x + b * y, a * y + b * z], [b * x + c * y, b * y + c * z]);
    [top[0] * a + top[1] * b, top[0] * b + top[1] * c, bottom[0] * b + bottom[1] * c]
}

/// xᵀ M x
#[inline(always)]
pub fn quadratic(m: Sym2, x: f32, y: f32) -> f32 {
    m[0] * x * x + 2.0 * m[1] * x * y + m[2] * y * y
}

/// Inverse and determinant of a symmetric matrix. The determinant is held above the smallest normal
/// number: callers add a base variance, which keeps real ones far above that.
#[inline(always)]
pub fn invert(m: Sym2) -> (Sym2, f32) {
    let determinant = (m[0] * m[2] - m[1] * m[1]).max(f32::MIN_POSITIVE);
    let inverse = 1.0 / determinant;
    ([m[2] * inverse, -m[1] * inverse, m[0] * inverse], determinant)
}

/// The larger eigenvalue of a symmetric matrix.
#[inline(always)]
pub fn largest_eigenvalue(m: Sym2) -> f32 {
    let (mean, half) = (0.5 * (m[0] + m[2]), 0.5 * (m[0] - m[2]));
    mean + (half * half + m[1] * m[1]).sqrt()
}

/// A symmetric matrix with its eigenvalues held at or above `floor` ≥ 0: averages of rounded numbers
/// can lose positivity.
#[inline(always)]
pub fn at_least(m: Sym2, floor: f32) -> Sym2 {
    let (mean, half) = (0.5 * (m[0] + m[2]), 0.5 * (m[0] - m[2]));
    let radius = (half * half + m[1] * m[1]).sqrt();
    let (high, low) = ((mean + radius).max(floor), (mean - radius).max(floor));
    // Keep the eigenvectors, replace the eigenvalues.
    let shrink = 0.5 * (high - low) / radius.max(f32::MIN_POSITIVE);
    let centre = 0.5 * (high + low);
    let held = [centre + shrink * half, shrink * m[1], centre - shrink * half];
    if mean - radius >= floor { m } else { held }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn tangents_complete_a_frame(x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0) {
            prop_assume!(x * x + y * y + z * z > 1e-3);
            let n = unit([x, y, z]);
            let (t, b) = tangents(n);
            let back = cross(t, b);
            for c in 0..3 {
                prop_assert!((back[c] - n[c]).abs() < 1e-5);
            }
            prop_assert!(dot(t, b).abs() < 1e-5 && (dot(t, t) - 1.0).abs() < 1e-5);
        }

        #[test]
        fn held_matrices_are_positive(a in -1.0f32..1.0, b in -1.0f32..1.0, c in -1.0f32..1.0) {
            let held = at_least([a, b, c], 0.01);
            prop_assert!(held[0] >= 0.0 && held[2] >= 0.0);
            prop_assert!(held[0] * held[2] - held[1] * held[1] > 0.5e-4);
        }
    }

    #[test]
    fn small_angles_keep_their_digits() {
        let tilt = 1e-4_f32;
        let got = tan_squared([0.0, 0.0, 1.0], [tilt, 0.0, 1.0]);
        assert!((got / (tilt * tilt) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn inverse_times_matrix_is_identity() {
        let m = [2.5, 1.5, 2.5];
        let (n, determinant) = invert(m);
        assert!((determinant - 4.0).abs() < 1e-6);
        assert!((m[0] * n[0] + m[1] * n[1] - 1.0).abs() < 1e-6);
        assert!((m[0] * n[1] + m[1] * n[2]).abs() < 1e-6);
        assert!((largest_eigenvalue(m) - 4.0).abs() < 1e-6);
    }
}
