//! Arguments, as written on the command line.

mod bake;

use std::path::PathBuf;

pub use bake::BakeArgs;

use clap::{Args as ArgGroup, Parser, Subcommand};

use crate::experiment::share::Share;
use crate::experiment::spec::Setting;
use crate::job;
use crate::metric;
use crate::tui::picture::{Colours, Pictures};

/// wrinkle's arguments.
#[derive(Debug, Parser)]
#[command(
    name = "wrinkle",
    version,
    about = "Measures filters for bump maps and normal maps against supersampled truth.",
    after_help = "Examples:
  wrinkle                             the terminal runner: watch, explore, compare
  wrinkle tui my_normals.png          what each filter does to your map, live
  wrinkle run                         the default experiment; its report goes to reports/highlight/
  wrinkle run quick                   a few seconds' work
  wrinkle render my_normals.png --method fournier --out look.png
  wrinkle bake ggx:0.3 --out rough.png  a normal map that follows a distribution
  wrinkle bake --onto my_normals.png --out finer.png  the same as detail on a map
  wrinkle list                        experiments, methods, patterns, surfaces",
    disable_help_subcommand = true
)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run experiments and write their reports.
    Run(RunArgs),
    /// Put the shards of an experiment together and write its report.
    Merge(MergeArgs),
    /// Run experiments again and compare with their reports, byte for byte.
    Verify(VerifyArgs),
    /// Open the terminal runner: watch runs, explore a scene, compare results.
    Tui(TuiArgs),
    /// Show the experiments, methods, patterns, surfaces and environments there are.
    List(ListArgs),
    /// Render one image.
    Render(RenderArgs),
    /// Draw what a multiple surface reflects.
    Lobes(LobesArgs),
    /// Score one image against another.
    Compare(CompareArgs),
    /// Fit Phong peaks to a measured distribution.
    Fit(FitArgs),
    /// Synthesise a normal map from a distribution of normals, or detail on a map.
    Bake(BakeArgs),
}

/// Arguments of `run`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle run                         the default experiment, `highlight`
  wrinkle run quick highlight         two experiments, one after the other
  wrinkle run my/experiment.toml --out results --threads 8
  wrinkle run highlight --shard 2/3   the second of three parts; `wrinkle merge` puts them together

