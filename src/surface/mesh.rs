//! Triangle meshes.

use std::sync::Arc;

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::ray::Ray;

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
    triangles: Vec<Triangle>,
    hierarchy: Bvh<f64, 3>,
}

impl PartialEq for Mesh {
    /// Whether they are tilings alike of the same triangles in memory.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared) && self.tiles == other.tiles
    }
}

#[derive(Clone, Debug)]
struct Triangle {
    corners: [Vertex; 3],
    /// Unit normal of its plane.
    normal: Vec3,
    /// How barycentric coordinates 1 and 2 grow over the plane.
    growth: [Vec3; 2],
    /// Its place in the hierarchy.
    node: usize,
}

impl Triangle {
    /// `None` if it has no area.
    fn new(corners: [Vertex; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|corner| corner.position);
        let (e1, e2) = (b - a, c - a);
        let cross = e1.cross(&e2);
        let square = cross.norm_squared();
        let normal = cross.try_normalize(0.0)?;
        let growth = [e2.cross(&cross) / square, cross.cross(&e1) / square];
        let finite = growth.iter().all(|g| g.iter().all(|x| x.is_finite()));
        (square > 0.0 && finite).then_some(Self { corners, normal, growth, node: 0 })
    }

    /// Where a ray meets its plane within its sides: the distance along the ray and the barycentric
    /// coordinates 1 and 2.
    fn meet(&self, origin: Vec3, direction: Vec3) -> Option<(f64, [f64; 2])> {
        // Neighbours overlap by a hair, so that no ray slips between them.
        const SLACK: f64 = 1e-9;
        let from = self.corners[0].position;
        let t = (from - origin).dot(&self.normal) / direction.dot(&self.normal);
        let within = origin + direction * t - from;
        let [b, c] = self.growth.map(|g| g.dot(&within));
        (t > 0.0 && t.is_finite() && b >= -SLACK && c >= -SLACK && b + c <= 1.0 + SLACK)
            .then_some((t, [b, c]))
    }

    fn hit(&self, origin: Vec3, direction: Vec3, t: f64, [b, c]: [f64; 2], tiles: [f64; 2]) -> Hit {
        let weights = [1.0 - b - c, b, c];
        let blend = |f: &dyn Fn(&Vertex) -> f64| -> f64 {
            self.corners.iter().zip(weights).map(|(corner, weight)| weight * f(corner)).sum()
        };
        let smooth =
            Vec3::new(blend(&|v| v.normal.x), blend(&|v| v.normal.y), blend(&|v| v.normal.z));
        let normal = smooth.try_normalize(1e-9).unwrap_or(self.normal);
        let gradient = [0, 1].map(|axis| {
            let [u0, u1, u2] = self.corners.map(|corner| corner.uv[axis]);
            (self.growth[0] * (u1 - u0) + self.growth[1] * (u2 - u0)) * tiles[axis]
        });
        // East is where u grows; where it does not, any tangent will do.
        let east = gradient[0] - normal * gradient[0].dot(&normal);
        let frame = match east.try_normalize(1e-12) {
            Some(tangent) => Frame { tangent, bitangent: normal.cross(&tangent), normal },
            None => Frame::about(normal),
        };
        let uv = [0, 1].map(|axis| blend(&|v| v.uv[axis]) * tiles[axis]);
        let point = origin + direction * t;
        Hit { t, point, frame, plane: self.normal, uv, gradient }
    }
}

impl Bounded<f64, 3> for Triangle {
    /// A hair larger than the triangle: a ray along an axis that runs right in a side of its box would be
    /// found to miss it.
    fn aabb(&self) -> Aabb<f64, 3> {
        let [a, b, c] = self.corners.map(|corner| corner.position);
        let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
        let hair = Vec3::repeat(1e-9 * low.amax().max(high.amax()) + 1e-30);
        Aabb::with_bounds((low - hair).into(), (high + hair).into())
    }
}

impl BHShape<f64, 3> for Triangle {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Mesh {
    /// A mesh of triangles, each three indices of vertices. Those without area, or of a vertex there is
    /// not, are left out. One tile a unit of its texture coordinates.
    pub fn new(vertices: &[Vertex], triangles: &[[usize; 3]]) -> Self {
        let triangle = |corners: &[usize; 3]| {
            let [a, b, c] = corners.map(|index| vertices.get(index).copied());
            Triangle::new([a?, b?, c?])
        };
        let mut triangles: Vec<Triangle> = triangles.iter().filter_map(triangle).collect();
        let hierarchy = Bvh::build(&mut triangles);
        Self { shared: Arc::new(Shared { triangles, hierarchy }), tiles: [1.0; 2] }
    }

    /// Triangles that have area.
    pub fn triangles(&self) -> usize {
        self.shared.triangles.len()
    }
}

impl Surface for Mesh {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        let Shared { triangles, hierarchy } = &*self.shared;
        let ray = Ray::new(origin.into(), direction);
        let mut first: Option<(f64, [f64; 2], &Triangle)> = None;
        for triangle in hierarchy.traverse_iterator(&ray, triangles) {
            if let Some((t, at)) = triangle.meet(origin, direction)
                && first.is_none_or(|(nearest, ..)| t < nearest)
            {
                first = Some((t, at, triangle));
            }
        }
        match first {
            Some((t, at, triangle)) => {
                let front = direction.dot(&triangle.normal) < 0.0;
                (triangle.hit(origin, direction, t, at, self.tiles), front)
            }
            None => (Hit::nowhere(), false),
        }
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        Self { shared: Arc::clone(&self.shared), tiles: [tiles, tiles / aspect] }
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
        Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]])
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
        let mesh = Mesh::new(&[corner, corner, other], &[[0, 1, 1], [0, 1, 2], [0, 1, 9]]);
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
        let at = |ring: usize, step: usize| ring * (around + 1) + step;
        let triangles: Vec<[usize; 3]> = (0..rings)
            .flat_map(|r| (0..around).map(move |s| (r, s)))
            .flat_map(|(r, s)| {
                let (a, b, c, d) = (at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1));
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let mesh = Mesh::new(&vertices, &triangles);
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
