//! What becomes of a map's slopes on a surface that stretches it (Blinn 1978 §2 and §4).

/// A turn of the normals of a map: slopes f = (∂F/∂x, ∂F/∂y) of the map are slopes M f in the tangent frame of the
/// surface. Without one, slopes of the map are slopes on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// M, row by row.
    pub matrix: [f32; 4],
    /// Whether only M f's direction is taken, and |f| stays the tangent of the angle.
    pub keeps_angle: bool,
}

impl Default for Bend {
    fn default() -> Self {
        Self { matrix: [1.0, 0.0, 0.0, 1.0], keeps_angle: false }
    }
}

impl Bend {
    /// A normal of the map, of any length and z ≥ 0, as it stands on the surface, of any length. Where M f is
    /// nothing, so is the slope.
    #[inline(always)]
    pub fn turn(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let [a, b, c, d] = self.matrix;
        let turned = [a * x + b * y, c * x + d * y];
        let squares = [[x, y], turned].map(|[x, y]| x * x + y * y);
        let kept = if squares[1] > 0.0 { (squares[0] / squares[1]).sqrt() } else { 0.0 };
        let scale = if self.keeps_angle { kept } else { 1.0 };
        [turned[0] * scale, turned[1] * scale, z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn angles_are_kept_or_stretched(
            matrix in prop::array::uniform4(-3.0f32..3.0), x in -2.0f32..2.0, y in -2.0f32..2.0
        ) {
            let of = |keeps_angle| Bend { matrix, keeps_angle }.turn([x, y, 0.5]);
            let (free, kept) = (of(false), of(true));
            prop_assume!(free[0].hypot(free[1]) > 1e-3);
            prop_assert!((kept[0].hypot(kept[1]) - x.hypot(y)).abs() < 1e-4);
            // The same direction.
            prop_assert!((kept[0] * free[1] - kept[1] * free[0]).abs() < 1e-3);
            prop_assert!(kept[0] * free[0] + kept[1] * free[1] > 0.0);
            prop_assert_eq!(Bend::default().turn([x, y, 0.5]), [x, y, 0.5]);
        }
    }

    #[test]
    fn nothing_stays_nothing() {
        let flat = Bend { matrix: [0.0; 4], keeps_angle: true };
        assert_eq!(flat.turn([0.3, 0.4, 1.0]), [0.0, 0.0, 1.0]);
        assert_eq!(
            Bend { keeps_angle: true, ..Bend::default() }.turn([0.0, 0.0, 1.0]),
            [0.0, 0.0, 1.0]
        );
    }
}
