//! The light: from a direction, from a point, or from everywhere.

use std::path::PathBuf;

use super::catalogue::unknown;
use super::item::Item;
use super::limits::Limits;
use super::reader::Reader;
use super::scene::{AZIMUTH, Shape};
use super::texture::folder;
use super::values::read_values;
use crate::light::Filter;
use crate::light::environment::{MOST_ACROSS, maps};
use crate::parameter::Values;

/// The one light.
#[derive(Clone, Debug, PartialEq)]
pub enum LightSpec {
    /// Light from very far away.
    Directional {
        /// Degrees above the plane z = 0 that it comes from: in (0, 90] for a plane, [−90, 90] for a
        /// sphere.
        elevation: f64,
        /// Degrees from +x towards +y that it comes from.
        azimuth: f64,
        /// Irradiance on a plane facing it.
        irradiance: f64,
    },
    /// Light from a point.
    Point {
        /// Where it is, scene units: above a plane, outside a sphere.
        position: [f64; 3],
        /// Radiant intensity: irradiance on a plane facing it at distance 1.
        intensity: f64,
    },
    /// Light from everywhere.
    Environment {
        /// Where its picture comes from.
        source: EnvironmentSource,
        /// Degrees it is turned about the vertical, from +x towards +y.
        rotation: f64,
        /// What its radiances are multiplied by.
        intensity: f64,
        /// How filtered lobes look it up.
        filter: Filter,
    },
}

/// Where an environment comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentSource {
    /// One the program computes.
    Map {
        /// Its name in [`crate::light::environment::maps::entries`].
        name: &'static str,
        /// Pixels across its picture; half as many down.
        width: usize,
        /// Its options.
        values: Values,
    },
    /// An image file.
    File {
        /// Where it is: the spec's folder joined with the path as the spec has it.
        path: PathBuf,
    },
}

/// Kinds of lights.
#[derive(Clone, Copy)]
enum Kind {
    Directional,
    Point,
    Environment,
}

/// How strong a light may be.
const STRENGTH: Limits = Limits::above(0.0, 1e6);

impl LightSpec {
    /// Its name in specs and results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Directional { .. } => "directional",
            Self::Point { .. } => "point",
            Self::Environment { .. } => "environment",
        }
    }

    /// Whether light comes from everywhere.
    pub fn is_environment(&self) -> bool {
        matches!(self, Self::Environment { .. })
    }

    pub(super) fn read(reader: &Reader, shape: Shape) -> Self {
        let kinds = [
            ("directional", Kind::Directional),
            ("point", Kind::Point),
            ("environment", Kind::Environment),
        ];
        match reader.choice("kind", &kinds) {
            Kind::Directional => directional(reader, shape),
            Kind::Point => Self::Point {
                position: position(reader, shape),
                intensity: reader.real("intensity", 1.0, STRENGTH),
            },
            Kind::Environment => Self::Environment {
                source: source(reader),
                rotation: reader.real("rotation", 0.0, AZIMUTH),
                intensity: reader.real("intensity", 1.0, STRENGTH),
                filter: reader.choice("filter", &Filter::ALL.map(|f| (f.name(), f))),
            },
        }
    }
}

fn directional(reader: &Reader, shape: Shape) -> LightSpec {
    let elevation = match shape {
        Shape::Plane => Limits::above(0.0, 90.0),
        _ => Limits::from_to(-90.0, 90.0),
    };
    LightSpec::Directional {
        elevation: reader.real("elevation", 40.0, elevation.degrees()),
        azimuth: reader.real("azimuth", 90.0, AZIMUTH),
        irradiance: reader.real("irradiance", 1.0, STRENGTH),
    }
}

/// Fewest pixels across a computed picture, and how many it has if the spec is silent.
const ACROSS: (u64, usize) = (16, 1024);

/// The picture of an environment: a map of the program's, white if the spec is silent, or a file.
fn source(reader: &Reader) -> EnvironmentSource {
    match (reader.item("map"), reader.item("file")) {
        (map, None) => computed(reader, map),
        (None, Some(file)) => {
            let path = file.text().map(|written| folder(reader).join(written)).unwrap_or_default();
            if file.text().is_some() && !path.is_file() {
                let help = "paths are relative to the folder of this file".to_owned();
                file.error(format!("there is no file {}", path.display()), Some(help));
            }
            EnvironmentSource::File { path }
        }
        (Some(_), Some(file)) => {
            let message = format!("{} has both `map` and `file`", reader.name());
            file.error(message, Some("keep one of them".to_owned()));
            reader.forgive();
            EnvironmentSource::File { path: PathBuf::new() }
        }
    }
}

fn computed(reader: &Reader, map: Option<Item>) -> EnvironmentSource {
    let entries = maps::entries();
    let entry = match map {
        None => Some(&entries[0]),
        Some(item) => item.text().and_then(|name| {
            let names: Vec<&str> = entries.iter().map(|entry| entry.card.name).collect();
            let found = entries.iter().find(|entry| entry.card.name == name);
            found.or_else(|| unknown("environment", name, &item, &names))
        }),
    };
    if entry.is_none() {
        reader.forgive();
    }
    let entry = entry.unwrap_or(&entries[0]);
    let (least, usual) = ACROSS;
    let width = reader.whole("width", usual as u64, least, MOST_ACROSS as u64) as usize;
    let values = read_values(reader, entry.parameters);
    // Twice as wide as high: an odd width loses a pixel.
    EnvironmentSource::Map { name: entry.card.name, width: width / 2 * 2, values }
}

/// Where a point light is; checked to be where it lights the surface.
fn position(reader: &Reader, shape: Shape) -> [f64; 3] {
    const DEFAULT: [f64; 3] = [0.0, 2.0, 2.0];
    let Some(item) = reader.item("position") else { return DEFAULT };
    let Some([x, y, z]) = item.point() else { return DEFAULT };
    match shape {
        Shape::Plane if z <= 0.0 => {
            item.error(format!("`position` is not above the plane: z is {z}"), None);
        }
        Shape::Sphere if x * x + y * y + z * z <= 1.0 => {
            item.error("`position` is inside the sphere of radius 1".to_owned(), None);
        }
        Shape::WavySphere(wavy) if x * x + y * y + z * z <= wavy.outside() * wavy.outside() => {
            let message = format!("`position` is not outside the crests, at {}", wavy.outside());
            item.error(message, None);
        }
        _ => {}
    }
    [x, y, z]
}
