//! Figure 14: outlines of highlights on a plane, Phong's and Blinn-Phong's.

use std::f64::consts::TAU;

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use super::pyramids::bumps;
use crate::geometry::Vec3;
use crate::geometry::elementary::pow64;
use crate::parameter::{Domain, Parameter, Value};
use crate::render::direction;

const EXPONENT: Parameter = Parameter {
    name: "exponent",
    meaning: "Blinn-Phong exponent; Phong's is a quarter of it, which is as wide at normal incidence",
    domain: Domain::Real { default: 200.0, min: 20.0, max: 5000.0 },
};

/// The row.
pub const ROW: Row = Row {
    name: "schilling-f14",
    title: "Phong against Blinn-Phong: outlines of the highlight on a plane",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 2.0,
    make,
};

/// Elevations of the light, degrees, and of the eye's mirror direction.
const ELEVATIONS: [f64; 4] = [60.0, 30.0, 15.0, 8.0];
/// The one that is drawn.
const DRAWN: f64 = 15.0;
/// Directions around the middle of a highlight that its outline is looked for in.
const AROUND: usize = 72;
/// Radius of the light's disc for the facets, degrees.
const DISC: f64 = 1.5;
/// Texels along a side of the map whose normals are the facets.
const SIDE: usize = 128;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let exponent = task.values.number("exponent");
    let facets = facets(exponent, task.seed);
    let mut exhibit = ROW.exhibit();
    let head = ["elevation, degrees", "model", "height over width", "overlap with the facets'"];
    let caption = "Outlines at half the highlight's greatest brightness: angular height over width seen by the eye, \
                   and the area common with the outline of a surface of many small mirrors, of the area of both.";
    let mut table = Table::new("outlines", caption, &head);
    let mut nearer = 0;
    let mut low = [0.0; 3];
    for elevation in ELEVATIONS {
        task.go_on()?;
        let light = direction(elevation, 90.0);
        let models: [(&str, Box<Brightness>); 3] = [
            ("many small mirrors", Box::new(|view| mirrored(&facets, &light, &view))),
            ("Blinn-Phong", Box::new(move |view| blinn_phong(&light, &view, exponent))),
            ("Phong", Box::new(move |view| phong(&light, &view, 0.25 * exponent))),
        ];
        let outlines = models.each_ref().map(|(_, model)| outline(elevation, model));
        for (((name, _), outline), low) in models.iter().zip(&outlines).zip(&mut low) {
            let (long, overlap) = (elongation(outline), overlap(outline, &outlines[0]));
            table.push(vec![elevation.into(), (*name).into(), long.into(), overlap.into()]);
            *low = long;
        }
        let [blinn, phong] = [1, 2].map(|model| overlap(&outlines[model], &outlines[0]));
        nearer += usize::from(blinn > phong);
        if elevation == DRAWN {
            let names = models.each_ref().map(|(name, _)| *name);
            exhibit.figures.push(drawn(names, &outlines));
        }
    }
    let [_, blinn, phong] = low;
    exhibit.claims = vec![
        Claim::shown(
            format!("height over width of the highlight at {}°: Blinn-Phong's over Phong's", ELEVATIONS[3]),
            "on a planar surface the difference is obvious",
            blinn / phong,
            "above 2",
            blinn / phong > 2.0,
        ),
        Claim::count(
            "elevations at which Blinn-Phong's outline is nearer than Phong's to that of many small mirrors",
            ELEVATIONS.len(),
            nearer,
        )
        .because("from straight above, the two models are nearly alike"),
    ];
    exhibit.tables = vec![table];
    exhibit.remarks = vec![format!(
        "Seen from a point, the highlight of a light at infinity on a plane. The small mirrors are the normals of a \
         normally distributed map with slope variance 1/{exponent}, each counted by the area it shows the eye; the \
         light is a disc of radius {DISC}° for them, a point for the two models. The exponents of the paper's figure \
         are not printed."
    )];
    Ok(exhibit)
}

/// What the eye sees of the highlight in the unit direction *to* the eye.
type Brightness<'a> = dyn Fn(Vec3) -> f64 + 'a;

