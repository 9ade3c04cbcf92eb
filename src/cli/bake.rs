//! `wrinkle bake`: a normal map synthesised from a distribution of normals.

use std::io::Write;
use std::path::Path;

use super::Exit;
use super::args::BakeArgs;
use super::exit::{Failure, tell};
use super::{output, surface};
use crate::lobe::vector::turned;
use crate::lobe::{EllipticLobe, Measure, MultipleSurface, NdfImage, Profile};
use crate::pattern::square_cells;
use crate::synthesis::{Agreement, Noise, Synthesis, octaves_for};
use crate::texture::NormalMap;
use crate::texture::image_file::{
    Codes, Green, HeightReading, NormalReading, read_height_map, read_normal_map,
    write_normal_map_exr, write_normal_map_png,
};

/// Pixels a side of NDFs that are made here.
const SIDE: usize = 256;
/// Most texels of a map: as many as are read from one.
const MOST_TEXELS: usize = 1 << 26;
/// Squares a side in which baked normals are held against their NDF.
const SQUARES: usize = 32;

/// Bakes the map asked for and writes it.
pub(super) fn bake(args: &BakeArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let png = output::ending(&args.out, &["png", "exr"])? == "png";
    let (width, height) = args.size;
    if width * height > MOST_TEXELS {
        let message =
            format!("{width}x{height} texels are more than the {MOST_TEXELS} that maps may have");
        return Err(Failure::wrong(message));
    }
    let ndf = ndf(args)?;
    let cells = square_cells([width, height], args.cells);
    let most = octaves_for([width, height], cells);
    let octaves = args.octaves.map_or(most, f64::from);
    if octaves > most {
        tell(format_args!(
            "warning: {width}x{height} texels can show {most} octaves; the others alias"
        ));
    }
    if most == 0.0 {
        tell(
            "warning: too few texels a lattice cell to show the noise: raise --size or lower --cells",
        );
    }
    let noise = Noise { cells, gain: args.gain, seed: args.seed };
    let map = Synthesis::new(ndf.clone(), noise).bake(width, height, octaves);
    write(args, png, &map)?;
    tell_of(args, &ndf, &map, octaves, out)?;
    Ok(Exit::Done)
}

/// Says what was written and how well it follows the NDF.
fn tell_of(
    args: &BakeArgs,
    ndf: &NdfImage,
    map: &NormalMap,
    octaves: f64,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let normals = map.texels().iter().map(|t| [t[0], t[1], t[2]]);
    let apart = Agreement::of(ndf, normals, SQUARES).total_variation;
    if args.json {
        let told = serde_json::json!({
            "out": args.out, "width": map.width(), "height": map.height(), "octaves": octaves,
            "seed": args.seed, "total_variation": apart,
        });
        writeln!(out, "{told:#}")?;
    } else {
        writeln!(
            out,
            "{}: {}x{}, {octaves} octaves; {:.1} % of its normals lie where the distribution has others",
            args.out.display(),
            map.width(),
            map.height(),
            100.0 * apart
        )?;
    }
    Ok(())
}

fn write(args: &BakeArgs, png: bool, map: &NormalMap) -> Result<(), Failure> {
    let green = if args.green == "down" { Green::Down } else { Green::Up };
    let codes = if args.bits == "8" { Codes::Eight } else { Codes::Sixteen };
    let written = match png {
        true => write_normal_map_png(&args.out, map, codes, green),
        false => write_normal_map_exr(&args.out, map, green),
    };
    written.map_err(Failure::failed)
}

/// The distribution that was asked for.
fn ndf(args: &BakeArgs) -> Result<NdfImage, Failure> {
    match (&args.ndf, &args.like) {
        (Some(word), _) => of_word(word, args),
        (None, Some(like)) => of_map(like, args),
        (None, None) => Err(Failure::wrong(
            "say which distribution: a lobe, an image of one, or --like a normal map",
        )),
    }
}

/// Measured from a normal map.
fn of_map(path: &Path, args: &BakeArgs) -> Result<NdfImage, Failure> {
    let green = if args.like_green == "down" { Green::Down } else { Green::Up };
    let reading = NormalReading { green, ..NormalReading::default() };
    let map = read_normal_map(path, &reading).map_err(Failure::wrong)?.map;
    let found = NdfImage::of_normals(map.texels(), None, SIDE);
    found.map_err(|error| Failure::wrong(format!("{}: {error}", path.display())))
}

