//! How well normals follow a distribution.

use crate::lobe::NdfImage;

/// Normals counted in squares of the (x, y) map, beside what an NDF expects there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Normals counted.
    pub count: f64,
    /// Pearson's χ² over the squares where at least [`LEAST`] are expected; those with fewer count together as one.
    pub chi_squared: f64,
    /// Squares that count, less 1.
    pub degrees: f64,
    /// ½ Σ |counted − expected| / N over all squares: 0 if they agree, 1 if they are apart.
    pub total_variation: f64,
}

/// The least that is expected of a square that counts by itself.
pub const LEAST: f64 = 10.0;

impl Agreement {
    /// Of unit normals with an NDF, in `squares`² squares. If the side of the NDF is a multiple of `squares`, what is
    /// expected is exact.
    pub fn of(ndf: &NdfImage, normals: impl Iterator<Item = [f32; 3]>, squares: usize) -> Self {
        let square = |[x, y]: [f64; 2]| {
            let of = |c: f64| (((0.5 * c + 0.5) * squares as f64) as usize).min(squares - 1);
            of(y) * squares + of(x)
        };
        let side = ndf.side();
        let mut expected = vec![0.0; squares * squares];
        for (k, d) in ndf.values().iter().enumerate() {
            let at = [k % side, k / side].map(|c| (2 * c + 1) as f64 / side as f64 - 1.0);
            expected[square(at)] += f64::from(*d) * 4.0 / (side * side) as f64;
        }
        let (mut counted, mut count) = (vec![0.0; squares * squares], 0.0);
        for [x, y, _] in normals {
            counted[square([x.into(), y.into()])] += 1.0;
            count += 1.0;
        }
        let (mut chi_squared, mut degrees, mut apart) = (0.0, -1.0, 0.0);
        let mut rest = [0.0; 2];
        let mut add = |want: f64, got: f64| {
            chi_squared += (got - want) * (got - want) / want;
            degrees += 1.0;
        };
        for (want, got) in expected.iter().map(|e| e * count).zip(counted) {
            apart += (got - want).abs();
            if want >= LEAST {
                add(want, got);
            } else {
                rest = [rest[0] + want, rest[1] + got];
            }
        }
        if rest[0] >= LEAST {
            add(rest[0], rest[1]);
        }
        Self { count, chi_squared, degrees, total_variation: 0.5 * apart / f64::max(count, 1.0) }
    }

    /// The part of samples that follow the NDF, and are independent, which agree worse than this: the upper tail of χ²,
    /// by the cube root of Wilson and Hilferty 1931.
    pub fn p_value(&self) -> f64 {
        let spread = 2.0 / (9.0 * self.degrees.max(1.0));
        let root = libm::cbrt(self.chi_squared / self.degrees.max(1.0));
        0.5 * libm::erfc((root - (1.0 - spread)) / (2.0 * spread).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_of_chi_squared_are_those_of_the_tables() {
        // Upper 5 % and 1 % points: 18.307 and 23.209 of 10 degrees, 124.342 and 135.807 of 100.
        for (degrees, chi_squared, tail) in [
            (10.0, 18.307, 0.05),
            (10.0, 23.209, 0.01),
            (100.0, 124.342, 0.05),
            (100.0, 135.807, 0.01),
        ] {
            let of = Agreement { count: 0.0, chi_squared, degrees, total_variation: 0.0 };
            assert!((of.p_value() / tail - 1.0).abs() < 0.02, "{degrees}: {}", of.p_value());
        }
    }

    #[test]
    fn what_is_apart_has_a_total_variation_of_one() {
        let corner = NdfImage::from_fn(32, |[x, y]| if x > 0.5 && y > 0.25 { 1.0 } else { 0.0 });
        let normals = std::iter::repeat_n([-0.5, -0.5, 0.7], 100);
        let of = Agreement::of(&corner.unwrap(), normals, 8);
        assert!(of.count == 100.0 && (of.total_variation - 1.0).abs() < 1e-6, "{of:?}");
        assert!(of.p_value() < 1e-12);
    }
}
