//! Arguments of `bake`.

use std::path::PathBuf;

use clap::Args as ArgGroup;

use super::parse_height;

/// Arguments of `bake`.
#[derive(Debug, ArgGroup)]
#[command(
    group = clap::ArgGroup::new("map").args(["like", "onto"]).multiple(true),
    after_help = "Examples:
  wrinkle bake beckmann:0.3 --out rough.png
  wrinkle bake ggx:0.1,0.4,30 --size 2048x2048 --bits 8 --green down --out brushed.png
  wrinkle bake '2*ggx:0.1 + beckmann:0.2@30,90' --out leaning.png
  wrinkle bake my_ndf.exr --out bumps.exr
  wrinkle bake --like my_normals.png --size 1024x1024 --out more_of_it.png
  wrinkle bake --like my_normals.png --ndf-out my_ndf.exr
  wrinkle bake --onto my_normals.png --size 4096x4096 --amount 0.3 --out finer.png

The map repeats without a seam; onto another map, if that does. An image of a distribution is square, its axes the x
and y of normals from -1 to 1, its values densities; the way of Kautz, Heidrich and Seidel 2001."
)]
pub struct BakeArgs {
    /// The distribution of normals: lobes (beckmann:A, ggx:A, blinn-phong:S; A,B for widths along u and v, A,B,DEGREES
    /// to turn them; @TILT,AZIMUTH to lean them; several as 2*ggx:0.1+ggx:0.4), a multiple surface (name or JSON file of
    /// peaks), or an image file.
    #[arg(value_name = "NDF", required_unless_present_any = ["like", "onto"])]
    pub ndf: Option<String>,
    /// Measure the distribution from this map.
    #[arg(long, value_name = "MAP", conflicts_with = "ndf")]
    pub like: Option<PathBuf>,
    /// Lay the bumps onto those of this map, as detail; the distribution is the map's own if none is told.
    #[arg(long, value_name = "MAP")]
    pub onto: Option<PathBuf>,
    /// How strong detail is: 0 gives the map back, 1 adds noise as strong as that of a map without another.
    #[arg(long, value_name = "A", default_value_t = 0.5, allow_negative_numbers = true, value_parser = parse_amount, requires = "onto")]
    pub amount: f64,
    /// Part of the map's own distribution that is mixed into the one told, so that all its normals come back.
    #[arg(long, value_name = "F", default_value_t = 0.02, allow_negative_numbers = true, value_parser = parse_floor, requires = "onto")]
    pub floor: f64,
    /// What the map of --like or --onto holds.
    #[arg(long, default_value = "normal", value_parser = ["normal", "height"], requires = "map")]
    pub kind: String,
    /// Which way green is up in that map.
    #[arg(long, default_value = "up", value_parser = ["up", "down"], requires = "map")]
    pub map_green: String,
    /// Height of white in that map, if it holds heights, in texels.
    #[arg(long, value_name = "H", default_value_t = 8.0, allow_negative_numbers = true, value_parser = parse_height, requires = "map")]
    pub height_scale: f64,
    /// What lies beyond that map's edge: the map again, or its edge texel.
    #[arg(long, default_value = "repeat", value_parser = ["repeat", "clamp"], requires = "map")]
    pub wrap: String,
    /// The normal map to write: PNG, or EXR (32-bit floats).
    #[arg(long, value_name = "IMAGE", required_unless_present = "ndf_out")]
    pub out: Option<PathBuf>,
    /// Write the distribution too, as a picture that can be given as NDF: EXR (32-bit floats), or 16-bit PNG.
    #[arg(long, value_name = "IMAGE")]
    pub ndf_out: Option<PathBuf>,
    /// Width and height of the map, texels; 1024x1024 if not given, onto a map its own. A larger one is interpolated.
    #[arg(long, value_name = "WxH", value_parser = parse_map_size)]
    pub size: Option<(usize, usize)>,
    /// Lattice cells of the first octave of noise along the shorter side: how many of the largest bumps there are. 16 if not
    /// given; onto a map, a quarter of its texels there.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub cells: Option<u32>,
    /// Octaves of noise; as many as the texels can show if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=24))]
    pub octaves: Option<u32>,
    /// Height of each octave over that of the one before, above 0 and below 1.
    #[arg(long, value_name = "G", default_value_t = 0.5, allow_negative_numbers = true, value_parser = parse_gain)]
    pub gain: f64,
    /// What the noise is drawn from.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Bits a coordinate of a PNG.
    #[arg(long, default_value = "16", value_parser = ["8", "16"])]
    pub bits: String,
    /// Which way green is up in what is written.
    #[arg(long, default_value = "up", value_parser = ["up", "down"])]
    pub green: String,
    /// What the values of an image are densities of: normals over the (x, y) map, or over solid angle.
    #[arg(long, default_value = "map", value_parser = ["map", "solid-angle"])]
    pub measure: String,
    /// Print what was made as JSON.
    #[arg(long)]
    pub json: bool,
}

fn parse_amount(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(amount) if (0.0..=8.0).contains(&amount) => Ok(amount),
        _ => Err("give a number from 0 to 8".into()),
    }
}

fn parse_floor(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(floor) if (0.0..1.0).contains(&floor) => Ok(floor),
        _ => Err("give a number from 0 to below 1".into()),
    }
}

fn parse_map_size(text: &str) -> Result<(usize, usize), String> {
    let (width, height) = text.split_once('x').ok_or("write it as 1024x1024")?;
    let side = |side: &str| match side.parse() {
        Ok(texels @ 1..=16384) => Ok(texels),
        _ => Err(format!("`{side}` is not a whole number from 1 to 16384")),
    };
    Ok((side(width)?, side(height)?))
}

fn parse_gain(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(gain) if gain > 0.0 && gain < 1.0 => Ok(gain),
        _ => Err("give a number above 0 and below 1".into()),
    }
}
