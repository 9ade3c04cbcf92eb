//! What an experiment found: everything a report is written from.
//!
//! A [`Results`] holds no times: they vary from run to run and live in [`Costs`].

use std::sync::Arc;

use serde::{Deserialize, Serialize};

pub use super::budget::Budget;
use super::sequence::Sequence;
use super::spec::MotionSpec;
use crate::method::Truth;
use crate::render::Film;
use crate::texture::Lookup;

/// All that one run of an experiment found, apart from what it cost.
#[derive(Clone, Debug)]
pub struct Results {
    /// The experiment's name: its file's stem.
    pub name: String,
    /// Its title, a line.
    pub title: String,
    /// The question it answers, a sentence or two.
    pub question: String,
    /// The spec as written, TOML.
    pub spec: String,
    /// The seed of every random choice.
    pub seed: u64,
    /// The methods compared, in the order of the spec; the brute-force curve is `unfiltered`.
    pub methods: Vec<MethodInfo>,
    /// The textures, in the order of the spec.
    pub textures: Vec<TextureInfo>,
    /// One a scene: a texture seen one way under one light with one base lobe; of things that move, one a frame.
    pub scenes: Vec<SceneResult>,
    /// How things move, if they do.
    pub motion: Option<MotionSpec>,
    /// One a scene that moves: its frames, and how methods flicker over them.
    pub sequences: Vec<Sequence>,
}

/// A method as the experiment used it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MethodInfo {
    /// Its label in this experiment, unique: the method's name, or the spec's own.
    pub label: String,
    /// The method's name in the registry.
    pub name: String,
    /// Author, year, title, section.
    pub source: String,
    /// What it does, in a sentence.
    pub summary: String,
    /// Its multiple surface, in words and symbols.
    pub formula: String,
    /// What it cannot do.
    pub limits: String,
    /// Whether it keeps the footprint's energy.
    pub normalised: bool,
    /// Its options as `name = value`, in alphabetical order, then its lookup if it is not trilinear.
    pub options: Vec<String>,
    /// How it looks up what lies under a footprint, if it does.
    pub lookup: Option<Lookup>,
}

/// A texture as the experiment used it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TextureInfo {
    /// Its name in the spec.
    pub name: String,
    /// What made it: a pattern with its parameters, or a file with its reading.
    pub description: String,
    /// Texels along u.
    pub width: usize,
    /// Texels along v.
    pub height: usize,
    /// Things worth knowing about the map (normals not of unit length, below the horizon, …).
    pub notes: Vec<String>,
    /// A picture of the normal map: width × height RGB, 8 bit, row 0 at the top.
    #[serde(skip)]
    pub picture: Option<Arc<Picture>>,
}

/// A small 8-bit picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// sRGB triples, row by row from the top.
    pub rgb: Vec<[u8; 3]>,
}

/// The coordinates of a scene in the sweep: the columns that every row of `metrics.csv` shares.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneKey {
    /// Texture name.
    pub texture: String,
    /// Surface name: `plane`, `sphere`, `drapery` or `wavy-sphere`.
    pub surface: String,
    /// Light name: `directional` or `point`.
    pub light: String,
    /// Base lobe name: `blinn-phong`, `beckmann` or `ggx`.
    pub lobe: String,
    /// The base lobe's exponent or α.
    pub parameter: f64,
    /// `ndf` or `microfacet`.
    pub shading: String,
    /// Texels across a pixel at the image's centre: the square root of the footprint's area.
    pub texels_per_pixel: f64,
    /// Distance from the camera to the origin, scene units.
    pub distance: f64,
    /// Degrees above the plane z = 0 that the camera stands at.
    pub elevation: f64,
    /// Number of the frame, from 1, if things move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<u32>,
}

/// What was found for one scene.
#[derive(Clone, Debug)]
pub struct SceneResult {
    /// Where it stands in the sweep.
    pub key: SceneKey,
    /// A file-name-safe identifier, unique in the experiment, the same in every run.
    pub slug: String,
    /// The slug of its sequence, the same in all its frames; of a still scene, its own.
    pub sequence: String,
    /// The converged reference.
    pub reference: Reference,
    /// One a method and sample count, in the order of the spec.
    pub trials: Vec<TrialResult>,
    /// Methods that could not take this scene's base lobe.
    pub refusals: Vec<RefusalInfo>,
    /// Footprints whose distribution of normals was looked at.
    pub probes: Vec<Probe>,
    /// Budgets of the errors of some methods, if the spec asks for them.
    pub budgets: Vec<Budget>,
}

/// A converged reference image.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The image.
    pub film: Arc<Film>,
    /// The variance of each of its pixels, in their order.
    pub variance: Vec<f64>,
    /// Samples a pixel, all replicates together.
    pub spp: u32,
    /// Estimated root mean square error of the image itself: the standard error of the mean of its
    /// independent replicates, root mean square over pixels.
    pub rmse: f64,
    /// The mean over pixels of each pixel's standard error.
    pub mean_error: f64,
    /// What it shows of the bumps.
    pub truth: Truth,
    /// The least relative difference of root mean square errors that it was to tell apart.
    pub gap: f64,
}

