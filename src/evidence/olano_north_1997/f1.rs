//! Figure 1: a sphere with a rippled normal distribution map, at two map scales.

use std::sync::Arc;

use super::super::{Claim, Drawing, Exhibit, Figure, Halted, Images, Panel, Row, Table, Task};
use super::body::on_body;
use super::common::{EXPONENT, Highlight, highlight, method, prefiltered};
use crate::geometry::Vec3;
use crate::light::Light;
use crate::lobe::{BaseLobe, Shading};
use crate::render::{Camera, Film, PixelSampler, View, direction, render};
use crate::surface::{Shape, Sphere};
use crate::texture::{Lookup, NormalMap, Wrap};

/// The row.
pub const ROW: Row = Row {
    name: "olano-f1",
    title: "A sphere with a rippled map at two scales: where ripples are under-sampled, the highlight blurs and \
            lengthens across them",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 4.0,
    make,
};

/// Pixels along a side.
const SIDE: usize = 256;
/// Samples a pixel of converged images.
const CONVERGED: u32 = 256;
/// Tiles round the sphere, four ripples to a tile: ripples some 20 pixels apart, and three to a pixel.
const SCALES: [(&str, f64); 2] = [("ripples seen", 8.0), ("ripples under-sampled", 512.0)];

/// Ripples along v with slopes up to 0.3, or none.
fn map(slope: f64) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(64, 64, Wrap::Repeat, |_, v| {
        [0.0, -slope * libm::sin(4.0 * std::f64::consts::TAU * v), 1.0, 1.0]
    }))
}

/// The sphere before the camera, the highlight in its middle: there v runs upwards in the image.
fn view(around: f64) -> View {
    View {
        camera: Camera::orbiting(6.0, 10.0, -90.0, 22.0, SIDE, SIDE),
        surface: Shape::Sphere(Sphere::new()).tiled(around / std::f64::consts::TAU, 1.0),
        light: Light::Directional { direction: to_light(), irradiance: 1.0 },
        shading: Shading::Ndf,
        wrap: Wrap::Repeat,
        lookup: Lookup::default(),
    }
}

/// Unit direction to the light.
fn to_light() -> Vec3 {
    direction(30.0, -90.0)
}

struct Shots<'a> {
    base: BaseLobe,
    task: &'a Task<'a>,
}

impl Shots<'_> {
    fn take(
        &self,
        name: &str,
        map: &Arc<NormalMap>,
        around: f64,
        spp: u32,
    ) -> Result<Film, Halted> {
        let built = prefiltered(method(name, &[]).as_ref(), map, &self.base);
        let (sampler, seed) = (PixelSampler::new(spp), self.task.seed);
        let cancelled = || self.task.progress.cancelled();
        Ok(render(&view(around), built.as_ref(), &sampler, seed, 0, &cancelled)?)
    }
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let base = BaseLobe::BlinnPhong { exponent: task.values.number("exponent") };
    let shots = Shots { base, task };
    let (rippled, flat) = (map(0.3), map(0.0));
    let smooth = shots.take("unfiltered", &flat, SCALES[0].1, 16)?;
    let mut table = Table::new(
        "highlights",
        "The highlight's size by second moments of its radiance, which way its length runs, how much neighbouring \
         rows differ, and the error against the converged image.",
        &[
            "image",
            "length, pixels",
            "width, pixels",
            "length over width",
            "angle to the ripples' direction, degrees",
            "differences of rows, of the light",
            "RMSE",
            "RMSE unfiltered",
        ],
    );
    let own = highlight(&smooth);
    table.push(row("no ripples", own, &smooth, [f64::NAN; 2]));
    let mut panels = vec![Panel::new("smooth", "no ripples", textured(&smooth, SCALES[0].1))];
    let mut found = vec![];
    for (label, around) in SCALES {
        let converged = shots.take("unfiltered", &rippled, around, CONVERGED)?;
        let filtered = shots.take("olano-north-printed", &rippled, around, 1)?;
        let unfiltered = shots.take("unfiltered", &rippled, around, 1)?;
        let errors = [&filtered, &unfiltered].map(|film| rmse(film, &converged));
        let shape = highlight(&filtered);
        table.push(row(label, shape, &filtered, errors));
        found.push((shape, roughness(&filtered), errors));
        let stem = format!("{}", around as usize);
        let film = |name: &str, what: &str, film: Film| {
            let film = textured(&film, around);
            Panel::new(&format!("{name}-{stem}"), format!("{what}, {label}"), film)
        };
        panels.push(film("filtered", "filtered", filtered).remarked("1 sample a pixel"));
        panels.push(film("unfiltered", "unfiltered", unfiltered).remarked("1 sample a pixel"));
        panels.push(
            film("converged", "converged", converged)
                .remarked(format!("{CONVERGED} samples a pixel")),
        );
    }
    let mut exhibit = ROW.exhibit();
    exhibit.claims = claims(own, &found);
    exhibit.tables = vec![table];
    exhibit.remarks = vec![
        "The paper prints neither map nor object; ripples here are a sine along v with slopes up to 0.3 on a smooth \
         sphere, and shading is that of its pictures, Pearson II without normalisation."
            .into(),
    ];
    let images = Images { panels, white: None, reference: None, across: 4 };
    exhibit.figures = vec![Figure::new(
        "spheres",
        "A sphere whose map ripples from pole to pole, at two scales of the map.",
        Drawing::Images(images),
    )];
    Ok(exhibit)
}

