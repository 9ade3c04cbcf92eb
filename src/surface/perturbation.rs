//! How a bump function turns the normal of a surface (Blinn 1978 §2 and §4).

use std::sync::Arc;

use super::{Hit, Shape, Surface};
use crate::geometry::Vec3;
use crate::texture::Bend;

/// P_u and P_v: how a point of a parametric surface moves with u and v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// P_u.
    pub u: Vec3,
    /// P_v.
    pub v: Vec3,
}

impl Derivatives {
    /// N = P_u × P_v, not of unit length.
    pub fn normal(&self) -> Vec3 {
        self.u.cross(&self.v)
    }

    /// D = (F_u (N × P_v) − F_v (N × P_u)) / |N|, which makes N + D the normal of the surface displaced by F along
    /// N/|N|, as far as F itself is negligible; 0 where there is no normal.
    pub fn displacement(&self, [f_u, f_v]: [f64; 2]) -> Vec3 {
        let normal = self.normal();
        let along = normal.cross(&self.v) * f_u - normal.cross(&self.u) * f_v;
        along.unscale(normal.norm().max(f64::MIN_POSITIVE))
    }

    /// D′ = a |N| D/|D| with a = √(F_u² + F_v²): the same direction at an angle whose tangent is a, however large
    /// the surface is. 0 where D is. (Print has a |N|/|D|, no vector.)
    pub fn scale_invariant(&self, slopes: [f64; 2]) -> Vec3 {
        let tangent = (slopes[0] * slopes[0] + slopes[1] * slopes[1]).sqrt();
        let along = self.displacement(slopes).try_normalize(f64::MIN_POSITIVE);
        along.map_or_else(Vec3::zeros, |along| along * (tangent * self.normal().norm()))
    }

    /// A = F_v P_u − F_u P_v, the axis that N turns about: N × (N + D) = |N| A and |D| = |A|.
    pub fn axis(&self, [f_u, f_v]: [f64; 2]) -> Vec3 {
        self.u * f_v - self.v * f_u
    }
}

/// What a map's slopes are on a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Perturbation {
    /// Slopes in the surface's own orthonormal tangent frame, however large its tiles are.
    #[default]
    Tangent,
    /// Derivatives of a displacement: bumps keep their height, and flatten where the surface is stretched.
    Displacement {
        /// Scene units that a height of one tile's width stands for.
        unit: f64,
    },
    /// The displacement's direction at the map's own angle.
    ScaleInvariant,
}

impl Perturbation {
    /// M of [`Bend`] at a hit: slopes f of a map of square texels, `aspect` times as high as wide, are
    /// M f = unit (f_x ∇u + f_y aspect ∇v) in the frame of the hit; for D/|N| = −F_u ∇u − F_v ∇v. Finite everywhere:
    /// no slope is made more than 10⁶ times as steep.
    pub fn bend(&self, hit: &Hit, aspect: f64) -> Bend {
        const STEEPEST: f64 = 1e6;
        let (unit, keeps_angle) = match *self {
            Self::Tangent => return Bend::default(),
            Self::Displacement { unit } => (unit, false),
            Self::ScaleInvariant => (1.0, true),
        };
        let [u, v] = [hit.gradient[0] * unit, hit.gradient[1] * (unit * aspect)];
        let (tangent, bitangent) = (hit.frame.tangent, hit.frame.bitangent);
        let entries = [u.dot(&tangent), v.dot(&tangent), u.dot(&bitangent), v.dot(&bitangent)];
        let matrix = entries.map(|m| m.clamp(-STEEPEST, STEEPEST) as f32);
        Bend { matrix, keeps_angle }
    }
}

/// A surface whose bumps are not slopes in its tangent frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Perturbed {
    shape: Arc<Shape>,
    form: Perturbation,
    aspect: f64,
}

impl Perturbed {
    /// A surface with a form of perturbation.
    pub fn new(shape: Shape, form: Perturbation) -> Self {
        Self { shape: Arc::new(shape), form, aspect: 1.0 }
    }

    /// The surface.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// What becomes of the map's slopes at a hit.
    pub fn bend(&self, hit: &Hit) -> Bend {
        self.form.bend(hit, self.aspect)
    }
}

impl Surface for Perturbed {
    fn trace(&self, origin: Vec3, direction: Vec3) -> (Hit, bool) {
        self.shape.trace(origin, direction)
    }

    fn tiled(&self, tiles: f64, aspect: f64) -> Self {
        Self { shape: Arc::new(self.shape.tiled(tiles, aspect)), form: self.form, aspect }
    }

