//! Surfaces made of Bézier patches.

mod join;
mod newton;
mod shapes;
mod teapot;

pub use shapes::{bent_patch, ribbon};
pub use teapot::{teapot, teapot_mesh};

use std::sync::Arc;

use join::{Joined, join};

use super::facets::{Facets, Meeting};
use super::{Bezier, Hit, Mesh, Surface, Vertex};
use crate::geometry::{Frame, Vec3};

/// A patch and how texture coordinates run on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charted {
    /// The patch.
    pub patch: Bezier,
    /// Its chart.
    pub chart: Chart,
}

/// Where a patch lies among texture coordinates, in lengths: (u, v) of the patch are at `origin` +
/// (u, v) · `extent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chart {
    /// Where (0, 0) of the patch is, scene units.
    pub origin: [f64; 2],
    /// How long the patch counts along u and v, scene units.
    pub extent: [f64; 2],
    /// If patches close to a ring along u: how long it counts, scene units. As many tiles lie around it as
    /// come nearest to what is asked, at least one, so that the seam closes.
    pub around: Option<f64>,
}

/// Bézier patches before a ray: the point, normal, ∇u and ∇v of a hit are the patch's own.
///
/// A ray first meets a fine mesh of the patches in a hierarchy of boxes; from there Newton's method finds the
/// point of the true patch, over the edges where patches meet. Where there is none (at a silhouette, where the
/// mesh and the patch part by less than the chord of a cell) the point on the mesh is taken, with the tangent plane
/// that the patch has at its u and v.
///
/// Texture coordinates run as the patches' charts say, as on a surface unrolled.
#[derive(Clone, Debug)]
pub struct Patches {
    shared: Arc<Shared>,
    tiles: [f64; 2],
}

/// What all tilings share.
#[derive(Debug)]
struct Shared {
    patches: Vec<Charted>,
    joined: Vec<Joined>,
    /// Whether back sides are seen, too.
    both_sides: bool,
    mesh: Facets,
    /// Which triangle of [`Cells`] each facet is.
    triangles: Vec<u32>,
}

impl PartialEq for Patches {
    /// Whether they are tilings alike of the same patches in memory.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared) && self.tiles == other.tiles
    }
}

/// Cells of the mesh along a side of a patch.
const CELLS: usize = 16;

/// A patch divided into cells, two triangles each.
#[derive(Clone, Copy, Debug)]
struct Cells(usize);

impl Cells {
    /// Triangles of a patch.
    fn triangles(self) -> usize {
        2 * self.0 * self.0
    }

    /// The patch that a triangle is of, and (u, v) of its corners.
    fn corners(self, triangle: usize) -> (usize, [[f64; 2]; 3]) {
        let (patch, rest) = (triangle / self.triangles(), triangle % self.triangles());
        let (cell, second) = (rest / 2, rest % 2 == 1);
        let (i, j) = (cell % self.0, cell / self.0);
        let corner = |i: usize, j: usize| [i, j].map(|k| k as f64 / self.0 as f64);
        let (a, c) = (corner(i, j), corner(i + 1, j + 1));
        (patch, if second { [a, c, corner(i, j + 1)] } else { [a, corner(i + 1, j), c] })
    }
}

impl Patches {
    /// The surface of `patches`, of which back sides are seen if `both_sides`; else they hide what is behind them
    /// and send no light. Seen from behind, frames are turned about: bumps are dents (Blinn 1978: "this
    /// correspondence will be reversed if the base patch is rotated to view the back side").
    pub fn new(patches: Vec<Charted>, both_sides: bool) -> Self {
        let cells = Cells(CELLS);
        let (mesh, triangles) = Facets::new(patches.len() * cells.triangles(), |triangle| {
            let (patch, corners) = cells.corners(triangle);
            Some(corners.map(|[u, v]| patches[patch].patch.at(u, v).point))
        });
        let joined = join(&patches);
        let shared = Arc::new(Shared { patches, joined, both_sides, mesh, triangles });
        Self { shared, tiles: [1.0; 2] }
    }

