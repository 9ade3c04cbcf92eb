use std::path::Path;

use super::*;
use crate::lobe::Measure;
use crate::parameter::Values;
use crate::texture::image_file::{
    Codes, Green, HeightReading, NormalReading, write_normal_map_exr, write_normal_map_png,
    write_values_exr, write_values_png,
};

/// Waves of 24 by 16 texels, as a file of normals whose green is down.
fn waves(folder: &Path, name: &str) -> MapFile {
    let entry = crate::pattern::find("waves").unwrap();
    let map = (entry.build)(24, 16, &Values::defaults(entry.parameters), 1).normals;
    let path = folder.join(name);
    match name.ends_with(".exr") {
        true => write_normal_map_exr(&path, &map, Green::Down).unwrap(),
        false => write_normal_map_png(&path, &map, Codes::Eight, Green::Down).unwrap(),
    }
    let reading = NormalReading { green: Green::Down, ..NormalReading::default() };
    MapFile { path, reading: Reading::Normals(reading) }
}

fn recipe(ground: Ground) -> Recipe {
    Recipe { ground, cells: None, octaves: None, gain: 0.5, seed: 1 }
}

fn onto(map: &MapFile, ndf: Option<NdfSource>, amount: f64, size: Option<[usize; 2]>) -> Recipe {
    recipe(Ground::Onto { map: map.clone(), ndf, amount, floor: 0.02, size })
}

fn parse(text: &str, folder: &Path) -> Result<NdfSource, String> {
    NdfSource::parse(text, folder, Measure::Map)
}

fn apart(a: &NormalMap, b: &NormalMap) -> f32 {
    let pairs = a.texels().iter().zip(b.texels());
    pairs.flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs())).fold(0.0, f32::max)
}

#[test]
fn detail_of_amount_zero_is_the_map_at_any_size_and_under_any_distribution() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["waves.png", "waves.exr"] {
        let map = waves(folder.path(), name);
        let ground = map.read().unwrap().normals;
        for ndf in [None, Some(parse("blinn-phong:2000", folder.path()).unwrap())] {
            for size in [None, Some([24, 16]), Some([61, 40])] {
                let baked = onto(&map, ndf.clone(), 0.0, size).bake().unwrap();
                let [width, height] = size.unwrap_or([24, 16]);
                // Single precision, a few times over.
                let apart = apart(&baked.normals, &ground.resampled(width, height));
                assert!(apart < 2e-6, "{name} {ndf:?} {size:?}: {apart}");
                let found = baked.onto.unwrap();
                assert!(found.missed.rms < 1e-4 && found.size == [24, 16], "{found:?}");
                assert!((found.tilt[0] - found.tilt[1]).abs() < 1e-4, "{found:?}");
            }
        }
    }
}

#[test]
fn detail_tilts_normals_and_stands_where_the_map_has_no_texels() {
    let folder = tempfile::tempdir().unwrap();
    let map = waves(folder.path(), "waves.png");
    let baked = onto(&map, None, 0.5, Some([96, 64])).bake().unwrap();
    // A quarter of 16 texels is four cells, and 64 texels show four octaves of those.
    assert_eq!((baked.cells, baked.octaves), ([6, 4], 4.0));
    let found = baked.onto.unwrap();
    assert!(found.tilt[1] > found.tilt[0], "{found:?}");
    let plain = onto(&map, None, 0.0, Some([96, 64])).bake().unwrap().normals;
    assert!(apart(&baked.normals, &plain) > 0.1);
    assert_eq!(baked.normals, onto(&map, None, 0.5, Some([96, 64])).bake().unwrap().normals);
}

#[test]
fn a_map_made_smaller_is_refused_with_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let map = waves(folder.path(), "waves.png");
    let error = onto(&map, None, 0.5, Some([24, 15])).bake().unwrap_err().to_string();
    assert!(error.contains("waves.png: it has 24x16 texels, and 24x15 would"), "{error}");
    let error = onto(&map, None, 0.5, Some([1 << 14; 2])).bake().unwrap_err().to_string();
    assert!(error.contains("texels are more than"), "{error}");
}

