//! The bump pyramid and the roughness pyramid in double precision, as the paper makes them.

use crate::parameter::{Value, Values};
use crate::pattern::{self, Bumps};
use crate::texture::NormalMap;

/// A symmetric matrix (a b; b c) as [a, b, c].
pub type Covariance = [f64; 3];

/// A cell of both pyramids.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cell {
    /// x̄: the mean perturbation vector (f_u, f_v).
    pub mean: [f64; 2],
    /// K: their covariance within the cell.
    pub roughness: Covariance,
}

/// A level of both pyramids of a square map whose side is a power of two.
#[derive(Clone, Debug)]
pub struct Level {
    /// Cells along a side.
    pub side: usize,
    /// Row by row from v = 0.
    pub cells: Vec<Cell>,
}

/// A pattern of the program's on a square map, with some of its options set.
pub fn bumps(name: &str, side: usize, set: &[(&'static str, Value)], seed: u64) -> Bumps {
    let entry = pattern::find(name).expect("a pattern of the program's own");
    let values = Values::defaults(entry.parameters).with(set);
    (entry.build)(side, side, &values, seed)
}

/// The perturbation vectors of a square map: level 0, without roughness.
pub fn vectors(map: &NormalMap) -> Level {
    let side = map.width();
    let cell = |at: usize| Cell { mean: map.slope(at % side, at / side), ..Cell::default() };
    Level { side, cells: (0..side * side).map(cell).collect() }
}

/// All levels, level 0 first, by the paper's recursive rule: K_l = ¼ Σ K_{l−1} + ¼ Σ (x − x̄)(x − x̄)ᵀ. What is
/// kept of a K is `keep(K)`.
pub fn recursive(bottom: Level, keep: impl Fn(Covariance) -> Covariance) -> Vec<Level> {
    let mut levels = vec![bottom];
    while let Some(below) = levels.last().filter(|level| level.side > 1) {
        let side = below.side / 2;
        let four = |at: usize| {
            let (i, j) = (2 * (at % side), 2 * (at / side));
            [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(di, dj)| below.cells[(j + dj) * below.side + i + di])
        };
        let cell = |at: usize| {
            let Cell { mean, roughness } = pooled(&four(at));
            Cell { mean, roughness: keep(roughness) }
        };
        let cells = (0..side * side).map(cell).collect();
        levels.push(Level { side, cells });
    }
    levels
}

/// The cells of level `level` straight from the bottom: mean and covariance over all of each.
pub fn direct(bottom: &Level, level: usize) -> Level {
    let (block, side) = (1 << level, bottom.side >> level);
    let cell = |at: usize| {
        let (i, j) = (block * (at % side), block * (at / side));
        let under = (0..block * block)
            .map(|k| bottom.cells[(j + k / block) * bottom.side + i + k % block])
            .collect::<Vec<_>>();
        pooled(&under)
    };
    Level { side, cells: (0..side * side).map(cell).collect() }
}

/// The mean of the cells' means; the mean of their roughness and the covariance of their means.
fn pooled(cells: &[Cell]) -> Cell {
    let per = 1.0 / cells.len() as f64;
    let mean = [0, 1].map(|axis| cells.iter().map(|c| c.mean[axis]).sum::<f64>() * per);
    let mut roughness = [0.0; 3];
    for cell in cells {
        let [x, y] = [cell.mean[0] - mean[0], cell.mean[1] - mean[1]];
        for (sum, (own, spread)) in
            roughness.iter_mut().zip(cell.roughness.into_iter().zip([x * x, x * y, y * y]))
        {
            *sum += per * (own + spread);
        }
    }
    Cell { mean, roughness }
}

/// D = (d₁ d₂; 0 d₃) with D Dᵀ = K: d₁ = √(a − b²/c), d₂ = b/√c, d₃ = √c. Where c = 0, d₁ = √a and the others are
/// 0, of which the print does not tell.
pub fn factor([a, b, c]: Covariance) -> [f64; 3] {
    if c <= 0.0 {
        return [a.max(0.0).sqrt(), 0.0, 0.0];
    }
    [(a - b * b / c).max(0.0).sqrt(), b / c.sqrt(), c.sqrt()]
}

/// K = D Dᵀ.
pub fn product([d1, d2, d3]: [f64; 3]) -> Covariance {
    [d1 * d1 + d2 * d2, d2 * d3, d3 * d3]
}

/// xᵀ K⁻¹ x; without bound where K has no extent in a direction that x has.
pub fn distance([a, b, c]: Covariance, [x, y]: [f64; 2]) -> f64 {
    let determinant = a * c - b * b;
    (c * x * x - 2.0 * b * x * y + a * y * y) / determinant.max(f64::MIN_POSITIVE)
}

/// [σ₁², σ₂², the angle of the first from +u, radians], σ₁ ≥ σ₂.
pub fn principal([a, b, c]: Covariance) -> [f64; 3] {
    let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
    let radius = (half * half + b * b).sqrt();
    [mean + radius, (mean - radius).max(0.0), 0.5 * libm::atan2(b, half)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn factors_and_axes_are_of_the_matrix(x in -2.0f64..2.0, y in -2.0f64..2.0, s in 0.0f64..2.0) {
            // x xᵀ + s I is positive.
            let k = [x * x + s, x * y, y * y + s];
            for (got, want) in product(factor(k)).into_iter().zip(k) {
                prop_assert!((got - want).abs() < 1e-9 || y * y + s < 1e-9);
            }
            let [most, least, angle] = principal(k);
            prop_assert!((most - (x * x + y * y + s)).abs() < 1e-12 && (least - s).abs() < 1e-12);
            let along = [angle.cos(), angle.sin()];
            if s > 1e-3 {
                prop_assert!((distance(k, along) * most - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn both_rules_agree_on_a_small_map() {
        let bottom = vectors(&bumps("gaussian", 8, &[], 3).normals);
        let levels = recursive(bottom.clone(), |k| k);
        assert_eq!(levels.len(), 4);
        for (at, level) in levels.iter().enumerate() {
            let want = direct(&bottom, at);
            assert_eq!(level.side, want.side);
            for (a, b) in level.cells.iter().zip(&want.cells) {
                assert!((a.roughness[0] - b.roughness[0]).abs() < 1e-14);
                assert!((a.mean[1] - b.mean[1]).abs() < 1e-14);
            }
        }
    }
}