    /// The patches.
    pub fn patches(&self) -> &[Charted] {
        &self.shared.patches
    }

    /// A mesh of the patches, `cells` cells along each side of each, two triangles a cell, without those that
    /// are nothing, at the poles; normals at its corners are the patches'. Texture coordinates run as here, in
    /// tiles of a scene unit.
    pub fn mesh(&self, cells: usize) -> Mesh {
        let side = cells.max(1);
        let mut vertices = Vec::new();
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for Charted { patch, chart } in &self.shared.patches {
            let first = vertices.len();
            let index = |i: usize, j: usize| (first + j * (side + 1) + i) as u32;
            for (i, j) in (0..=side).flat_map(|j| (0..=side).map(move |i| (i, j))) {
                let [u, v] = [i, j].map(|k| k as f64 / side as f64);
                let (position, normal) = (patch.at(u, v).point, patch.tangents(u, v).normal);
                let uv = chart.uv([u, v], [1.0; 2]);
                vertices.push(Vertex { position, normal, uv });
                if i < side && j < side {
                    let [a, b, c, d] =
                        [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        Mesh::new(vertices, &triangles)
    }

    fn hit(&self, origin: Vec3, direction: Vec3, met: &Meeting) -> (Hit, bool) {
        let Shared { patches, joined, both_sides, mesh, triangles } = &*self.shared;
        let (patch, corners) = Cells(CELLS).corners(triangles[met.facet] as usize);
        let at = [0, 1].map(|axis| met.blend(corners.map(|c| c[axis])).clamp(0.0, 1.0));
        let front = direction.dot(&mesh.facet(met.facet).normal) < 0.0;
        let guess = newton::Place { patch, at };
        let found =
            newton::solve(patches, joined, origin, direction, guess, met.t).filter(|found| {
                // The other side of a silhouette is not what the ray came upon.
                let normal = patches[found.place.patch]
                    .patch
                    .tangents(found.place.at[0], found.place.at[1])
                    .normal;
                (direction.dot(&normal) < 0.0) == front
            });
        let (place, t, point) = match found {
            Some(found) => (found.place, found.t, found.point),
            None => (guess, met.t, origin + direction * met.t),
        };
        let Charted { patch, chart } = &patches[place.patch];
        let tangents = patch.tangents(place.at[0], place.at[1]);
        let counted = chart.counted(self.tiles);
        let gradient = [0, 1].map(|k| tangents.gradient[k] * (chart.extent[k] * counted[k]));
        let frame = Frame::new(tangents.normal, gradient[0]);
        let turned = if front { 1.0 } else { -1.0 };
        let frame = Frame {
            tangent: frame.tangent * turned,
            bitangent: frame.bitangent * turned,
            normal: frame.normal * turned,
        };
        let hit = Hit {
            t,
            point,
            frame,
            plane: frame.normal,
            uv: chart.uv(place.at, self.tiles),
            gradient,
        };
        (hit, front || *both_sides)
    }
}

impl Chart {
    /// Tiles a scene unit along u and v, where `tiles` are asked for.
    fn counted(&self, [across, along]: [f64; 2]) -> [f64; 2] {
        let whole = |around: f64| (across * around).round().max(1.0) / around;
        [self.around.map_or(across, whole), along]
    }

    /// Texture coordinates of (u, v) of the patch, where `tiles` tiles a scene unit are asked for.
    fn uv(&self, at: [f64; 2], tiles: [f64; 2]) -> [f64; 2] {
        let counted = self.counted(tiles);
        [0, 1].map(|k| (self.origin[k] + at[k] * self.extent[k]) * counted[k])
    }
}

impl Surface for Patches {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        match self.shared.mesh.first(origin, direction) {
            Some(met) => self.hit(origin, direction, &met),
            None => (Hit::nowhere(), false),
        }
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        Self { shared: Arc::clone(&self.shared), tiles: [tiles, tiles / aspect] }
    }

    /// Those of the first patch.
    fn tiles_across(&self) -> f64 {
        self.shared
            .patches
            .first()
            .map_or(self.tiles[0], |first| first.chart.counted(self.tiles)[0])
    }
}
