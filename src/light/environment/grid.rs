//! Numbers over the sphere of directions, on a grid of longitude and latitude.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::geometry::Vec3;
use crate::geometry::elementary::{atan2_64, floor64};
use crate::texture::tap_weights;

/// A direction as a place on an equirectangular picture: `across` from its left edge, any number, a turn
/// being 1; `down` from the zenith (0) to the nadir (1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub across: f64,
    pub down: f64,
}

impl Spot {
    /// Where a direction of any length is. The picture's middle is +y; as seen from inside, the sky turns
    /// to the left with growing azimuth, so +x is a quarter to the right.
    #[inline]
    pub fn of(direction: &Vec3) -> Self {
        let [x, y, z] = [direction.x, direction.y, direction.z];
        let azimuth = atan2_64(y, x);
        let polar = atan2_64((x * x + y * y).sqrt(), z);
        Self { across: 0.5 - (azimuth - FRAC_PI_2) / TAU, down: polar / PI }
    }

    /// The unit direction.
    pub fn direction(self) -> Vec3 {
        let (sin_polar, cos_polar) = libm::sincos(self.down * PI);
        let (sin, cos) = libm::sincos(FRAC_PI_2 - (self.across - 0.5) * TAU);
        Vec3::new(sin_polar * cos, sin_polar * sin, cos_polar)
    }
}

/// One number a cell; rows of equal height in polar angle, from the zenith down.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    pub width: usize,
    pub height: usize,
    /// Row by row.
    pub values: Vec<f32>,
}

impl Grid {
    /// The value of cell `column` of `row`.
    #[inline]
    pub fn cell(&self, column: usize, row: usize) -> f64 {
        f64::from(self.values[row * self.width + column])
    }

    /// The value at a place, bilinear between the centres of cells. Over a pole it goes on half a turn
    /// away.
    #[inline]
    pub fn at(&self, spot: Spot) -> f64 {
        let turns = spot.across - floor64(spot.across);
        let x = turns * self.width as f64 - 0.5;
        let y = spot.down * self.height as f64 - 0.5;
        let (left, top) = (floor64(x), floor64(y));
        let (right_part, lower_part) = (x - left, y - top);
        // Rows −1 and `height` lie beyond a pole.
        let row = |y: f64| {
            let line =
                |row: usize, shift: usize| self.between(left as isize, right_part, row, shift);
            if y < 0.0 {
                line(0, self.width / 2)
            } else if y as usize >= self.height {
                line(self.height - 1, self.width / 2)
            } else {
                line(y as usize, 0)
            }
        };
        let (above, below) = (row(top), row(top + 1.0));
        above + lower_part * (below - above)
    }

    #[inline]
    fn between(&self, left: isize, part: f64, row: usize, shift: usize) -> f64 {
        // `left` is −1 or a column.
        let wrap = |column: usize| if column >= self.width { column - self.width } else { column };
        let first = (left + shift as isize + self.width as isize) as usize % self.width;
        let (a, b) = (self.cell(first, row), self.cell(wrap(first + 1), row));
        a + part * (b - a)
    }

    /// Solid angle of a cell of `row`, steradians.
    pub fn solid_angle(&self, row: usize) -> f64 {
        let edge = |row: usize| libm::cos(PI * row as f64 / self.height as f64);
        (edge(row) - edge(row + 1)) * TAU / self.width as f64
    }

    /// The same on a grid of another size: the mean by solid angle of what lies under each cell.
    pub fn resampled(&self, width: usize, height: usize) -> Self {
        if (width, height) == (self.width, self.height) {
            return self.clone();
        }
        let columns: Vec<Vec<(usize, f64)>> =
            (0..width).map(|i| tap_weights(self.width, width, i).collect()).collect();
        let mut values = Vec::with_capacity(width * height);
        for j in 0..height {
            let rows: Vec<(usize, f64)> = tap_weights(self.height, height, j)
                .map(|(row, share)| (row, share * self.solid_angle(row)))
                .collect();
            let all: f64 = rows.iter().map(|(_, weight)| weight).sum();
            for columns in &columns {
                let mut sum = 0.0;
                for &(row, weight) in &rows {
                    for &(column, share) in columns {
                        sum += weight * share * self.cell(column, row);
                    }
                }
                values.push((sum / all) as f32);
            }
        }
        Self { width, height, values }
    }

