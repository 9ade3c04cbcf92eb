//! Triangle meshes.

use std::sync::Arc;

use super::facets::{Facet, Facets, Meeting};
use super::{Hit, Surface};
use crate::geometry::{Frame, Vec3};

/// A corner of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is, world space.
    pub position: Vec3,
    /// Unit normal of the smooth surface there, world space.
    pub normal: Vec3,
    /// Texture coordinates; one unit is one tile before [`Surface::tiled`].
    pub uv: [f64; 2],
}

/// What a triangle of a model has at a corner beside its vertex: its own tangent, for texture coordinates may break
/// between triangles that share a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Corner {
    /// Direction of growing u, unit length, world space; zero if there is none.
    pub tangent: [f32; 3],
    /// Whether v grows to the other side of it than on a map.
    pub mirrored: bool,
}

/// Triangles with texture coordinates and smooth normals, in a bounding volume hierarchy. Only its front
/// sides, whose corners run counter-clockwise, are seen; back sides hide what is behind them and send no
/// light.
#[derive(Clone, Debug)]
pub struct Mesh {
    shared: Arc<Shared>,
    /// Tiles a unit of u and of v.
    tiles: [f64; 2],
}

/// What all tilings of a mesh share.
#[derive(Debug)]
struct Shared {
    vertices: Vec<Vertex>,
    facets: Facets,
    /// The vertices of each facet.
    corners: Vec<[u32; 3]>,
    /// The tangents of each facet's corners; empty if frames follow ∇u. Then it is a model, which has whole tiles.
    tangents: Vec<[Corner; 3]>,
}

impl PartialEq for Mesh {
    /// Whether they are tilings alike of the same triangles in memory.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared) && self.tiles == other.tiles
    }
}

impl Mesh {
    /// A mesh of triangles, each three indices of vertices. Those without area, or of a vertex there is
    /// not, are left out. One tile a unit of its texture coordinates.
    pub fn new(vertices: Vec<Vertex>, triangles: &[[u32; 3]]) -> Self {
        Self::framed(vertices, triangles, &[])
    }

    /// A mesh whose frames follow the tangents of the triangles' corners, interpolated and held perpendicular to the
    /// normal; the bitangent is n × t, or where texture coordinates are mirrored −n × t, so that it is on the side
    /// of growing v and a bump of the map is a bump there, too. Its tiles are whole and square in texture
    /// coordinates, so that seams close: one unit of either holds as many.
    pub(super) fn framed(
        vertices: Vec<Vertex>,
        triangles: &[[u32; 3]],
        tangents: &[[Corner; 3]],
    ) -> Self {
        let position = |index: u32| vertices.get(index as usize).map(|vertex| vertex.position);
        let (facets, order) = Facets::new(triangles.len(), |k| {
            let [a, b, c] = triangles[k].map(position);
            Some([a?, b?, c?])
        });
        let corners = order.iter().map(|&k| triangles[k as usize]).collect();
        let tangents = match tangents {
            [] => Vec::new(),
            _ => order.iter().map(|&k| tangents[k as usize]).collect(),
        };
        let shared = Arc::new(Shared { vertices, facets, corners, tangents });
        Self { shared, tiles: [1.0; 2] }
    }

    /// Triangles that have area.
    pub fn triangles(&self) -> usize {
        self.shared.facets.len()
    }

    /// Whether a triangle is met from its front, and what is there.
    fn hit(&self, origin: Vec3, direction: Vec3, met: &Meeting) -> (Hit, bool) {
        let facet = self.shared.facets.facet(met.facet);
        let corners =
            self.shared.corners[met.facet].map(|index| &self.shared.vertices[index as usize]);
        let front = direction.dot(&facet.normal) < 0.0;
        let mut hit = hit(origin + direction * met.t, met, facet, corners, self.tiles);
        if let Some(corners) = self.shared.tangents.get(met.facet) {
            hit.frame = framed(hit.frame, met, corners);
        }
        (hit, front)
    }
}

/// The frame with the tangents of the corners, interpolated; as it is where they come to nothing.
fn framed(frame: Frame, met: &Meeting, corners: &[Corner; 3]) -> Frame {
    let tangent = [0, 1, 2].map(|k| met.blend(corners.map(|c| f64::from(c.tangent[k]))));
    let (normal, tangent) = (frame.normal, Vec3::from(tangent));
    let flat = tangent - normal * normal.dot(&tangent);
    let Some(tangent) = flat.try_normalize(1e-6) else { return frame };
    // All three corners agree: where u and v mirror, triangles share no tangents.
    let side = if corners[0].mirrored { -1.0 } else { 1.0 };
    Frame { tangent, bitangent: normal.cross(&tangent) * side, normal }
}

fn hit(point: Vec3, met: &Meeting, facet: &Facet, corners: [&Vertex; 3], tiles: [f64; 2]) -> Hit {
    let smooth = Vec3::from([0, 1, 2].map(|k| met.blend(corners.map(|corner| corner.normal[k]))));
    let normal = smooth.try_normalize(1e-9).unwrap_or(facet.normal);
    let gradient = [0, 1].map(|axis| {
        let [u0, u1, u2] = corners.map(|corner| corner.uv[axis]);
        (facet.growth[0] * (u1 - u0) + facet.growth[1] * (u2 - u0)) * tiles[axis]
    });
    // East is where u grows; where it does not, any tangent will do.
    let east = gradient[0] - normal * gradient[0].dot(&normal);
    let frame = match east.try_normalize(1e-12) {
        Some(tangent) => Frame { tangent, bitangent: normal.cross(&tangent), normal },
        None => Frame::about(normal),
    };
    let uv = [0, 1].map(|axis| met.blend(corners.map(|corner| corner.uv[axis])) * tiles[axis]);
    Hit { t: met.t, point, frame, plane: facet.normal, uv, gradient }
}

