//! What the lab and its threads say to each other.

use std::path::PathBuf;
use std::sync::Arc;

use super::setup::Setup;
use crate::experiment::spec::Spec;
use crate::metric::Equivalent;
use crate::render::Film;

/// What the lab asks of its threads.
#[derive(Clone, Debug)]
pub enum Order {
    /// To open an experiment or a map, by name or path.
    Open(String),
    /// To render a scene. It takes the place of what was asked before.
    Show(Box<Wanted>),
    /// To stop rendering.
    Rest,
    /// To look under a pixel of the scene shown.
    Probe(Look),
    /// To write an experiment into the folder of experiments.
    Save(String),
}

/// A scene to render.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The scene's number: answers carry it.
    pub scene: u64,
    /// The scene.
    pub spec: Spec,
    /// Samples a pixel of every method.
    pub spp: u32,
    /// The methods looked at now, by their place in the spec: they come first.
    pub first: Vec<usize>,
}

/// A pixel to look under.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The scene's number.
    pub scene: u64,
    /// The pixel.
    pub pixel: [usize; 2],
    /// The methods, by their place in the spec.
    pub methods: Vec<usize>,
}

/// What the lab's threads tell.
#[derive(Clone, Debug)]
pub enum Told {
    /// What was asked to be opened is open, or why it is not.
    Opened(Result<Box<Setup>, String>),
    /// About the scene of this number.
    Of(u64, Finding),
    /// An experiment was written, or why it could not be.
    Saved(Result<PathBuf, String>),
}

/// What was found about a scene.
#[derive(Clone, Debug)]
pub enum Finding {
    /// Things worth knowing about its texture, a sentence each.
    Notes(Vec<String>),
    /// Something is being worked at, and how much of it is done, from 0 to 1.
    Working(String, f64),
    /// The reference has converged further.
    Reference {
        /// The image.
        film: Arc<Film>,
        /// Samples a pixel.
        spp: u32,
        /// Its own error.
        rmse: f64,
    },
    /// A method's map was built.
    Built {
        /// Which.
        method: usize,
        /// Seconds it took; 0 if it was built for an earlier scene.
        secs: f64,
        /// Bytes a texel beyond the map.
        bytes_per_texel: f64,
    },
    /// A method's image.
    Image {
        /// Which.
        method: usize,
        /// The image.
        film: Arc<Film>,
        /// CPU nanoseconds a pixel.
        ns_per_pixel: f64,
    },
    /// A method does not take the base lobe: a sentence.
    Refused {
        /// Which.
        method: usize,
        /// Why.
        reason: String,
    },
    /// Errors anew: one a method, as far as there are images.
    Scores(Vec<Option<Score>>),
    /// What lies under a pixel.
    Under(Box<Under>),
    /// All of it is done.
    Done,
    /// It cannot be rendered: a sentence.
    Failed(String),
}

/// How far a method's image is from the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// Root mean square error.
    pub rmse: f64,
    /// How many unfiltered samples a pixel are as good, as far as these are measured.
    pub worth: Option<Equivalent>,
}

/// What lies under a pixel.
#[derive(Clone, Debug)]
pub struct Under {
    /// The pixel.
    pub pixel: [usize; 2],
    /// Texels the footprint is across; None where the pixel misses the surface.
    pub texels_across: Option<f64>,
    /// The true distribution of normals, densities on the 1297 directions of Fournier's grid.
    pub truth: Vec<f32>,
    /// What the methods asked for hold of it.
    pub methods: Vec<Held>,
}

/// What a method holds of a footprint.
#[derive(Clone, Debug)]
pub struct Held {
    /// Which method.
    pub method: usize,
    /// Its densities.
    pub density: Vec<f32>,
    /// The axes of its lobes, tangent space.
    pub axes: Vec<[f32; 3]>,
    /// Total variation distance to the truth: 0 for the same, 1 for disjoint.
    pub distance: f64,
}
