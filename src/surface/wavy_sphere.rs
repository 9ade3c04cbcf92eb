//! The wavy sphere (Olano and North 1997, figures 1 and 2).

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Hit, Mesh, Surface, Vertex};
use crate::geometry::{Ripples, Vec3, spherical_frame};

/// What normals of a map on a [`WavySphere`] stand on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WavyFrame {
    /// The normals of the vertices, interpolated (Phong shading): as on any mesh.
    Vertex,
    /// The sphere without ripples, at the texture coordinate. The map has to hold the ripples, which it does
    /// at its own resolution and not at the mesh's: the pattern `wavy-sphere`.
    Sphere,
}

/// A rippled sphere about the origin as a triangle mesh: its vertices are on the smooth surface, on circles
/// of longitude and latitude, their normals the smooth surface's.
///
/// u and v run as on [`super::Sphere`]. Between vertices they are linear, and so are footprints; near a pole,
/// where triangles are all that is left of cells, u is that of the middle of the cell.
#[derive(Clone, Debug, PartialEq)]
pub struct WavySphere {
    mesh: Mesh,
    frame: WavyFrame,
    /// Tiles round the equator, whole.
    around: f64,
}

impl WavySphere {
    /// The mesh with `cells` cells from pole to pole (at least 2) and twice as many round the equator, of 2 × 1
    /// tiles; of 1 × 1 tile for [`WavyFrame::Sphere`].
    pub fn new(ripples: Ripples, cells: usize, frame: WavyFrame) -> Self {
        let (down, across) = (cells.max(2), 2 * cells.max(2));
        let vertices: Vec<Vertex> = (0..=down)
            .flat_map(|j| (0..=across).map(move |i| (i, j)))
            .map(|(i, j)| vertex(ripples, [i, j], [across, down]))
            .collect();
        let index = |i: usize, j: usize| (j * (across + 1) + i) as u32;
        let triangles: Vec<[u32; 3]> = (0..down)
            .flat_map(|j| (0..across).map(move |i| (i, j)))
            .flat_map(|(i, j)| {
                let [a, b, c, d] =
                    [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
                // At a pole one of the two has no area, and the mesh leaves it out.
                if j == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
            })
            .collect();
        Self { mesh: Mesh::new(vertices, &triangles), frame, around: 1.0 }.tiled(2.0 / TAU, 1.0)
    }

    /// Triangles of its mesh.
    pub fn triangles(&self) -> usize {
        self.mesh.triangles()
    }
}

/// Corner (i, j) of a grid of [across, down] cells, j from the south pole. Its v is halved, so that a unit of
/// either coordinate is one turn.
fn vertex(ripples: Ripples, [i, j]: [usize; 2], [across, down]: [usize; 2]) -> Vertex {
    let pole = j == 0 || j == down;
    // The seam's two sides are one line, a pole one point.
    let longitude = if pole { 0.0 } else { TAU * (i % across) as f64 / across as f64 };
    let latitude = PI * j as f64 / down as f64 - FRAC_PI_2;
    let out = match j {
        0 => -Vec3::z(),
        _ if pole => Vec3::z(),
        _ => spherical_frame(longitude, latitude).normal,
    };
    // A pole's corner is that of the one triangle that meets it in this cell.
    let shift = if pole { 0.5 } else { 0.0 };
    Vertex {
        position: out * ripples.radius(out),
        normal: ripples.normal(out),
        uv: [(i as f64 + shift) / across as f64, 0.5 * j as f64 / down as f64],
    }
}

impl Surface for WavySphere {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        let (mut hit, hits) = self.mesh.trace(origin, direction);
        if self.frame == WavyFrame::Sphere {
            let [u, v] = hit.uv;
            hit.frame = spherical_frame(TAU * u, PI * v - FRAC_PI_2);
        }
        (hit, hits)
    }

