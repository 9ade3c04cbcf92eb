//! Directions drawn where an environment is bright.

use std::f64::consts::PI;

use super::grid::{Grid, Spot};
use crate::geometry::elementary::floor64;

/// Tables that draw a cell in proportion to its value times its solid angle, and a direction evenly from
/// the cell: the density at a direction is its cell's value over ∫ L dω. The usual product of a marginal
/// over rows and a conditional within each (Pharr, Jakob and Humphreys 2023, §12.5).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tables {
    /// Cumulative share of rows; ends with 1.
    rows: Vec<f64>,
    /// Cumulative share of cells within each row; each ends with 1.
    cells: Vec<f64>,
    /// 1 / ∫ L dω; 0 if that is 0, where all directions are equally likely.
    scale: f64,
}

impl Tables {
    pub fn of(grid: &Grid) -> Self {
        let mut cells = Vec::with_capacity(grid.values.len());
        let mut rows = Vec::with_capacity(grid.height);
        let mut total = 0.0;
        for j in 0..grid.height {
            let start = cells.len();
            let mut sum = 0.0;
            for i in 0..grid.width {
                sum += grid.cell(i, j);
                cells.push(sum);
            }
            finish(&mut cells[start..]);
            total += sum * grid.solid_angle(j);
            rows.push(total);
        }
        if total <= 0.0 {
            rows = (0..grid.height)
                .map(|j| (1.0 - libm::cos(PI * (j + 1) as f64 / grid.height as f64)) / 2.0)
                .collect();
        }
        finish(&mut rows);
        Self { rows, cells, scale: if total > 0.0 { 1.0 / total } else { 0.0 } }
    }

    /// The place that two numbers in [0, 1) draw.
    pub fn draw(&self, grid: &Grid, u1: f64, u2: f64) -> Spot {
        let (row, part) = find(&self.rows, u1);
        let cells = &self.cells[row * grid.width..(row + 1) * grid.width];
        let (column, across) = find(cells, u2);
        // Even in the cosine of the polar angle.
        let edge = |row: usize| libm::cos(PI * row as f64 / grid.height as f64);
        let cosine = edge(row) + part * (edge(row + 1) - edge(row));
        let down = libm::acos(cosine.clamp(-1.0, 1.0)) / PI;
        Spot { across: (column as f64 + across) / grid.width as f64, down }
    }

    /// Density at a place, per steradian.
    pub fn density(&self, grid: &Grid, spot: Spot) -> f64 {
        if self.scale == 0.0 {
            return 1.0 / (4.0 * PI);
        }
        let turns = spot.across - floor64(spot.across);
        let column = ((turns * grid.width as f64) as usize).min(grid.width - 1);
        let row = ((spot.down * grid.height as f64) as usize).min(grid.height - 1);
        grid.cell(column, row) * self.scale
    }
}

/// Divides cumulative sums by their last; all zero, they become even.
fn finish(sums: &mut [f64]) {
    let count = sums.len() as f64;
    let last = sums.last().copied().unwrap_or(0.0);
    for (i, sum) in sums.iter_mut().enumerate() {
        *sum = if last > 0.0 { *sum / last } else { (i + 1) as f64 / count };
    }
}

/// The step of a cumulative table that `u` falls in, and how far into it, from 0 to 1.
fn find(table: &[f64], u: f64) -> (usize, f64) {
    let step = table.partition_point(|&end| end <= u).min(table.len() - 1);
    let start = if step == 0 { 0.0 } else { table[step - 1] };
    let width = (table[step] - start).max(f64::MIN_POSITIVE);
    (step, ((u - start) / width).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let values = (0..32 * 16).map(|i| if i % 7 == 0 { 0.0 } else { ((i * 37) % 23) as f32 });
        Grid { width: 32, height: 16, values: values.collect() }
    }

    #[test]
    fn the_density_integrates_to_one() {
        for grid in [grid(), Grid { values: vec![0.0; 512], ..grid() }] {
            let tables = Tables::of(&grid);
            let mut total = 0.0;
            for row in 0..16 {
                for column in 0..32 {
                    let across = (f64::from(column) + 0.5) / 32.0;
                    let spot = Spot { across, down: (row as f64 + 0.5) / 16.0 };
                    total += tables.density(&grid, spot) * grid.solid_angle(row);
                }
            }
            assert!((total - 1.0).abs() < 1e-12, "{total}");
        }
    }

    #[test]
    fn what_is_drawn_integrates_the_map_itself() {
        // Σ L/p over draws is ∫ L dω exactly, draw by draw, as p is L over that.
        let (grid, tables) = (grid(), Tables::of(&grid()));
        let integral = grid.mean() * 4.0 * PI;
        for k in 0..1000 {
            let (u1, u2) = ((f64::from(k) * 0.618_034).fract(), (f64::from(k) * 0.754_878).fract());
            let spot = tables.draw(&grid, u1, u2);
            let (column, row) = ((spot.across * 32.0) as usize, (spot.down * 16.0) as usize);
            let estimate = grid.cell(column.min(31), row.min(15)) / tables.density(&grid, spot);
            assert!((estimate / integral - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn draws_integrate_other_functions() {
        // A lattice of n draws (no random number): ∫ cos²θ dω = 4π/3 where L is not 0, by f/p. Cells
        // where L is 0 are left out on both sides.
        let (grid, tables) = (grid(), Tables::of(&grid()));
        let n = 200_000;
        let mut sum = 0.0;
        for k in 0..n {
            let (u1, u2) =
                ((f64::from(k) + 0.5) / f64::from(n), (f64::from(k) * 0.618_033_988_75).fract());
            let spot = tables.draw(&grid, u1, u2);
            sum += libm::cos(PI * spot.down).powi(2) / tables.density(&grid, spot) / f64::from(n);
        }
        let mut want = 0.0;
        for row in 0..16 {
            let lit = (0..32).filter(|&column| grid.cell(column, row) > 0.0).count() as f64;
            let [a, b] = [row, row + 1].map(|r| libm::cos(PI * r as f64 / 16.0));
            want += lit / 32.0 * 2.0 * PI * (a.powi(3) - b.powi(3)) / 3.0;
        }
        assert!((sum / want - 1.0).abs() < 2e-3, "{sum} {want}");
    }
}
