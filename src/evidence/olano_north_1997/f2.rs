//! Figure 2: one smooth object at two polygon counts, shaded from vertices and with a map.

use std::sync::Arc;

use super::super::{Claim, Drawing, Exhibit, Figure, Halted, Images, Panel, Row, Table, Task};
use super::body::on_body;
use super::common::{EXPONENT, method, prefiltered};
use crate::geometry::{Ripples, Vec3};
use crate::light::Light;
use crate::lobe::{BaseLobe, Shading};
use crate::parameter::{Value, Values};
use crate::pattern;
use crate::render::{Camera, Film, PixelSampler, View, direction, render};
use crate::surface::{Shape, WavyFrame, WavySphere};
use crate::texture::{Lookup, NormalMap, Wrap};

/// The row.
pub const ROW: Row = Row {
    name: "olano-f2",
    title: "A wavy sphere of few and of fewer polygons, shaded from vertices and with a normal distribution map",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 15.0,
    make,
};

const SIDE: usize = 256;
const SPP: u32 = 16;
/// The wavy sphere, which the paper does not describe.
const RIPPLES: Ripples = Ripples { count: 12, amplitude: 0.03 };
/// Cells from pole to pole of the two meshes, and of the one that counts as smooth.
const FEW: usize = 32;
const FEWER: usize = 20;
const SMOOTH: usize = 160;

/// Unit direction to the light.
fn to_light() -> Vec3 {
    direction(45.0, -90.0)
}

struct Shots<'a> {
    base: BaseLobe,
    task: &'a Task<'a>,
}

impl Shots<'_> {
    /// Phong shading: normals of the vertices, no map.
    fn from_vertices(&self, cells: usize) -> Result<Film, Halted> {
        let flat = NormalMap::from_fn(1, 1, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]);
        self.take(cells, WavyFrame::Vertex, "unfiltered", &Arc::new(flat))
    }

    fn with_map(&self, cells: usize, map: &Arc<NormalMap>) -> Result<Film, Halted> {
        self.take(cells, WavyFrame::Sphere, "olano-north-printed", map)
    }

    fn take(
        &self,
        cells: usize,
        frame: WavyFrame,
        name: &str,
        map: &Arc<NormalMap>,
    ) -> Result<Film, Halted> {
        let built = prefiltered(method(name, &[]).as_ref(), map, &self.base);
        let (sampler, seed) = (PixelSampler::new(SPP), self.task.seed);
        let cancelled = || self.task.progress.cancelled();
        Ok(render(&view(cells, frame), built.as_ref(), &sampler, seed, 0, &cancelled)?)
    }
}

fn view(cells: usize, frame: WavyFrame) -> View {
    View {
        camera: Camera::orbiting(6.0, 20.0, -60.0, 22.0, SIDE, SIDE),
        surface: Shape::WavySphere(WavySphere::new(RIPPLES, cells, frame)),
        light: Light::Directional { direction: to_light(), irradiance: 1.0 },
        shading: Shading::Ndf,
        wrap: Wrap::Repeat,
        lookup: Lookup::default(),
    }
}

/// The ripples' normals, longitude by latitude.
fn map() -> Arc<NormalMap> {
    let entry = pattern::find("wavy-sphere").expect("a pattern of the program's own");
    let mut values = Values::defaults(entry.parameters);
    values.set("ripples", Value::Number(f64::from(RIPPLES.count)));
    values.set("amplitude", Value::Number(RIPPLES.amplitude));
    Arc::new((entry.build)(512, 256, &values, 1).normals)
}

