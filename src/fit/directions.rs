//! Where a distribution is known: a grid over the hemisphere, or directions as they were measured.

use super::InputError;
use super::kernel::CHUNK;
use crate::geometry::{HemisphereGrid, Vec3};

/// Scattered directions have at least so many neighbours, if there are as many directions.
const NEAREST: usize = 8;
/// Cosine of the angle within which all scattered directions are neighbours: 5°, the step of the paper's
/// grid. Nearer ones alone would tell the noise of dense measurements, not how a peak falls off.
const NEAR: f64 = 0.996_194_698_091_745_5;
/// Directions of at least this cosine (2·10⁻⁶ radians) are one direction, sampled again.
const SAME: f64 = 1.0 - 2e-12;

/// Directions, axis by axis, filled up with zero vectors to whole chunks (where every peak is 0), so that
/// loops over them become vector code.
#[derive(Clone, Debug)]
pub struct Directions {
    /// The grid they are of; `None` if they are scattered.
    grid: Option<HemisphereGrid>,
    count: usize,
    axes: [Vec<f64>; 3],
}

impl Directions {
    /// The directions of a grid.
    pub fn new(grid: HemisphereGrid) -> Self {
        let axes = axes(grid.samples().iter().map(|sample| sample.direction));
        Self { count: grid.samples().len(), axes, grid: Some(grid) }
    }

    /// Any directions, brought to unit length; they may repeat, and may point below the horizon.
    ///
    /// # Errors
    /// [`InputError::Direction`] for the first that is zero or not finite.
    pub fn scattered(directions: &[Vec3]) -> Result<Self, InputError> {
        let to_unit = |(index, &direction): (usize, &Vec3)| {
            unit(direction).ok_or(InputError::Direction { index, direction })
        };
        let units: Vec<Vec3> =
            directions.iter().enumerate().map(to_unit).collect::<Result<_, _>>()?;
        let count = units.len();
        Ok(Self { grid: None, count, axes: axes(units.into_iter()) })
    }

    /// The grid they are of; `None` if they are scattered.
    pub fn grid(&self) -> Option<&HemisphereGrid> {
        self.grid.as_ref()
    }

    /// Number of directions.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Direction `index` < `count`, of unit length.
    pub fn at(&self, index: usize) -> Vec3 {
        let [x, y, z] = &self.axes;
        Vec3::new(x[index], y[index], z[index])
    }

    /// The directions in order.
    pub fn iter(&self) -> impl Iterator<Item = Vec3> {
        (0..self.count).map(|index| self.at(index))
    }

    /// Indices of the directions around one. On a grid: those beside it. If scattered: all others within
    /// 5°, and the nearest 8 if those are fewer; the same direction sampled again is no neighbour. The
    /// search looks at every direction: it is made for a few of them, not for all.
    pub fn neighbours(&self, index: usize) -> Vec<usize> {
        if let Some(grid) = &self.grid {
            return grid.neighbours(index);
        }
        let centre = self.at(index);
        let cosines = self.iter().map(|direction| centre.dot(&direction));
        let mut others: Vec<(f64, usize)> =
            cosines.zip(0..).filter(|(cosine, _)| *cosine < SAME).collect();
        let near = others.iter().filter(|(cosine, _)| *cosine >= NEAR).count().max(NEAREST);
        if near < others.len() {
            others.select_nth_unstable_by(near, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            others.truncate(near);
        }
        let mut indices: Vec<usize> = others.into_iter().map(|(_, index)| index).collect();
        indices.sort_unstable();
        indices
    }

    /// x, y and z of chunk `k`.
    pub(super) fn chunk(&self, k: usize) -> [&[f64; CHUNK]; 3] {
        let at = k * CHUNK..(k + 1) * CHUNK;
        // The lengths are multiples of a chunk, so the slice has a chunk's length.
        [0, 1, 2].map(|c| self.axes[c][at.clone()].try_into().expect("a whole chunk"))
    }

    pub(super) fn chunks(&self) -> usize {
        self.axes[0].len() / CHUNK
    }
}

/// Each axis in a list of its own, in whole chunks.
fn axes(directions: impl Iterator<Item = Vec3>) -> [Vec<f64>; 3] {
    let mut axes: [Vec<f64>; 3] = Default::default();
    for direction in directions {
        (0..3).for_each(|c| axes[c].push(direction[c]));
    }
    axes.map(|mut axis| {
        axis.resize(axis.len().div_ceil(CHUNK) * CHUNK, 0.0);
        axis
    })
}

/// A vector of any length brought to 1; `None` if it is zero or not finite.
fn unit(vector: Vec3) -> Option<Vec3> {
    // First by the largest part, so that no square overflows or vanishes.
    let largest = vector.amax();
    let usable = vector.iter().all(|part| part.is_finite()) && largest > 0.0;
    usable.then(|| (vector / largest).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_length_becomes_one() {
        let tiny = Vec3::new(0.0, 3e-308, 4e-308);
        let huge = Vec3::new(-1e308, 0.0, -1e308);
        let directions = Directions::scattered(&[tiny, huge]).unwrap();
        assert_eq!(directions.count(), 2);
        assert!((directions.at(0) - Vec3::new(0.0, 0.6, 0.8)).norm() < 1e-15);
        assert!((directions.at(1) + Vec3::new(0.5, 0.0, 0.5).normalize()).norm() < 1e-15);
        for bad in
            [Vec3::zeros(), Vec3::new(f64::NAN, 0.0, 1.0), Vec3::new(0.0, f64::INFINITY, 1.0)]
        {
            let refused = Directions::scattered(&[tiny, bad]);
            assert!(matches!(refused, Err(InputError::Direction { index: 1, .. })));
        }
    }

    #[test]
    fn neighbours_are_the_nearest() {
        // A ring of 40 directions, 9° apart, and one of them again.
        let at = |k: i32| {
            let angle = f64::from(k) * 9.0_f64.to_radians();
            Vec3::new(angle.cos(), angle.sin(), 0.0)
        };
        let mut ring: Vec<Vec3> = (0..40).map(at).collect();
        ring.push(at(10) * 7.0);
        let directions = Directions::scattered(&ring).unwrap();
        assert_eq!(directions.neighbours(10), [6, 7, 8, 9, 11, 12, 13, 14]);
        // Where they are dense, all within 5°.
        let dense: Vec<Vec3> =
            (0..400).map(|k| Vec3::new(0.001 * f64::from(k), 0.0, 1.0)).collect();
        let found = Directions::scattered(&dense).unwrap().neighbours(0);
        assert_eq!(found.len(), 87, "atan 0.0874 = 5°");
        assert_eq!(found[..3], [1, 2, 3]);
    }

    #[test]
    fn a_lone_direction_has_no_neighbours() {
        let directions = Directions::scattered(&[Vec3::z()]).unwrap();
        assert!(directions.neighbours(0).is_empty());
        assert_eq!(Directions::scattered(&[]).unwrap().count(), 0);
    }
}
