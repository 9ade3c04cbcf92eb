//! The teapot (Newell 1975; its control points as published in Crow 1987, *The Origins of the Teapot*).

use super::shapes::length_of;
use super::{Chart, Charted, Patches};
use crate::geometry::Vec3;
use crate::surface::{Bezier, Mesh};

/// Scene units of one unit of the published points.
const SCALE: f64 = 0.3;
/// Half its height, units of the published points: it stands about the origin.
const MIDDLE: f64 = 1.575;

/// The teapot of 32 bicubic patches, upright about the origin, of 0.3 scene units a unit of its published control
/// points: 0.945 high and 1.2 across its body, its handle at −x and its spout at +x. Only its outside is seen.
///
/// Its body with bottom and rim, its lid, handle and spout each have texture coordinates of their own. u runs
/// around, eastwards on what stands upright, whole tiles around the widest; v runs up the body and the lid by
/// length, and along the handle and spout away from the body.
pub fn teapot() -> Patches {
    Patches::new(patches(), false)
}

/// The teapot as a mesh, `cells` cells along each side of each patch: 64 `cells`² triangles but for those that are
/// nothing at the poles; 16 cells make about 16,000, as many as Kautz et al. 2001, figure 5, tells of (17,000).
pub fn teapot_mesh(cells: usize) -> Mesh {
    teapot().mesh(cells)
}

/// A part of the teapot with texture coordinates of its own.
struct Part {
    /// Rows of control points from end to end of v, each from the first to the last of u. Patches share a row.
    patches: &'static [[[Published; 4]; 4]],
    /// What closes a patch of them to a ring along u.
    closed: Closed,
}

/// x, y and z of a published control point.
type Published = [f64; 3];

/// How copies of patches make a ring.
#[derive(Clone, Copy, PartialEq)]
enum Closed {
    /// Four quarters about z.
    Quarters,
    /// Two halves, mirrored in y = 0.
    Halves,
}

fn patches() -> Vec<Charted> {
    let parts = [
        Part { patches: &points::BODY, closed: Closed::Quarters },
        Part { patches: &points::LID, closed: Closed::Quarters },
        Part { patches: &points::HANDLE, closed: Closed::Halves },
        Part { patches: &points::SPOUT, closed: Closed::Halves },
    ];
    parts.iter().flat_map(Part::charted).collect()
}

impl Part {
    fn charted(&self) -> Vec<Charted> {
        let base: Vec<Bezier> = self.patches.iter().map(of_rows).collect();
        let widest = |patch: &Bezier| {
            (0..=4).fold(0.0f64, |most, k| most.max(length_of(patch, 0, 0.25 * f64::from(k))))
        };
        let width = base.iter().map(widest).fold(0.0, f64::max);
        let copies = if self.closed == Closed::Quarters { 4 } else { 2 };
        let mut start = 0.0;
        let mut all = Vec::new();
        for patch in &base {
            let along = 0.5 * (length_of(patch, 1, 0.0) + length_of(patch, 1, 1.0));
            for copy in 0..copies {
                let origin = [width * f64::from(copy), start];
                let around = Some(width * f64::from(copies));
                let chart = Chart { origin, extent: [width, along], around };
                let patch = self.closed.copy(patch, copy).placed(-Vec3::z() * MIDDLE, SCALE);
                all.push(Charted { patch, chart: chart.scaled(SCALE) });
            }
            start += along;
        }
        all
    }
}

impl Closed {
    /// The patch once more, further round by u.
    fn copy(self, patch: &Bezier, copy: i32) -> Bezier {
        let turned = |p: &Vec3| match (self, copy) {
            (_, 0) => *p,
            (Self::Quarters, 1) => Vec3::new(-p.y, p.x, p.z),
            (Self::Quarters, 2) => Vec3::new(-p.x, -p.y, p.z),
            (Self::Quarters, _) => Vec3::new(p.y, -p.x, p.z),
            (Self::Halves, _) => Vec3::new(p.x, -p.y, p.z),
        };
        let mut points = patch.points().map(|line| line.map(|p| turned(&p)));
        // A mirror turns the patch inside out; going round the other way turns it back.
        if self == Self::Halves && copy == 1 {
            points.reverse();
        }
        Bezier::new(points)
    }
}

impl Chart {
    fn scaled(self, scale: f64) -> Self {
        Self {
            origin: self.origin.map(|c| c * scale),
            extent: self.extent.map(|c| c * scale),
            around: self.around.map(|c| c * scale),
        }
    }
}

/// The patch whose points are given row by row along v.
fn of_rows(rows: &[[Published; 4]; 4]) -> Bezier {
    Bezier::new([0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| Vec3::from(rows[j][i]))))
}

mod points;

#[cfg(test)]
mod tests;
