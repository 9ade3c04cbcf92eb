//! Figures of an exhibit, as data: the report draws them.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::render::Film;

/// A drawing with what it shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// Its name within the row, safe as part of a file's name.
    pub name: String,
    /// What it shows, a sentence or two.
    pub caption: String,
    /// What is drawn.
    pub drawing: Drawing,
}

impl Figure {
    /// A figure.
    pub fn new(name: &str, caption: impl Into<String>, drawing: Drawing) -> Self {
        Self { name: name.into(), caption: caption.into(), drawing }
    }
}

/// What a figure draws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drawing {
    /// Rendered images side by side, on one exposure.
    Images(Images),
    /// Distributions of normals on the hemisphere seen from above, on one scale unless they ask for
    /// their own.
    Discs(Vec<Disc>),
    /// Numbers against numbers.
    Chart(Chart),
    /// Scalar fields in false colour, on one scale.
    Fields(Vec<Field>),
    /// Reflection in the plane of incidence, as polar plots.
    Lobes(Vec<LobePlot>),
    /// Tables of heights as nets of lines, seen from above and aside, hidden lines left out. Heights are in
    /// sides of a cell.
    Nets(Vec<Field>),
    /// Diagrams of lines and arrows.
    Sketches(Vec<Sketch>),
}

/// Rendered images on one exposure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Images {
    /// The images, in the order they are shown.
    pub panels: Vec<Panel>,
    /// Radiance shown as white; chosen from the first panel if not given.
    pub white: Option<f64>,
    /// Index of the panel that the others are compared with, if their errors are to be shown.
    pub reference: Option<usize>,
    /// Most panels in a row.
    pub across: usize,
}

/// An image of a figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// Its name within the row: the stem of its EXR file.
    pub name: String,
    /// What it is called.
    pub label: String,
    /// A line below that: samples, error.
    pub remark: String,
    /// The image. Kept as a file of its own, not in the record.
    #[serde(skip)]
    pub film: Option<Arc<Film>>,
}

impl Panel {
    /// A panel.
    pub fn new(name: &str, label: impl Into<String>, film: Arc<Film>) -> Self {
        let (name, label) = (name.to_owned(), label.into());
        Self { name, label, remark: String::new(), film: Some(film) }
    }

    /// The same panel with a line below its label.
    pub fn remarked(mut self, remark: impl Into<String>) -> Self {
        self.remark = remark.into();
        self
    }
}

/// A distribution of normals on the hemisphere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Disc {
    /// What it is called.
    pub label: String,
    /// A line below that.
    pub remark: String,
    /// Densities on the directions of [`crate::geometry::HemisphereGrid::fournier`] (1297), or nothing.
    /// Negative values (residuals) are drawn in another hue.
    pub density: Vec<f64>,
    /// Unit axes to mark, tangent space.
    pub peaks: Vec<[f64; 3]>,
    /// Whether it is drawn on a scale of its own: a residual beside a distribution.
    pub own_scale: bool,
}

/// Numbers against numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, in the order of its legend.
    pub series: Vec<Series>,
}

/// An axis of a [`Chart`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What it measures, with its unit.
    pub label: String,
    /// Whether it is logarithmic.
    pub log: bool,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: &str) -> Self {
        Self { label: label.into(), log: false }
    }

    /// A logarithmic axis.
    pub fn log(label: &str) -> Self {
        Self { label: label.into(), log: true }
    }
}

/// A curve or a cloud of a [`Chart`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// (x, y), in order.
    pub points: Vec<[f64; 2]>,
    /// Whether the points are joined.
    pub joined: bool,
}

/// A scalar field on a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Field {
    /// What it is called.
    pub label: String,
    /// Cells across.
    pub width: usize,
    /// Values row by row from the *bottom*, as maps have them; as many as a multiple of `width`.
    pub values: Vec<f64>,
}

/// A diagram, to one scale each way; y is up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sketch {
    /// What it is called.
    pub label: String,
    /// What is drawn, the first below the others.
    pub strokes: Vec<Stroke>,
}

/// A line of a [`Sketch`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Its points, joined.
    pub points: Vec<[f64; 2]>,
    /// Whether it ends in an arrow's head.
    pub arrow: bool,
    /// What stands beside its end; may be empty.
    pub name: String,
    /// Which of the inks it is drawn in; equal numbers look alike.
    pub ink: usize,
}

/// Reflection in the plane of incidence for a few directions of incidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LobePlot {
    /// What reflects.
    pub label: String,
    /// Azimuth of the plane of incidence in the tangent plane, degrees from +x.
    pub azimuth: f64,
    /// One a direction of incidence.
    pub reflections: Vec<Reflection>,
}

/// What is reflected of light from one direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reflection {
    /// Angle of incidence, degrees from the normal, towards the negative side of the plane.
    pub incidence: f64,
    /// [angle, radiance]: of exit, degrees from the normal from −90 to 90, rising, negative on the
    /// side of the light.
    pub exits: Vec<[f64; 2]>,
}
