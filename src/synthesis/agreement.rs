//! How well normals follow a distribution.

use crate::lobe::NdfImage;
use crate::lobe::vector::V3;

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

/// The share of an NDF's normals in each square.
fn shares(ndf: &NdfImage, squares: usize) -> Vec<f64> {
    let side = ndf.side();
    let mut shares = vec![0.0; squares * squares];
    for (k, d) in ndf.values().iter().enumerate() {
        let at = [k % side, k / side].map(|c| (2 * c + 1) as f64 / side as f64 - 1.0);
        shares[square(at, squares)] += f64::from(*d) * 4.0 / (side * side) as f64;
    }
    shares
}

/// The square that a place of the (x, y) map lies in.
fn square([x, y]: [f64; 2], squares: usize) -> usize {
    let of = |c: f64| (((0.5 * c + 0.5) * squares as f64) as usize).min(squares - 1);
    of(y) * squares + of(x)
}

/// The total variation distance of normals from an NDF over `squares`² squares, ½ Σ |p − q|: of a distribution that is
/// known as normals with their probabilities, which sum to 1. Nothing is drawn.
pub fn total_variation(
    ndf: &NdfImage,
    normals: impl Iterator<Item = (V3, f64)>,
    squares: usize,
) -> f64 {
    let mut apart = shares(ndf, squares);
    for ([x, y, _], probability) in normals {
        apart[square([x.into(), y.into()], squares)] -= probability;
    }
    0.5 * apart.iter().map(|d| d.abs()).sum::<f64>()
}

/// The total variation distance that `count` independent normals of the NDF itself have from it on average, counted in
/// `squares`² squares: chance alone. A square of share p deviates by 2 ν C(N, ν) p^ν (1 − p)^(N − ν + 1) of N normals on
/// average, ν = ⌊N p⌋ + 1 (de Moivre 1730, for binomial counts).
pub fn by_chance(ndf: &NdfImage, count: usize, squares: usize) -> f64 {
    let n = count as f64;
    let deviation = |p: f64| {
        let v = (n * p).floor() + 1.0;
        if !(p > 0.0 && v <= n) {
            return 0.0;
        }
        let choose = libm::lgamma(n + 1.0) - libm::lgamma(v + 1.0) - libm::lgamma(n - v + 1.0);
        2.0 * v * libm::exp(choose + v * libm::log(p) + (n - v + 1.0) * libm::log1p(-p))
    };
    0.5 * shares(ndf, squares).into_iter().map(deviation).sum::<f64>() / n.max(1.0)
}

/// The least that is expected of a square that counts by itself.
pub const LEAST: f64 = 10.0;

impl Agreement {
    /// Of unit normals with an NDF, in `squares`² squares. If the side of the NDF is a multiple of `squares`, what is
    /// expected is exact.
    pub fn of(ndf: &NdfImage, normals: impl Iterator<Item = V3>, squares: usize) -> Self {
        let expected = shares(ndf, squares);
        let (mut counted, mut count) = (vec![0.0; squares * squares], 0.0);
        for [x, y, _] in normals {
            counted[square([x.into(), y.into()], squares)] += 1.0;
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
    fn chance_alone_is_what_binomial_counts_deviate_by() {
        // Two squares of a half each of 4 normals: |X − 2| is 0, 1, 2 with probabilities 6, 8, 2 sixteenths: ¾ on average, and
        // the same of the other square, over 4 and halved.
        let halves = NdfImage::from_fn(8, |[x, y]| f32::from(y > 0.5 && x.abs() < 0.5)).unwrap();
        let found = by_chance(&halves, 4, 2);
        // Densities are of single precision.
        assert!((found - 0.1875).abs() < 1e-6, "{found}");
        // Of many: √(p (1 − p) / 2πN) each.
        let n = 1_000_000;
        let want = 2.0 * (0.25 / (2.0 * std::f64::consts::PI * n as f64)).sqrt();
        assert!((by_chance(&halves, n, 2) / want - 1.0).abs() < 1e-5);
    }

    #[test]
    fn probabilities_are_held_against_shares() {
        let halves = NdfImage::from_fn(8, |[x, y]| f32::from(y > 0.5 && x.abs() < 0.5)).unwrap();
        let normals = [([-0.1, 0.7, 0.7], 0.7), ([0.1, 0.7, 0.7], 0.3)];
        assert!((total_variation(&halves, normals.into_iter(), 2) - 0.2).abs() < 1e-6);
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