    fn tiles_across(&self) -> f64 {
        self.shape.tiles_across()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frame;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-2.0f64..2.0).prop_map(Vec3::from)
    }

    fn patch() -> impl Strategy<Value = Derivatives> {
        (vector(), vector())
            .prop_map(|(u, v)| Derivatives { u, v })
            .prop_filter("a plane", |p| p.normal().norm() > 0.05)
    }

    proptest! {
        #[test]
        fn the_normal_turns_about_the_axis_by_the_angle(p in patch(), f in prop::array::uniform2(-3.0f64..3.0)) {
            let (n, d, a) = (p.normal(), p.displacement(f), p.axis(f));
            let turned = n + d;
            prop_assert!((n.cross(&turned) - a * n.norm()).norm() < 1e-9 * (1.0 + a.norm() * n.norm()));
            prop_assert!((d.norm() - a.norm()).abs() < 1e-9 * (1.0 + a.norm()));
            prop_assert!(d.dot(&n).abs() < 1e-9 * (1.0 + d.norm() * n.norm()));
            let tangent = n.cross(&turned).norm() / n.dot(&turned);
            prop_assert!((tangent - d.norm() / n.norm()).abs() < 1e-9 * (1.0 + tangent));
        }

        #[test]
        fn scaling_a_patch_flattens_displacements_alone(
            p in patch(), f in prop::array::uniform2(-3.0f64..3.0), s in 0.2f64..5.0
        ) {
            prop_assume!(p.displacement(f).norm() > 1e-6);
            let scaled = Derivatives { u: p.u * s, v: p.v * s };
            let tangent = |d: Vec3, p: &Derivatives| d.norm() / p.normal().norm();
            let flat = tangent(scaled.displacement(f), &scaled) / tangent(p.displacement(f), &p);
            prop_assert!((flat * s - 1.0).abs() < 1e-9, "{flat}");
            let a = (f[0] * f[0] + f[1] * f[1]).sqrt();
            for p in [&p, &scaled] {
                prop_assert!((tangent(p.scale_invariant(f), p) - a).abs() < 1e-9 * (1.0 + a));
            }
        }

        #[test]
        fn the_bend_is_the_displacement_seen_in_the_frame(
            p in patch(), f in prop::array::uniform2(-1.0f64..1.0), aspect in 0.3f64..3.0
        ) {
            // u and v count tiles: ∇u is P_v × N / |N|², ∇v is N × P_u / |N|².
            let n = p.normal();
            let gradient = [p.v.cross(&n), n.cross(&p.u)].map(|g| g / n.norm_squared());
            let hit = Hit { frame: Frame::about(n.normalize()), gradient, ..Hit::nowhere() };
            // A tile's height of v holds `aspect` widths of texels.
            let slopes = [f[0], f[1] * aspect];
            let frame = hit.frame;
            for (form, want) in [
                (Perturbation::Displacement { unit: 1.0 }, n + p.displacement(slopes)),
                (Perturbation::ScaleInvariant, {
                    let along = p.displacement(slopes).try_normalize(1e-9).unwrap_or_default();
                    n.normalize() + along * (f[0] * f[0] + f[1] * f[1]).sqrt()
                }),
            ] {
                let [x, y, z] = form.bend(&hit, aspect).turn([-f[0] as f32, -f[1] as f32, 1.0]);
                let got = (frame.tangent * f64::from(x) + frame.bitangent * f64::from(y) + frame.normal * f64::from(z)).normalize();
                prop_assert!((got - want.normalize()).norm() < 1e-4, "{form:?} {got} {want}");
            }
        }
    }

    #[test]
    fn on_the_unit_patch_it_is_the_gradient() {
        let unit = Derivatives { u: Vec3::x(), v: Vec3::y() };
        assert_eq!(unit.displacement([0.3, -0.4]), Vec3::new(-0.3, 0.4, 0.0));
        assert!((unit.scale_invariant([0.3, -0.4]) - Vec3::new(-0.3, 0.4, 0.0)).norm() < 1e-15);
        assert_eq!(unit.scale_invariant([0.0; 2]), Vec3::zeros());
        let none = Derivatives { u: Vec3::x(), v: Vec3::x() };
        assert_eq!(none.scale_invariant([1.0, 1.0]), Vec3::zeros());
    }

    /// A curved patch, its derivatives, and a bump function with its.
    fn curved(u: f64, v: f64) -> Vec3 {
        Vec3::new(u + 0.1 * v * v, v - 0.2 * u * v, 0.4 * (1.3 * u).sin() * (0.9 * v).cos())
    }

    fn difference(f: impl Fn(f64, f64) -> Vec3, u: f64, v: f64, h: f64) -> Derivatives {
        Derivatives {
            u: (f(u + h, v) - f(u - h, v)) / (2.0 * h),
            v: (f(u, v + h) - f(u, v - h)) / (2.0 * h),
        }
    }

    #[test]
    fn it_is_off_by_the_first_power_of_the_height() {
        // Bumps of height h and length h, so that slopes stay what they are.
        let error = |h: f64, point: fn(f64, f64) -> Vec3| {
            let f = |u: f64, v: f64| h * (u / h).sin() * (0.7 * v / h).cos();
            let slopes = |u: f64, v: f64| {
                [(u / h).cos() * (0.7 * v / h).cos(), -0.7 * (u / h).sin() * (0.7 * v / h).sin()]
            };
            let normal = |u, v| difference(point, u, v, 1e-5).normal().normalize();
            let moved = |u: f64, v: f64| point(u, v) + normal(u, v) * f(u, v);
            const POINTS: usize = 3000;
            let off = (0..POINTS).map(|k| {
                // The same points whatever the bumps, spread evenly by relatives of the golden ratio.
                let [u, v] = [0.754_877_666, 0.569_840_291].map(|a| (a * (k + 1) as f64).fract());
                let p = difference(point, u, v, 1e-5);
                let truth = difference(moved, u, v, 1e-4 * h).normal().normalize();
                ((p.normal() + p.displacement(slopes(u, v))).normalize() - truth).norm()
            });
            off.sum::<f64>() / POINTS as f64
        };
        let [coarse, fine] = [1e-2, 1e-3].map(|h| error(h, curved));
        let order = (coarse / fine).log10();
        assert!((order - 1.0).abs() < 0.1, "{coarse} {fine}");
        // On a plane nothing is left out.
        let plane = error(1e-2, |u, v| Vec3::new(u + 0.3 * v, 2.0 * v, 0.5 * u));
        assert!(plane < 1e-6, "{plane}");
    }
}
