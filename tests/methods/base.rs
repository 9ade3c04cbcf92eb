//! Where there is one normal, a filter is the base lobe.

use wrinkle::lobe::{BaseLobe, MultipleSurface};
use wrinkle::texture::Wrap;

use super::fixture::{FINE, FINE_ERROR, bumps, cases, centres, footprint, integrate, single};

/// ½ ∫ |D − D_base| |cos| dω about the normal: a density below the base lobe's horizon counts too.
fn total_variation(surface: &MultipleSurface, base: &BaseLobe, normal: [f32; 3]) -> f64 {
    let [apart] = integrate(&FINE, normal, |h, cosine| {
        let tan_squared = (1.0 - cosine * cosine).max(0.0) / (cosine * cosine);
        let want = if cosine > 0.0 { base.density(tan_squared) } else { 0.0 };
        [0.5 * (f64::from(surface.density(h)) - want).abs() * cosine.abs()]
    });
    apart
}

#[test]
fn a_single_normal_gives_the_base_lobe() {
    for tilt in [0.0f64, 20.0, 45.0] {
        let (sine, cosine) = tilt.to_radians().sin_cos();
        let map = single(8, [0.8 * sine, -0.6 * sine, cosine]);
        let [x, y, z, _] = map.texel(0, 0);
        for case in cases() {
            let filtered = case.on(&map);
            for level in [0.0, 1.6, 3.0] {
                let surface = filtered.lobes_at(&footprint(&map, 0.4, 0.1, level));
                let apart = total_variation(&surface, &case.base, [x, y, z]);
                let allowed = case.base_error + FINE_ERROR;
                assert!(apart <= allowed, "{} at {tilt}°: {apart} > {allowed}", case.name);
            }
        }
    }
}

#[test]
fn at_a_texel_of_the_map_a_filter_is_the_unfiltered_lobe() {
    for wrap in [Wrap::Repeat, Wrap::Clamp] {
        let map = bumps(5, 4, wrap);
        // A fractal surface is as rough at a texel as it is all over.
        for case in cases().into_iter().filter(|case| !case.card.fractal) {
            let filtered = case.on(&map);
            for (k, at) in centres(&map, 0).iter().enumerate().step_by(7) {
                let [x, y, z, _] = map.texels()[k];
                let apart = total_variation(&filtered.lobes_at(at), &case.base, [x, y, z]);
                let allowed = case.base_error + FINE_ERROR;
                assert!(apart <= allowed, "{} texel {k}: {apart} > {allowed}", case.name);
            }
        }
    }
}
