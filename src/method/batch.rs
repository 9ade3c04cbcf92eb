//! Many shading points at once, in structure-of-arrays form.

use crate::lobe::vector::V3;
use crate::texture::{Bend, Footprint, Lookup};

/// Lanes in a batch: a few kilobytes an axis, so that a batch stays in the first-level cache.
pub const BATCH: usize = 128;

/// One number a lane.
pub type Lane = [f32; BATCH];

/// Up to [`BATCH`] shading points of one surface, one light, one map.
///
/// Directions are in the surface's tangent space. Lanes past `len` hold finite numbers of no meaning,
/// so that loops can run over the whole width.
#[derive(Clone, Debug)]
pub struct Batch {
    /// How many lanes are real.
    pub len: usize,
    /// Folded texture coordinate across the map (see [`crate::texture::Wrap::fold`]).
    pub u: Lane,
    /// Folded texture coordinate along the map.
    pub v: Lane,
    /// [∂u/∂x, ∂v/∂x, ∂u/∂y, ∂v/∂y] for one sample spacing (see [`Footprint`]); unset where the
    /// method does not need footprints.
    pub jacobian: [Lane; 4],
    /// How what lies under the footprints is averaged.
    pub lookup: Lookup,
    /// What becomes of the map's slopes; None if they are slopes on the surface.
    pub bends: Option<Bends>,
    /// Direction of the half vector; any length.
    pub half: [Lane; 3],
    /// Unit direction to the light; unset for [`crate::lobe::Shading::Ndf`] where the method does not
    /// need directions.
    pub light: [Lane; 3],
    /// Unit direction to the eye; set as `light` is.
    pub view: [Lane; 3],
    /// Irradiance on a plane facing the light; 0 where the ray misses or the light is below the
    /// horizon of the surface.
    pub irradiance: Lane,
}

/// [`Bend`]s of a batch's points.
#[derive(Clone, Debug)]
pub struct Bends {
    /// Their matrices, row by row.
    pub matrix: [Lane; 4],
    /// Whether they keep angles, all of them or none.
    pub keeps_angle: bool,
}

impl Bends {
    /// That of lane `i`.
    #[inline(always)]
    pub fn at(&self, i: usize) -> Bend {
        let [a, b, c, d] = &self.matrix;
        Bend { matrix: [a[i], b[i], c[i], d[i]], keeps_angle: self.keeps_angle }
    }

    /// Turns the normals of all lanes, given coordinate by coordinate.
    pub fn turn(&self, [x, y, z]: [&mut Lane; 3]) {
        for i in 0..BATCH {
            [x[i], y[i], z[i]] = self.at(i).turn([x[i], y[i], z[i]]);
        }
    }
}

impl Default for Batch {
    fn default() -> Self {
        let up = [[0.0; BATCH], [0.0; BATCH], [1.0; BATCH]];
        Self {
            len: 0,
            u: [0.0; BATCH],
            v: [0.0; BATCH],
            jacobian: [[0.0; BATCH]; 4],
            lookup: Lookup::default(),
            bends: None,
            half: up,
            light: up,
            view: up,
            irradiance: [0.0; BATCH],
        }
    }
}

impl Batch {
    /// The footprint of lane `i`.
    #[inline(always)]
    pub fn footprint(&self, i: usize) -> Footprint {
        let [ux, vx, uy, vy] = &self.jacobian;
        let (along_x, along_y) = ([ux[i], vx[i]], [uy[i], vy[i]]);
        let bend = self.bend(i);
        Footprint { u: self.u[i], v: self.v[i], along_x, along_y, lookup: self.lookup, bend }
    }

    /// What becomes of the map's slopes at lane `i`.
    #[inline(always)]
    pub fn bend(&self, i: usize) -> Bend {
        self.bends.as_ref().map_or_else(Bend::default, |bends| bends.at(i))
    }

    /// Direction of lane `i`'s half vector.
    #[inline(always)]
    pub fn half(&self, i: usize) -> V3 {
        [self.half[0][i], self.half[1][i], self.half[2][i]]
    }

    /// Unit direction from lane `i` to the light.
    #[inline(always)]
    pub fn light(&self, i: usize) -> V3 {
        [self.light[0][i], self.light[1][i], self.light[2][i]]
    }

    /// Unit direction from lane `i` to the eye.
    #[inline(always)]
    pub fn view(&self, i: usize) -> V3 {
        [self.view[0][i], self.view[1][i], self.view[2][i]]
    }
}
