//! Light from everywhere: an environment map.
//!
//! An environment is luminance by direction, as if from infinitely far away; light has no colour here. It
//! is kept as an equirectangular picture whose middle is +y and whose top is +z, and as blurred copies of
//! that ([`Environment::cone`]).

mod cone;
mod file;
mod grid;
mod levels;
pub mod maps;
mod tables;

pub use cone::PROBES;
pub use file::{EnvironmentError, Read, inspect, read};

use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::Vec3;
use grid::{Grid, Spot};
use levels::Levels;
use tables::Tables;

/// Most pixels across an environment's picture.
pub const MOST_ACROSS: usize = 8192;

/// Radiance towards a unit direction.
pub type Radiance = dyn Fn(&Vec3) -> f64 + Sync;

/// Radiance by direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    map: Arc<Grid>,
    tables: Arc<Tables>,
    levels: Arc<Levels>,
    /// Part of a turn from +x towards +y.
    turned: f64,
}

impl Environment {
    /// The environment of a luminance picture twice as wide as high, row by row from the top; its values
    /// finite and not negative. It is turned by `rotation` degrees about the vertical, from +x towards
    /// +y, and all radiances are multiplied by `intensity`. Blurring takes a while for large pictures; rows
    /// run in parallel and give the same at any thread count.
    ///
    /// # Panics
    /// If the number of values is not that of a picture `height` high: a programming error.
    pub fn new(height: usize, values: &[f32], rotation: f64, intensity: f64) -> Self {
        assert!(height > 0 && values.len() == 2 * height * height, "shape of an environment");
        let values =
            values.iter().map(|&v| (f64::from(v) * intensity).min(f64::from(f32::MAX)) as f32);
        let map = Grid { width: 2 * height, height, values: values.collect() };
        let (tables, levels) = (Tables::of(&map), Levels::of(&map));
        let (map, tables, levels) = (Arc::new(map), Arc::new(tables), Arc::new(levels));
        Self { map, tables, levels, turned: rotation / 360.0 }
    }

    /// The environment whose radiance towards a unit direction is `radiance`, on a picture `height` pixels
    /// high: each pixel is the mean of 4 × 4 directions within it.
    pub fn of(
        radiance: &(dyn Fn(&Vec3) -> f64 + Sync),
        height: usize,
        rotation: f64,
        intensity: f64,
    ) -> Self {
        const FINER: usize = 4;
        let part = |index: usize, sub: usize| index as f64 + (sub as f64 + 0.5) / FINER as f64;
        let pixel = |row: usize, column: usize| {
            let mut sum = 0.0;
            for k in 0..FINER * FINER {
                let across = part(column, k % FINER) / (2 * height) as f64;
                let down = part(row, k / FINER) / height as f64;
                sum += radiance(&Spot { across, down }.direction());
            }
            (sum / (FINER * FINER) as f64) as f32
        };
        let mut values = vec![0.0; 2 * height * height];
        values.par_chunks_mut(2 * height).enumerate().for_each(|(row, line)| {
            line.iter_mut().enumerate().for_each(|(column, value)| *value = pixel(row, column));
        });
        Self::new(height, &values, rotation, intensity)
    }

    /// The same environment, turned by further degrees about the vertical. It shares the picture.
    pub fn turned(&self, degrees: f64) -> Self {
        Self { turned: self.turned + degrees / 360.0, ..self.clone() }
    }

    /// Pixels down its picture.
    pub fn height(&self) -> usize {
        self.map.height
    }

    /// Memory of its blurred copies, in bytes.
    pub fn bytes(&self) -> usize {
        self.levels.bytes()
    }

    #[inline]
    fn spot(&self, direction: &Vec3) -> Spot {
        let spot = Spot::of(direction);
        Spot { across: spot.across + self.turned, ..spot }
    }

    /// Radiance from a direction of any length, bilinear between pixels.
    #[inline]
    pub fn radiance(&self, direction: &Vec3) -> f64 {
        self.map.at(self.spot(direction))
    }

    /// The mean radiance over all directions.
    pub fn mean(&self) -> f64 {
        self.map.mean()
    }

    /// The direction that two numbers in [0, 1) draw, its density as [`Environment::density`].
    pub fn sample(&self, u1: f64, u2: f64) -> (Vec3, f64) {
        let spot = self.tables.draw(&self.map, u1, u2);
        let density = self.tables.density(&self.map, spot);
        (Spot { across: spot.across - self.turned, ..spot }.direction(), density)
    }

    /// Density of [`Environment::sample`] at a direction of any length, per steradian: in proportion to the
    /// radiance of the pixel there; the same everywhere if all is black.
    #[inline]
    pub fn density(&self, direction: &Vec3) -> f64 {
        self.tables.density(&self.map, self.spot(direction))
    }
}

#[cfg(test)]
mod tests;
