//! docs/conventions.md held to the program: a second renderer, written from the page alone in plain
//! double precision, must make the same pictures.
#![allow(clippy::disallowed_methods, reason = "tests compare numbers within tolerances")]

#[path = "conventions/brute.rs"]
mod brute;

use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::Arc;

use brute::{Brute, Lamp, Lobe, Map, Solid};
use wrinkle::geometry::Vec3;
use wrinkle::light::Light;
use wrinkle::lobe::{BaseLobe, MultipleSurface, Shading};
use wrinkle::method::{BATCH, Batch, Lane, Prefiltered, Silent, build};
use wrinkle::render::{Camera, Film, PixelSampler, View, average, direction, render, stream};
use wrinkle::surface::{Plane, Shape, Sphere, Surface};
use wrinkle::texture::image_file::{Green, NormalReading, Zero, read_normal_map};
use wrinkle::texture::{Footprint, Interpolation, Lookup, NormalMap, Wrap};

const SEED: u64 = 3;

/// 8-bit colours of a map of 4 × 3 texels, the picture's top row first: no two alike, none symmetric.
const COLOURS: [[[u8; 3]; 4]; 3] = [
    [[150, 120, 250], [128, 170, 240], [100, 128, 245], [127, 127, 255]],
    [[160, 160, 230], [90, 140, 235], [128, 100, 250], [140, 110, 240]],
    [[128, 128, 255], [120, 90, 230], [170, 130, 238], [110, 150, 244]],
];

fn write_png(path: &Path) {
    let image = image::RgbImage::from_fn(4, 3, |x, y| image::Rgb(COLOURS[y as usize][x as usize]));
    image.save(path).unwrap();
}

fn read_png(reading: &NormalReading) -> NormalMap {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.png");
    write_png(&path);
    read_normal_map(&path, reading).unwrap().map
}

/// The scene of most tests here; both renderers are told of it in their own words.
fn brute() -> Brute {
    Brute {
        distance: 4.0,
        elevation: 35.0,
        azimuth: -70.0,
        fov: 30.0,
        size: [17, 12],
        solid: Solid::Plane,
        tiles: [0.6, 0.6 * 4.0 / 3.0],
        lamp: Lamp::Far { elevation: 40.0, azimuth: 100.0, irradiance: 2.5 },
        lobe: Lobe::Phong(60.0),
        microfacet: false,
        map: Map::from_top_rows(&COLOURS),
    }
}

fn view_of(scene: &Brute) -> View {
    let [width, height] = scene.size;
    View {
        camera: Camera::orbiting(
            scene.distance,
            scene.elevation,
            scene.azimuth,
            scene.fov,
            width,
            height,
        ),
        surface: match scene.solid {
            Solid::Plane => Shape::Plane(Plane::new().tiled(scene.tiles[0], 0.75)),
            Solid::Sphere => Shape::Sphere(Sphere::new().tiled(scene.tiles[0] / TAU, 0.75)),
        },
        light: match scene.lamp {
            Lamp::Far { elevation, azimuth, irradiance } => {
                Light::Directional { direction: direction(elevation, azimuth), irradiance }
            }
            Lamp::Near { position: [x, y, z], intensity } => {
                Light::Point { position: Vec3::new(x, y, z), intensity }
            }
        },
        shading: if scene.microfacet { Shading::Microfacet } else { Shading::Ndf },
        wrap: if scene.map.repeats { Wrap::Repeat } else { Wrap::Clamp },
        lookup: Lookup::default(),
    }
}

fn base_of(lobe: Lobe) -> BaseLobe {
    match lobe {
        Lobe::Phong(exponent) => BaseLobe::BlinnPhong { exponent },
        Lobe::Beckmann(alpha) => BaseLobe::Beckmann { alpha },
        Lobe::Ggx(alpha) => BaseLobe::Ggx { alpha },
    }
}

fn film_of(scene: &Brute, spp: u32) -> Film {
    let reading = NormalReading { wrap: view_of(scene).wrap, ..Default::default() };
    let nearest = if scene.map.facets { Interpolation::Nearest } else { Interpolation::Bilinear };
    let map = Arc::new(read_png(&reading).with_interpolation(nearest));
    let unfiltered = build("unfiltered").unwrap();
    let map = unfiltered.prefilter(&map, &base_of(scene.lobe), &Silent).unwrap();
    let sampler = PixelSampler::new(spp);
    render(&view_of(scene), map.as_ref(), &sampler, SEED, 0, &|| false).unwrap()
}

