//! Lookups: what they find on maps where the answer is known.

use std::sync::Arc;

use wrinkle::texture::{Footprint, Lookup, NormalMap, Wrap};

use super::fixture::{COARSE, COARSE_ERROR, Case, bumps, cases, half_vectors, moments, single};

/// A footprint of the whole of a map that repeats, longer than wide, by any lookup.
fn long(lookup: Lookup) -> Footprint {
    Footprint {
        u: 0.3,
        v: 0.4,
        along_x: [2.0, 0.5],
        along_y: [-0.1, 0.4],
        lookup,
        ..Footprint::default()
    }
}

#[test]
fn a_map_of_one_normal_is_that_normal_by_any_lookup() {
    let map = single(8, [0.3, -0.2, 1.0]);
    for case in cases() {
        let filtered = case.on(&map);
        let trilinear = filtered.lobes_at(&long(Lookup::Trilinear));
        for lookup in Lookup::ALL {
            let found = filtered.lobes_at(&long(lookup));
            for h in half_vectors() {
                let (a, b) = (found.density(h), trilinear.density(h));
                // Single precision and its weights' sum; an exponent of 60 multiplies what is off.
                assert!((a - b).abs() <= 1e-3 * b + 1e-5, "{} {lookup:?}: {a} {b}", case.name);
            }
        }
    }
}

#[test]
fn whole_tiles_are_the_same_by_any_lookup() {
    // Whatever is looked up, the mean over many tiles is the mean over one: the vector moment, which all
    // normalised methods that keep roughness have from the map.
    let map = bumps(8, 8, Wrap::Repeat);
    let whole = Footprint { along_x: [8.0, 0.0], along_y: [0.0, 8.0], ..Footprint::whole() };
    for case in cases().iter().filter(|case| case.card.normalised && case.card.keeps_roughness) {
        let filtered = case.on(&map);
        let of = |lookup| {
            moments(&COARSE, &filtered.lobes_at(&Footprint { lookup, ..whole }), [0.0, 0.0, 1.0]).1
        };
        let trilinear = of(Lookup::Trilinear);
        for lookup in [Lookup::Anisotropic, Lookup::Ewa, Lookup::Exact] {
            let off = (of(lookup) - trilinear).norm();
            // The exact lookup interpolates normals, which pulls those between texels together.
            let between = if lookup == Lookup::Exact { 0.02 } else { 0.0 };
            let allowed = case.card.precision + COARSE_ERROR + between;
            assert!(off <= allowed, "{} {lookup:?}: {off}", case.name);
        }
    }
}

/// Waves along u alone: a footprint long in v and narrow in u sees one phase of them.
fn waves() -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(64, 64, Wrap::Repeat, |u, _| {
        [0.6 * (4.0 * std::f64::consts::TAU * u).sin(), 0.0, 1.0, 1.0]
    }))
}

#[test]
fn only_trilinear_lookups_blur_across_a_long_footprint() {
    let map = waves();
    // Two texels wide at a slope of the wave, 32 long.
    let at = |lookup| Footprint {
        u: 0.0625,
        v: 0.5,
        along_x: [2.0 / 64.0, 0.0],
        along_y: [0.0, 32.0 / 64.0],
        lookup,
        ..Footprint::default()
    };
    // Eight bits round a cell's numbers by as much as a lookup changes them; a fractal surface is as rough under any
    // footprint.
    let fine = |case: &&Case| {
        case.card.keeps_roughness && !case.card.fractal && !case.name.contains("8-bit")
    };
    for case in cases().iter().filter(fine) {
        let filtered = case.on(&map);
        // The narrower, the denser at its own axis.
        let peak = |lookup| {
            let surface = filtered.lobes_at(&at(lookup));
            let [x, .., weight] = map.sample(0.0625, 0.5);
            let z = (1.0 - x * x).sqrt();
            surface.density([x, 0.0, z]) / weight
        };
        let [trilinear, anisotropic, ewa, exact] = Lookup::ALL.map(peak);
        assert!(trilinear < 0.7 * exact, "{}: {trilinear} {exact}", case.name);
        assert!((anisotropic / exact - 1.0).abs() < 0.25, "{}: {anisotropic} {exact}", case.name);
        assert!((ewa / exact - 1.0).abs() < 0.15, "{}: {ewa} {exact}", case.name);
    }
}