fn claims(own: Highlight, found: &[(Highlight, f64, [f64; 2])]) -> Vec<Claim> {
    let [(seen, rough, _), (under, blurred, errors)] = [found[0], found[1]];
    let longer = under.length / under.width;
    vec![
        Claim::shown(
            "length over width of the highlight, ripples under-sampled, over that without ripples",
            "the specular highlight elongates (figure 1)",
            longer / (own.length / own.width),
            "above 1.2",
            longer > 1.2 * own.length / own.width,
        ),
        Claim::at_most(
            "angle of its length to the direction in which the ripples run, degrees",
            "in the direction of the ripples (figure 1)",
            10.0,
            90.0 - under.angle.abs(),
        ),
        Claim::shown(
            "differences of neighbouring rows over all light, under-sampled over seen",
            "the specular highlight blurs (figure 1)",
            blurred / rough,
            "below 0.5",
            blurred < 0.5 * rough,
        ),
        Claim::shown(
            "length of the highlight, ripples seen over under-sampled",
            "one representation, continuous from bumps to shading (abstract)",
            seen.length / under.length,
            "within 25 % of 1: the same light, gathered in streaks",
            (seen.length / under.length - 1.0).abs() < 0.25,
        ),
        Claim::shown(
            "RMSE of the filtered image, under-sampled, over the unfiltered one's",
            "the maps are filtered (figure 1)",
            errors[0] / errors[1],
            "below 0.5",
            errors[0] < 0.5 * errors[1],
        )
        .because("without normalisation a wide lobe is too bright; see olano-s"),
        Claim::not_applicable(
            "the colour texture",
            "a regular image texture",
            "there is no colour here: images have a grey texture, which no number here counts",
        ),
    ]
}

/// The highlights on a grey check, a tile of the map twice on either axis, but no smaller than is seen.
fn textured(highlights: &Film, around: f64) -> Arc<Film> {
    let checks = (64.0 / around).min(2.0);
    let albedo = |[u, v]: [f64; 2]| {
        let check = (checks * u).floor() + (checks * v).floor();
        if check.rem_euclid(2.0) == 0.0 { 1.0 } else { 0.4 }
    };
    Arc::new(on_body(highlights, &view(around), to_light(), 0.15, albedo))
}

fn row(label: &str, shape: Highlight, film: &Film, errors: [f64; 2]) -> Vec<super::super::Cell> {
    let Highlight { length, width, angle } = shape;
    let numbers = [length, width, length / width, 90.0 - angle.abs(), roughness(film)];
    let error = |e: f64| if e.is_nan() { "".into() } else { e.into() };
    let errors = errors.map(error);
    std::iter::once(label.into()).chain(numbers.map(Into::into)).chain(errors).collect()
}

/// Σ |difference of vertical neighbours| over Σ radiance.
fn roughness(film: &Film) -> f64 {
    let (pixels, width) = (film.pixels(), film.width());
    let differences = pixels.iter().zip(&pixels[width..]).map(|(a, b)| f64::from((a - b).abs()));
    differences.sum::<f64>() / pixels.iter().map(|p| f64::from(*p)).sum::<f64>()
}

fn rmse(film: &Film, truth: &Film) -> f64 {
    let squares = film.pixels().iter().zip(truth.pixels()).map(|(a, b)| f64::from(a - b).powi(2));
    (squares.sum::<f64>() / film.pixels().len() as f64).sqrt()
}