/// Holds the program's picture to the other renderer's, both with samples at `positions(pixel)`, each
/// pixel to 10⁻⁵ of the brightest.
fn assert_same_picture(scene: &Brute, spp: u32, what: &str) {
    let film = film_of(scene, spp);
    let sampler = PixelSampler::new(spp);
    let [width, height] = scene.size;
    let own: Vec<f64> = (0..width * height)
        .map(|pixel| {
            let (x, y) = ((pixel % width) as f64, (pixel / width) as f64);
            let places = sampler.positions(stream(SEED, 0, pixel));
            let sum: f64 = places.iter().map(|[dx, dy]| scene.radiance(x + dx, y + dy)).sum();
            sum / f64::from(spp)
        })
        .collect();
    let brightest = own.iter().fold(0.0, |a: f64, b| a.max(*b));
    assert!(brightest > 0.01, "{what}: a black picture proves nothing");
    for (pixel, (got, want)) in film.pixels().iter().zip(&own).enumerate() {
        let error = (f64::from(*got) - want).abs() / brightest;
        assert!(error < 1e-5, "{what}, pixel {pixel}: {got} for {want}");
    }
}

#[test]
fn every_material_light_and_surface_makes_the_same_picture() {
    let lamps = [brute().lamp, Lamp::Near { position: [0.5, 1.5, 1.2], intensity: 3.0 }];
    for lobe in [Lobe::Phong(60.0), Lobe::Beckmann(0.3), Lobe::Ggx(0.2)] {
        for microfacet in [false, true] {
            for lamp in lamps {
                let on_plane = Brute { lobe, microfacet, lamp, ..brute() };
                assert_same_picture(&on_plane, 1, &format!("plane {lobe:?} {microfacet} {lamp:?}"));
                // 5 tiles round the equator; half of that times 4/3 up, so that texels are square there.
                let tiles = [5.0, 0.5 * 5.0 * 4.0 / 3.0];
                let on_sphere = Brute { solid: Solid::Sphere, tiles, ..on_plane };
                assert_same_picture(
                    &on_sphere,
                    1,
                    &format!("sphere {lobe:?} {microfacet} {lamp:?}"),
                );
            }
        }
    }
}

#[test]
fn edges_and_interpolation_are_as_the_page_says() {
    for repeats in [false, true] {
        for facets in [false, true] {
            let scene = Brute { map: Map { repeats, facets, ..brute().map }, ..brute() };
            assert_same_picture(&scene, 1, &format!("repeats {repeats}, facets {facets}"));
        }
    }
}

#[test]
fn a_pixel_is_the_mean_over_its_square() {
    assert_same_picture(&brute(), 16, "16 samples");
    // And the samples may lie anywhere in it: a plain grid converges to the same picture.
    let (scene, n) = (brute(), 64);
    let film = film_of(&scene, 4096);
    for (pixel, got) in film.pixels().iter().enumerate() {
        let (x, y) = ((pixel % 17) as f64, (pixel / 17) as f64);
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
        let sum: f64 = (0..n * n).map(|k| scene.radiance(x + at(k % n), y + at(k / n))).sum();
        let want = sum / f64::from(n * n);
        assert!((f64::from(*got) / want - 1.0).abs() < 2e-3, "pixel {pixel}: {got} for {want}");
    }
}

#[test]
fn one_sample_is_the_centre_and_more_are_a_net() {
    assert_eq!(PixelSampler::new(1).positions(77), [[0.5, 0.5]]);
    // 16 points: one in each of the 16 equal boxes of every shape with sides 2⁻ᵃ × 2⁻⁽⁴⁻ᵃ⁾.
    for pixel in 0..20 {
        let points = PixelSampler::new(16).positions(stream(SEED, 0, pixel));
        for a in 0..=4 {
            let (across, down) = (1u32 << a, 16u32 >> a);
            let cell = |[x, y]: &[f64; 2]| {
                (x * f64::from(across)) as u32 * down + (y * f64::from(down)) as u32
            };
            let mut cells: Vec<u32> = points.iter().map(cell).collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..16).collect::<Vec<_>>(), "boxes 1/{across} × 1/{down}");
        }
    }
    let streams = [stream(1, 0, 0), stream(1, 0, 1), stream(1, 1, 0), stream(2, 0, 0)];
    for (i, one) in streams.iter().enumerate() {
        assert!(streams[i + 1..].iter().all(|other| other != one), "streams share numbers");
    }
}

