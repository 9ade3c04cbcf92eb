//! What a multiple surface reflects in the plane of incidence (Fournier 1992 §4: it implies a BRDF).

use super::vector::{V3, unit};
use super::{MultipleSurface, Shading};

/// Steps of the angle of exit a degree.
const STEPS: i32 = 2;

/// [angle of exit, radiance] from −90° to 90° by half degrees, for light of unit irradiance on a plane
/// facing it.
///
/// The plane of incidence stands on the surface along the direction `azimuth` degrees from +x towards
/// +y. The light comes from its negative side, `incidence` degrees from the normal, so that a mirror
/// would send it to the angle `incidence`. All zero for light at or below the horizon. Radiance is as
/// [`Shading`] defines it: with `ndf` there is no cosine to the light.
pub fn reflection(
    surface: &MultipleSurface,
    shading: Shading,
    incidence: f64,
    azimuth: f64,
) -> Vec<[f64; 2]> {
    let (sin, cos) = libm::sincos(azimuth.to_radians());
    let toward = |degrees: f64| -> V3 {
        let (across, up) = libm::sincos(degrees.to_radians());
        [(across * cos) as f32, (across * sin) as f32, up as f32]
    };
    let light = toward(-incidence);
    let lit = incidence.abs() < 90.0;
    let exit = |step: i32| {
        let degrees = f64::from(step) / f64::from(STEPS);
        let view = toward(degrees);
        let half = unit([0, 1, 2].map(|c| light[c] + view[c]));
        let radiance = if lit { surface.radiance(shading, half, light, view) } else { 0.0 };
        [degrees, f64::from(radiance)]
    };
    (-90 * STEPS..=90 * STEPS).map(exit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::{PhongPeak, find_named, named};

    fn one_peak(exponent: f32) -> MultipleSurface {
        let mut surface = MultipleSurface::new();
        surface.add(PhongPeak { amplitude: 2.0, direction: [0.0, 0.0, 1.0], exponent }, 1.0);
        surface
    }

    #[test]
    fn a_peak_about_the_normal_reflects_like_a_mirror() {
        for incidence in [0.0, 30.0, 60.0] {
            let found = reflection(&one_peak(50.0), Shading::Ndf, incidence, 20.0);
            let most = found.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
            assert_eq!(most[0], incidence);
            // D(h) of the half angle between mirror direction and exit.
            for [exit, radiance] in found {
                let half = ((exit - incidence) / 2.0).to_radians();
                let want = 2.0 * half.cos().powf(50.0);
                assert!((radiance - want).abs() < 1e-4, "{incidence} {exit}: {radiance} {want}");
            }
        }
    }

    #[test]
    fn symmetric_surfaces_have_symmetric_plots() {
        for name in ["velvet", "three-normals", "anisotropic"] {
            let surface = find_named(name).unwrap().surface();
            for shading in [Shading::Ndf, Shading::Microfacet] {
                let found = reflection(&surface, shading, 0.0, 0.0);
                for (a, b) in found.iter().zip(found.iter().rev()) {
                    assert!(
                        (a[1] - b[1]).abs() <= 1e-4 * a[1].abs().max(1e-3),
                        "{name} {shading:?} {}: {} {}",
                        a[0],
                        a[1],
                        b[1]
                    );
                }
            }
        }
    }

    #[test]
    fn the_bare_distribution_is_reciprocal() {
        // Exchanging light and eye mirrors the plane: the same half vector.
        let surface = find_named("silk").unwrap().surface();
        let at = |incidence: f64, exit: f64, azimuth: f64| {
            let found = reflection(&surface, Shading::Ndf, incidence, azimuth);
            found.into_iter().find(|[angle, _]| *angle == exit).unwrap()[1]
        };
        for (incidence, exit) in [(10.0, 40.0), (60.0, -20.0), (75.0, 30.0)] {
            let (one, other) = (at(incidence, exit, 30.0), at(exit, incidence, 210.0));
            assert!((one - other).abs() <= 1e-5 * one.max(1e-3), "{one} {other}");
        }
    }

    #[test]
    fn nothing_is_lit_from_below_and_all_is_finite() {
        for surface in named().iter().map(|named| named.surface()) {
            for shading in [Shading::Ndf, Shading::Microfacet] {
                assert!(reflection(&surface, shading, 90.0, 0.0).iter().all(|e| e[1] == 0.0));
                let grazing = reflection(&surface, shading, 89.5, 45.0);
                assert!(grazing.iter().all(|e| e[1].is_finite() && e[1] >= 0.0));
            }
        }
    }
}