#[test]
fn heights_have_a_distribution_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("heights.png");
    let values: Vec<f32> = (0..256).map(|k| ((k % 16) as f32 - 8.0).abs()).collect();
    write_values_png(&path, (16, 16), &values).unwrap();
    let reading = Reading::Heights(HeightReading { height_scale: 8.0, ..Default::default() });
    let ndf = NdfSource::Map(MapFile { path, reading }).read().unwrap();
    // A roof: slopes of 1 either way along x, but for the two rows of its ridges, which are level.
    let x = std::f32::consts::FRAC_1_SQRT_2;
    assert!(ndf.at(x, 0.0) > 10.0 && ndf.at(-x, 0.0) > 10.0 && ndf.at(0.0, x) < 1e-6);
}

#[test]
fn a_distribution_that_was_written_bakes_the_same_as_the_measured_one() {
    let folder = tempfile::tempdir().unwrap();
    let measured = NdfSource::Map(waves(folder.path(), "waves.exr"));
    let ndf = measured.read().unwrap();
    let rows: Vec<f32> = ndf.values().chunks(ndf.side()).rev().flatten().copied().collect();
    let size = (ndf.side(), ndf.side());
    write_values_exr(folder.path().join("ndf.exr"), size, &rows).unwrap();
    write_values_png(folder.path().join("ndf.png"), size, &rows).unwrap();
    let bake =
        |ndf: NdfSource| recipe(Ground::Bare { ndf, size: [32, 32] }).bake().unwrap().normals;
    let want = bake(measured);
    // A density of single precision is only brought to sum 1 once more.
    let exr = parse("ndf.exr", folder.path()).unwrap();
    assert!(apart(&want, &bake(exr)) < 1e-5);
    // Codes are half a 65535th of the peak off; of what thin regions hold, that is more.
    let png = parse("ndf.png", folder.path()).unwrap();
    let peak = ndf.values().iter().fold(0.0f32, |most, d| most.max(*d));
    let read = png.read().unwrap();
    let off = ndf.values().iter().zip(read.values()).map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f32::max) < peak / 65_535.0);
    assert!(apart(&want, &bake(png)) < 0.01);
}

#[test]
fn words_and_files_are_told_apart_and_what_is_neither_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let parse = |text: &str| parse(text, folder.path());
    assert!(
        matches!(parse("ggx:0.3 + ggx:0.1@20,0"), Ok(NdfSource::Lobes(lobes)) if lobes.len() == 2)
    );
    assert_eq!(parse("velvet"), Ok(NdfSource::Named("velvet")));
    std::fs::write(folder.path().join("peaks.json"), "{}").unwrap();
    let peaks = parse("peaks.json").unwrap();
    assert!(peaks.read().unwrap_err().to_string().contains("peaks.json"));
    assert!(parse("nothing.exr").unwrap_err().contains("there is no file"));
    assert!(parse("ggx:9").unwrap_err().contains("ggx:9: a roughness"));
    std::fs::write(folder.path().join("note.png"), "no image").unwrap();
    assert!(parse("note.png").unwrap().read().unwrap_err().to_string().contains("note.png"));
}

#[test]
fn what_recipes_hold_is_told_without_names_of_files() {
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (waves(folder.path(), "a.png"), waves(folder.path(), "b.png"));
    let like = |map: &MapFile| Some(NdfSource::Map(map.clone()));
    let (one, other) = (onto(&a, like(&b), 0.5, None), onto(&b, like(&a), 0.5, None));
    assert_ne!(one, other);
    assert_eq!(one.files(), [a.path.as_path(), b.path.as_path()]);
    assert_eq!(one.nameless(), other.nameless());
}