#[test]
fn a_files_top_row_is_the_maps_last_and_green_may_be_turned() {
    let up = read_png(&NormalReading::default());
    let down = read_png(&NormalReading { green: Green::Down, ..Default::default() });
    for (row, colours) in COLOURS.iter().enumerate() {
        for (i, colour) in colours.iter().enumerate() {
            let raw = colour.map(|c| 2.0 * f64::from(c) / 255.0 - 1.0);
            let length = raw.iter().map(|c| c * c).sum::<f64>().sqrt();
            let (got, turned) = (up.texel(i, 2 - row), down.texel(i, 2 - row));
            for c in 0..3 {
                assert!((f64::from(got[c]) - raw[c] / length).abs() < 1e-6, "row {row}, {i}");
                assert_eq!(turned[c], if c == 1 { -got[c] } else { got[c] });
            }
            assert_eq!(got[3], 1.0);
        }
    }
}

#[test]
fn what_128_means() {
    // The first texel of the bottom row is (128, 128, 255).
    let slope = |zero| {
        let [x, _, z, _] = read_png(&NormalReading { zero, ..Default::default() }).texel(0, 0);
        x / z
    };
    assert!((slope(Zero::Middle) - 1.0 / 255.0).abs() < 1e-6);
    assert_eq!(slope(Zero::Above), 0.0);
}

#[test]
fn heights_become_normals_by_central_differences() {
    use wrinkle::pattern::file::{Reading, read};
    use wrinkle::texture::image_file::HeightReading;
    let grey: [[u8; 3]; 3] = [[0, 51, 255], [102, 204, 25], [77, 5, 128]]; // top row first
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("heights.png");
    image::GrayImage::from_fn(3, 3, |x, y| image::Luma([grey[y as usize][x as usize]]))
        .save(&path)
        .unwrap();
    let reading = HeightReading { height_scale: 6.0, wrap: Wrap::Repeat };
    let map = read(&path, &Reading::Heights(reading)).unwrap().normals;
    let height = |i: usize, j: usize| 6.0 * f64::from(grey[2 - j % 3][i % 3]) / 255.0;
    for j in 0..3 {
        for i in 0..3 {
            let along_u = (height(i + 1, j) - height(i + 2, j)) / 2.0;
            let along_v = (height(i, j + 1) - height(i, j + 2)) / 2.0;
            let [x, y, z, _] = map.texel(i, j).map(f64::from);
            assert!((x / z + along_u).abs() < 1e-5 && (y / z + along_v).abs() < 1e-5, "{i} {j}");
        }
    }
}

#[test]
fn frames_are_right_handed_and_follow_u_and_v() {
    let surfaces = [Shape::Plane(Plane::new()), Shape::Sphere(Sphere::new().tiled(0.5, 0.75))];
    for surface in surfaces {
        let at = |x: f64, y: f64| {
            surface.intersect(Vec3::new(x, y, 3.0), Vec3::new(0.1, -0.05, -1.0)).unwrap()
        };
        let (hit, step) = (at(0.2, 0.3), 1e-6);
        let frame = hit.frame;
        assert!((frame.tangent.cross(&frame.bitangent) - frame.normal).norm() < 1e-12);
        for (dx, dy) in [(step, 0.0), (0.0, step)] {
            let near = at(0.2 + dx, 0.3 + dy);
            let moved = near.point - hit.point;
            let axes = [(frame.tangent, 0), (frame.bitangent, 1)];
            for (axis, c) in axes {
                // Moving along the tangent changes u alone, and raises it; v likewise.
                let rate = hit.gradient[c].norm();
                let want = rate * moved.dot(&axis);
                assert!((near.uv[c] - hit.uv[c] - want).abs() < 1e-10, "{surface:?}");
                assert!((hit.gradient[c] / rate - axis).norm() < 1e-9);
            }
        }
    }
}

