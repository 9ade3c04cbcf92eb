//! Rays over a height map: what they meet first, and whether they leave it (the ground truth of masking
//! and self-shadowing).

use std::sync::Arc;

use super::HeightMap;
use crate::geometry::elementary::floor64;

/// A height map as a surface for rays: bilinear between entry centres, going on for ever as the map
/// wraps. Lengths are sides of a texel, along x and y as along z; entry (i, j) stands at x = i + ½,
/// y = j + ½.
///
/// # How a ray goes
/// From cell to cell of the grid of entry centres (Amanatides and Woo 1987). Over a cell the height along
/// a ray is a quadratic, so that what it meets there is found exactly, without steps. A ray ends at the
/// greatest or least height, and in any case after 16 times the sides of the map: flatter rays than that
/// reach no further.
#[derive(Clone, Debug)]
pub struct Relief {
    heights: Arc<HeightMap>,
    range: [f64; 2],
    /// The most cells a ray goes through, and the longest way along x or y.
    reach: f64,
}

/// A ray: where it begins and where it goes, z out of the surface; any length.
#[derive(Clone, Copy, Debug)]
struct Ray {
    start: [f64; 3],
    direction: [f64; 3],
}

/// A ray above one cell: how high it is above the surface, from where it enters.
struct Passage {
    /// Where it enters and leaves, in lengths of the ray's direction.
    from: f64,
    to: f64,
    /// Height above the surface at `from` + s: g₀ + g₁ s + g₂ s².
    above: [f64; 3],
}

impl Relief {
    /// The surface of a height map.
    pub fn new(heights: Arc<HeightMap>) -> Self {
        let range = heights.range();
        let reach = 16.0 * (heights.width() + heights.height()) as f64;
        Self { heights, range, reach }
    }

    /// The height at (x, y).
    pub fn height(&self, x: f64, y: f64) -> f64 {
        let (cell, [right, up]) = cell_of(x, y);
        let [low, across, along, twist] = self.cell(cell);
        low + across * right + along * up + twist * right * up
    }

    /// Whether something upward from the surface at (x, y) can be seen: whether the ray in `direction`
    /// (any length; below the horizon nothing can) meets the surface nowhere.
    pub fn sees(&self, [x, y]: [f64; 2], direction: [f64; 3]) -> bool {
        let start = self.height(x, y);
        if direction[2] < 0.0 {
            return false;
        }
        let mut clear = true;
        let ray = Ray { start: [x, y, start], direction };
        self.walk(&ray, |passage, z| {
            let [g0, g1, g2] = passage.above;
            // It starts on the surface: g₀ is 0 there, whatever rounding says.
            let g0 = if passage.from == 0.0 { 0.0 } else { g0 };
            clear = lowest(g0, g1, g2, passage.to - passage.from) >= 0.0;
            clear && z < self.range[1]
        });
        clear
    }

    /// Where on the surface the ray to an eye in direction `to_eye` (any length, z > 0) begins that
    /// passes over (x, y) at height 0: what the eye sees there, where a surface without bumps would show
    /// (x, y). It may lie outside the map.
    pub fn seen_at(&self, [x, y]: [f64; 2], to_eye: [f64; 3]) -> [f64; 2] {
        let [dx, dy, dz] = to_eye;
        let along = dx.abs().max(dy.abs());
        if !(dz > 0.0 && along > 0.0) {
            return [x, y];
        }
        // In from the greatest height, or from as far as rays reach.
        let back = (self.range[1] / dz).min(self.reach / along);
        let start = [x + back * dx, y + back * dy, back * dz];
        let ray = Ray { start, direction: [-dx, -dy, -dz] };
        let mut hit = 0.0;
        self.walk(&ray, |passage, z| {
            let found = first_zero(passage.above, passage.to - passage.from);
            hit = found.map_or(passage.to, |s| passage.from + s);
            found.is_none() && z > self.range[0]
        });
        [start[0] - hit * dx, start[1] - hit * dy]
    }