/// (n·h)ᵐ.
fn blinn_phong(light: &Vec3, view: &Vec3, exponent: f64) -> f64 {
    pow64((light + view).normalize().z.max(1e-300), exponent)
}

/// (r·v)ᵐ, r the light mirrored at the plane.
fn phong(light: &Vec3, view: &Vec3, exponent: f64) -> f64 {
    let mirrored = Vec3::new(-light.x, -light.y, light.z);
    pow64(mirrored.dot(view).max(1e-300), exponent)
}

/// The part of the area seen that mirrors the light's disc.
fn mirrored(facets: &[Vec3], light: &Vec3, view: &Vec3) -> f64 {
    let edge = libm::cos(DISC.to_radians());
    let (mut lit, mut seen) = (0.0, 0.0);
    for n in facets {
        // A facet of a bump map has 1/n_z of area for its texel.
        let shown = n.dot(view).max(0.0) / n.z;
        let back = n * (2.0 * n.dot(view)) - view;
        seen += shown;
        lit += if back.dot(light) > edge { shown } else { 0.0 };
    }
    lit / seen.max(f64::MIN_POSITIVE)
}

fn facets(exponent: f64, seed: u64) -> Vec<Vec3> {
    let variance = Value::Number(1.0 / exponent);
    let set = [
        ("slope_variance_u", variance.clone()),
        ("slope_variance_v", variance),
        ("correlation_length", Value::Number(1.5)),
    ];
    let map = bumps("gaussian", SIDE, &set, seed).normals;
    map.texels().iter().map(|&[x, y, z, _]| Vec3::new(x.into(), y.into(), z.into())).collect()
}

/// The direction to the eye of what is seen [across, up] degrees from the mirror direction of a light at this
/// elevation; None above the horizon.
fn view(elevation: f64, [across, up]: [f64; 2]) -> Option<Vec3> {
    let below = elevation - up;
    (below > 0.0).then(|| direction(below, -90.0 + across))
}

/// Angular distance of the outline at half the greatest brightness, degrees, in [`AROUND`] directions from the
/// highlight's middle, the first across.
fn outline(elevation: f64, model: &Brightness) -> Vec<f64> {
    let at = |offset: [f64; 2]| view(elevation, offset).map_or(0.0, model);
    let line = (-40..=40).map(|step| at([0.0, 0.5 * f64::from(step)]));
    let half = 0.5 * line.fold(0.0, f64::max);
    let radius = |i: usize| {
        let (sin, cos) = libm::sincos(TAU * i as f64 / AROUND as f64);
        let outside = |r: f64| at([r * cos, r * sin]) < half;
        let mut far = 0.25;
        while !outside(far) && far < 60.0 {
            far += 0.25;
        }
        let mut near = far - 0.25;
        for _ in 0..8 {
            let middle = 0.5 * (near + far);
            if outside(middle) { far = middle } else { near = middle }
        }
        far
    };
    (0..AROUND).map(radius).collect()
}

/// Height over width.
fn elongation(outline: &[f64]) -> f64 {
    let quarter = AROUND / 4;
    (outline[quarter] + outline[3 * quarter]) / (outline[0] + outline[2 * quarter])
}

/// Common area over the area of both.
fn overlap(a: &[f64], b: &[f64]) -> f64 {
    let area = |pick: fn(f64, f64) -> f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| pick(*a, *b) * pick(*a, *b)).sum()
    };
    area(f64::min) / area(f64::max)
}

fn drawn(names: [&str; 3], outlines: &[Vec<f64>; 3]) -> Figure {
    let series = names.iter().zip(outlines).map(|(name, outline)| {
        let point = |i: usize| {
            let (sin, cos) = libm::sincos(TAU * i as f64 / AROUND as f64);
            [outline[i % AROUND] * cos, outline[i % AROUND] * sin]
        };
        Series { label: (*name).into(), points: (0..=AROUND).map(point).collect(), joined: true }
    });
    let chart = Chart {
        x: Axis::linear("across, degrees from the mirror direction"),
        y: Axis::linear("up, degrees"),
        series: series.collect(),
    };
    let caption = format!(
        "Outlines at half brightness of a highlight on a plane as the eye sees it, the light {DRAWN}° above the \
         horizon."
    );
    Figure::new("outlines", caption, Drawing::Chart(chart))
}
