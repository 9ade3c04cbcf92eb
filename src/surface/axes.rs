//! The axes that a bump map's offset vectors stand in (Schilling 1997, *The Local Coordinate System*).

use std::sync::Arc;

use super::{Hit, Shape, Surface};
use crate::geometry::{Frame, Vec3};

/// A choice of two tangent vectors at every point of a surface. A bump map's slopes (f_u, f_v) turn the unit
/// normal n into n + f_u s_u + f_v s_v, of no unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axes {
    /// "1. The natural system": s_u = n × p_v and s_v = p_u × n, divided by |p_u × p_v| here: −∇u and −∇v. With
    /// slopes ∂F/∂u and ∂F/∂v in scene units a tile this is Blinn's displacement (1978): bumps keep their
    /// height wherever they are.
    Natural,
    /// "2. The natural system with normalized unit vectors": the same at unit length; slopes are heights per
    /// length, and bumps grow and shrink with the surface.
    Normalised,
    /// "3. An orthonormal system with main direction m": e₁ = m × n/|m × n| and e₂ = n × e₁, turned round. (In
    /// print s_u and s_v point to where u and v fall, but e₁ and e₂ to where they rise, on the sphere with m
    /// its axis. Slopes are to mean the same in all three.)
    MainDirection(Vec3),
}

impl Axes {
    /// [s_u, s_v] at a hit, world space. Finite everywhere: where ∇u or ∇v is no longer than nothing, or m is
    /// along the normal, some tangent stands in.
    pub fn at(&self, hit: &Hit) -> [Vec3; 2] {
        let [u, v] = hit.gradient;
        match *self {
            Self::Natural => [-u, -v],
            Self::Normalised => {
                let unit = |g: Vec3, or: Vec3| g.try_normalize(1e-300).unwrap_or(or);
                [-unit(u, hit.frame.tangent), -unit(v, hit.frame.bitangent)]
            }
            Self::MainDirection(main) => {
                let frame = along_main_direction(hit.frame.normal, main);
                [-frame.tangent, -frame.bitangent]
            }
        }
    }

    /// The unit normal of a bump map's slopes at a hit, world space.
    pub fn perturbed(&self, hit: &Hit, [f_u, f_v]: [f64; 2]) -> Vec3 {
        let [s_u, s_v] = self.at(hit);
        (hit.frame.normal + s_u * f_u + s_v * f_v).normalize()
    }

    /// A, row by row: the map's slopes (f_u, f_v) are slopes A (f_u, f_v) in the frame of the hit.
    pub fn slopes(&self, hit: &Hit) -> [[f64; 2]; 2] {
        let axes = self.at(hit);
        [hit.frame.tangent, hit.frame.bitangent].map(|t| axes.map(|s| -s.dot(&t)))
    }
}

/// The frame about a unit `normal` whose tangent is perpendicular to `main`: e₁ = m × n/|m × n|, e₂ = n × e₁
/// (Schilling 1997). Where the two are parallel it has no meaning, and is some frame about the normal.
pub fn along_main_direction(normal: Vec3, main: Vec3) -> Frame {
    match main.cross(&normal).try_normalize(1e-12) {
        Some(tangent) => Frame { tangent, bitangent: normal.cross(&tangent), normal },
        None => Frame::about(normal),
    }
}

/// A surface on which bumps stand along a main direction ([`Axes::MainDirection`]), whatever its texture
/// coordinates do.
#[derive(Clone, Debug, PartialEq)]
pub struct MainDirection {
    shape: Arc<Shape>,
    main: Vec3,
}

impl MainDirection {
    /// A surface with this main direction, world space, of any length; of no length it is z.
    pub fn new(shape: Shape, main: Vec3) -> Self {
        let main = main.try_normalize(0.0).unwrap_or(Vec3::z());
        Self { shape: Arc::new(shape), main }
    }

    /// The surface.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }
}