    /// Calls `step` with each passage of a ray and its height at the end of it, until it says false.
    fn walk(&self, ray: &Ray, mut step: impl FnMut(&Passage, f64) -> bool) {
        let [x, y, z] = ray.start;
        let [dx, dy, dz] = ray.direction;
        let ([mut i, mut j], _) = cell_of(x, y);
        let (mut from, cells) = (0.0, 2.0 * self.reach);
        let mut left = if x.is_finite() && y.is_finite() { cells } else { 0.0 };
        while left > 0.0 {
            // Where it crosses the next line between cells.
            let cross = |start: f64, d: f64, cell: i64| match d {
                d if d > 0.0 => ((cell + 1) as f64 + 0.5 - start) / d,
                d if d < 0.0 => (cell as f64 + 0.5 - start) / d,
                _ => f64::INFINITY,
            };
            let (next_x, next_y) = (cross(x, dx, i), cross(y, dy, j));
            let to = next_x.min(next_y).max(from);
            if !to.is_finite() {
                return; // straight up or down: it stays in this cell
            }
            let right = (x + from * dx - i as f64 - 0.5).clamp(0.0, 1.0);
            let up = (y + from * dy - j as f64 - 0.5).clamp(0.0, 1.0);
            let [low, across, along, twist] = self.cell([i, j]);
            let above = [
                z + from * dz - (low + across * right + along * up + twist * right * up),
                dz - (across * dx + along * dy + twist * (right * dy + up * dx)),
                -twist * dx * dy,
            ];
            if !step(&Passage { from, to, above }, z + to * dz) {
                return;
            }
            if next_x <= next_y {
                i += if dx > 0.0 { 1 } else { -1 };
            }
            if next_y <= next_x {
                j += if dy > 0.0 { 1 } else { -1 };
            }
            (from, left) = (to, left - 1.0);
        }
    }

    /// The surface of a cell: [F, its rise along x, its rise along y, its twist] at its lowest corner.
    fn cell(&self, [i, j]: [i64; 2]) -> [f64; 4] {
        let (i, j) = (i as isize, j as isize);
        let at = |x: isize, y: isize| self.heights.at(i + x, j + y);
        let (low, right, up) = (at(0, 0), at(1, 0), at(0, 1));
        [low, right - low, up - low, at(1, 1) - right - up + low]
    }
}

/// The cell between entry centres that holds (x, y), and the place in it, from 0 to 1.
fn cell_of(x: f64, y: f64) -> ([i64; 2], [f64; 2]) {
    let [i, j] = [x, y].map(|c| floor64(c - 0.5));
    ([i as i64, j as i64], [x - 0.5 - i, y - 0.5 - j])
}

/// The least of g₀ + g₁ s + g₂ s² for s from 0 to `end`.
fn lowest(g0: f64, g1: f64, g2: f64, end: f64) -> f64 {
    let at = |s: f64| g0 + s * (g1 + s * g2);
    let bottom = if g2 > 0.0 { (-0.5 * g1 / g2).clamp(0.0, end) } else { 0.0 };
    at(bottom).min(at(end)).min(g0)
}

/// The first s from 0 to `end` at which g₀ + g₁ s + g₂ s² is 0 or below.
fn first_zero([g0, g1, g2]: [f64; 3], end: f64) -> Option<f64> {
    if g0 <= 0.0 {
        return Some(0.0);
    }
    // Both roots without cancellation: q / g₂ and g₀ / q.
    let square = g1 * g1 - 4.0 * g2 * g0;
    if square < 0.0 {
        return None;
    }
    let q = -0.5 * (g1 + square.sqrt().copysign(g1));
    let inside = |s: &f64| (0.0..=end).contains(s);
    [q / g2, g0 / q].into_iter().filter(inside).reduce(f64::min)
}

#[cfg(test)]
mod tests;
