//! Figures 9 to 11: multiple surfaces that come from no bump map (§4).

use std::sync::Arc;

use crate::light::Light;
use crate::lobe::{MultipleSurface, Shading, find_named, reflection};
use crate::render::{Camera, Film, Portrait, direction};

use super::super::{
    Claim, Disc, Drawing, Exhibit, Figure, Halted, Images, LobePlot, Panel, Reflection, Row, Table,
    Task,
};
use super::textures::on_grid;

/// Pixels along a side of a portrait.
const SIDE: usize = 320;
/// Directions of incidence that reflection is drawn for, degrees from the normal.
const INCIDENCES: [f64; 3] = [0.0, 30.0, 60.0];

const fn row(
    name: &'static str,
    title: &'static str,
    make: fn(&Task) -> Result<Exhibit, Halted>,
) -> Row {
    Row { name, title, parts: &[], parameters: &[], secs: 0.5, make }
}

/// Figure 9.
pub const F9: Row =
    row("fournier-f9", "A sphere with an anisotropic surface, and one with three normals", f9);
/// Figure 10.
pub const F10: Row = row("fournier-f10", "Velvet, from the paper's table of peaks", f10);
/// Figure 11.
pub const F11: Row = row("fournier-f11", "Silk, from the paper's table of peaks", f11);

fn f9(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = F9.exhibit();
    let shown = show(&mut exhibit, &["anisotropic", "three-normals"], task)?;
    let long = elongation(&shown[0]);
    exhibit.claims = vec![
        Claim::shown(
            "length of the anisotropic surface's highlight, of its width",
            "an anisotropic surface is obtained in a very straightforward manner (§4)",
            long,
            "above 2",
            long > 2.0,
        ),
        Claim::count("highlights of the surface with three normals", 3, highlights(&shown[1])),
    ];
    exhibit.remarks = vec![
        "No numbers are printed for the anisotropic surface; the exponent of the third of the three normals is not \
         printed and is taken to be that of the others."
            .into(),
    ];
    Ok(exhibit)
}

fn f10(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = F10.exhibit();
    show(&mut exhibit, &["velvet", "velvet-printed"], task)?;
    let mut table = Table::new(
        "rim",
        "Mean radiance of a sphere lit from the eye, by the angle between eye and normal, over that of its middle.",
        &["reading", "0° to 20°", "40° to 60°", "75° to 88°"],
    );
    let mut at_rim = Vec::new();
    for name in ["velvet", "velvet-printed"] {
        let zones = zones(&portrait(name, &facing()));
        table.push(vec![
            name.into(),
            1.0.into(),
            (zones[1] / zones[0]).into(),
            (zones[2] / zones[0]).into(),
        ]);
        at_rim.push(zones[2] / zones[0]);
    }
    exhibit.claims = vec![
        Claim::shown(
            "radiance at the rim of a sphere lit from the eye, over that in its middle, first number along the normal",
            "the reflective behaviour of velvet (§4), which is brightest at its rim",
            at_rim[0],
            "above 1",
            at_rim[0] > 1.0,
        ),
        Claim::not_applicable(
            "likeness to Figure 10",
            "a colour print",
            "its numbers are not printed",
        ),
    ];
    exhibit.tables = vec![table];
    exhibit.remarks = vec![
        "The table's vectors can be read in two ways: (0, 0, 1) is the normal in the first row, but the others lie \
         around the normal only if their first number is the one along it. Both readings are shown; the rim tells \
         which is velvet."
            .into(),
    ];
    Ok(exhibit)
}

fn f11(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = F11.exhibit();
    show(&mut exhibit, &["silk", "silk-printed"], task)?;
    exhibit.claims = vec![Claim::not_applicable(
        "likeness to Figure 11",
        "“a rough approximation of silk” in a colour print",
        "its numbers are not printed",
    )];
    exhibit.remarks = vec![
        "As for velvet, the vectors are shown under both readings. The last two amplitudes of the table stand the \
         other way round than those of the other three directions; they are used as printed."
            .into(),
    ];
    Ok(exhibit)
}

/// Portraits, distributions and reflection of named surfaces as figures; the portraits.
fn show(exhibit: &mut Exhibit, names: &[&str], task: &Task) -> Result<Vec<Film>, Halted> {
    let usual = Portrait::sphere(SIDE, SIDE);
    let (mut films, mut panels, mut discs, mut lobes) = (vec![], vec![], vec![], vec![]);
    for &name in names {
        task.go_on()?;
        let film = portrait(name, &usual);
        panels.push(Panel::new(name, name, Arc::new(film.clone())));
        films.push(film);
        let surface = surface(name);
        discs.push(Disc {
            label: name.into(),
            remark: format!("{} peaks", surface.lobes().len()),
            density: on_grid(&surface),
            peaks: surface.lobes().iter().map(|lobe| lobe.axis().map(f64::from)).collect(),
            own_scale: true,
        });
        for azimuth in [0.0, 90.0] {
            lobes.push(plot(name, &surface, azimuth));
        }
    }
    let images = Images { panels, white: None, reference: None, across: names.len() };
    let caption = "Spheres, each the same multiple surface in the local frame of every point.";
    exhibit.figures = vec![
        Figure::new("spheres", caption, Drawing::Images(images)),
        Figure::new("normals", "Their distributions of normals.", Drawing::Discs(discs)),
        Figure::new(
            "reflection",
            "What they reflect in two planes of incidence.",
            Drawing::Lobes(lobes),
        ),
    ];
    Ok(films)
}

