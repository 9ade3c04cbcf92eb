//! A renderer in plain double precision, written from docs/conventions.md alone: nothing here comes
//! from the program.

use std::f64::consts::{PI, TAU};

type V = [f64; 3];

fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn sum(terms: &[(f64, V)]) -> V {
    [0, 1, 2].map(|c| terms.iter().map(|(s, v)| s * v[c]).sum())
}

fn unit(a: V) -> V {
    sum(&[(1.0 / dot(a, a).sqrt(), a)])
}

fn towards(elevation: f64, azimuth: f64) -> V {
    let (e, a) = (elevation.to_radians(), azimuth.to_radians());
    [e.cos() * a.cos(), e.cos() * a.sin(), e.sin()]
}

#[derive(Clone, Copy, Debug)]
pub enum Solid {
    Plane,
    Sphere,
}

#[derive(Clone, Copy, Debug)]
pub enum Lamp {
    Far { elevation: f64, azimuth: f64, irradiance: f64 },
    Near { position: V, intensity: f64 },
}

#[derive(Clone, Copy, Debug)]
pub enum Lobe {
    Phong(f64),
    Beckmann(f64),
    Ggx(f64),
}

impl Lobe {
    /// D of the cosine to the normal.
    pub fn density(self, c: f64) -> f64 {
        let tan2 = (1.0 - c * c) / (c * c);
        match self {
            _ if c <= 0.0 => 0.0,
            Self::Phong(s) => (s + 2.0) / TAU * c.powf(s),
            Self::Beckmann(a) => (-tan2 / (a * a)).exp() / (PI * a * a * c.powi(4)),
            Self::Ggx(a) => a * a / (PI * c.powi(4) * (a * a + tan2).powi(2)),
        }
    }

    /// Smith's G₁ of the cosine to the normal.
    fn shadowing(self, c: f64) -> f64 {
        let tan = (1.0 - c * c).max(0.0).sqrt() / c;
        let beckmann = |alpha: f64| {
            let a = 1.0 / (alpha * tan);
            let fit = (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a);
            if a < 1.6 { fit } else { 1.0 }
        };
        match self {
            Self::Phong(s) => beckmann((2.0 / (s + 2.0)).sqrt()),
            Self::Beckmann(alpha) => beckmann(alpha),
            Self::Ggx(alpha) => 2.0 / (1.0 + (1.0 + (alpha * tan).powi(2)).sqrt()),
        }
    }
}

/// Unit normals, row by row from the bottom of the picture.
#[derive(Clone, Debug)]
pub struct Map {
    pub size: [i64; 2],
    pub normals: Vec<V>,
    pub repeats: bool,
    pub facets: bool,
}

impl Map {
    pub fn from_top_rows<const W: usize>(rows: &[[[u8; 3]; W]]) -> Self {
        let decoded = |c: &[u8; 3]| unit(c.map(|b| 2.0 * f64::from(b) / 255.0 - 1.0));
        let normals = rows.iter().rev().flat_map(|row| row.iter().map(decoded)).collect();
        Self { size: [W as i64, rows.len() as i64], normals, repeats: true, facets: false }
    }

    fn texel(&self, i: i64, j: i64) -> V {
        let [w, h] = self.size;
        let inside =
            |i: i64, n: i64| if self.repeats { i.rem_euclid(n) } else { i.clamp(0, n - 1) };
        self.normals[(inside(j, h) * w + inside(i, w)) as usize]
    }

    fn normal(&self, u: f64, v: f64) -> V {
        let (x, y) = (u * self.size[0] as f64, v * self.size[1] as f64);
        if self.facets {
            return self.texel(x.floor() as i64, y.floor() as i64);
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (x.floor() as i64, y.floor() as i64);
        let (a, b) = (x - x.floor(), y - y.floor());
        unit(sum(&[
            ((1.0 - a) * (1.0 - b), self.texel(i, j)),
            (a * (1.0 - b), self.texel(i + 1, j)),
            ((1.0 - a) * b, self.texel(i, j + 1)),
            (a * b, self.texel(i + 1, j + 1)),
        ]))
    }
}

/// A point of a surface: where, (u, v), and tangent, bitangent, normal.
struct Point {
    at: V,
    uv: [f64; 2],
    axes: [V; 3],
}

#[derive(Clone, Debug)]
pub struct Brute {
    pub distance: f64,
    pub elevation: f64,
    pub azimuth: f64,
    pub fov: f64,
    pub size: [usize; 2],
    pub solid: Solid,
    /// Plane: along a scene unit of x and y. Sphere: round the equator and from pole to pole.
    pub tiles: [f64; 2],
    pub lamp: Lamp,
    pub lobe: Lobe,
    pub microfacet: bool,
    pub map: Map,
}

impl Brute {
    fn eye(&self) -> V {
        sum(&[(self.distance, towards(self.elevation, self.azimuth))])
    }

