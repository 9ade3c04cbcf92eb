//! Under an environment: white stays white, flat maps are what brute force finds, threads do not matter.

use std::sync::Arc;

use wrinkle::geometry::Frame;
use wrinkle::light::environment::{Environment, maps};
use wrinkle::light::{Filter, Light, mirrored};
use wrinkle::lobe::{BaseLobe, Shading};
use wrinkle::method::{MeanNormals, Truth, brute_force};
use wrinkle::parameter::Values;
use wrinkle::render::{Camera, Film, Filtered, PixelSampler, View, reference_replicate, trial};
use wrinkle::surface::{Plane, Shape, Sphere};
use wrinkle::texture::{Lookup, NormalMap, Wrap};

use super::fixture::{BASES, Case, bumps, cases, footprint, hemisphere, single, top, weighted};

fn environment(name: &str, height: usize) -> Arc<Environment> {
    let entry = maps::find(name).unwrap();
    let radiance = (entry.build)(&Values::defaults(entry.parameters));
    Arc::new(Environment::of(&*radiance, height, 20.0, 1.0))
}

/// Unit directions from straight above to all but level.
fn views() -> Vec<[f32; 3]> {
    let mut all = vec![[0.0, 0.0, 1.0]];
    for (k, elevation) in [70.0f64, 45.0, 20.0, 8.0, 3.0].into_iter().enumerate() {
        let (up, flat) = elevation.to_radians().sin_cos();
        let (sin, cos) = (1.3 + 2.1 * k as f64).sin_cos();
        all.push([flat * cos, flat * sin, up].map(|c| c as f32));
    }
    all
}

/// The farthest from 1 that the map comes under white light, over levels and views.
fn farthest_from_white(case: &Case, map: &Arc<NormalMap>, white: &Environment) -> f64 {
    let (filtered, means) = (case.on(map), MeanNormals::beside(&case.card, map));
    let frame = Frame::about(wrinkle::geometry::Vec3::z());
    let mut farthest = 0.0f64;
    for level in [-1.0, 0.0, 0.7, 2.0, top(map) as f32] {
        let at = footprint(map, 0.31, 0.77, level);
        let surface = filtered.lobes_at(&at);
        for view in views() {
            let mean = means.as_ref().map(|means| means.at(&at));
            // A footprint that shows the eye nothing has no colour.
            let shown = mean.is_none_or(|m| {
                m[0] * view[0] + m[1] * view[1] + m[2] * view[2] > 0.02 * view[2].max(0.3)
            });
            let seen = mirrored(white, Filter::Elliptic, &surface, mean, &frame, view);
            if shown && seen.area > 0.0 {
                farthest = farthest.max((seen.light / seen.area - 1.0).abs());
            }
        }
    }
    farthest
}

#[test]
fn white_stays_white_for_methods_that_keep_energy_and_for_no_other() {
    let white = environment("white", 16);
    let maps = [bumps(8, 8, Wrap::Repeat), weighted(5, 3), hemisphere(16)];
    let mut wrong = vec![];
    for case in cases() {
        let far = maps.iter().map(|map| farthest_from_white(&case, map, &white));
        let far: Vec<f64> = far.collect();
        let kept = far.iter().all(|f| *f <= case.card.precision.max(1e-3));
        if kept != case.card.normalised {
            wrong.push(format!("{}: {far:?}, {}", case.name, case.card.precision));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn view(shape: Shape, light: Light, elevation: f64) -> View {
    let camera = Camera::orbiting(4.0, elevation, -90.0, 40.0, 8, 6);
    let surface = shape.tiled(2.0, 1.0);
    let (shading, wrap, lookup) = (Shading::Ndf, Wrap::Repeat, Lookup::default());
    View { camera, surface, light, shading, wrap, lookup }
}

fn under(environment: &Arc<Environment>, filter: Filter) -> Light {
    Light::Environment { environment: Arc::clone(environment), filter }
}

fn unfiltered(view: &View, map: &Arc<NormalMap>, base: &BaseLobe, spp: u32) -> Film {
    let method = brute_force();
    let prefiltered = method.prefilter(map, base, &wrinkle::method::Silent).unwrap();
    let filtered = Filtered { map, card: method.card(), prefiltered: prefiltered.as_ref() };
    trial(view, &filtered, &PixelSampler::new(spp), 1, 0, &|| false).unwrap()
}

fn truth(view: &View, map: &Arc<NormalMap>, base: &BaseLobe, spp: u32) -> Film {
    let of = (Truth::Bumps, map, base);
    reference_replicate(view, of, &PixelSampler::new(spp), 1, 1, &|| false).unwrap()
}

fn mean(film: &Film) -> f64 {
    film.pixels().iter().map(|p| f64::from(*p)).sum::<f64>() / film.pixels().len() as f64
}

#[test]
fn white_is_exactly_white_in_truth() {
    let white = environment("white", 16);
    for base in BASES {
        for elevation in [90.0, 30.0, 5.0] {
            let view = view(Shape::Plane(Plane::new()), under(&white, Filter::Elliptic), elevation);
            let film = truth(&view, &bumps(8, 8, Wrap::Repeat), &base, 16);
            assert!(film.pixels().iter().all(|p| *p == 1.0), "{base}: {:?}", film.pixels());
        }
    }
}

#[test]
fn a_flat_map_is_what_brute_force_finds() {
    let flat = single(4, [0.0, 0.0, 1.0]);
    let mut all = vec![];
    for name in ["studio", "moon"] {
        let light = under(&environment(name, 128), Filter::Elliptic);
        for base in BASES {
            for elevation in [75.0, 40.0, 15.0] {
                let view = view(Shape::Plane(Plane::new()), light.clone(), elevation);
                let (got, want) =
                    (unfiltered(&view, &flat, &base, 16), truth(&view, &flat, &base, 2048));
                let pairs = got.pixels().iter().zip(want.pixels());
                let square: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
                let rms = (square / got.pixels().len() as f64).sqrt() / mean(&want);
                all.push((format!("{name} {base} {elevation}"), rms, mean(&got) / mean(&want)));
            }
        }
    }
    println!("{all:#?}");
    // A cone stands for the mirrored lobe to second moments.
    let bad: Vec<_> = all.iter().filter(|(_, rms, _)| *rms > 0.1).collect();
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn background_is_the_same_in_truth_and_trial_and_films_at_any_thread_count() {
    let moon = environment("moon", 64);
    let view = view(Shape::Sphere(Sphere::new()), under(&moon, Filter::Round), 10.0);
    let (map, base) = (bumps(8, 8, Wrap::Repeat), BASES[0]);
    let films = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| (unfiltered(&view, &map, &base, 4), truth(&view, &map, &base, 16)))
    };
    let (one, three) = (films(1), films(3));
    assert_eq!(one, three);
    let corners = [0, 7, 40, 47].map(|i| (one.0.pixels()[i], one.1.pixels()[i]));
    assert!(corners.iter().all(|(a, b)| a == b && *a > 0.0), "{corners:?}");
}
