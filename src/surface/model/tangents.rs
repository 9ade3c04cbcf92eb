//! Tangents of triangles' corners: the file's, or MikkTSpace's.

use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};

use super::{Corner, Point};
use crate::geometry::Vec3;

/// The same bits on every machine.
struct Portable;

impl Ops for Portable {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        libm::acos(f64::from(x)) as f32
    }
}

/// What MikkTSpace asks for, and where it puts what it finds.
struct Asked<'a> {
    positions: &'a [Vec3],
    normals: &'a [Vec3],
    points: &'a [Point],
    triangles: &'a [[u32; 3]],
    found: Vec<[Corner; 3]>,
}

/// The tangent of each corner of each triangle: the file's where all three have one, else as MikkTSpace has it (Mikkelsen
/// 2008, *Simulation of Wrinkled Surfaces Revisited*).
pub(super) fn corners(
    positions: &[Vec3],
    normals: &[Vec3],
    points: &[Point],
    triangles: &[[u32; 3]],
) -> Vec<[Corner; 3]> {
    let given = |corner: u32| {
        let [x, y, z, sign] = points[corner as usize].tangent?;
        let tangent = Vec3::from([x, y, z].map(f64::from)).try_normalize(1e-30)?;
        Some(Corner {
            tangent: [tangent.x, tangent.y, tangent.z].map(|c| c as f32),
            mirrored: sign < 0.0,
        })
    };
    let given = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(given);
        Some([a?, b?, c?])
    };
    let of_file: Vec<Option<[Corner; 3]>> = triangles.iter().map(given).collect();
    if of_file.iter().all(Option::is_some) {
        return of_file.into_iter().flatten().collect();
    }
    let found = vec![[Corner::default(); 3]; triangles.len()];
    let mut asked = Asked { positions, normals, points, triangles, found };
    match generate_tangents::<_, Portable>(&mut asked) {
        Ok(()) => {}
        // There is no way for it to fail yet; if there comes one, frames follow u alone.
        Err(_) => asked.found.fill([Corner::default(); 3]),
    }
    let pair = of_file.into_iter().zip(asked.found);
    pair.map(|(of_file, found)| of_file.unwrap_or(found)).collect()
}

impl Asked<'_> {
    fn index(&self, face: usize, vertex: usize) -> usize {
        self.triangles[face][vertex] as usize
    }
}

impl Geometry<Portable> for Asked<'_> {
    fn num_faces(&self) -> usize {
        self.triangles.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vertex: usize) -> [f32; 3] {
        let p = self.positions[self.index(face, vertex)];
        [p.x, p.y, p.z].map(|c| c as f32)
    }

    fn normal(&self, face: usize, vertex: usize) -> [f32; 3] {
        let n = self.normals[self.index(face, vertex)];
        [n.x, n.y, n.z].map(|c| c as f32)
    }

    fn tex_coord(&self, face: usize, vertex: usize) -> [f32; 2] {
        self.points[self.index(face, vertex)].uv
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, vertex: usize) {
        self.found[face][vertex] = space.map_or(Corner::default(), |space| Corner {
            tangent: space.tangent(),
            mirrored: !space.is_orientation_preserving(),
        });
    }
}