    /// As a sphere is tiled. What holds the ripples themselves ([`WavyFrame::Sphere`]) lies on it once,
    /// whatever is asked.
    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        let (around, aspect) = match self.frame {
            WavyFrame::Vertex => ((tiles * TAU).round().max(1.0), aspect),
            WavyFrame::Sphere => (1.0, 0.5),
        };
        Self { mesh: self.mesh.tiled(around, aspect), frame: self.frame, around }
    }

    fn tiles_across(&self) -> f64 {
        self.around / TAU
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Sphere;

    const RIPPLES: Ripples = Ripples { count: 8, amplitude: 0.05 };

    /// Rays from all around at the sphere and past it, some along the axes and at poles and seams.
    fn rays() -> impl Iterator<Item = (Vec3, Vec3)> {
        let spiral = (0..600).map(|i| {
            let t = f64::from(i);
            let from = spherical_frame(2.4 * t, (t / 300.0 - 1.0).asin()).normal * 3.0;
            (from, Vec3::new((0.7 * t).sin(), (1.3 * t).cos(), (0.9 * t).sin()) * 0.8 - from)
        });
        let axes = [Vec3::x(), Vec3::y(), Vec3::z(), -Vec3::x(), -Vec3::y(), -Vec3::z()];
        spiral.chain(axes.map(|axis| (axis * 3.0, -axis)))
    }

    #[test]
    fn numbers_are_finite_at_poles_seams_and_silhouettes() {
        for frame in [WavyFrame::Vertex, WavyFrame::Sphere] {
            let sphere = WavySphere::new(RIPPLES, 5, frame).tiled(0.6, 0.5);
            let mut seen = 0;
            for (origin, direction) in rays() {
                let (hit, hits) = sphere.trace(origin, direction);
                seen += usize::from(hits);
                let vectors = [hit.point, hit.frame.tangent, hit.frame.normal, hit.gradient[0]];
                assert!(vectors.iter().flat_map(|v| v.iter()).all(|x| x.is_finite()));
                assert!(hit.uv.iter().all(|c| c.is_finite()) && hit.gradient[1].norm() < 1e6);
                let frame = hit.frame;
                assert!((frame.tangent.cross(&frame.bitangent) - frame.normal).norm() < 1e-9);
            }
            assert!(seen > 300, "{seen}");
        }
    }

    #[test]
    fn without_ripples_it_is_the_sphere() {
        let flat = Ripples { count: 3, amplitude: 0.0 };
        for frame in [WavyFrame::Vertex, WavyFrame::Sphere] {
            let fine = WavySphere::new(flat, 120, frame).tiled(0.4, 0.5);
            let exact = Sphere::new();
            let exact = exact.tiled(fine.tiles_across(), 0.5);
            for (origin, direction) in rays() {
                let (Some(a), Some(b)) =
                    (fine.intersect(origin, direction), exact.intersect(origin, direction))
                else {
                    continue;
                };
                // A chord of 1.5° is 0.0001 below its arc; slanted rays go further for it.
                if b.frame.normal.dot(&direction.normalize()) < -0.3 && b.point.z.abs() < 0.99 {
                    assert!((a.t - b.t).abs() < 1e-3);
                    assert!((a.frame.normal - b.frame.normal).norm() < 2e-3);
                    // A triangle has one direction of u, and east turns by up to a cell, 1.5°, over it.
                    assert!((a.frame.tangent - b.frame.tangent).norm() < 0.027, "{:?}", b.point);
                    // A triangle's plane is up to half a cell's diagonal, 1.06° or 0.0185, off the sphere's; and
                    // over a cell of 1.5° a parallel's length changes by 0.026 of tan latitude.
                    let within = 0.022 + 0.027 * b.point.z.abs() / b.point.xy().norm();
                    for c in 0..2 {
                        let turn = a.uv[c] - b.uv[c];
                        assert!((turn - turn.round()).abs() < 2e-3, "{:?} {:?}", a.uv, b.uv);
                        let off = (a.gradient[c] - b.gradient[c]).norm();
                        assert!(off < within * b.gradient[c].norm(), "{off} {:?}", b.point);
                    }
                }
            }
        }
    }

    #[test]
    fn cells_are_two_triangles_but_for_the_poles() {
        let sphere = WavySphere::new(RIPPLES, 6, WavyFrame::Vertex);
        assert_eq!(sphere.triangles(), 2 * 12 * 6 - 2 * 12);
    }

    #[test]
    fn a_map_of_the_ripples_lies_on_it_once() {
        let sphere = WavySphere::new(RIPPLES, 40, WavyFrame::Sphere).tiled(5.0, 0.7);
        for (origin, direction) in rays() {
            if let Some(hit) = sphere.intersect(origin, direction) {
                let at = spherical_frame(TAU * hit.uv[0], PI * hit.uv[1] - FRAC_PI_2).normal;
                assert!((at - hit.point.normalize()).norm() < 0.04, "within a cell of 4.5°");
                assert!((hit.frame.normal - at).norm() < 1e-12);
            }
        }
    }
}
