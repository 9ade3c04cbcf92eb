//! Integrals of restricted densities over the sphere, numerically.

use crate::geometry::elementary::exp64;
use crate::lobe::vector::{Sym2, invert};
use crate::lobe::{Cut, Generator};

/// g(q) in double precision.
pub fn fall(generator: Generator, q: f64) -> f64 {
    match generator {
        Generator::Gaussian => exp64(-0.5 * q),
        Generator::Pearson { m } => {
            let base = (1.0 - q / f64::from(2 * m)).max(0.0);
            (0..m).fold(1.0, |product, _| product * base)
        }
    }
}

/// Nodes and weights of Gauss and Legendre's rule of six points on [−1, 1].
const GAUSS: [[f64; 2]; 6] = [
    [-0.932_469_514_203_152, 0.171_324_492_379_170_35],
    [-0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
    [-0.238_619_186_083_196_9, 0.467_913_934_572_691],
    [0.238_619_186_083_196_9, 0.467_913_934_572_691],
    [0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
    [0.932_469_514_203_152, 0.171_324_492_379_170_35],
];

/// ∫ g(q) (n·h) dω over the sphere, q = (h − u) S⁻¹ (h − u)ᵀ, n the direction of u; the relative error is
/// about 10⁻⁵, or 10⁻³ for Pearson II with m < 4, whose end is a kink.
///
/// With z along the narrower principal axis of S across n, dω = dz dφ. Gauss's rule takes z, where S bounds
/// how far the density reaches; circles of constant z are closed, so equal steps in φ take those, as fast as
/// a Gaussian can be taken. Steps are parts of the density's own width in either direction.
pub fn moment(cut: &Cut, generator: Generator) -> f64 {
    let Frame { radial, lean, inverse, reach, .. } = Frame::of(cut);
    let length = f64::from(cut.length);
    let (fine, widest) = match generator {
        Generator::Gaussian => (1.0, 6.0),
        // Smooth only so far, and not at all beyond √2m.
        Generator::Pearson { m } if m < 4 => (0.1, f64::from(2 * m).sqrt()),
        Generator::Pearson { m } => (0.4, f64::from(2 * m).sqrt().min(6.0)),
    };
    let [xx, xz, zz] = inverse;
    let leaned = xx * lean[0] * lean[0] + 2.0 * xz * lean[0] * lean[1] + zz * lean[1] * lean[1];
    let step = 1.2 * fine / (xx + 1.0 / radial + leaned).sqrt();
    let around = circle((std::f64::consts::TAU / step).ceil().clamp(24.0, 1e5) as usize);
    let half = (widest * reach).min(1.0);
    let panels = (2.0 * half * zz.sqrt() / (3.0 * fine)).ceil().clamp(1.0, 1e3);
    let farthest = widest * widest;
    let on_circle = |z: f64| {
        let r = (1.0 - z * z).max(0.0).sqrt();
        let terms = around.iter().map(|[sin, cos]| {
            let (up, x) = (r * cos, r * sin);
            let d = up - length;
            let (x, z) = (x - lean[0] * d, z - lean[1] * d);
            let q = d * d / radial + x * (xx * x + 2.0 * xz * z) + zz * z * z;
            if q < farthest { fall(generator, q) * up } else { 0.0 }
        });
        terms.sum::<f64>() * std::f64::consts::TAU / around.len() as f64
    };
    let width = 2.0 * half / panels;
    let mut sum = 0.0;
    for panel in 0..panels as usize {
        let middle = -half + width * (panel as f64 + 0.5);
        for [node, weight] in GAUSS {
            sum += 0.5 * width * weight * on_circle(middle + 0.5 * width * node);
        }
    }
    sum
}

/// A cut in the frame of the principal axes of S across n, the wider one first.
struct Frame {
    radial: f64,
    lean: [f64; 2],
    /// C⁻¹.
    inverse: [f64; 3],
    /// √S_zz.
    reach: f64,
}

impl Frame {
    fn of(cut: &Cut) -> Self {
        let radial = f64::from(cut.radial);
        let [lx, ly] = cut.lean.map(f64::from);
        let [cxx, cxy, cyy] = cut.across.map(f64::from);
        let across = [cxx + radial * lx * lx, cxy + radial * lx * ly, cyy + radial * ly * ly];
        // The wider axis, from the one of x by half of the angle of (sxx − syy, 2 sxy).
        let (sin, cos) = libm::sincos(0.5 * libm::atan2(2.0 * across[1], across[0] - across[2]));
        let turned = |[a, b, c]: [f64; 3]| {
            [
                a * cos * cos + 2.0 * b * sin * cos + c * sin * sin,
                (c - a) * sin * cos + b * (cos * cos - sin * sin),
                a * sin * sin - 2.0 * b * sin * cos + c * cos * cos,
            ]
        };
        let inverse: Sym2 = invert(cut.across).0;
        Self {
            radial,
            lean: [cos * lx + sin * ly, cos * ly - sin * lx],
            inverse: turned(inverse.map(f64::from)),
            reach: turned(across)[2].max(0.0).sqrt(),
        }
    }
}

/// Sine and cosine of `n` equal steps around.
fn circle(n: usize) -> Vec<[f64; 2]> {
    let of = |k: usize| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * k as f64 / n as f64);
        [sin, cos]
    };
    (0..n).map(of).collect()
}
