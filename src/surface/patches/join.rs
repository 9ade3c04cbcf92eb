//! Which patches meet at which edges.

use super::Charted;
use crate::geometry::Vec3;

/// What lies over the edges of a patch: those where u is 0, u is 1, v is 0 and v is 1.
pub(super) type Joined = [Option<Beyond>; 4];

/// The edge of another patch, or of the same, that is the same curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Beyond {
    pub patch: usize,
    /// Which edge of that patch: twice the axis across it, plus 1 at the axis' end.
    pub edge: usize,
    /// Whether it runs the other way.
    pub reversed: bool,
}

impl Beyond {
    /// (u, v) there of a point that is `past` the edge, at `along` on it.
    pub(super) fn enter(&self, past: f64, along: f64) -> [f64; 2] {
        let along = if self.reversed { 1.0 - along } else { along };
        let across = if self.edge % 2 == 1 { 1.0 - past } else { past };
        if self.edge / 2 == 0 { [across, along] } else { [along, across] }
    }
}

/// Finds for each edge of each patch another whose four control points are the same. An edge that is a single
/// point has none: nothing can be crossed there.
pub(super) fn join(patches: &[Charted]) -> Vec<Joined> {
    let edges: Vec<(usize, usize, [Vec3; 4])> = patches
        .iter()
        .enumerate()
        .flat_map(|(patch, charted)| {
            let edges = edges(charted.patch.points());
            edges.into_iter().enumerate().map(move |(edge, line)| (patch, edge, line))
        })
        .filter(|(.., line)| line.iter().any(|point| point != &line[0]))
        .collect();
    let mut joined: Vec<Joined> = vec![[None; 4]; patches.len()];
    for (k, (patch, edge, line)) in edges.iter().enumerate() {
        let found =
            edges.iter().enumerate().filter(|(other, _)| *other != k).find_map(|(_, other)| {
                let back = [other.2[3], other.2[2], other.2[1], other.2[0]];
                let beyond = |reversed| Beyond { patch: other.0, edge: other.1, reversed };
                if same(line, &other.2) {
                    Some(beyond(false))
                } else {
                    same(line, &back).then(|| beyond(true))
                }
            });
        joined[*patch][*edge] = found;
    }
    joined
}

fn edges(points: &[[Vec3; 4]; 4]) -> [[Vec3; 4]; 4] {
    [points[0], points[3], points.map(|line| line[0]), points.map(|line| line[3])]
}

/// Whether two curves are the same to rounding.
fn same(a: &[Vec3; 4], b: &[Vec3; 4]) -> bool {
    let size = a.iter().fold(0.0f64, |size, point| size.max(point.amax()));
    a.iter().zip(b).all(|(a, b)| (a - b).amax() <= 1e-12 * size)
}
