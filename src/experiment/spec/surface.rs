//! The surface that carries the bumps, and the axes they stand in.

use std::path::PathBuf;

use super::item::Item;
use super::limits::Limits;
use super::reader::Reader;
use super::texture::folder;
use crate::geometry::Ripples;
use crate::surface::{Perturbation, Up};

/// A surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceSpec {
    /// What it is.
    pub shape: Shape,
    /// What its bumps stand in.
    pub axes: AxesSpec,
    /// What slopes of its bumps are.
    pub perturbation: Perturbation,
    /// The file of a mesh; of no other shape.
    pub model: Option<ModelSpec>,
}

/// A model in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelSpec {
    /// Where it is: the spec's folder joined with the path as the spec has it.
    pub path: PathBuf,
    /// Which of its axes points up.
    pub up: Up,
}

/// The form of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// The plane z = 0.
    Plane,
    /// The sphere of radius 1 about the origin.
    Sphere,
    /// A cloth that hangs in folds about the origin and faces −y.
    Drapery,
    /// A sphere about the origin whose radius ripples, as a mesh.
    WavySphere(WavySphereSpec),
    /// The teapot.
    Teapot,
    /// A flat patch with one corner bent back.
    BentPatch,
    /// The cylinder of radius 1 about z, 2 high.
    Cylinder,
    /// A strip that waves and faces −y.
    Ribbon,
    /// The triangles of a file, within the sphere of radius 1 about the origin.
    Mesh,
}

/// A rippled sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WavySphereSpec {
    /// Its ripples.
    pub ripples: Ripples,
    /// Cells of the mesh from pole to pole, in [3, 256]; twice as many are round the equator.
    pub cells: usize,
}

impl WavySphereSpec {
    /// Radius of its crests: nothing of it is further out.
    pub(super) fn outside(&self) -> f64 {
        1.0 + self.ripples.amplitude
    }

    fn read(reader: &Reader) -> Self {
        Self {
            cells: reader.whole("cells", 24, 3, 256) as usize,
            ripples: Ripples {
                count: reader.whole("ripples", 12, 0, 64) as u32,
                amplitude: reader.real("amplitude", 0.03, Limits::from_to(0.0, 0.5)),
            },
        }
    }
}

/// The axes that bumps stand in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxesSpec {
    /// Along u and across it, about the surface's normal.
    Natural,
    /// East, north and out on the sphere without ripples.
    Sphere,
    /// Across a main direction and on its side: its coordinates, world space, not all 0.
    MainDirection([f64; 3]),
}

impl Shape {
    /// Its name in specs and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Sphere => "sphere",
            Self::Drapery => "drapery",
            Self::WavySphere(_) => "wavy-sphere",
            Self::Teapot => "teapot",
            Self::BentPatch => "bent-patch",
            Self::Cylinder => "cylinder",
            Self::Ribbon => "ribbon",
            Self::Mesh => "mesh",
        }
    }
}

/// The words for a shape, before its own keys are read.
#[derive(Clone, Copy)]
enum Word {
    Of(Shape),
    WavySphere,
}

impl SurfaceSpec {
    /// Reads it, with the key `tiles` and its value if there is one.
    pub(super) fn read<'a>(reader: &Reader<'a>) -> (Self, Option<(Item<'a>, f64)>) {
        let shapes = [
            ("plane", Word::Of(Shape::Plane)),
            ("sphere", Word::Of(Shape::Sphere)),
            ("drapery", Word::Of(Shape::Drapery)),
            ("wavy-sphere", Word::WavySphere),
            ("teapot", Word::Of(Shape::Teapot)),
            ("bent-patch", Word::Of(Shape::BentPatch)),
            ("cylinder", Word::Of(Shape::Cylinder)),
            ("ribbon", Word::Of(Shape::Ribbon)),
            ("mesh", Word::Of(Shape::Mesh)),
        ];
        let shape = match reader.choice("shape", &shapes) {
            Word::Of(shape) => shape,
            Word::WavySphere => Shape::WavySphere(WavySphereSpec::read(reader)),
        };
        let model = if shape == Shape::Mesh { ModelSpec::read(reader) } else { None };
        let tiles = reader.item("tiles");
        let limits = Limits::above(0.0, 1e6);
        let tiles = tiles.and_then(|t| Some((t.clone(), t.real(limits)?)));
        let axes = AxesSpec::read(reader, shape);
        let perturbation = read_perturbation(reader, axes);
        (Self { shape, axes, perturbation, model }, tiles)
    }
}

/// What slopes are; displacements stand in ∇u and ∇v, and no other axes.
fn read_perturbation(reader: &Reader, axes: AxesSpec) -> Perturbation {
    #[derive(Clone, Copy, PartialEq)]
    enum Form {
        Tangent,
        Displacement,
        ScaleInvariant,
    }
    let words = [
        ("tangent", Form::Tangent),
        ("displacement", Form::Displacement),
        ("scale-invariant", Form::ScaleInvariant),
    ];
    let form = reader.choice("perturbation", &words);
    if form != Form::Tangent
        && axes != AxesSpec::Natural
        && let Some(item) = reader.item("perturbation")
    {
        let message = "displacements stand along u and v: a `frame` would change nothing";
        item.error(message.to_owned(), Some("leave out one of the two".to_owned()));
    }
    match form {
        Form::Tangent => Perturbation::Tangent,
        Form::Displacement => Perturbation::Displacement {
            unit: reader.real("height_unit", 1.0, Limits::above(0.0, 1e6)),
        },
        Form::ScaleInvariant => Perturbation::ScaleInvariant,
    }
}

impl ModelSpec {
    fn read(reader: &Reader) -> Option<Self> {
        let file = reader.required("file", "the path of an OBJ, glTF or GLB file")?;
        let path = folder(reader).join(file.text()?);
        if !path.is_file() {
            let help = "paths are relative to the folder of this file".to_owned();
            file.error(format!("there is no file {}", path.display()), Some(help));
        }
        Some(Self { path, up: reader.choice("up", &[("y", Up::Y), ("z", Up::Z)]) })
    }
}

impl AxesSpec {
    fn read(reader: &Reader, shape: Shape) -> Self {
        #[derive(Clone, Copy)]
        enum Frame {
            Natural,
            Sphere,
            Main,
        }
        let frame = match shape {
            Shape::WavySphere(_) => reader.choice(
                "frame",
                &[
                    ("vertex", Frame::Natural),
                    ("sphere", Frame::Sphere),
                    ("main-direction", Frame::Main),
                ],
            ),
            _ => reader.choice(
                "frame",
                &[("normalised", Frame::Natural), ("main-direction", Frame::Main)],
            ),
        };
        match frame {
            Frame::Natural => Self::Natural,
            Frame::Sphere => Self::Sphere,
            Frame::Main => Self::MainDirection(main_direction(reader, shape)),
        }
    }
}

/// The main direction; by default the sphere's axis, and on the plane +y, which gives the plane's own axes.
fn main_direction(reader: &Reader, shape: Shape) -> [f64; 3] {
    let default = if shape == Shape::Plane { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let Some(item) = reader.item("main") else { return default };
    let Some([x, y, z]) = item.point() else { return default };
    let message = match shape {
        Shape::Plane if x == 0.0 && y == 0.0 => {
            "`main` is across the plane: no axis follows from it"
        }
        _ if [x, y, z] == [0.0; 3] => "`main` has no direction",
        _ => return [x, y, z],
    };
    item.error(message.to_owned(), None);
    default
}