#[test]
fn the_poles_are_finite() {
    let camera = Camera::look_at(Vec3::new(0.0, 0.0, 4.0), Vec3::zeros(), 25.0, 9, 9);
    for azimuth in [0.0, 137.0] {
        let lamp = Lamp::Far { elevation: 50.0, azimuth, irradiance: 1.0 };
        let scene = Brute { solid: Solid::Sphere, tiles: [5.0, 10.0 / 3.0], lamp, ..brute() };
        let view = View { camera, ..view_of(&scene) };
        let centre = view.footprint(4.5, 4.5).unwrap();
        assert!(centre.along_x.iter().chain(&centre.along_y).all(|d| d.is_finite()));
        let map = Arc::new(read_png(&NormalReading::default()));
        for method in ["unfiltered", "schilling-anisotropic", "fournier"] {
            let base = base_of(scene.lobe);
            let map = build(method).unwrap().prefilter(&map, &base, &Silent).unwrap();
            let sampler = PixelSampler::new(4);
            let film = render(&view, map.as_ref(), &sampler, SEED, 0, &|| false).unwrap();
            assert!(film.pixels().iter().all(|p| p.is_finite() && *p >= 0.0), "{method}");
        }
    }
}

#[test]
fn light_below_the_surface_is_none_and_facing_is_not_foreshortened() {
    // A flat map seen and lit from straight above: radiance E · D(0), at any angle of incidence where
    // the half vector is the normal.
    let flat = Arc::new(NormalMap::new(1, 1, Wrap::Repeat, vec![[0.0, 0.0, 1.0, 1.0]]));
    let base = BaseLobe::BlinnPhong { exponent: 60.0 };
    let map = build("unfiltered").unwrap().prefilter(&flat, &base, &Silent).unwrap();
    let shine = |eye: f64, light: f64| {
        let light = Light::Directional { direction: direction(light, 90.0), irradiance: 2.5 };
        let camera = Camera::orbiting(4.0, eye, -90.0, 20.0, 1, 1);
        let surface = Shape::Plane(Plane::new());
        let (shading, wrap, lookup) = (Shading::Ndf, Wrap::Repeat, Lookup::default());
        let view = View { camera, surface, light, shading, wrap, lookup };
        render(&view, map.as_ref(), &PixelSampler::new(1), 0, 0, &|| false).unwrap().pixels()[0]
    };
    let peak = (2.5 * 62.0 / TAU) as f32;
    for elevation in [10.0, 40.0, 80.0] {
        assert!((shine(elevation, elevation) / peak - 1.0).abs() < 1e-4, "{elevation}°");
    }
    assert!(shine(40.0, 0.5) > 0.0);
    assert_eq!(shine(40.0, -0.5), 0.0);
}

/// A "map" whose radiance is the pyramid level its footprints ask for.
struct Levels;

impl Prefiltered for Levels {
    fn bytes(&self) -> usize {
        0
    }

    fn lobes_at(&self, _: &Footprint) -> MultipleSurface {
        MultipleSurface::new()
    }

    fn shade(&self, batch: &Batch, _: Shading, radiance: &mut Lane) {
        for (i, out) in radiance.iter_mut().enumerate().take(batch.len.min(BATCH)) {
            *out = batch.footprint(i).level(4, 3);
        }
    }
}

#[test]
fn levels_and_tilings_follow_the_footprint() {
    let scene = brute();
    let view = view_of(&scene);
    let rate = scene.texels_per_step(8.5, 6.0);
    let area = (rate[0][0] * rate[1][1] - rate[0][1] * rate[1][0]).abs();
    let centre = view.footprint(8.5, 6.0).unwrap();
    assert!((centre.texels_across(4, 3) / area.sqrt() - 1.0).abs() < 1e-5);
    let longest = rate.map(|[u, v]| u.hypot(v)).into_iter().fold(0.0, f64::max);
    assert!((f64::from(centre.level(4, 3)) - longest.log2()).abs() < 1e-5);
    // A sample's footprint is the pixel's, √spp times smaller a side: 4 samples, one level down.
    let levels = |spp| {
        let sampler = PixelSampler::new(spp);
        render(&view, &Levels, &sampler, SEED, 0, &|| false).unwrap().pixels()[8 + 17 * 6]
    };
    assert!((levels(1) - levels(4) - 1.0).abs() < 0.02);
    assert!((levels(1) - levels(64) - 3.0).abs() < 0.02);
}

