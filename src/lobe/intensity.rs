//! The intensity models that Blinn 1978 takes for granted: its reference \[3\], Blinn 1977, *Models of Light
//! Reflection for Computer Synthesized Pictures*, and Phong 1975.
//!
//! Blinn 1977 has s = D G F / (N·E), D relative to its greatest value. Here D is normalised, and so it is a part of
//! the light that comes in: D G F / (4 n·v). His three distributions are, by name here: D₁ = cosᶜ α, Blinn-Phong;
//! D₃, Trowbridge and Reitz's, GGX, whose α is his c₃. D₂ = exp(−(c₂ α)²), Torrance and Sparrow's, is not
//! among the base lobes: Beckmann's with α = 1/c₂, which for small angles is the same, takes its place. A hundredth of its
//! normals lie elsewhere where D₂ falls to half at 10°, a tenth at 30°.

use serde::{Deserialize, Serialize};

use super::vector::{V3, dot, scale, unit};

/// What part of the light a facet mirrors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Fresnel {
    /// All of it, at any angle.
    #[default]
    Mirror,
    /// That of a smooth dielectric of this index of refraction, at least 1.
    Index(f32),
}

impl Fresnel {
    /// The part of unpolarised light mirrored where the cosine of the angle of incidence is c (Blinn 1977, F):
    /// ½ (g − c)²/(g + c)² (1 + (c (g + c) − 1)²/(c (g − c) + 1)²), with g² = n² + c² − 1.
    #[inline(always)]
    pub fn reflectance(self, cosine: f32) -> f32 {
        let Self::Index(index) = self else { return 1.0 };
        let c = cosine.clamp(0.0, 1.0);
        let g = (index * index + c * c - 1.0).max(0.0).sqrt();
        let (less, more) = (g - c, (g + c).max(f32::MIN_POSITIVE));
        let along = (c * more - 1.0) / (c * less + 1.0);
        let across = less / more;
        0.5 * across * across * (1.0 + along * along)
    }
}

/// G/(4 n·v): G the part of a facet in a V-shaped groove that is neither shadowed nor masked (Torrance and
/// Sparrow 1967), min(1, 2 (n·h)(n·v)/(v·h), 2 (n·h)(n·l)/(v·h)); 0 if light or eye is below the facet. All but
/// `half` of unit length.
#[inline(always)]
pub fn groove(axis: V3, half: V3, light: V3, view: V3) -> f32 {
    let half = unit(half);
    let [to_half, to_light, to_view] = [half, light, view].map(|d| dot(axis, d));
    let turned = 2.0 * to_half / dot(view, half).max(f32::MIN_POSITIVE);
    let open = (turned * to_view.min(to_light)).clamp(0.0, 1.0);
    let value = open / (4.0 * to_view.max(f32::MIN_POSITIVE));
    if (to_light > 0.0) & (to_view > 0.0) { value } else { 0.0 }
}

