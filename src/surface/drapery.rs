//! A hanging cloth (Fournier 1992 §3, figure 8).

use super::{Mesh, Vertex};
use crate::geometry::Vec3;

/// Cells along the folds and across them: "the geometry is rather coarse (a 11x40 grid)".
const CELLS: [usize; 2] = [11, 40];
/// Half the cloth's width and height, scene units.
const HALF: [f64; 2] = [1.25, 1.0];

/// A cloth that hangs in folds, 2.5 wide and 2 high about the origin, as a coarse mesh: it faces −y, u runs
/// along +x by length along the cloth, v along +z. The paper's own model, Taillefer's, is lost: the folds here
/// are cosines that deepen towards the hem.
pub fn drapery() -> Mesh {
    let [down, across] = CELLS;
    let place = |i: usize, j: usize| {
        let x = HALF[0] * (2.0 * i as f64 / across as f64 - 1.0);
        let z = HALF[1] * (2.0 * j as f64 / down as f64 - 1.0);
        let depth = 0.05 + 0.09 * (1.0 - z);
        let y = depth * libm::cos(8.0 * x + 0.5 * z + 0.9 * libm::sin(1.9 * x));
        Vec3::new(x, y, z)
    };
    let index = |i: usize, j: usize| (j * (across + 1) + i) as u32;
    let cells = || (0..down).flat_map(move |j| (0..across).map(move |i| (i, j)));
    let triangles: Vec<[u32; 3]> = cells()
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let positions: Vec<Vec3> = (0..=down)
        .flat_map(|j| (0..=across).map(move |i| (i, j)))
        .map(|(i, j)| place(i, j))
        .collect();
    let lengths = lengths(&positions[(down / 2) * (across + 1)..][..=across]);
    let normals = smooth_normals(&positions, &triangles);
    let vertex = |(k, (position, normal)): (usize, (&Vec3, &Vec3))| Vertex {
        position: *position,
        normal: *normal,
        uv: [lengths[k % (across + 1)], position.z + HALF[1]],
    };
    let vertices: Vec<Vertex> = positions.iter().zip(&normals).enumerate().map(vertex).collect();
    Mesh::new(vertices, &triangles)
}

/// Length along a line of points up to each of them.
fn lengths(line: &[Vec3]) -> Vec<f64> {
    let mut length = 0.0;
    let step = |pair: &[Vec3]| {
        length += (pair[1] - pair[0]).norm();
        length
    };
    std::iter::once(0.0).chain(line.windows(2).map(step)).collect()
}

/// The mean normal of the triangles around each point, by area.
fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut sums = vec![Vec3::zeros(); positions.len()];
    for [a, b, c] in triangles.iter().map(|corners| corners.map(|corner| corner as usize)) {
        let cross = (positions[b] - positions[a]).cross(&(positions[c] - positions[a]));
        [a, b, c].into_iter().for_each(|corner| sums[corner] += cross);
    }
    sums.into_iter().map(|sum| sum.try_normalize(0.0).unwrap_or(-Vec3::y())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Surface;

    #[test]
    fn it_is_a_coarse_grid_that_faces_the_eye() {
        let cloth = drapery();
        assert_eq!(cloth.triangles(), 2 * 11 * 40);
        for i in 0..40 {
            for j in 0..40 {
                let (x, z) = (f64::from(i) / 20.0 - 0.975, f64::from(j) / 22.0 - 0.885);
                let origin = Vec3::new(x, -5.0, z);
                let hit = cloth.intersect(origin, Vec3::y()).expect("the cloth has no holes");
                let frame = hit.frame;
                assert!(frame.normal.y < 0.0 && hit.plane.y < 0.0);
                assert!((frame.tangent.cross(&frame.bitangent) - frame.normal).norm() < 1e-12);
                assert!(frame.tangent.x > 0.0 && frame.bitangent.z > 0.0);
                // A unit of u is a unit of length half way down; folds are shallower above, deeper below, and
                // steeper in their flanks: nowhere more than twice.
                let scale = hit.gradient[0].norm();
                assert!((0.5..2.0).contains(&scale), "{scale} at {x} {z}");
            }
        }
    }
}