#[test]
fn a_spec_tiles_to_the_texels_it_asks_for() {
    use wrinkle::experiment::preview::{Wish, render_frames};
    use wrinkle::experiment::spec::Spec;
    let folder = tempfile::tempdir().unwrap();
    write_png(&folder.path().join("map.png"));
    let spec = "[image]\nwidth = 17\nheight = 12\n\
        [sweep]\ntexture = [\"mine\"]\nmethod = [\"unfiltered\"]\n\
        [texture.mine]\nfile = \"map.png\"\nkind = \"normal\"\n";
    let spec = Spec::parse(spec, &folder.path().join("spec.toml")).unwrap();
    let wish = Wish { texture: None, texels_per_pixel: Some(0.4), spp: 1, frame: 0 };
    let method = build("unfiltered").unwrap();
    let silent = &wrinkle::method::Silent;
    let frames = render_frames(&spec, method.as_ref(), &wish, 1, silent, &|_| ()).unwrap();
    let film = &frames.films[0];
    // The defaults of docs/experiments.md.
    let scene = Brute {
        elevation: 40.0,
        azimuth: -90.0,
        fov: 25.0,
        lamp: Lamp::Far { elevation: 40.0, azimuth: 90.0, irradiance: 1.0 },
        tiles: [1.0, 4.0 / 3.0],
        ..brute()
    };
    let rate = scene.texels_per_step(8.5, 6.0);
    let across = (rate[0][0] * rate[1][1] - rate[0][1] * rate[1][0]).abs().sqrt();
    let tiles = 0.4 / across;
    let scene = Brute { tiles: [tiles, tiles * 4.0 / 3.0], ..scene };
    let brightest = film.pixels().iter().fold(0.0f32, |a, b| a.max(*b));
    for (pixel, got) in film.pixels().iter().enumerate() {
        let want = scene.radiance((pixel % 17) as f64 + 0.5, (pixel / 17) as f64 + 0.5);
        let error = (f64::from(*got) - want).abs() / f64::from(brightest);
        assert!(error < 1e-5, "pixel {pixel}: {got} for {want}");
    }
}

#[test]
fn weights_scale_light_and_are_interpolated() {
    let up = |w| [0.0, 0.0, 1.0, w];
    let map = Arc::new(NormalMap::new(2, 1, Wrap::Clamp, vec![up(1.0), up(3.0)]));
    let base = BaseLobe::Ggx { alpha: 0.3 };
    let map = build("unfiltered").unwrap().prefilter(&map, &base, &Silent).unwrap();
    for (u, weight) in [(0.0, 1.0), (0.25, 1.0), (0.4, 1.6), (0.5, 2.0), (0.75, 3.0), (1.0, 3.0)] {
        let at = Footprint { u, v: 0.5, ..Footprint::default() };
        let density = f64::from(map.lobes_at(&at).density([0.0, 0.0, 1.0]));
        assert!((density / (weight * Lobe::Ggx(0.3).density(1.0)) - 1.0).abs() < 1e-5, "u = {u}");
    }
}

#[test]
fn a_sphere_takes_whole_tiles_and_a_camera_above_has_north_on_top() {
    for (asked, round) in [(5.3, 5.0), (5.6, 6.0), (0.2, 1.0)] {
        let sphere = Sphere::new().tiled(asked / TAU, 0.75);
        assert!((sphere.tiles_across() * TAU - round).abs() < 1e-12);
    }
    let [right, down] = Camera::orbiting(4.0, 90.0, 30.0, 25.0, 8, 8).ray_steps();
    assert!(right.normalize().x > 1.0 - 1e-9 && down.normalize().y < -1.0 + 1e-9);
}

#[test]
fn a_reference_is_the_mean_of_its_replicates_and_knows_its_error() {
    let films = [[1.0, 4.0], [3.0, 4.0]].map(|pixels| Film::new(2, 1, pixels.to_vec()));
    let reference = average(&films, 512);
    assert_eq!(reference.film.pixels(), [2.0, 4.0]);
    // Σ (rₖ − r̄)² / (R (R − 1)) is 1 and 0 for the two pixels; its root mean is √½.
    assert!((reference.rmse - 0.5f64.sqrt()).abs() < 1e-12);
}

#[test]
fn every_base_lobe_is_as_printed_here_and_has_unit_projected_area() {
    for lobe in [Lobe::Phong(10.0), Lobe::Beckmann(0.5), Lobe::Ggx(0.5)] {
        let n = 20_000;
        let mut area = 0.0;
        for i in 0..n {
            let theta = (f64::from(i) + 0.5) / f64::from(n) * PI / 2.0;
            let density = lobe.density(theta.cos());
            let theirs = base_of(lobe).density(theta.tan().powi(2));
            assert!((density - theirs).abs() <= 1e-9 * (1.0 + density), "{lobe:?} {theta}");
            area += density * theta.cos() * TAU * theta.sin() * PI / 2.0 / f64::from(n);
        }
        assert!((area - 1.0).abs() < 1e-4, "{lobe:?}: {area}");
    }
}