/// Pixels that every mesh fills: silhouettes are no matter of shading.
fn inside() -> Vec<bool> {
    let meshes = [FEWER, FEW, SMOOTH].map(|cells| view(cells, WavyFrame::Vertex));
    let camera = meshes[0].camera;
    let hits = |x: f64, y: f64| {
        let ray = camera.ray(x, y);
        meshes.iter().all(|mesh| mesh.surface.intersect(camera.origin(), ray).is_some())
    };
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let of = |i: usize| {
        let (x, y) = ((i % SIDE) as f64, (i / SIDE) as f64);
        corners.iter().all(|[dx, dy]| hits(x + dx, y + dy))
    };
    (0..SIDE * SIDE).map(of).collect()
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let base = BaseLobe::BlinnPhong { exponent: task.values.number("exponent") };
    let shots = Shots { base, task };
    let (map, inside) = (map(), inside());
    let smooth = shots.from_vertices(SMOOTH)?;
    let scale = peak(&smooth);
    let difference = |a: &Film, b: &Film| rms(a, b, &inside) / scale;
    let films = [
        shots.from_vertices(FEW)?,
        shots.from_vertices(FEWER)?,
        shots.with_map(FEW, &map)?,
        shots.with_map(FEWER, &map)?,
    ];
    task.progress.advance(1, 1);
    let [a, b, c, d] = films.each_ref().map(|film| difference(film, &smooth));
    let [phong, mapped] = [difference(&films[0], &films[1]), difference(&films[2], &films[3])];
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::shown(
            "change of the highlights from few polygons to fewer: with the map, over from vertices",
            "highlights change with the polygons, and do not with normal distribution mapping (figure 2)",
            mapped / phong,
            "below 0.5",
            mapped < 0.5 * phong,
        ),
        Claim::shown(
            "difference from the smooth surface, few polygons: with the map, over from vertices",
            "separates the sampling of normals from that of geometry (abstract)",
            c / a,
            "below 0.5",
            c < 0.5 * a,
        )
        .because(
            "where few polygons are enough for the vertices' normals, what is left with the map is its own lobe: \
             Pearson II is not the surface's",
        ),
        Claim::shown(
            "difference from the smooth surface, fewer polygons: with the map, over from vertices",
            "separates the sampling of normals from that of geometry (abstract)",
            d / b,
            "below 0.5",
            d < 0.5 * b,
        ),
    ];
    let triangles = |cells| WavySphere::new(RIPPLES, cells, WavyFrame::Vertex).triangles();
    let mut table = Table::new(
        "differences",
        "Root mean square difference from the smooth surface over pixels that all meshes fill, of its peak.",
        &["image", "triangles", "difference"],
    );
    let labels = [("a", "from vertices", FEW), ("b", "from vertices", FEWER)];
    let labels =
        labels.into_iter().chain([("c", "with the map", FEW), ("d", "with the map", FEWER)]);
    let count = format!("{} triangles, {SPP} samples a pixel", triangles(SMOOTH));
    let shown = |film: &Film, cells| {
        Arc::new(on_body(film, &view(cells, WavyFrame::Vertex), to_light(), 0.1, |_| 1.0))
    };
    let mut panels = vec![Panel::new("smooth", "smooth", shown(&smooth, SMOOTH)).remarked(count)];
    for (((name, label, cells), film), error) in labels.zip(films).zip([a, b, c, d]) {
        table.push(vec![format!("{name}) {label}").into(), triangles(cells).into(), error.into()]);
        let remark = format!("{} triangles", triangles(cells));
        let film = shown(&film, cells);
        panels.push(Panel::new(name, format!("{name}) {label}"), film).remarked(remark));
    }
    exhibit.tables = vec![table];
    exhibit.remarks = vec![format!(
        "Images have a grey body under the highlights, shaded from vertices; no number here counts it. From {} to {} \
         triangles the image changes by {:.4} of its peak from vertices, by {:.4} with the map. Meshes, ripples, \
         light and camera are chosen here; the paper prints none of them.",
        triangles(FEW),
        triangles(FEWER),
        phong,
        mapped
    )];
    let images = Images { panels, white: None, reference: Some(0), across: 3 };
    exhibit.figures = vec![Figure::new(
        "spheres",
        "A wavy sphere, smooth, and of two meshes: shaded from its vertices' normals (Phong shading), and with a \
         normal distribution map.",
        Drawing::Images(images),
    )];
    Ok(exhibit)
}

fn peak(film: &Film) -> f64 {
    film.pixels().iter().copied().fold(0.0, f32::max).into()
}

fn rms(a: &Film, b: &Film, inside: &[bool]) -> f64 {
    let pixels = a.pixels().iter().zip(b.pixels()).zip(inside).filter(|(_, inside)| **inside);
    let (mut sum, mut count) = (0.0, 0usize);
    for ((a, b), _) in pixels {
        sum += f64::from(a - b).powi(2);
        count += 1;
    }
    (sum / count.max(1) as f64).sqrt()
}
