//! What a surface of many small mirrors shows of an environment.
//!
//! Every facet of normal h is a mirror that the eye sees by the area it shows, (v·h)₊. A multiple surface
//! is a density D of such facets, so along the direction v to the eye it sends
//!
//! L = Σ_l A_l F_l / (v·M + Σ_l (A_l − v·m_l))
//!
//! with A_l = ∫ D_l (v·h)₊ dω the area its lobe l shows, m_l = ∫ D_l h dω the lobe's moment, and F_l the mean of
//! the environment over the mirrored directions of what is seen of the lobe. M is the mean normal of the
//! footprint, weights included. Where the moments add to M, as energy asks for, the denominator is Σ A_l, and
//! a white environment stays white; a lobe that has lost energy, or gained it, shows.
//!
//! Each lobe is taken for a mixture of Gaussians in slopes ([`Slopes::gaussians`]). For a Gaussian A has a
//! closed form, and so have mean and covariance of the slopes that are seen: the eye sees facets that lean
//! towards it more. Mean and covariance go through the mirror to first order, δr = 2 (v·δ) h + 2 (v·h) δ,
//! and ask the environment for a cone.

use super::environment::Environment;
use crate::geometry::elementary::exp64;
use crate::geometry::{Frame, Vec3};
use crate::lobe::vector::{Sym2, V3, dot};
use crate::lobe::{MultipleSurface, Slopes, Spread};

/// What form of cone an environment is looked up with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// An ellipse: as wide in each direction as the light that comes in.
    #[default]
    Elliptic,
    /// A circle as wide as the ellipse is long: a mip map's isotropic lookup.
    Round,
}

impl Filter {
    /// Both, the default first.
    pub const ALL: [Self; 2] = [Self::Elliptic, Self::Round];

    /// Its name in specs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Elliptic => "elliptic",
            Self::Round => "round",
        }
    }
}

/// What is seen of a surface: light, and the area it comes from. Their ratio is radiance; sums over samples
/// of a pixel are divided, so that samples count by the area they show.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// Σ A F.
    pub light: f64,
    /// What the footprint's normals show.
    pub area: f64,
}

/// What a multiple surface shows of an environment to an eye in the unit direction `view`, tangent space;
/// `frame` is the tangent space in the world. `mean` is the footprint's mean normal M; without one, the
/// lobes' own moments stand for it.
pub fn mirrored(
    environment: &Environment,
    filter: Filter,
    surface: &MultipleSurface,
    mean: Option<V3>,
    frame: &Frame,
    view: V3,
) -> Seen {
    let mut seen = Seen::default();
    let mut moments = 0.0;
    for lobe in surface.lobes() {
        let slopes = lobe.slopes();
        moments += f64::from(dot(slopes.moment(), view));
        let eye = slopes.local(view).map(f64::from);
        for &(share, covariance) in slopes.gaussians().iter() {
            let weight = f64::from(slopes.amplitude * share);
            let Some(patch) = Patch::of(slopes.mean, covariance, eye) else {
                continue;
            };
            // What is hardly seen is not worth a lookup.
            if patch.area > 1e-7 {
                let area = weight * patch.area;
                let cone = Cone::of(&slopes, &patch, eye);
                seen.area += area;
                seen.light += area * cone.light(environment, filter, frame);
            }
        }
    }
    // v·M + Σ (A − v·m)
    if let Some(mean) = mean {
        seen.area += f64::from(dot(mean, view)) - moments;
    }
    seen
}

/// What an eye sees of a Gaussian of slopes: slopes x weigh (v_z + v_xy·x)₊.
#[derive(Clone, Copy, Debug)]
struct Patch {
    /// The weights' mean.
    area: f64,
    /// Mean of the slopes seen.
    mean: [f64; 2],
    /// Their covariance.
    covariance: [f64; 3],
}

impl Patch {
    /// `eye` in the pole's frame. None if nothing is seen.
    fn of(mean: [f32; 2], covariance: Sym2, eye: [f64; 3]) -> Option<Self> {
        let ([x, y], [a, b, c]) = (mean.map(f64::from), covariance.map(f64::from));
        let towards = [a * eye[0] + b * eye[1], b * eye[0] + c * eye[1]];
        // v·h at slope x is normal with this mean and deviation.
        let level = eye[2] + eye[0] * x + eye[1] * y;
        let deviation = (eye[0] * towards[0] + eye[1] * towards[1]).max(0.0).sqrt();
        let limit = level / deviation.max(1e-12);
        let (below, density) = normal(limit)?;
        // Moments of a standard normal ξ weighed by (limit + ξ)₊.
        let zeroth = limit * below + density;
        let first = below / zeroth;
        let second = (limit * below + 2.0 * density) / zeroth;
        let squeeze = (second - first * first - 1.0) / (deviation * deviation).max(1e-24);
        let shift = first / deviation.max(1e-12);
        Some(Self {
            area: level * below + deviation * density,
            mean: [x + shift * towards[0], y + shift * towards[1]],
            covariance: [
                a + squeeze * towards[0] * towards[0],
                b + squeeze * towards[0] * towards[1],
                c + squeeze * towards[1] * towards[1],
            ],
        })
    }
}

