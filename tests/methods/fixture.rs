//! Every method with every base lobe it takes, maps to try them on, and integrals over directions.

use std::f64::consts::TAU;
use std::sync::{Arc, LazyLock};

use wrinkle::geometry::{Frame, HemisphereGrid, Vec3};
use wrinkle::lobe::intensity::Fresnel;
use wrinkle::lobe::{BaseLobe, MultipleSurface, Shading};
use wrinkle::method::{self, Card, Entry, Method, Prefiltered, Silent};
use wrinkle::parameter::{Domain, Value, Values};
use wrinkle::texture::{Footprint, NormalMap, Wrap, level_sizes};

/// Every shading.
pub const SHADINGS: [Shading; 5] = [
    Shading::Ndf,
    Shading::Microfacet,
    Shading::Phong,
    Shading::TorranceSparrow(Fresnel::Mirror),
    Shading::TorranceSparrow(Fresnel::Index(1.5)),
];

/// The base lobes that methods are tried with.
pub const BASES: [BaseLobe; 4] = [
    BaseLobe::BlinnPhong { exponent: 30.0 },
    BaseLobe::BlinnPhong { exponent: 60.0 },
    BaseLobe::Beckmann { alpha: 0.25 },
    BaseLobe::Ggx { alpha: 0.2 },
];

/// A method with some options and a base lobe it takes.
pub struct Case {
    /// Method, options that are not the defaults, base lobe.
    pub name: String,
    pub card: Card,
    pub base: BaseLobe,
    /// What [`Method::base_error`] claims.
    pub base_error: f64,
    method: Box<dyn Method>,
}

impl Case {
    pub fn on(&self, map: &Arc<NormalMap>) -> Box<dyn Prefiltered> {
        self.method.prefilter(map, &self.base, &Silent).expect("a base lobe it takes")
    }
}

/// Every entry of the registry, with its defaults and with each other word of its choices, and each
/// base lobe it takes.
pub fn cases() -> Vec<Case> {
    let mut all = vec![];
    for entry in method::entries() {
        for (words, values) in settings(&entry) {
            for base in BASES {
                let method = (entry.build)(&values);
                if let Ok(base_error) = method.base_error(&base) {
                    let (name, card) =
                        (format!("{}{words}, {base}", entry.card.name), method.card());
                    all.push(Case { name, card, base, base_error, method });
                }
            }
        }
    }
    all
}

fn settings(entry: &Entry) -> Vec<(String, Values)> {
    let defaults = Values::defaults(entry.parameters);
    let mut all = vec![(String::new(), defaults.clone())];
    for parameter in entry.parameters {
        let Domain::Choice { words } = parameter.domain else { continue };
        for &word in &words[1..] {
            let mut values = defaults.clone();
            values.set(parameter.name, Value::Word(word));
            all.push((format!(" {} = {word}", parameter.name), values));
        }
    }
    all
}

/// Smooth bumps with slopes up to about 0.7 and no two normals alike; all weights 1.
pub fn bumps(width: usize, height: usize, wrap: Wrap) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(width, height, wrap, |u, v| {
        let (x, y) = (TAU * u, TAU * v);
        [0.4 * (x + 0.3).sin() + 0.2 * (2.0 * y).cos(), 0.3 * (y + x + 0.1).cos(), 1.0, 1.0]
    }))
}

/// The same bumps, the weights from ½ to 1½.
pub fn weighted(width: usize, height: usize) -> Arc<NormalMap> {
    let map = bumps(width, height, Wrap::Repeat);
    let uneven =
        |(k, &[x, y, z, _]): (usize, &[f32; 4])| [x, y, z, 0.5 + (0.37 * k as f32).fract()];
    let texels = map.texels().iter().enumerate().map(uneven).collect();
    Arc::new(NormalMap::new(width, height, Wrap::Repeat, texels))
}

/// A hemisphere seen from above, its weights its surface area (Fournier 1992 §2.3).
pub fn hemisphere(side: usize) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(side, side, Wrap::Clamp, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        if z > 0.0 { [x, y, z, 1.0 / z] } else { [0.0, 0.0, 1.0, 0.0] }
    }))
}

/// A map all of whose normals are `normal`.
pub fn single(side: usize, [x, y, z]: [f64; 3]) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(side, side, Wrap::Repeat, |_, _| [x, y, z, 1.0]))
}

