//! Sample directions over the upper hemisphere.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::Vec3;

/// One direction of a [`HemisphereGrid`] and the solid angle it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Unit direction in tangent space, z ≥ 0.
    pub direction: Vec3,
    /// Solid angle of its cell, steradians. The cells tile the hemisphere: they sum to 2π.
    pub solid_angle: f64,
}

/// Fournier's layout of directions over the hemisphere (1992 §2.3): rings of constant polar angle
/// θ, equally spaced azimuths φ, and one sample at the pole.
///
/// With 18 rings and 72 azimuths it is the paper's grid: every 5° in θ and φ, and a pole cap of
/// radius 5/12°. That radius makes the cap half the area of its neighbours exactly when the first
/// ring's cells reach from 5/12° to 5°, so ring centres lie at 2.5°, 7.5°, …, 87.5°.
#[derive(Clone, Debug, PartialEq)]
pub struct HemisphereGrid {
    rings: usize,
    azimuths: usize,
    samples: Vec<Sample>,
}

impl HemisphereGrid {
    /// A grid of `rings` × `azimuths` directions and the pole; both at least 1.
    pub fn new(rings: usize, azimuths: usize) -> Self {
        Self::jittered(rings, azimuths, 0.0, 0)
    }

    /// A grid each of whose directions, the pole excepted, is moved within its own cell: by `jitter`, from
    /// 0 (not at all) to 1, of the way from the middle to a point that is even in the cell's θ and φ, a
    /// function of `seed` alone. Cells, their solid angles and their neighbours stay. It is not in the paper,
    /// whose directions are regular: it shows what that costs where normals fall between them.
    pub fn jittered(rings: usize, azimuths: usize, jitter: f64, seed: u64) -> Self {
        let jitter = jitter.clamp(0.0, 1.0);
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut part = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let (rings, azimuths) = (rings.max(1), azimuths.max(1));
        let step = std::f64::consts::FRAC_PI_2 / rings as f64;
        let around = std::f64::consts::TAU / azimuths as f64;
        // Half of a neighbour's area: the paper's 5/12° for its 5° cells.
        let cap = step / 12.0;
        let pole_area = std::f64::consts::TAU * (1.0 - libm::cos(cap));
        let mut samples = vec![Sample { direction: Vec3::z(), solid_angle: pole_area }];
        for ring in 0..rings {
            let inner = if ring == 0 { cap } else { step * ring as f64 };
            let outer = step * (ring + 1) as f64;
            let solid_angle = around * (libm::cos(inner) - libm::cos(outer));
            let middle = step * (ring as f64 + 0.5);
            samples.extend((0..azimuths).map(|k| {
                let theta = middle + jitter * (inner + (outer - inner) * part() - middle);
                let (sin_theta, cos_theta) = libm::sincos(theta);
                let phi = around * (k as f64 + jitter * (part() - 0.5));
                let (sin_phi, cos_phi) = libm::sincos(phi);
                let direction = Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta);
                Sample { direction, solid_angle }
            }));
        }
        Self { rings, azimuths, samples }
    }

    /// The paper's grid: 18 × 72 + 1 = 1297 directions.
    pub fn fournier() -> Self {
        Self::new(18, 72)
    }

    /// The samples: the pole first, then ring by ring outwards, azimuth by azimuth from +x to +y.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Number of rings of constant θ, the pole not counted.
    pub fn rings(&self) -> usize {
        self.rings
    }

    /// Number of directions in a ring.
    pub fn azimuths(&self) -> usize {
        self.azimuths
    }

    /// Indices of the samples beside sample `index`: the next on its ring, and those at the same
    /// azimuth on the rings within and without. The pole's neighbours are the whole first ring.
    pub fn neighbours(&self, index: usize) -> Vec<usize> {
        if index == 0 {
            return (1..=self.azimuths).collect();
        }
        let (ring, k) = ((index - 1) / self.azimuths, (index - 1) % self.azimuths);
        let at = |ring: usize, k: usize| 1 + ring * self.azimuths + k % self.azimuths;
        let mut found = vec![at(ring, k + 1), at(ring, k + self.azimuths - 1)];
        found.push(if ring == 0 { 0 } else { at(ring - 1, k) });
        if ring + 1 < self.rings {
            found.push(at(ring + 1, k));
        }
        found
    }

    /// ∫ f(ω) dω over the hemisphere by the midpoint rule of this grid.
    pub fn integrate(&self, mut f: impl FnMut(Vec3) -> f64) -> f64 {
        self.samples.iter().map(|s| f(s.direction) * s.solid_angle).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn the_papers_grid_has_1297_samples_and_a_half_size_pole() {
        let grid = HemisphereGrid::fournier();
        assert_eq!(grid.samples().len(), 18 * 72 + 1);
        let ratio = grid.samples()[0].solid_angle / grid.samples()[1].solid_angle;
        assert!((ratio - 0.5).abs() < 0.01, "pole cap to neighbour: {ratio}");
    }

    #[test]
    fn cells_tile_the_hemisphere() {
        for (rings, azimuths) in [(18, 72), (1, 1), (7, 13), (90, 360)] {
            let grid = HemisphereGrid::new(rings, azimuths);
            assert!((grid.integrate(|_| 1.0) - TAU).abs() < 1e-12);
        }
    }

    #[test]
    fn integrates_a_cosine_lobe() {
        // ∫ (s+2)/2π cosˢθ · cosθ dω = 1.
        let s = 40.0;
        let grid = HemisphereGrid::new(180, 72);
        let total = grid.integrate(|w| (s + 2.0) / TAU * libm::pow(w.z, s + 1.0));
        assert!((total - 1.0).abs() < 2e-3, "{total}");
    }

    #[test]
    fn jitter_keeps_each_direction_in_its_cell() {
        let plain = HemisphereGrid::fournier();
        assert_eq!(HemisphereGrid::jittered(18, 72, 0.0, 9), plain, "not at all, bit by bit");
        let full = HemisphereGrid::jittered(18, 72, 1.0, 9);
        assert_eq!(full, HemisphereGrid::jittered(18, 72, 1.0, 9));
        assert_ne!(full, HemisphereGrid::jittered(18, 72, 1.0, 10));
        assert_eq!(full.samples()[0], plain.samples()[0]);
        let step = 5f64.to_radians();
        for (a, b) in plain.samples().iter().zip(full.samples()).skip(1) {
            assert_eq!(a.solid_angle, b.solid_angle);
            let theta = |s: &Sample| s.direction.z.acos();
            let phi = |s: &Sample| s.direction.y.atan2(s.direction.x);
            let turn = (phi(b) - phi(a) + 3.0 * TAU / 2.0) % TAU - TAU / 2.0;
            assert!((theta(b) - theta(a)).abs() <= 0.5 * step + 1e-12);
            assert!(turn.abs() <= 0.5 * step + 1e-12, "{turn}");
        }
        // Half the jitter goes half the way, and the rule still integrates: its variance is of a cell.
        let half = HemisphereGrid::jittered(18, 72, 0.5, 9);
        let gap = |g: &HemisphereGrid| {
            (g.samples()[700].direction - plain.samples()[700].direction).norm()
        };
        assert!((gap(&half) / gap(&full) - 0.5).abs() < 0.01);
        assert!((full.integrate(|w| w.z) - TAU / 2.0).abs() < 0.01);
    }

    #[test]
    fn neighbours_are_mutual_and_near() {
        let grid = HemisphereGrid::fournier();
        for i in 0..grid.samples().len() {
            for j in grid.neighbours(i) {
                assert!(grid.neighbours(j).contains(&i), "{i} and {j}");
                let angle = grid.samples()[i].direction.dot(&grid.samples()[j].direction);
                assert!(angle > libm::cos(6f64.to_radians()), "{i} and {j} are far apart");
            }
        }
    }
}