/// Reflection in a plane of incidence.
pub fn plot(label: &str, surface: &MultipleSurface, azimuth: f64) -> LobePlot {
    let of = |incidence| Reflection {
        incidence,
        exits: reflection(surface, Shading::Ndf, incidence, azimuth),
    };
    LobePlot { label: label.into(), azimuth, reflections: INCIDENCES.map(of).into() }
}

fn surface(name: &str) -> MultipleSurface {
    find_named(name).expect("a surface of the program's own").surface()
}

fn portrait(name: &str, portrait: &Portrait) -> Film {
    portrait.of(surface(name))
}

/// A sphere seen and lit from one side.
fn facing() -> Portrait {
    Portrait {
        camera: Camera::orbiting(30.0, 0.0, -90.0, 4.2, SIDE, SIDE),
        light: Light::Directional { direction: direction(0.0, -90.0), irradiance: 1.0 },
        ..Portrait::sphere(SIDE, SIDE)
    }
}

/// Mean radiance by the angle between eye and normal of a sphere far away: 0° to 20°, 40° to 60°, 75° to
/// 88°.
fn zones(film: &Film) -> [f64; 3] {
    let bounds: [[f64; 2]; 3] = [[0.0, 20.0], [40.0, 60.0], [75.0, 88.0]];
    let view = facing();
    let (camera, mut sums) = (view.camera, [[0.0; 2]; 3]);
    for (i, &radiance) in film.pixels().iter().enumerate() {
        let ray = camera.ray((i % SIDE) as f64 + 0.5, (i / SIDE) as f64 + 0.5);
        let Some(hit) = view.shape.intersect(camera.origin(), ray) else { continue };
        let cosine = -hit.frame.normal.dot(&ray.normalize());
        let angle = libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees();
        for (sum, [low, high]) in sums.iter_mut().zip(bounds) {
            if (low..high).contains(&angle) {
                *sum = [sum[0] + f64::from(radiance), sum[1] + 1.0];
            }
        }
    }
    sums.map(|[sum, count]| sum / count)
}

/// Length over width of the light in an image: the square root of the ratio of its second moments.
fn elongation(film: &Film) -> f64 {
    let (mut total, mut first) = (0.0, [0.0; 2]);
    let pixels = || {
        film.pixels().iter().enumerate().map(|(i, &r)| {
            // Bright parts count most: the highlight, not the haze.
            (f64::from(r).powi(2), [(i % film.width()) as f64, (i / film.width()) as f64])
        })
    };
    for (weight, at) in pixels() {
        total += weight;
        first = [first[0] + weight * at[0], first[1] + weight * at[1]];
    }
    let mean = first.map(|sum| sum / total);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (weight, at) in pixels() {
        let [dx, dy] = [at[0] - mean[0], at[1] - mean[1]];
        (xx, xy, yy) = (xx + weight * dx * dx, xy + weight * dx * dy, yy + weight * dy * dy);
    }
    let (middle, bend) = (0.5 * (xx + yy), (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt());
    ((middle + bend) / (middle - bend)).sqrt()
}

/// Separate maxima of at least a fifth of the largest radiance, none within a sixteenth of the image of a
/// brighter one.
fn highlights(film: &Film) -> usize {
    let (width, height, pixels) = (film.width() as isize, film.height() as isize, film.pixels());
    let reach = width / 16;
    let least = 0.2 * pixels.iter().copied().fold(0.0, f32::max);
    let at = |x: isize, y: isize| pixels[(y * width + x) as usize];
    let alone = |x: isize, y: isize| {
        let here = (at(x, y), -y, -x); // of equal ones, the first counts
        let rows = (y - reach).max(0)..=(y + reach).min(height - 1);
        rows.flat_map(|v| ((x - reach).max(0)..=(x + reach).min(width - 1)).map(move |u| (u, v)))
            .all(|(u, v)| (at(u, v), -v, -u) <= here)
    };
    let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    all.filter(|&(x, y)| at(x, y) > least && alone(x, y)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spots(spots: &[(f64, f64, f64, f64)]) -> Film {
        let pixel = |i: usize| {
            let (x, y) = ((i % 64) as f64, (i / 64) as f64);
            let of = |&(cx, cy, rx, ry): &(f64, f64, f64, f64)| {
                (-((x - cx) / rx).powi(2) - ((y - cy) / ry).powi(2)).exp()
            };
            spots.iter().map(of).sum::<f64>() as f32
        };
        Film::new(64, 64, (0..64 * 64).map(pixel).collect())
    }

    #[test]
    fn highlights_are_counted_and_measured() {
        assert_eq!(highlights(&spots(&[(20.0, 20.0, 3.0, 3.0)])), 1);
        assert_eq!(highlights(&spots(&[(20.0, 20.0, 3.0, 3.0), (45.0, 30.0, 3.0, 3.0)])), 2);
        let long = elongation(&spots(&[(32.0, 32.0, 9.0, 3.0)]));
        assert!((long - 3.0).abs() < 0.01, "{long}");
    }
}