/// One method at one sample count.
#[derive(Clone, Debug)]
pub struct TrialResult {
    /// The method's label.
    pub method: String,
    /// Samples a pixel.
    pub spp: u32,
    /// The image.
    pub film: Arc<Film>,
    /// Its scores against the reference.
    pub scores: Vec<Score>,
}

/// A metric and its value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// The metric's name, as in the `metric` column.
    pub metric: String,
    /// Its value.
    pub value: f64,
    /// Where its value before a reference without noise lies 95 times in 100, if that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
}

impl TrialResult {
    /// The value of a metric, if it was scored.
    pub fn score(&self, metric: &str) -> Option<f64> {
        self.scores.iter().find(|s| s.metric == metric).map(|s| s.value)
    }
}

/// A method that does not take the scene's base lobe.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RefusalInfo {
    /// The method's label.
    pub method: String,
    /// Why, as a sentence.
    pub reason: String,
}

/// A footprint whose true distribution of normals is set beside each method's.
///
/// Distributions are sampled on [`crate::geometry::HemisphereGrid::fournier`] (1297 directions), as
/// densities D per steradian in tangent space.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Probe {
    /// The pixel, from the left and from the top.
    pub pixel: [usize; 2],
    /// Texels the footprint is across.
    pub texels_across: f64,
    /// The true distribution: the mean of the base lobes over the footprint.
    pub truth: Vec<f32>,
    /// Each method's.
    pub methods: Vec<ProbedMethod>,
}

/// A method's distribution at a [`Probe`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ProbedMethod {
    /// The method's label.
    pub method: String,
    /// Its distribution on the probe's directions.
    pub density: Vec<f32>,
    /// Its lobes.
    pub peaks: Vec<Peak>,
    /// ½ ∫ |D − D_true| cos θ dω over the hemisphere: 0 for equal, 1 for disjoint normalised
    /// distributions.
    pub l1: f64,
    /// Its divergence from the truth, nats; see [`crate::metric::kl_divergence`].
    #[serde(default)]
    pub kl: Option<f64>,
    /// How far its mass would have to be moved; see [`crate::metric::wasserstein`].
    #[serde(default)]
    pub wasserstein: Option<f64>,
}

/// By method, in the order they are first seen, the mean over probes of [`ProbedMethod::l1`].
pub fn mean_distances<'a>(probes: impl Iterator<Item = &'a [ProbedMethod]>) -> Vec<(&'a str, f64)> {
    mean_figures(probes, |probed| Some(probed.l1))
}

/// By method, in the order they are first seen, the mean of a figure over the probes that have it.
pub fn mean_figures<'a>(
    probes: impl Iterator<Item = &'a [ProbedMethod]>,
    figure: impl Fn(&ProbedMethod) -> Option<f64>,
) -> Vec<(&'a str, f64)> {
    let mut found: Vec<(&str, Vec<f64>)> = Vec::new();
    for probed in probes.flatten() {
        let Some(value) = figure(probed) else { continue };
        match found.iter_mut().find(|(method, _)| *method == probed.method) {
            Some((_, values)) => values.push(value),
            None => found.push((&probed.method, vec![value])),
        }
    }
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    found.into_iter().map(|(method, distances)| (method, mean(&distances))).collect()
}

/// A lobe of a multiple surface, for drawing.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Peak {
    /// Its axis, unit, tangent space.
    pub axis: [f32; 3],
    /// Its density at the axis.
    pub density: f32,
}

/// What a run cost. These numbers vary from run to run and machine to machine.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Costs {
    /// One a texture, method and base lobe.
    pub prefilters: Vec<PrefilterCost>,
    /// One a trial, in the order of the results.
    pub trials: Vec<TrialCost>,
    /// Wall-clock seconds of the whole run, resumed parts not counted.
    pub total_secs: f64,
    /// Threads used.
    pub threads: usize,
}

/// The cost of preparing a map.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PrefilterCost {
    /// Texture name.
    pub texture: String,
    /// Method label.
    pub method: String,
    /// Base lobe, as in [`SceneKey::lobe`].
    pub lobe: String,
    /// The base lobe's exponent or α.
    pub parameter: f64,
    /// Wall-clock seconds.
    pub secs: f64,
    /// Bytes held beyond the normal map, divided by the map's texels.
    pub bytes_per_texel: f64,
}

/// The cost of a rendering.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TrialCost {
    /// The scene's slug.
    pub scene: String,
    /// Method label.
    pub method: String,
    /// Samples a pixel.
    pub spp: u32,
    /// CPU nanoseconds a pixel: wall-clock time × threads ÷ pixels.
    pub ns_per_pixel: f64,
}