    /// The mean over the sphere.
    pub fn mean(&self) -> f64 {
        let row = |j: usize| {
            let sum: f64 = (0..self.width).map(|i| self.cell(i, j)).sum();
            sum * self.solid_angle(j)
        };
        (0..self.height).map(row).sum::<f64>() / (4.0 * PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    pub(crate) fn numbered(width: usize, height: usize) -> Grid {
        let values = (0..width * height).map(|i| ((i * 37) % 11) as f32).collect();
        Grid { width, height, values }
    }

    proptest! {
        #[test]
        fn places_and_directions_are_inverse(across in 0.0f64..1.0, down in 0.001f64..0.999) {
            let spot = Spot { across, down };
            let back = Spot::of(&(spot.direction() * 3.0));
            let turn = back.across - across;
            prop_assert!((turn - turn.round()).abs() < 1e-9 && (back.down - down).abs() < 1e-9);
        }

        #[test]
        fn lookups_are_continuous_everywhere(
            x in -1.0f64..1.0, y in -1.0f64..1.0, z in -1.0f64..1.0, pole in any::<bool>()
        ) {
            let grid = numbered(16, 8);
            let mut d = Vec3::new(x, y, z);
            prop_assume!(d.norm() > 0.1);
            if pole {
                // Next to a pole, and across it.
                d = Vec3::new(x * 1e-6, y * 1e-6, 1.0_f64.copysign(z));
            }
            let near = d.normalize() + Vec3::new(1e-7, -1e-7, 1e-7);
            let (a, b) = (grid.at(Spot::of(&d)), grid.at(Spot::of(&near)));
            // Away from the poles a cell is π/8 wide; at a pole all longitudes meet.
            prop_assert!(pole || (a - b).abs() < 1e-3 || z.abs() > 0.99 * d.norm());
            prop_assert!((0.0..=10.0).contains(&a));
        }
    }

    #[test]
    fn the_middle_is_ahead_and_x_a_quarter_to_the_right() {
        let spot = |x, y, z| Spot::of(&Vec3::new(x, y, z));
        assert_eq!(spot(0.0, 1.0, 0.0), Spot { across: 0.5, down: 0.5 });
        assert_eq!(spot(1.0, 0.0, 0.0), Spot { across: 0.75, down: 0.5 });
        assert_eq!((spot(0.0, 0.0, 2.0).down, spot(0.0, 0.0, -1.0).down), (0.0, 1.0));
    }

    #[test]
    fn centres_of_cells_have_their_values() {
        let grid = numbered(6, 3);
        for row in 0..3 {
            for column in 0..6 {
                let across = (column as f64 + 0.5) / 6.0;
                let spot = Spot { across, down: (row as f64 + 0.5) / 3.0 };
                assert!((grid.at(spot) - grid.cell(column, row)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn cells_tile_the_sphere_and_resampling_keeps_the_mean() {
        let grid = numbered(24, 12);
        let all: f64 = (0..12).map(|j| 24.0 * grid.solid_angle(j)).sum();
        assert!((all - 4.0 * PI).abs() < 1e-12);
        for (width, height) in [(24, 12), (12, 6), (16, 8), (2, 1)] {
            let small = grid.resampled(width, height);
            // Rows that do not nest share a row's solid angle evenly, which is not quite true.
            let within = if 12 % height == 0 { 1e-6 } else { 0.02 };
            assert!((small.mean() - grid.mean()).abs() < within, "{width}");
        }
    }
}
