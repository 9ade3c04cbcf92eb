//! Figures 4 and 5 and *The Local Coordinate System*: offset vectors in three local frames.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Images, Panel, Row, Series, Table, Task,
};
use super::bumped::Bumped;
use super::pyramids::{Level, bumps, recursive, vectors};
use crate::geometry::{Vec3, spherical_frame};
use crate::metric;
use crate::parameter::Value;
use crate::render::{Camera, Film, direction};
use crate::surface::{Axes, Hit, Plane, Shape, Sphere, Surface};

/// The row.
pub const ROW: Row = Row {
    name: "schilling-f4-f5",
    title: "Bump maps as offset vectors in three local frames, on a plane and on a sphere",
    parts: &[],
    parameters: &[],
    secs: 6.0,
    make,
};

/// The three, with what they are called.
fn all() -> [(&'static str, Axes); 3] {
    [
        ("natural", Axes::Natural),
        ("natural, normalised", Axes::Normalised),
        ("main direction z", Axes::MainDirection(Vec3::z())),
    ]
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![agree_on_a_plane()];
    exhibit.claims.extend(scales());
    task.go_on()?;
    let (turns, claims) = turns();
    exhibit.claims.extend(claims);
    exhibit.claims.push(interpolated());
    let (order, figure) = first_order();
    exhibit.claims.push(order);
    exhibit.figures.push(figure);
    exhibit.tables.push(turns);
    task.go_on()?;
    images(&mut exhibit, task)?;
    exhibit.remarks = vec![
        "The print says of frame 3 that e₂ is perpendicular to m and e₁ in the plane of n and m; its formulas, which \
         are used, make e₁ perpendicular to m."
            .into(),
        "s_u and s_v of the natural frame point to where u and v fall, e₁ and e₂ to where they rise. Slopes are \
         subtracted along e₁ and e₂ here, so that a map says the same in all three."
            .into(),
    ];
    Ok(exhibit)
}

/// The hit of the unit sphere, one tile round and one from pole to pole, at a longitude and latitude.
fn on_sphere(longitude: f64, latitude: f64) -> Hit {
    let out = spherical_frame(longitude, latitude).normal;
    let sphere = Sphere::new().tiled(1.0 / TAU, 0.5);
    sphere.trace(out * 3.0, -out).0
}

fn agree_on_a_plane() -> Claim {
    let hit = Plane::new().trace(Vec3::new(0.3, 0.2, 1.0), -Vec3::z()).0;
    let slopes = [0.7, -0.4];
    let want = Vec3::new(-0.7, 0.4, 1.0).normalize();
    let three = [Axes::Natural, Axes::Normalised, Axes::MainDirection(Vec3::y())];
    let off = three.map(|axes| (axes.perturbed(&hit, slopes) - want).norm());
    let worst = off.into_iter().fold(0.0, f64::max);
    Claim::at_most(
        "largest difference of the perturbed normals of the three frames on a plane, m along v",
        "n′ = n + f_u s_u + f_v s_v",
        1e-12,
        worst,
    )
}

/// Tangent of the angle that a slope along u turns the normal by.
fn tilt(axes: Axes, hit: &Hit) -> f64 {
    let normal = axes.perturbed(hit, [0.1, 0.0]);
    normal.cross(&hit.frame.normal).norm() / normal.dot(&hit.frame.normal)
}

/// What becomes of bumps where the map is laid smaller.
fn scales() -> Vec<Claim> {
    let plane = |tiles: f64| Plane::new().tiled(tiles, 1.0).trace(Vec3::z(), -Vec3::z()).0;
    let ratio = |axes: Axes| tilt(axes, &plane(4.0)) / tilt(axes, &plane(1.0));
    let north =
        |axes: Axes| tilt(axes, &on_sphere(0.3, PI / 3.0)) / tilt(axes, &on_sphere(0.3, 0.0));
    vec![
        Claim::near(
            "slope of the same bumps on a map laid at a quarter of its size, natural frame",
            4.0,
            ratio(Axes::Natural),
            1e-3,
        ),
        Claim::near(
            "the same, normalised frame (scale invariant)",
            1.0,
            ratio(Axes::Normalised),
            1e-3,
        ),
        Claim::near(
            "slope along u at latitude 60° of that at the equator, natural frame: bumps keep their height",
            2.0,
            north(Axes::Natural),
            1e-3,
        ),
        Claim::near("the same, main direction", 1.0, north(Axes::MainDirection(Vec3::z())), 1e-3),
    ]
}

/// How far the first axis turns, degrees, between points `apart` radians from each other: at most, about a
/// place.
fn turn(axes: Axes, place: Vec3, apart: f64) -> f64 {
    let about = crate::geometry::Frame::about(place);
    let axis = |i: u32| {
        let (sin, cos) = libm::sincos(TAU * (f64::from(i) + 0.25) / 16.0);
        let at = place + (about.tangent * cos + about.bitangent * sin) * (0.5 * apart);
        let hit =
            on_sphere(libm::atan2(at.y, at.x), libm::asin((at.z / at.norm()).clamp(-1.0, 1.0)));
        axes.at(&hit)[0].normalize()
    };
    let axes: Vec<Vec3> = (0..16).map(axis).collect();
    let pairs = axes.iter().flat_map(|a| axes.iter().map(move |b| a.dot(b)));
    libm::acos(pairs.fold(1.0, f64::min).clamp(-1.0, 1.0)).to_degrees()
}

fn turns() -> (Table, Vec<Claim>) {
    const APART: f64 = 1e-3;
    let places = [
        ("equator", spherical_frame(0.4, 0.0).normal),
        ("latitude 60°", spherical_frame(0.4, PI / 3.0).normal),
        ("north pole", Vec3::z()),
        ("on the x axis", Vec3::x()),
    ];
    let caption = "Largest turn of the first axis, degrees, between points 0.001 radians apart on the sphere: a \
                   continuous frame turns by about as much.";
    let head = ["frame", places[0].0, places[1].0, places[2].0, places[3].0];
    let mut table = Table::new("turns", caption, &head);
    let across = ("main direction x", Axes::MainDirection(Vec3::x()));
    let mut found = Vec::new();
    for (name, axes) in all().into_iter().chain([across]) {
        let turns = places.map(|(_, place)| turn(axes, place, APART));
        let mut row = vec![name.into()];
        row.extend(turns.iter().map(|&degrees| degrees.into()));
        table.push(row);
        found.push(turns);
    }
    let [natural, normalised, along_z, along_x] = found[..] else { unreachable!("four frames") };
    let pole = natural[2].min(normalised[2]);
    let ends = along_z[2].max(along_x[3]);
    let calm = found.iter().map(|turns| turns[0].max(turns[1])).fold(0.0, f64::max);
    let claims = vec![
        Claim::shown(
            "turn of the axes at the pole of spherical coordinates, natural frames, degrees",
            "an example of a mapping that makes problems is a sphere: at the pole, one coordinate is not unique",
            pole,
            "above 90 there, below 1 at the equator and at 60°",
            pole > 90.0 && calm < 1.0,
        ),
        Claim::shown(
            "turn of the axes at the ends of a constant main direction, degrees",
            "the directions of the axes should be a continuous function of the location; a good example is the mapping \
             onto a sphere, the direction of the axis of the earth as m",
            ends,
            "below 1",
            ends < 1.0,
        )
        .because(
            "no tangent field on a sphere is continuous everywhere: a main direction moves the two places to the ends \
             of m, and does not take them away; normals there are finite",
        ),
    ];
    (table, claims)
}

/// "The direct interpolation of two vectors with different lengths would cause the vector to change directions
/// faster close to the end with the shorter vector."
fn interpolated() -> Claim {
    let angle = |t: f64| {
        // 60° apart, the second four times as long.
        let (sin, cos) = libm::sincos(PI / 3.0);
        let [x, y] = [(1.0 - t) + 4.0 * t * cos, 4.0 * t * sin];
        libm::atan2(y, x).to_degrees()
    };
    let [short, long] = [angle(0.25), angle(1.0) - angle(0.75)];
    Claim::shown(
        "turn of an interpolated axis in the quarter beside the shorter of two axes 60° apart, of that beside the \
         longer, four times as long",
        "directions change faster close to the end with the shorter vector",
        short / long,
        "above 1",
        short > long,
    )
}

/// Error of the natural frame's normal against the surface P + F n itself.
fn first_order() -> (Claim, Figure) {
    let bump = |h: f64, u: f64, v: f64| h * (libm::sin(5.0 * u) + libm::cos(4.0 * v));
    let error = |h: f64| {
        let (u, v, d) = (0.7, 0.4, 1e-5);
        let at = |u: f64, v: f64| spherical_frame(u, v).normal * (1.0 + bump(h, u, v));
        let truth = (at(u + d, v) - at(u - d, v)).cross(&(at(u, v + d) - at(u, v - d))).normalize();
        let f_u = (bump(h, u + d, v) - bump(h, u - d, v)) / (2.0 * d) * TAU;
        let f_v = (bump(h, u, v + d) - bump(h, u, v - d)) / (2.0 * d) * PI;
        (Axes::Natural.perturbed(&on_sphere(u, v), [f_u, f_v]) - truth).norm()
    };
    let points: Vec<[f64; 2]> =
        (0..=12).map(|i| libm::exp10(-4.0 + 0.25 * f64::from(i))).map(|h| [h, error(h)]).collect();
    let order = libm::log10(points[8][1] / points[4][1]);
    let claim = Claim::near(
        "order of the natural frame's error against the displaced surface, in the height of the bumps (2: the normal \
         is right to first order, for a “sufficiently small” f)",
        2.0,
        order,
        0.05,
    );
    let series = vec![Series { label: "natural frame".into(), points, joined: true }];
    let chart = Chart {
        x: Axis::log("height of f, radii"),
        y: Axis::log("error of the unit normal"),
        series,
    };
    let caption =
        "The perturbed normal against that of the displaced surface p + f n/|n| on a sphere.";
    (claim, Figure::new("order", caption, Drawing::Chart(chart)))
}

const SIZE: (usize, usize) = (240, 180);
/// Samples a pixel of what the covariance is held to, and of the pictures of the frames.
const SAMPLES: [u32; 2] = [256, 16];

fn images(exhibit: &mut Exhibit, task: &Task) -> Result<(), Halted> {
    let (width, height) = SIZE;
    let grid = [
        ("count", Value::Number(2.0)),
        ("bevel", Value::Number(6.0)),
        ("depth", Value::Number(4.0)),
    ];
    let plates = levels("grid", &grid, task.seed);
    let plane = Shape::Plane(Plane::new().tiled(1.2, 1.0));
    let sphere = Shape::Sphere(Sphere::new().tiled(10.0 / TAU, 1.0));
    let scenes = [
        ("plane", &plane, Camera::orbiting(4.0, 45.0, -90.0, 32.0, width, height), 1.2),
        ("sphere", &sphere, Camera::orbiting(4.0, 65.0, -90.0, 32.0, width, height), 10.0 / TAU),
    ];
    let mut panels = Vec::new();
    for (name, shape, camera, tiles) in scenes {
        for (of, axes) in all() {
            task.go_on()?;
            // On the plane the axis z tells no direction; v does.
            let (of, axes) = match axes {
                Axes::MainDirection(_) if name == "plane" => {
                    ("main direction y", Axes::MainDirection(Vec3::y()))
                }
                axes => (of, axes),
            };
            let scene = scene(shape, camera, &plates, axes, tiles, 20.0);
            let film = Arc::new(scene.supersampled(SAMPLES[1], task.seed));
            let short = ["natural", "normalised", "main"][panels.len() % 3];
            panels.push(Panel::new(&format!("{name}-{short}"), format!("{name}: {of}"), film));
        }
    }
    let drawing = Images { panels, white: None, reference: None, across: 3 };
    let caption = "One bump map in the three frames. On the sphere bumps keep their height in the natural frame, and are \
                   steeper the smaller they get towards the pole; all frames turn round at the pole.";
    exhibit.figures.push(Figure::new("frames", caption, Drawing::Images(drawing)));
    let rough =
        [("slope_variance_u", Value::Number(0.01)), ("slope_variance_v", Value::Number(0.002))];
    let rough = levels("gaussian", &rough, task.seed);
    let camera = Camera::orbiting(4.0, 40.0, -90.0, 32.0, width, height);
    let fine = Shape::Sphere(Sphere::new().tiled(80.0 / TAU, 1.0));
    let scene = scene(&fine, camera, &rough, Axes::Natural, 80.0 / TAU, 60.0);
    by_covariance(exhibit, &scene, task)
}

/// The natural frame, whose slopes the matrix A stretches, by the paper's mean and covariance carried along.
fn by_covariance(exhibit: &mut Exhibit, scene: &Bumped, task: &Task) -> Result<(), Halted> {
    let truth = scene.supersampled(SAMPLES[0], task.seed + 1);
    task.go_on()?;
    let (one, filtered) = (scene.supersampled(1, task.seed), scene.by_covariance());
    let rmse = |film: &Film| metric::score("rmse", film, &truth).unwrap_or(f64::NAN);
    let [noise, left] = [rmse(&one), rmse(&filtered)];
    exhibit.claims.push(Claim::shown(
        "RMSE of the natural frame with mean and covariance carried to the surface, of one sample a pixel",
        "this representation is appropriate for most practical normal vector distributions",
        left / noise,
        "below 1/2",
        left < 0.5 * noise,
    ));
    let panel = |name: &str, label: &str, film: Film| Panel::new(name, label, Arc::new(film));
    let panels = vec![
        panel("carried-converged", "converged", truth)
            .remarked(format!("{} samples a pixel", SAMPLES[0])),
        panel("carried-sampled", "sampled bumps", one).remarked(format!("RMSE {noise:.3}")),
        panel("carried-covariance", "mean and covariance", filtered)
            .remarked(format!("RMSE {left:.3}")),
    ];
    let drawing = Images { panels, white: None, reference: Some(0), across: 3 };
    let caption = "Small bumps in the natural frame on a sphere: A x̄ and A K Aᵀ with the base lobe's variance, A the \
                   matrix from slopes in (s_u, s_v) to slopes in an orthonormal frame.";
    exhibit.figures.push(Figure::new("covariance", caption, Drawing::Images(drawing)));
    Ok(())
}

fn levels(pattern: &str, set: &[(&'static str, Value)], seed: u64) -> Vec<Level> {
    recursive(vectors(&bumps(pattern, 64, set, seed).normals), |k| k)
}

fn scene<'a>(
    shape: &'a Shape,
    camera: Camera,
    levels: &'a [Level],
    axes: Axes,
    tiles: f64,
    exponent: f64,
) -> Bumped<'a> {
    // At the equator, or anywhere on the plane, heights are in sides of a texel.
    let texel = 1.0 / (tiles * levels[0].side as f64);
    Bumped { shape, camera, levels, axes, texel, light: direction(45.0, -50.0), exponent }
}