/// Phong's stand-in for the half vector: on the side of the axis where that is, at the angle whose cosine is
/// (r·v)^¼, r the mirror of `light` about `axis`, so that cosˢ of it is (r·v)^(s/4); and whether r is on the eye's
/// side, and the light above the facet. All but `half` of unit length.
///
/// For small angles it is the half vector's own angle in the plane of incidence, and less across it, by the cosine of
/// incidence: Phong's highlights are round where those of half vectors are long and narrow.
#[inline(always)]
pub fn phong_half(axis: V3, half: V3, light: V3, view: V3) -> (V3, bool) {
    let to_light = dot(axis, light);
    let off = [0, 1, 2].map(|i| 2.0 * to_light * axis[i] - light[i] - view[i]);
    // 1 − r·v from the chord: it keeps its digits where the two all but meet.
    let missing = 0.5 * dot(off, off);
    let seen = (missing < 1.0) & (to_light > 0.0);
    let root = (1.0 - missing).max(0.0).sqrt();
    let (cosine, sine) = (root.sqrt(), (missing.min(1.0) / (1.0 + root)).sqrt());
    let along = dot(half, axis);
    let aside = [0, 1, 2].map(|i| half[i] - along * axis[i]);
    let length = dot(aside, aside).sqrt();
    let aside = scale(aside, sine / length.max(f32::MIN_POSITIVE));
    ([0, 1, 2].map(|i| cosine * axis[i] + aside[i]), seen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::{BaseLobe, Shading, Spread};
    use proptest::prelude::*;

    fn at(elevation: f64, azimuth: f64) -> V3 {
        let (s, c) = libm::sincos(elevation.to_radians());
        let (sa, ca) = libm::sincos(azimuth.to_radians());
        [c * ca, c * sa, s].map(|x| x as f32)
    }

    fn sum(a: V3, b: V3) -> V3 {
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    }

    #[test]
    fn fresnel_has_its_known_values() {
        for index in [1.0f32, 1.33, 1.5, 2.4] {
            let fresnel = Fresnel::Index(index);
            let straight = ((index - 1.0) / (index + 1.0)).powi(2);
            assert!((fresnel.reflectance(1.0) - straight).abs() < 1e-6);
            let grazing = fresnel.reflectance(0.0);
            assert!(grazing == 1.0 || index == 1.0, "{index}: {grazing}");
            // The laws of sines and tangents.
            for degrees in [10.0f64, 40.0, 70.0, 85.0] {
                let i = degrees.to_radians();
                let t = (i.sin() / f64::from(index)).asin();
                let (s, p) = ((i - t).sin() / (i + t).sin(), (i - t).tan() / (i + t).tan());
                let want = 0.5 * (s * s + p * p);
                let got = f64::from(fresnel.reflectance(i.cos() as f32));
                assert!((got - want).abs() < 2e-5, "{index} at {degrees}°: {got} {want}");
            }
        }
        assert_eq!(Fresnel::Mirror.reflectance(0.3), 1.0);
    }

    #[test]
    fn a_groove_is_open_where_neither_side_is_in_the_way() {
        let n = [0.0, 0.0, 1.0];
        assert_eq!(groove(n, sum(n, n), n, n), 0.25);
        // Blinn 1977: G = 1 while both 2 (n·h)(n·v) and 2 (n·h)(n·l) exceed v·h. In a mirror's configuration v·h is
        // n·v, and 2 (n·h) is 2: open down to the horizon.
        for elevation in [5.0, 40.0, 80.0] {
            let (l, v) = (at(elevation, 0.0), at(elevation, 180.0));
            assert!((groove(n, sum(l, v), l, v) * 4.0 * v[2] - 1.0).abs() < 1e-4);
        }
        // Light from where the eye is: v·h is 1, and G = 2 (n·v)² below 45°.
        let v = at(30.0, 0.0);
        assert!((groove(n, sum(v, v), v, v) * 4.0 * v[2] - 0.5).abs() < 1e-6);
        assert_eq!(groove(n, sum(v, at(-10.0, 0.0)), at(-10.0, 0.0), v), 0.0);
    }

    #[test]
    fn beckmann_stands_for_torrance_and_sparrows_distribution() {
        // Total variation distance of the areas of facets, D cos θ, between D₂, brought to the same sum, and Beckmann's.
        const STEPS: u32 = 100_000;
        let step = std::f64::consts::FRAC_PI_2 / f64::from(STEPS);
        let apart = |half_width: f64| {
            let c2 = f64::sqrt(f64::ln(2.0)) / half_width.to_radians();
            let beckmann = BaseLobe::Beckmann { alpha: 1.0 / c2 };
            let rings: Vec<[f64; 3]> = (0..STEPS)
                .map(|k| {
                    let angle = (f64::from(k) + 0.5) * step;
                    let area = std::f64::consts::TAU * angle.sin() * angle.cos() * step;
                    let d2 = (-(c2 * angle).powi(2)).exp();
                    [area, d2, beckmann.density(angle.tan().powi(2))]
                })
                .collect();
            let sum: f64 = rings.iter().map(|[area, d2, _]| area * d2).sum();
            0.5 * rings.iter().map(|[area, d2, b]| area * (d2 / sum - b).abs()).sum::<f64>()
        };
        let found = [2.0, 10.0, 30.0].map(apart);
        for (found, want) in found.into_iter().zip([0.00055, 0.0134, 0.0954]) {
            assert!((found / want - 1.0).abs() < 0.02, "{found} {want}");
        }
    }

    proptest! {
        #[test]
        fn phong_is_the_mirrored_direction_to_a_quarter_of_the_exponent(
            e in 2.0f64..88.0, a in 0.0f64..360.0, ve in 2.0f64..88.0, va in 0.0f64..360.0, s in 4.0f64..400.0
        ) {
            let (l, v) = (at(e, a), at(ve, va));
            let lobe = BaseLobe::BlinnPhong { exponent: s }.about([0.0, 0.0, 1.0], 1.0);
            let got = f64::from(lobe.radiance(Shading::Phong, sum(l, v), l, v));
            let l = l.map(f64::from);
            let v = v.map(f64::from);
            let cosine = (-l[0] * v[0] - l[1] * v[1] + l[2] * v[2]).max(0.0);
            let peak = (s + 2.0) / std::f64::consts::TAU;
            let want = peak * cosine.powf(0.25 * s);
            // A last bit of r·v of 10⁻⁷ is s/4 of them in the power.
            prop_assert!((got - want).abs() < 2e-6 * s * want + 1e-5 * peak, "{got} {want}");
        }

        #[test]
        fn torrance_and_sparrow_is_the_same_both_ways(
            e in 5.0f64..85.0, a in 0.0f64..360.0, ve in 5.0f64..85.0, alpha in 0.1f64..1.0
        ) {
            let (l, v) = (at(e, a), at(ve, 20.0));
            let lobe = BaseLobe::Ggx { alpha }.about([0.0, 0.0, 1.0], 1.0);
            let shading = Shading::TorranceSparrow(Fresnel::Index(1.5));
            // Radiance is the reflectance times the cosine to the light.
            let there = lobe.radiance(shading, sum(l, v), l, v) / l[2];
            let back = lobe.radiance(shading, sum(l, v), v, l) / v[2];
            prop_assert!((there - back).abs() <= 1e-4 * there + 1e-6, "{there} {back}");
        }
    }

    #[test]
    fn grooves_send_on_no_more_light_than_comes_in() {
        // The part of light from each side that leaves: ∫ radiance (n·v) dω over its irradiance n·l. (Phong's model
        // makes no such promise.)
        const STEPS: usize = 300;
        let lobes = [
            BaseLobe::BlinnPhong { exponent: 20.0 },
            BaseLobe::Beckmann { alpha: 0.3 },
            BaseLobe::Ggx { alpha: 0.5 },
        ];
        for (lobe, elevation) in lobes.iter().flat_map(|l| [15.0, 45.0, 80.0].map(|e| (l, e))) {
            let (spread, l) = (lobe.about([0.0, 0.0, 1.0], 1.0), at(elevation, 0.0));
            let mut sent = [0.0; 2];
            let step = std::f64::consts::FRAC_PI_2 / STEPS as f64;
            for i in 0..STEPS * STEPS * 4 {
                let polar = ((i / (STEPS * 4)) as f64 + 0.5) * step;
                let around = ((i % (STEPS * 4)) as f64 + 0.5) * step;
                let (s, c) = libm::sincos(polar);
                let v = [s * libm::cos(around), s * libm::sin(around), c].map(|x| x as f32);
                for (sum_of, fresnel) in sent.iter_mut().zip([Fresnel::Mirror, Fresnel::Index(1.5)])
                {
                    let shading = Shading::TorranceSparrow(fresnel);
                    let radiance = spread.radiance(shading, sum(l, v), l, v);
                    *sum_of += f64::from(radiance) * c * s * step * step;
                }
            }
            let [mirror, glass] = sent.map(|sum| sum / f64::from(l[2]));
            assert!(mirror <= 1.001 && mirror > 0.5, "{lobe} from {elevation}°: {mirror}");
            assert!(glass < 0.6 * mirror, "{lobe} from {elevation}°: {glass} of {mirror}");
        }
    }

    #[test]
    fn a_wider_lobe_is_the_mean_of_phongs_about_the_normals_it_stands_for() {
        // Normals of Gaussian slopes of variance K about z, each with a Phong highlight: the lobe of covariance
        // K + 1/s, seen around the mirrored direction, in the plane of incidence and across it. The lobe has other tails
        // than the mean: it is told by how wide it is, the second moment of v about r, here by its height where all its
        // light is kept (a Gaussian of twice the variance is half as high).
        let (s, k) = (400.0, 0.004);
        let base = BaseLobe::BlinnPhong { exponent: s };
        let spread = (k + 1.0 / s) as f32;
        let wide = crate::lobe::EllipticLobe::new(
            [0.0, 0.0, 1.0],
            [spread, 0.0, spread],
            1.0,
            base.profile(),
        );
        for elevation in [85.0, 60.0, 35.0] {
            let (l, v) = (at(elevation, 0.0), at(elevation, 180.0));
            let got = wide.radiance(Shading::Phong, sum(l, v), l, v);
            let mut mean = 0.0;
            const SIDE: i32 = 121;
            let mut weights = 0.0;
            for i in 0..SIDE * SIDE {
                let slope =
                    |j: i32| (f64::from(j) / f64::from(SIDE - 1) - 0.5) * 10.0 * f64::sqrt(k);
                let (x, y) = (slope(i % SIDE), slope(i / SIDE));
                let weight = (-0.5 * (x * x + y * y) / k).exp();
                let lobe = base.about([-x, -y, 1.0].map(|c| c as f32), 1.0);
                mean += weight * f64::from(lobe.radiance(Shading::Phong, sum(l, v), l, v));
                weights += weight;
            }
            let ratio = f64::from(got) / (mean / weights);
            // Second-order terms: of the order of the covariance over the square of the sine of elevation.
            assert!((ratio - 1.0).abs() < 0.06, "{elevation}°: {ratio}");
        }
    }
}