/// Φ and φ of a standard normal distribution; None below −6, where Φ is 10⁻⁹.
fn normal(x: f64) -> Option<(f64, f64)> {
    if x > 8.0 {
        return Some((1.0, 0.0));
    }
    let density = exp64(-0.5 * x * x) / (std::f64::consts::TAU).sqrt();
    (x > -6.0).then(|| (0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2), density))
}

/// Mirrored directions, in the tangent space of the surface.
struct Cone {
    direction: Vec3,
    frame: Frame,
    /// Covariance across the direction, along the frame's tangent and bitangent.
    covariance: [f64; 3],
}

impl Cone {
    fn of(slopes: &Slopes, patch: &Patch, eye: [f64; 3]) -> Self {
        let [x, y] = patch.mean;
        let length = (1.0 + x * x + y * y).sqrt();
        let normal = Vec3::new(x, y, 1.0) / length;
        let eye = Vec3::from(eye);
        // How the unit normal moves with the slopes, and the mirrored direction with the normal.
        let moved = [Vec3::x(), Vec3::y()].map(|axis| (axis - normal * normal.dot(&axis)) / length);
        let facing = eye.dot(&normal);
        let direction = normal * (2.0 * facing) - eye;
        let mirrored = moved.map(|d| normal * (2.0 * eye.dot(&d)) + d * (2.0 * facing));
        let [a, b, c] = patch.covariance;
        let spread = |[p, q]: [Vec3; 2]| a * p.dot(&p) + 2.0 * b * p.dot(&q) + c * q.dot(&q);
        let frame = Frame::about(direction);
        let held = held(0.5 * spread(moved).max(0.0));
        let column = |axis: &Vec3| mirrored.map(|m| m.dot(axis));
        let (t, u) = (column(&frame.tangent), column(&frame.bitangent));
        let product = |p: [f64; 2], q: [f64; 2]| {
            held * (a * p[0] * q[0] + b * (p[0] * q[1] + p[1] * q[0]) + c * p[1] * q[1])
        };
        let covariance = [product(t, t), product(t, u), product(u, u)];
        let out = |v: Vec3| {
            let part = |c: usize| {
                v.x * f64::from(slopes.tangent[c])
                    + v.y * f64::from(slopes.bitangent[c])
                    + v.z * f64::from(slopes.pole[c])
            };
            Vec3::new(part(0), part(1), part(2))
        };
        let frame = Frame {
            tangent: out(frame.tangent),
            bitangent: out(frame.bitangent),
            normal: out(frame.normal),
        };
        Self { direction: frame.normal, frame, covariance }
    }

    /// The mean of the environment over the cone.
    fn light(&self, environment: &Environment, filter: Filter, world: &Frame) -> f64 {
        let direction = world.world_from_local(self.direction);
        match filter {
            Filter::Elliptic => {
                let across = [self.frame.tangent, self.frame.bitangent];
                let across = across.map(|axis| world.world_from_local(axis));
                environment.elliptic_cone(&direction, &across, self.covariance)
            }
            Filter::Round => {
                let [a, b, c] = self.covariance;
                let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
                environment.cone(&direction, mean + (half * half + b * b).sqrt())
            }
        }
    }
}

/// What a cone's variance is multiplied by for the sphere's curvature, where normals have variance `v` per
/// axis in slopes. Seen along its axis, a Gaussian of slopes mirrors to directions of mean cosine
/// E[(1 − t)/(1 + t)], t exponential of mean 2v; the cone is the von Mises-Fisher distribution of that mean
/// cosine. (1 for narrow lobes, where its variance is 4v.)
fn held(v: f64) -> f64 {
    if v < 1e-6 {
        return 1.0;
    }
    // E[1/(1 + t)] = z e^z E₁(z), z = 1/2v (Abramowitz and Stegun 1964, 5.1.54: within 5·10⁻⁵ for z ≥ 1).
    let z = 0.5 / v;
    let mean = (z * (z + 2.334_733) + 0.250_621) / (z * (z + 3.330_657) + 1.681_534);
    let cosine = (2.0 * mean - 1.0).max(0.03);
    // κ of that mean cosine, coth κ − 1/κ: a close guess, and a step of the fixed-point equation.
    let guess = cosine * (3.0 - cosine * cosine) / (1.0 - cosine * cosine);
    let variance = if guess > 12.0 {
        1.0 - cosine
    } else if guess > 0.5 {
        1.0 + 2.0 / (exp64(2.0 * guess) - 1.0) - cosine
    } else {
        1.0 / guess
    };
    variance / (4.0 * v)
}