impl Surface for Mesh {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        match self.shared.facets.first(origin, direction) {
            Some(met) => self.hit(origin, direction, &met),
            None => (Hit::nowhere(), false),
        }
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        let tiles = if self.shared.tangents.is_empty() {
            [tiles, tiles / aspect]
        } else {
            [tiles.round().max(1.0); 2]
        };
        Self { shared: Arc::clone(&self.shared), tiles }
    }

    fn tiles_across(&self) -> f64 {
        self.tiles[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{Plane, Sphere};
    use proptest::prelude::*;

    /// A square of the plane z = 0, two triangles.
    fn square() -> Mesh {
        let corner = |x: f64, y: f64| Vertex {
            position: Vec3::new(x, y, 0.0),
            normal: Vec3::z(),
            uv: [x, y],
        };
        let vertices = [corner(-2.0, -2.0), corner(2.0, -2.0), corner(2.0, 2.0), corner(-2.0, 2.0)];
        Mesh::new(vertices.to_vec(), &[[0, 1, 2], [0, 2, 3]])
    }

    proptest! {
        #[test]
        fn a_flat_mesh_is_the_plane(x in -1.0f64..1.0, y in -1.0f64..1.0, z in 0.5f64..3.0, aim in -0.5f64..0.5) {
            let (origin, direction) = (Vec3::new(x, y, z), Vec3::new(aim, -aim, -1.0));
            let mesh = square().tiled(3.0, 0.5).intersect(origin, direction);
            let plane = Plane::new().tiled(3.0, 0.5).intersect(origin, direction).unwrap();
            if plane.point.x.abs() < 2.0 && plane.point.y.abs() < 2.0 {
                let mesh = mesh.expect("within the square");
                prop_assert!((mesh.t - plane.t).abs() < 1e-12);
                for axis in 0..2 {
                    prop_assert!((mesh.uv[axis] - plane.uv[axis]).abs() < 1e-9);
                    prop_assert!((mesh.gradient[axis] - plane.gradient[axis]).norm() < 1e-9);
                }
                prop_assert!((mesh.frame.tangent - plane.frame.tangent).norm() < 1e-12);
            } else {
                prop_assert!(mesh.is_none());
            }
        }
    }

    #[test]
    fn back_sides_hide_and_are_not_seen() {
        let below = square().trace(Vec3::new(0.3, 0.2, -1.0), Vec3::z());
        assert!(!below.1 && below.0.t == 1.0);
        assert!(!square().trace(Vec3::new(0.0, 0.0, 1.0), Vec3::z()).1);
    }

    #[test]
    fn what_has_no_area_is_left_out() {
        let corner = Vertex { position: Vec3::x(), normal: Vec3::z(), uv: [0.0; 2] };
        let other = Vertex { position: Vec3::new(f64::NAN, 0.0, 0.0), ..corner };
        let mesh = Mesh::new(vec![corner, corner, other], &[[0, 1, 1], [0, 1, 2], [0, 1, 9]]);
        assert_eq!(mesh.triangles(), 0);
        assert!(mesh.intersect(Vec3::z(), -Vec3::z()).is_none());
    }

    #[test]
    fn a_fine_mesh_of_the_sphere_is_hit_where_the_sphere_is() {
        let (rings, around) = (60usize, 120usize);
        let vertex = |ring: usize, step: usize| {
            let (st, ct) = libm::sincos(std::f64::consts::PI * ring as f64 / rings as f64);
            let (sp, cp) = libm::sincos(std::f64::consts::TAU * step as f64 / around as f64);
            // Exactly a point at both poles, where sin π is not quite 0.
            let st = if ring == rings { 0.0 } else { st };
            let position = Vec3::new(st * cp, st * sp, ct);
            Vertex { position, normal: position, uv: [step as f64, ring as f64] }
        };
        let vertices: Vec<Vertex> =
            (0..=rings).flat_map(|ring| (0..=around).map(move |step| vertex(ring, step))).collect();
        let at = |ring: usize, step: usize| (ring * (around + 1) + step) as u32;
        let triangles: Vec<[u32; 3]> = (0..rings)
            .flat_map(|r| (0..around).map(move |s| (r, s)))
            .flat_map(|(r, s)| {
                let (a, b, c, d) = (at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1));
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let mesh = Mesh::new(vertices, &triangles);
        // The first and last ring have one triangle a step that is a point.
        assert_eq!(mesh.triangles(), 2 * around * (rings - 1));
        for i in 0..200 {
            let t = f64::from(i);
            let origin =
                Vec3::new(3.0 * (0.7 * t).cos(), 3.0 * (0.7 * t).sin(), 2.0 * (1.3 * t).sin());
            let direction = Vec3::new(0.3 * t.sin(), 0.3 * t.cos(), 0.0) - origin;
            let (want, got) =
                (Sphere::new().intersect(origin, direction), mesh.intersect(origin, direction));
            let (want, got) = (want.unwrap(), got.expect("no ray slips through"));
            assert!(
                (want.t - got.t).abs() < 2e-3
                    && (want.frame.normal - got.frame.normal).norm() < 5e-3
            );
        }
    }
}