impl Surface for MainDirection {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        let (hit, hits) = self.shape.trace(origin, direction);
        (Hit { frame: along_main_direction(hit.frame.normal, self.main), ..hit }, hits)
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        Self { shape: Arc::new(self.shape.tiled(tiles, aspect)), main: self.main }
    }

    fn tiles_across(&self) -> f64 {
        self.shape.tiles_across()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{Plane, Sphere, drapery};
    use proptest::prelude::*;

    fn near(a: Vec3, b: Vec3) -> bool {
        (a - b).norm() < 1e-9
    }

    proptest! {
        #[test]
        fn on_the_unit_plane_all_three_are_one(
            x in -3.0f64..3.0, y in -3.0f64..3.0, f_u in -2.0f64..2.0, f_v in -2.0f64..2.0
        ) {
            let hit = Plane::new().intersect(Vec3::new(x, y, 2.0), -Vec3::z()).unwrap();
            let want = Vec3::new(-f_u, -f_v, 1.0).normalize();
            for axes in [Axes::Natural, Axes::Normalised, Axes::MainDirection(Vec3::y())] {
                prop_assert!(near(axes.perturbed(&hit, [f_u, f_v]), want), "{axes:?}");
                prop_assert_eq!(axes.slopes(&hit), [[1.0, 0.0], [0.0, 1.0]]);
            }
        }

        #[test]
        fn scaled_maps_keep_their_height_or_their_angle(tiles in 0.1f64..10.0, aspect in 0.2f64..5.0, f in -1.0f64..1.0) {
            // Slopes a tile, F in scene units: on smaller tiles the same heights are steeper.
            let plane = Plane::new().tiled(tiles, aspect);
            let hit = plane.intersect(Vec3::new(0.3, 0.4, 1.0), -Vec3::z()).unwrap();
            let tangent = |axes: Axes, slopes| {
                let n = axes.perturbed(&hit, slopes);
                [-n.x / n.z, -n.y / n.z]
            };
            let [across, along] = [tangent(Axes::Natural, [f, 0.0]), tangent(Axes::Natural, [0.0, f])];
            prop_assert!((across[0] - f * tiles).abs() < 1e-9 && across[1] == 0.0);
            prop_assert!((along[1] - f * tiles / aspect).abs() < 1e-9);
            for axes in [Axes::Normalised, Axes::MainDirection(Vec3::y())] {
                prop_assert!((tangent(axes, [f, 0.0])[0] - f).abs() < 1e-12);
            }
        }

        #[test]
        fn on_the_sphere_normalised_and_its_axis_are_the_frame(x in -0.9f64..0.9, z in -0.9f64..0.9) {
            let hit = Sphere::new().intersect(Vec3::new(x, -3.0, z), Vec3::y());
            if let Some(hit) = hit.filter(|hit| hit.point.z.abs() < 1.0 - 1e-9) {
                for axes in [Axes::Normalised, Axes::MainDirection(Vec3::z())] {
                    let [s_u, s_v] = axes.at(&hit);
                    prop_assert!(near(-s_u, hit.frame.tangent) && near(-s_v, hit.frame.bitangent));
                }
            }
        }

        #[test]
        fn natural_is_blinns_displacement_to_first_order(a in -3.0f64..3.0, e in -1.2f64..1.2, phase in 0.0f64..6.0) {
            // F on the unit sphere, its normals by differences of P + F N/|N| (Blinn 1978).
            let bump = |h: f64, u: f64, v: f64| h * ((5.0 * u + phase).sin() + (4.0 * v).cos());
            let at = |u: f64, v: f64| crate::geometry::spherical_frame(u, v).normal;
            let hit = Sphere::new().tiled(1.0 / std::f64::consts::TAU, 0.5);
            let hit = hit.intersect(at(a, e) * 3.0, -at(a, e)).unwrap();
            let error = |h: f64| {
                let moved = |u: f64, v: f64| at(u, v) * (1.0 + bump(h, u, v));
                let d = 1e-5;
                let p_u = moved(a + d, e) - moved(a - d, e);
                let p_v = moved(a, e + d) - moved(a, e - d);
                let f = [bump(h, a + d, e) - bump(h, a - d, e), bump(h, a, e + d) - bump(h, a, e - d)];
                // From radians to tiles: a turn is a tile of u, half a turn one of v.
                let [f_u, f_v] = f.map(|f| f / (2.0 * d));
                let (tau, pi) = (std::f64::consts::TAU, std::f64::consts::PI);
                let bumped = Axes::Natural.perturbed(&hit, [f_u * tau, f_v * pi]);
                (bumped - p_u.cross(&p_v).normalize()).norm()
            };
            // The print's normal leaves out F's share of P_u and P_v, which is of the order of F times its slope.
            prop_assert!(error(1e-3) < 40e-6 && error(1e-2) < 40e-4, "{} {}", error(1e-3), error(1e-2));
        }
    }

    #[test]
    fn a_pole_has_finite_axes_whichever_are_chosen() {
        let sphere = Sphere::new();
        for tilt in [0.0, 1e-300, 1e-15, 1e-9, 1e-3] {
            let hit = sphere.intersect(Vec3::new(tilt, 0.0, 3.0), -Vec3::z()).unwrap();
            for axes in [Axes::Natural, Axes::Normalised, Axes::MainDirection(Vec3::z())] {
                let n = axes.perturbed(&hit, [0.3, -0.2]);
                assert!((n.norm() - 1.0).abs() < 1e-12, "{axes:?} at {tilt}: {n}");
            }
        }
    }

    #[test]
    fn a_main_direction_turns_frames_and_nothing_else() {
        let shapes = [Shape::Sphere(Sphere::new()), Shape::Mesh(drapery())];
        for shape in shapes {
            let main = Vec3::new(1.0, 0.2, 0.3);
            let turned = MainDirection::new(shape.clone(), main).tiled(3.0, 0.5);
            let shape = shape.tiled(3.0, 0.5);
            let (origin, direction) = (Vec3::new(0.1, -4.0, 0.2), Vec3::new(0.02, 1.0, 0.03));
            let (a, b) = (turned.trace(origin, direction), shape.trace(origin, direction));
            assert!(a.1 && b.1 && turned.tiles_across() == shape.tiles_across());
            assert_eq!(Hit { frame: b.0.frame, ..a.0 }, b.0);
            assert!(a.0.frame.tangent.dot(&main).abs() < 1e-12);
            assert!(a.0.frame.bitangent.dot(&main) > 0.0, "e₂ is on the side of m");
            assert_eq!(a.0.frame.normal, b.0.frame.normal);
        }
    }
}