/// A lobe in words, a multiple surface, or an image.
fn of_word(word: &str, args: &BakeArgs) -> Result<NdfImage, Failure> {
    let failed = |error| Failure::wrong(format!("{word}: {error}"));
    if let Some(lobe) = lobe(word) {
        let surface: MultipleSurface = [lobe.map_err(Failure::wrong)?].into_iter().collect();
        return NdfImage::of_surface(&surface, SIDE).map_err(failed);
    }
    if let Some(wanted) = surface::wanted(word)? {
        return NdfImage::of_surface(&wanted.surface(), SIDE).map_err(failed);
    }
    let path = Path::new(word);
    if !path.is_file() {
        let message = format!(
            "there is no file {word}; a distribution is a lobe such as beckmann:0.3 or beckmann:0.1,0.4,30, a multiple \
             surface (`wrinkle list`), or an image file"
        );
        return Err(Failure::wrong(message));
    }
    let reading = HeightReading { height_scale: 1.0, ..HeightReading::default() };
    let image = read_height_map(path, &reading).map_err(Failure::wrong)?.map;
    let rows = image.values().chunks(image.width()).rev();
    let values: Vec<f32> = rows.flatten().map(|v| *v as f32).collect();
    let measure = if args.measure == "solid-angle" { Measure::SolidAngle } else { Measure::Map };
    NdfImage::of_image((image.width(), image.height()), &values, measure).map_err(failed)
}

/// A lobe in words, FAMILY:WIDTH, FAMILY:U,V or FAMILY:U,V,DEGREES; `None` if the word is of another kind.
fn lobe(word: &str) -> Option<Result<EllipticLobe, String>> {
    let (family, numbers) = word.split_once(':')?;
    let family = match family {
        "blinn-phong" => Family::BlinnPhong,
        "beckmann" => Family::Beckmann,
        "ggx" => Family::Ggx,
        _ => return None,
    };
    Some(family.lobe(numbers).map_err(|error| format!("{word}: {error}")))
}

enum Family {
    BlinnPhong,
    Beckmann,
    Ggx,
}

impl Family {
    fn lobe(&self, numbers: &str) -> Result<EllipticLobe, String> {
        let parsed: Result<Vec<f64>, _> = numbers.split(',').map(|n| n.trim().parse()).collect();
        let numbers = parsed.map_err(|_| "write numbers with commas between them".to_owned())?;
        let (u, v, degrees) = match *numbers.as_slice() {
            [width] => (width, width, 0.0),
            [u, v] => (u, v, 0.0),
            [u, v, degrees] => (u, v, degrees),
            _ => {
                return Err(
                    "give one width, one along u and one along v, or both and an angle".into()
                );
            }
        };
        // Narrower, and the lobe would be less than a pixel of its image wide.
        let (widths, what) = match self {
            Self::BlinnPhong => (1.0..=5000.0, "an exponent is from 1 to 5000"),
            Self::Beckmann | Self::Ggx => (0.02..=2.0, "a roughness α is from 0.02 to 2"),
        };
        if !(widths.contains(&u) && widths.contains(&v)) {
            return Err(what.into());
        }
        if !(-360.0..=360.0).contains(&degrees) {
            return Err("the angle is from -360 to 360 degrees".into());
        }
        let spread = |width: f64| match self {
            Self::BlinnPhong => 1.0 / width,
            Self::Beckmann => 0.5 * width * width,
            Self::Ggx => width * width,
        };
        let [a, b] = [u, v].map(spread);
        let profile = match self {
            // One exponent for both tails: that of the mean variance.
            Self::BlinnPhong => Profile::Student { exponent: (2.0 / (a + b)) as f32 },
            Self::Beckmann => Profile::Gaussian,
            Self::Ggx => Profile::Ggx,
        };
        Ok(EllipticLobe::new([0.0, 0.0, 1.0], turned([a, b], degrees), 1.0, profile))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lobes_are_read_in_words_and_nonsense_is_told() {
        for word in ["beckmann:0.3", "ggx:0.1,0.4", "blinn-phong:60", "beckmann:0.1, 0.4, -30"] {
            assert!(lobe(word).unwrap().is_ok(), "{word}");
        }
        for word in [
            "beckmann:",
            "ggx:NaN",
            "beckmann:0",
            "ggx:1,2,3,4",
            "beckmann:0.1,0.1,inf",
            "blinn-phong:-3",
        ] {
            assert!(lobe(word).unwrap().is_err(), "{word}");
        }
        assert!(lobe("velvet").is_none() && lobe("C:file.exr").is_none());
    }
}