    /// Direction of the ray through image point (x, y).
    fn ray(&self, x: f64, y: f64) -> V {
        let [width, height] = self.size.map(|n| n as f64);
        let forward = sum(&[(-1.0, unit(self.eye()))]);
        let right = unit(cross(forward, [0.0, 0.0, 1.0]));
        let up = cross(right, forward);
        let pixel = 2.0 * (0.5 * self.fov).to_radians().tan() / height;
        sum(&[
            (1.0, forward),
            (pixel * (x - 0.5 * width), right),
            (-pixel * (y - 0.5 * height), up),
        ])
    }

    fn hit(&self, x: f64, y: f64) -> Option<Point> {
        let (eye, ray) = (self.eye(), unit(self.ray(x, y)));
        let along = |t: f64| sum(&[(1.0, eye), (t, ray)]);
        match self.solid {
            Solid::Plane => {
                let at = (ray[2] < 0.0).then(|| along(-eye[2] / ray[2]))?;
                let uv = [at[0] * self.tiles[0], at[1] * self.tiles[1]];
                Some(Point { at, uv, axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] })
            }
            Solid::Sphere => {
                let b = dot(eye, ray);
                let root = b * b - dot(eye, eye) + 1.0;
                let at = (root >= 0.0).then(|| along(-b - root.sqrt()))?;
                let (longitude, latitude) = (at[1].atan2(at[0]), at[2].asin());
                let uv =
                    [longitude / TAU * self.tiles[0], (latitude + PI / 2.0) / PI * self.tiles[1]];
                let east = [-longitude.sin(), longitude.cos(), 0.0];
                Some(Point { at, uv, axes: [east, cross(at, east), at] })
            }
        }
    }

    /// Radiance at image point (x, y).
    pub fn radiance(&self, x: f64, y: f64) -> f64 {
        let Some(point) = self.hit(x, y) else { return 0.0 };
        let (light, irradiance) = match self.lamp {
            Lamp::Far { elevation, azimuth, irradiance } => {
                (towards(elevation, azimuth), irradiance)
            }
            Lamp::Near { position, intensity } => {
                let to = sum(&[(1.0, position), (-1.0, point.at)]);
                (unit(to), intensity / dot(to, to))
            }
        };
        if dot(light, point.axes[2]) <= 0.0 {
            return 0.0;
        }
        let view = unit(sum(&[(-1.0, self.ray(x, y))]));
        let half = unit(sum(&[(1.0, light), (1.0, view)]));
        let local = self.map.normal(point.uv[0], point.uv[1]);
        let [t, b, n] = point.axes;
        let normal = sum(&[(local[0], t), (local[1], b), (local[2], n)]);
        let bare = irradiance * self.lobe.density(dot(normal, half));
        let (to_light, to_view) = (dot(normal, light), dot(normal, view));
        if !self.microfacet {
            bare
        } else if to_light > 0.0 && to_view > 0.0 {
            let shadowing = self.lobe.shadowing(to_light) * self.lobe.shadowing(to_view);
            bare * shadowing / (4.0 * to_view)
        } else {
            0.0
        }
    }

    /// Texels along u and v that a step of one pixel to the right, and one down, crosses at image
    /// point (x, y), by differences.
    pub fn texels_per_step(&self, x: f64, y: f64) -> [[f64; 2]; 2] {
        let step = 1e-5;
        let uv = |x, y| self.hit(x, y).map_or([f64::NAN; 2], |point| point.uv);
        [(step, 0.0), (0.0, step)].map(|(dx, dy)| {
            let (from, to) = (uv(x - dx, y - dy), uv(x + dx, y + dy));
            [0, 1].map(|c| (to[c] - from[c]) / (2.0 * step) * self.map.size[c] as f64)
        })
    }
}
