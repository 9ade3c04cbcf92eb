//! The truth under an environment: every facet under a pixel, one at a time.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::{Point, View};
use crate::geometry::elementary::{ln64, pow64};
use crate::geometry::{Frame, Vec3};
use crate::light::Seen;
use crate::light::environment::Environment;
use crate::lobe::BaseLobe;
use crate::render::Choices;
use crate::texture::NormalMap;

/// The part of samples whose mirrored direction is drawn from the environment; the others' facets are drawn
/// from the base lobe.
const SHARE: f64 = 0.5;

/// Brute force over facets.
///
/// A sample takes the map's normal n and weight w at its place and draws one facet h, in one of two ways:
/// from D(h) (h·n), or as the facet that mirrors a direction of the environment's tables to the eye, whose
/// density is that direction's times 4 (v·h). Whichever drew it, it counts by what both might have done (the
/// balance heuristic, Veach and Guibas 1995): with q the mixture's density, its area is w D(h) (v·h)₊ / q, its
/// light that times L. A pixel is the ratio of sums, so that a white environment gives 1 exactly.
pub(super) struct BruteForce<'a> {
    view: &'a View,
    environment: &'a Environment,
    map: &'a Arc<NormalMap>,
    base: BaseLobe,
    choices: Choices,
}

impl<'a> BruteForce<'a> {
    /// For `spp` samples a pixel.
    pub fn new(
        view: &'a View,
        environment: &'a Environment,
        map: &'a Arc<NormalMap>,
        base: BaseLobe,
        spp: u32,
    ) -> Self {
        Self { view, environment, map, base, choices: Choices::new(spp) }
    }

    /// What a sample sees; None if it misses.
    pub fn sees(&self, point: &Point) -> Option<Seen> {
        let sight = self.view.sight(point.x, point.y, 1.0)?;
        let at = &sight.footprint;
        let [x, y, z, weight] = self.map.sample(at.u, at.v);
        let [x, y, z] = at.bend.turn([x, y, z]).map(f64::from);
        let normal = sight.frame.world_from_local(Vec3::new(x, y, z)).normalize();
        let [choice, u1, u2] = self.choices.of(point.stream, point.index);
        let eye = sight.view;
        let facet = if choice < SHARE {
            let (direction, _) = self.environment.sample(u1, u2);
            let sum = eye + direction;
            if sum.norm_squared() > 1e-24 { sum.normalize() } else { normal }
        } else {
            drawn(&self.base, &normal, u1, u2)
        };
        let (facing, cosine) = (eye.dot(&facet), facet.dot(&normal));
        if facing <= 0.0 || cosine <= 0.0 {
            return Some(Seen::default());
        }
        let mirrored = facet * (2.0 * facing) - eye;
        let density = self.base.density(normal.cross(&facet).norm_squared() / (cosine * cosine));
        let drawn = (1.0 - SHARE) * density * cosine
            + SHARE * self.environment.density(&mirrored) * 4.0 * facing;
        let area = if drawn > 0.0 { f64::from(weight) * density * facing / drawn } else { 0.0 };
        let light = if area > 0.0 { area * self.environment.radiance(&mirrored) } else { 0.0 };
        Some(Seen { light, area })
    }
}

/// A facet of density D(h) (h·n) about a unit normal n, by inverting what part of it lies within an angle.
fn drawn(base: &BaseLobe, normal: &Vec3, u1: f64, u2: f64) -> Vec3 {
    // t = tan² of the angle; u1 is the part beyond it.
    let t = match *base {
        BaseLobe::BlinnPhong { exponent } => pow64(u1, -2.0 / (exponent + 2.0)) - 1.0,
        BaseLobe::Beckmann { alpha } => -alpha * alpha * ln64(u1),
        BaseLobe::Ggx { alpha } => alpha * alpha * (1.0 - u1) / u1,
    };
    let (sin, cos) = libm::sincos(TAU * u2);
    let slope = t.max(0.0).sqrt();
    let local = Vec3::new(slope * cos, slope * sin, 1.0) / (1.0 + t.max(0.0)).sqrt();
    Frame::about(*normal).world_from_local(local)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_are_drawn_as_the_base_lobe_says() {
        // Over a lattice of draws, Σ cos^k / n is ∫ D cos^(k+1) dω, found by the midpoint rule in t:
        // dω = ½ (1 + t)^(−3/2) dt dφ.
        for base in [
            BaseLobe::BlinnPhong { exponent: 12.0 },
            BaseLobe::Beckmann { alpha: 0.4 },
            BaseLobe::Ggx { alpha: 0.3 },
        ] {
            let normal = Vec3::new(0.3, -0.5, 0.6).normalize();
            for power in [1, 3] {
                let n = 20_000;
                let draws: f64 = (0..n)
                    .map(|k| {
                        let u1 = (f64::from(k) + 0.5) / f64::from(n);
                        let u2 = (f64::from(k) * 0.618_034).fract();
                        drawn(&base, &normal, u1, u2).dot(&normal).powi(power)
                    })
                    .sum();
                let m = 100_000;
                let exact: f64 = (0..m)
                    .map(|k| {
                        let u = (f64::from(k) + 0.5) / f64::from(m);
                        // t = (u/(1−u))², for the tails.
                        let root = u / (1.0 - u);
                        let t = root * root;
                        let measure = 2.0 * root / ((1.0 - u) * (1.0 - u));
                        let cosine = 1.0 / (1.0 + t).sqrt();
                        std::f64::consts::PI
                            * base.density(t)
                            * cosine.powi(power + 1)
                            * (1.0 + t).powf(-1.5)
                            * measure
                            / f64::from(m)
                    })
                    .sum();
                assert!((draws / f64::from(n) / exact - 1.0).abs() < 1e-3, "{base} {power}");
            }
        }
    }
}