Results are kept as they come. Interrupt with Ctrl-C; the same command goes on where it stopped.")]
pub struct RunArgs {
    /// Experiments: names of files in experiments/ without `.toml`, or paths of such files.
    #[arg(value_name = "NAME|FILE", default_value = job::DEFAULT)]
    pub experiments: Vec<String>,
    /// Folder that reports go to, one folder an experiment.
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Threads to use; all cores if not given. Results are the same at any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Do only the K-th of N parts of about the same work, and write no report: the parts may run at once, on several
    /// machines, with the same program.
    #[arg(long, value_name = "K/N")]
    pub shard: Option<Share>,
    /// Print a summary as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `merge`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle merge highlight             the shards in reports/highlight/
  wrinkle merge highlight --from node1/reports --from node2/reports

The report is the same, byte for byte, as that of a run that was not shared; only costs differ.
A shard that died is simply run again.")]
pub struct MergeArgs {
    /// The experiment: name of a file in experiments/ without `.toml`, or path of such a file.
    #[arg(value_name = "NAME|FILE", default_value = job::DEFAULT)]
    pub experiment: String,
    /// Folder that shards are in; may be given more than once. That of reports if not given.
    #[arg(long, value_name = "DIR")]
    pub from: Vec<PathBuf>,
    /// Folder that reports go to, one folder an experiment.
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Print a summary as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `verify`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle verify                      every report in reports/
  wrinkle verify quick                one of them
  wrinkle verify my/experiment.toml --out results

The experiment that is run is the one that stands in the report, afresh, in a temporary folder
(TMPDIR). All files are compared but those of costs. Exit code 0: all the same; 1: something
differs.")]
pub struct VerifyArgs {
    /// Reports: names of folders in the folder of reports, or paths of experiment files, whose reports are there; all
    /// reports if none is named.
    #[arg(value_name = "NAME|FILE")]
    pub reports: Vec<String>,
    /// Folder that reports are in.
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Threads to use; all cores if not given. Results are the same at any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print what was found as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `tui`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle tui                         experiments, the lab, results; ? shows all keys
  wrinkle tui quick                   with this experiment chosen
  wrinkle tui my_normals.png          what each filter does to this map, live

`wrinkle` alone does the same on a terminal.")]
pub struct TuiArgs {
    /// An experiment to choose, or an image file that holds a normal map, which opens in the lab.
    #[arg(value_name = "EXPERIMENT|MAP")]
    pub what: Option<String>,
    /// Folder that reports are in and go to.
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// How pictures are drawn; the terminal is asked if this is not given.
    #[arg(long, value_enum, default_value_t, value_name = "HOW")]
    pub pictures: Pictures,
    /// Which colours are used; NO_COLOR, COLORTERM and TERM tell if this is not given.
    #[arg(long, value_enum, default_value_t, value_name = "WHICH", visible_alias = "color")]
    pub colour: Colours,
    /// Leave the mouse to the terminal.
    #[arg(long)]
    pub no_mouse: bool,
    /// Threads to use; all cores if not given. Results are the same at any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// Arguments of `list`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle list
  wrinkle list --json")]
pub struct ListArgs {
    /// Print as JSON, options included.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `render`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle render my_normals.png --method schilling-anisotropic --out look.png
  wrinkle render quick --texture small-twill --method fournier --spp 4 --out twill.exr
  wrinkle render velvet --shape sphere --out velvet.png
  wrinkle render height.png --kind height --height-scale 8 --texels-per-pixel 2 --out h.png
  wrinkle render my_normals.png --shape teapot --method lean --out teapot.png
  wrinkle render my_normals.png --shape statue.glb --set material.exponent=200 --out statue.png
  wrinkle render letters --set texture.letters.text=\"MY TEXT\" --shape ribbon --out letters.png
  wrinkle render my_normals.png --shape sphere --animate --spp 4 --size 240x240 --out turning.png")]
pub struct RenderArgs {
    /// An experiment (name or TOML file), an image file that holds a normal or height map, a pattern, or a
    /// multiple surface (name or JSON file of peaks).
    #[arg(value_name = "FILE")]
    pub file: String,
    /// The filter; `wrinkle list` shows them.
    #[arg(long, value_name = "M", default_value = "unfiltered")]
    pub method: String,
    /// Samples a pixel; 1 if not given, 16 for a multiple surface.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub spp: Option<u32>,
    /// The image to write: PNG (exposed, 8-bit sRGB) or EXR (linear, 32-bit float).
    #[arg(long, value_name = "IMAGE")]
    pub out: PathBuf,
    /// Which texture of the experiment; its first if not given.
    #[arg(long, value_name = "NAME")]
    pub texture: Option<String>,
    /// Texels across a pixel at the image's centre; the experiment's first scale, or 4, if not given.
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub texels_per_pixel: Option<f64>,
    /// What the bumps, or a multiple surface, cover: a surface (`wrinkle list`), or an OBJ, glTF or GLB file. If
    /// not given, the experiment's own; a plane; of a multiple surface a sphere.
    #[arg(long, value_name = "NAME|FILE")]
    pub shape: Option<String>,
    /// Changes any setting of the experiment, or of the default scene, as docs/experiments.md has them; may be
    /// given more than once.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<Setting>,
    /// Write all frames of a motion as an animated PNG. If no KIND is given, it is the experiment's own, or the object
    /// turns once round.
    #[arg(long, value_name = "KIND", num_args = 0..=1, require_equals = true, value_parser = ["rotate", "light", "drift", "approach", "recede"])]
    pub animate: Option<Option<String>>,
    /// Width and height of the image; the experiment's, or 640x480, if not given.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(usize, usize)>,
    /// What the image file holds.
    #[arg(long, default_value = "normal", value_parser = ["normal", "height"])]
    pub kind: String,
    /// Which way green is up in the normal map.
    #[arg(long, default_value = "up", value_parser = ["up", "down"])]
    pub green: String,
    /// Height of white in the height map, in texels.
    #[arg(long, value_name = "H", default_value_t = 8.0, allow_negative_numbers = true, value_parser = parse_height)]
    pub height_scale: f64,
    /// Exposure of a PNG: radiance is multiplied by it. Chosen from the image if not given.
    #[arg(long, value_name = "E", allow_negative_numbers = true, value_parser = parse_exposure)]
    pub exposure: Option<f64>,
}

/// Arguments of `lobes`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle lobes velvet --out velvet-lobes.png
  wrinkle lobes anisotropic --azimuth 0,45,90 --out lobes.png
  wrinkle lobes peaks.json --shading microfacet --json

Radiance is that of light of unit irradiance on a plane facing it, in the plane of incidence. A file of peaks is
JSON as `wrinkle lobes --json` and `wrinkle fit --json` print it.")]
pub struct LobesArgs {
    /// A multiple surface: its name (`wrinkle list`), or a JSON file of peaks.
    #[arg(value_name = "SURFACE")]
    pub surface: String,
    /// The picture to write, PNG.
    #[arg(long, value_name = "IMAGE", required_unless_present = "json")]
    pub out: Option<PathBuf>,
    /// Angles of incidence, degrees from the normal.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "0,30,60", allow_negative_numbers = true, value_parser = parse_incidence)]
    pub incidence: Vec<f64>,
    /// Planes of incidence, degrees from +x towards +y.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "0,90", allow_negative_numbers = true, value_parser = parse_azimuth)]
    pub azimuth: Vec<f64>,
    /// How lobes become light.
    #[arg(long, default_value = "ndf", value_parser = ["ndf", "microfacet"])]
    pub shading: String,
    /// Print peaks and radiances as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `compare`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle compare mine.exr reference.exr
  wrinkle compare mine.png reference.png --fail-above flip=0.05 --fail-below ssim=0.98
  wrinkle compare mine.exr reference.exr --metric relmse:pbrt,relmse:tev
  wrinkle compare mine.exr reference.exr --map error.png --map-kind flip
  wrinkle compare a.exr b.exr --json

Exits with 0 if no limit is broken, with 1 if one is, and with 2 if the request is wrong. docs/metrics.md has every
metric, its formula and its source.")]
pub struct CompareArgs {
    /// The image to score: EXR, HDR, PNG, TIFF or WebP.
    #[arg(value_name = "A")]
    pub test: PathBuf,
    /// The image it is scored against.
    #[arg(value_name = "B")]
    pub reference: PathBuf,
    /// Only these metrics; all if not given. A variant is asked for as relmse:pbrt.
    #[arg(long, value_name = "METRIC", value_delimiter = ',')]
    pub metric: Vec<String>,
    /// Exit with 1 if this metric is above this value, or has none; may be given more than once.
    #[arg(long, value_name = "METRIC=VALUE", value_parser = parse_limit)]
    pub fail_above: Vec<(String, f64)>,
    /// Exit with 1 if this metric is below this value, or has none; may be given more than once.
    #[arg(long, value_name = "METRIC=VALUE", value_parser = parse_limit)]
    pub fail_below: Vec<(String, f64)>,
    /// What codes for a display are scored as: as stored, from 0 to 1, or as the light they stand for.
    #[arg(long, default_value = "stored", value_parser = ["stored", "linear"])]
    pub encoding: String,
    /// Pixels of the screen to a degree of the visual field, for FLIP.
    #[arg(long, value_name = "N", default_value_t = metric::PPD, allow_negative_numbers = true, value_parser = parse_ppd)]
    pub ppd: f64,
    /// Write the error of each pixel: PNG (false colour) or EXR (numbers).
    #[arg(long, value_name = "IMAGE")]
    pub map: Option<PathBuf>,
    /// What the map shows.
    #[arg(long, default_value = "absolute", value_parser = ["absolute", "signed", "relative", "flip"])]
    pub map_kind: String,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `fit`.
#[derive(Debug, ArgGroup)]
#[command(after_help = "Examples:
  wrinkle fit samples.csv
  wrinkle fit samples.csv --max-peaks 3 --plot fit.png
  wrinkle fit samples.csv --restarts 14 --json

A line of the file is x,y,z,value: a direction of any length, z along the surface's normal, and the
density there, at least 0. Blank lines, lines that begin with # and a header are skipped.")]
pub struct FitArgs {
    /// The samples.
    #[arg(value_name = "SAMPLES.csv")]
    pub samples: PathBuf,
    /// The most peaks.
    #[arg(long, value_name = "K", default_value_t = 7, value_parser = clap::value_parser!(u16).range(1..=32))]
    pub max_peaks: u16,
    /// Add no peak once rms and maximum of what is left are below this part of the samples'.
    #[arg(long, value_name = "PART", default_value_t = 0.05, allow_negative_numbers = true, value_parser = parse_stop)]
    pub stop: f64,
    /// How often, at the end, a peak is set anew where most is left; kept if that is better.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1000))]
    pub restarts: u16,
    /// Draw samples, fit and what is left to this PNG.
    #[arg(long, value_name = "OUT.png")]
    pub plot: Option<PathBuf>,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

fn parse_size(text: &str) -> Result<(usize, usize), String> {
    let (width, height) = text.split_once('x').ok_or("write it as 640x480")?;
    let side = |side: &str| match side.parse() {
        Ok(pixels @ 1..=4096) => Ok(pixels),
        _ => Err(format!("`{side}` is not a whole number from 1 to 4096")),
    };
    Ok((side(width)?, side(height)?))
}

fn parse_incidence(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(angle) if angle > -90.0 && angle < 90.0 => Ok(angle),
        _ => Err("give degrees above -90 and below 90".into()),
    }
}

fn parse_azimuth(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(angle) if (-360.0..=360.0).contains(&angle) => Ok(angle),
        _ => Err("give degrees from -360 to 360".into()),
    }
}

fn parse_height(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(height) if (-1e4..=1e4).contains(&height) => Ok(height),
        _ => Err("give a number from -10000 to 10000".into()),
    }
}

fn parse_exposure(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(exposure) if exposure > 0.0 && f64::is_finite(exposure) => Ok(exposure),
        _ => Err("give a number above 0".into()),
    }
}

fn parse_stop(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(part) if (0.0..=1.0).contains(&part) => Ok(part),
        _ => Err("give a number from 0 to 1".into()),
    }
}

fn parse_ppd(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(ppd) if (1.0..=1000.0).contains(&ppd) => Ok(ppd),
        _ => Err("give a number from 1 to 1000".into()),
    }
}

fn parse_limit(text: &str) -> Result<(String, f64), String> {
    let (metric, value) = text.split_once('=').ok_or("write it as rmse=0.01")?;
    let value: f64 = value.parse().map_err(|_| format!("`{value}` is not a number"))?;
    if value.is_nan() {
        return Err("a limit cannot be NaN".into());
    }
    Ok((metric.to_owned(), value))
}
