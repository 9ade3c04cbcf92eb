//! The distributions on the sphere that the paper discusses (§4, §5), in the plane y = 0 and on the whole
//! sphere, in double precision.

use crate::geometry::{HemisphereGrid, Vec3};

/// A round distribution of width σ about the pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Density {
    /// n([x y]/z): a Gaussian on the plane that touches the pole, from the sphere's centre. Upper hemisphere.
    Planar,
    /// n([x y]/(z + 1)): from the opposite pole (stereographic).
    Stereographic,
    /// n([x y z]) for a 3D Gaussian about the pole, restricted to the sphere.
    Restricted,
}

impl Density {
    pub const ALL: [Self; 3] = [Self::Planar, Self::Stereographic, Self::Restricted];

    pub fn name(self) -> &'static str {
        match self {
            Self::Planar => "projected from the centre",
            Self::Stereographic => "projected from the opposite pole",
            Self::Restricted => "3D Gaussian, restricted",
        }
    }

    /// As printed: the Gaussian's own value, over its value at the pole. The width σ is that of the cluster
    /// at the pole in radians: half of it on the stereographic plane, where angles are halved.
    pub fn printed(self, h: Vec3, sigma: f64) -> f64 {
        let of = |square: f64, width: f64| libm::exp(-0.5 * square / (width * width));
        let across = h.x * h.x + h.y * h.y;
        match self {
            Self::Planar if h.z <= 0.0 => 0.0,
            Self::Planar => of(across / (h.z * h.z), sigma),
            Self::Stereographic if h.z <= -1.0 + 1e-12 => 0.0,
            Self::Stereographic => of(across / ((1.0 + h.z) * (1.0 + h.z)), 0.5 * sigma),
            Self::Restricted => of(2.0 - 2.0 * h.z, sigma),
        }
    }

    /// What the printed value is multiplied by to be a density a steradian of integral 1: for projections the
    /// area on the plane that a steradian covers, over the Gaussian's integral there; for the restriction
    /// the closed form for a mean of unit length, (1 − e^(−2/σ²)) 2πσ².
    pub fn factor(self, h: Vec3, sigma: f64) -> f64 {
        let square = sigma * sigma;
        match self {
            Self::Planar => 1.0 / (std::f64::consts::TAU * square * h.z * h.z * h.z),
            // dω = 4/(1 + r²)² dA, 1 + r² = 2/(1 + z).
            Self::Stereographic => {
                1.0 / (std::f64::consts::TAU * 0.25 * square * (1.0 + h.z) * (1.0 + h.z))
            }
            Self::Restricted => {
                1.0 / (std::f64::consts::TAU * square * -libm::expm1(-2.0 / square))
            }
        }
    }

    /// The density a steradian, of integral 1.
    pub fn normalised(self, h: Vec3, sigma: f64) -> f64 {
        let value = self.printed(h, sigma);
        if value > 0.0 { value * self.factor(h, sigma) } else { 0.0 }
    }
}

/// ∫ f dω over the whole sphere.
pub fn over_sphere(grid: &HemisphereGrid, f: impl Fn(Vec3) -> f64) -> f64 {
    grid.integrate(|d| f(d) + f(-d))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalised_densities_integrate_to_one() {
        let grid = HemisphereGrid::new(720, 8);
        for density in Density::ALL {
            for sigma in [0.1, 0.35, 0.8] {
                let total = over_sphere(&grid, |h| density.normalised(h, sigma));
                assert!((total - 1.0).abs() < 1e-4, "{density:?} {sigma}: {total}");
            }
        }
    }

    #[test]
    fn narrow_ones_are_all_alike() {
        let h = Vec3::new(0.02, 0.01, 1.0).normalize();
        let [a, b, c] = Density::ALL.map(|density| density.normalised(h, 0.03));
        assert!((a / b - 1.0).abs() < 0.01 && (b / c - 1.0).abs() < 0.01, "{a} {b} {c}");
    }
}