/// A footprint whose sides are 2^`level` texels.
pub fn footprint(map: &NormalMap, u: f32, v: f32, level: f32) -> Footprint {
    let texels = level.exp2();
    let (w, h) = (map.width() as f32, map.height() as f32);
    Footprint {
        u,
        v,
        along_x: [texels / w, 0.0],
        along_y: [0.0, texels / h],
        ..Footprint::default()
    }
}

/// The level at which the map is one cell.
pub fn top(map: &NormalMap) -> usize {
    level_sizes(map.width(), map.height()).len() - 1
}

/// Footprints at the centres of a level's cells, where a lookup reads one cell and no other.
pub fn centres(map: &NormalMap, level: usize) -> Vec<Footprint> {
    let (width, height) = level_sizes(map.width(), map.height())[level];
    let centre = |i: usize, size: usize| (i as f32 + 0.5) / size as f32;
    let cells = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
    cells.map(|(i, j)| footprint(map, centre(i, width), centre(j, height), level as f32)).collect()
}

/// Half vectors that look at every part of a distribution.
pub fn half_vectors() -> Vec<[f32; 3]> {
    let grid = HemisphereGrid::new(6, 12);
    grid.samples()
        .iter()
        .map(|s| [s.direction.x, s.direction.y, s.direction.z].map(|c| c as f32))
        .collect()
}

/// A grid over the sphere: a hemisphere and its mirror image. Its midpoint rule is off by
/// D(0) h²/24 · 2π for a lobe about its pole that starts at D(0), h the distance of rings: a relative
/// 2·10⁻⁴ at exponent 60 on [`FINE`], ten times as much on [`COARSE`].
pub type Grid = LazyLock<HemisphereGrid>;
pub static FINE: Grid = LazyLock::new(|| HemisphereGrid::new(180, 72));
pub static COARSE: Grid = LazyLock::new(|| HemisphereGrid::new(60, 48));

/// The relative error of integrals on [`FINE`], rounding of single precision included.
pub const FINE_ERROR: f64 = 3e-4;
/// The relative error of integrals on [`COARSE`].
pub const COARSE_ERROR: f64 = 3e-3;

/// ∫ f(h, cosine of h to `pole`) dω over the whole sphere, the grid's pole turned to `pole` (of any
/// length).
pub fn integrate<const N: usize>(
    grid: &HemisphereGrid,
    pole: [f32; 3],
    f: impl Fn([f32; 3], f64) -> [f64; N],
) -> [f64; N] {
    let frame = Frame::about(Vec3::from(pole.map(f64::from)).normalize());
    let mut sum = [0.0; N];
    for sample in grid.samples() {
        let up = frame.world_from_local(sample.direction);
        for (h, cosine) in [(up, sample.direction.z), (-up, -sample.direction.z)] {
            let value = f([h.x, h.y, h.z].map(|c| c as f32), cosine);
            sum.iter_mut().zip(value).for_each(|(s, v)| *s += v * sample.solid_angle);
        }
    }
    sum
}

/// The energy ∫ D dω and the vector moment ∫ D h dω.
pub fn moments(grid: &HemisphereGrid, surface: &MultipleSurface, pole: [f32; 3]) -> (f64, Vec3) {
    let [energy, x, y, z] = integrate(grid, pole, |h, _| {
        let d = f64::from(surface.density(h));
        let [x, y, z] = h.map(f64::from);
        [d, d * x, d * y, d * z]
    });
    (energy, Vec3::new(x, y, z))
}

/// How wide a multiple surface is: 1 − |∫ D h dω| / ∫ D dω, the directional variance of statistics
/// (Mardia and Jupp 2000, *Directional Statistics*, §9.2.1): 0 if all of D points one way, 1 if it
/// has no direction.
///
/// Unlike a variance of slopes it is finite for GGX, and it asks for no axis. A Blinn-Phong lobe has
/// 1/(s+2), near its slope variance 1/s. For a mixture it is concave in the
/// distribution, so pooling cells can only raise its mean.
pub fn width(grid: &HemisphereGrid, surface: &MultipleSurface) -> f64 {
    let (energy, moment) = moments(grid, surface, [0.0, 0.0, 1.0]);
    1.0 - moment.norm() / energy
}
