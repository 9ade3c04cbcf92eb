//! Reading and writing image files: round trips, conventions, and every way a file can be bad.

use std::path::{Path, PathBuf};

use image::{DynamicImage, GrayImage, ImageBuffer, Luma, LumaA, Rgb, RgbImage, Rgba};
use proptest::prelude::*;
use tempfile::TempDir;
use wrinkle::pattern::file::{Reading, read};
use wrinkle::texture::image_file::{
    Green, HeightReading, ImageError, NormalReading, Zero, read_height_map, read_normal_map,
    write_normal_map_png16,
};
use wrinkle::texture::{NormalMap, Wrap};

#[allow(dead_code)]
#[path = "../examples/make_data.rs"]
mod make_data;

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Saves an image under a name in a folder of its own.
fn saved(image: impl Into<DynamicImage>, name: &str) -> (TempDir, PathBuf) {
    let folder = folder();
    let path = folder.path().join(name);
    image.into().save(&path).unwrap();
    (folder, path)
}

/// Stores bytes as a file.
fn stored(bytes: &[u8], name: &str) -> (TempDir, PathBuf) {
    let folder = folder();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn normals(path: &Path) -> NormalMap {
    read_normal_map(path, &NormalReading::default()).unwrap().map
}

fn bumpy(width: usize, height: usize, wrap: Wrap) -> NormalMap {
    NormalMap::from_fn(width, height, wrap, |u, v| {
        [0.8 * libm::sin(7.0 * u + v), 0.6 * libm::cos(5.0 * v - u), 0.4 + u * v, 1.0]
    })
}

fn worst_angle(a: &NormalMap, b: &NormalMap) -> f32 {
    assert_eq!((a.width(), a.height()), (b.width(), b.height()));
    let chord = |a: &[f32; 4], b: &[f32; 4]| {
        ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
    };
    a.texels().iter().zip(b.texels()).map(|(a, b)| chord(a, b)).fold(0.0, f32::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn sixteen_bits_come_back(width in 1usize..20, height in 1usize..20) {
        let (folder, map) = (folder(), bumpy(width, height, Wrap::Repeat));
        let path = folder.path().join("map.png");
        write_normal_map_png16(&path, &map).unwrap();
        let back = read_normal_map(&path, &NormalReading::default()).unwrap();
        // Half a step of 2/65535 in each of three channels.
        prop_assert!(worst_angle(&map, &back.map) < 3f32.sqrt() / 65535.0 + 1e-6);
        prop_assert_eq!(back.notes, ["PNG, RGB, 16 bits a channel"]);
    }
}

#[test]
fn eight_bits_come_back_from_every_format() {
    let map = bumpy(7, 5, Wrap::Repeat);
    let code = |x, y| {
        let t = map.texel(x as usize, 4 - y as usize);
        [t[0], t[1], t[2]].map(|c| ((c + 1.0) * 127.5).round() as u8)
    };
    let rgb = RgbImage::from_fn(7, 5, |x, y| Rgb(code(x, y)));
    let rgba = ImageBuffer::from_fn(7, 5, |x, y| {
        let [r, g, b] = code(x, y);
        Rgba([r, g, b, 17])
    });
    for (image, name) in [
        (DynamicImage::from(rgb.clone()), "rgb.png"),
        (DynamicImage::from(rgba), "rgba.png"),
        (DynamicImage::from(rgb.clone()), "rgb.tiff"),
        (DynamicImage::from(rgb), "rgb.webp"),
    ] {
        let (_folder, path) = saved(image, name);
        assert!(worst_angle(&map, &normals(&path)) < 3f32.sqrt() / 255.0 * 1.01, "{name}");
    }
}

#[test]
fn floats_are_codes_or_normals_themselves() {
    let map = bumpy(6, 3, Wrap::Repeat);
    let picture = |f: fn(f32) -> f32| {
        ImageBuffer::from_fn(6, 3, |x, y| {
            let [x, y, z, _] = map.texel(x as usize, 2 - y as usize);
            Rgb([x, y, z].map(f))
        })
    };
    let (_a, coded) = saved(DynamicImage::ImageRgb32F(picture(|c| (c + 1.0) / 2.0)), "coded.exr");
    assert!(worst_angle(&map, &normals(&coded)) < 1e-6);
    let (_b, signed) = saved(DynamicImage::ImageRgb32F(picture(|c| c)), "signed.exr");
    let loaded = read_normal_map(&signed, &NormalReading::default()).unwrap();
    assert!(worst_angle(&map, &loaded.map) < 1e-6);
    assert_eq!(loaded.notes.len(), 2, "the notes say so: {:?}", loaded.notes);
}

#[test]
fn the_top_row_is_the_last_and_green_points_up_or_down() {
    // Top: leans up. Bottom: leans right.
    let image = RgbImage::from_vec(1, 2, vec![128, 255, 128, 255, 128, 128]).unwrap();
    let (_folder, path) = saved(image, "two.png");
    let reading = NormalReading { zero: Zero::Above, ..Default::default() };
    let up = read_normal_map(&path, &reading).unwrap().map;
    assert_eq!(up.texels(), [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]]);
    let down = NormalReading { green: Green::Down, ..reading };
    let down = read_normal_map(&path, &down).unwrap().map;
    assert_eq!(down.texel(0, 1), [0.0, -1.0, 0.0, 1.0]);
}

#[test]
fn zero_is_the_middle_or_the_number_above() {
    let eight = RgbImage::from_vec(1, 1, vec![128, 128, 255]).unwrap();
    let sixteen = ImageBuffer::<Rgb<u16>, _>::from_vec(1, 1, vec![32768, 32768, 65535]).unwrap();
    for (image, step) in
        [(DynamicImage::from(eight), 1.0 / 255.0), (DynamicImage::from(sixteen), 1.0 / 65535.0)]
    {
        let (_folder, path) = saved(image, "flat.png");
        let of = |zero| {
            let reading = NormalReading { zero, ..Default::default() };
            let loaded = read_normal_map(&path, &reading).unwrap();
            (loaded.map.texel(0, 0), loaded.notes.len())
        };
        assert_eq!(of(Zero::Above), ([0.0, 0.0, 1.0, 1.0], 1));
        let (normal, notes) = of(Zero::Middle);
        assert!((normal[0] / normal[2] - step).abs() < 1e-6, "slope of half a step: {normal:?}");
        assert_eq!(notes, 2, "a note offers the other reading");
    }
    // The least number is −1 either way, not below.
    let (_folder, path) = saved(RgbImage::from_vec(1, 1, vec![0, 128, 128]).unwrap(), "left.png");
    let reading = NormalReading { zero: Zero::Above, ..Default::default() };
    assert_eq!(read_normal_map(&path, &reading).unwrap().map.texel(0, 0), [-1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn odd_lengths_and_horizons_are_counted() {
    let image = RgbImage::from_vec(
        4,
        1,
        vec![
            128, 128, 200, // short
            128, 128, 255, // a unit but for rounding
            218, 128, 218, // the same, at 45°
            255, 128, 20, // long, and leaning below the horizon
        ],
    );
    let (_folder, path) = saved(image.unwrap(), "lengths.png");
    let notes = read_normal_map(&path, &NormalReading::default()).unwrap().notes;
    assert!(notes[1].starts_with("2 of 4 normals are not of unit length"), "{notes:?}");
    assert!(notes[1].contains("from 0.569 to 1.308"), "{notes:?}");
    assert!(notes.iter().any(|n| n.starts_with("1 of 4 normals are below the horizon")));
}

#[test]
fn two_channels_are_enough() {
    let image = RgbImage::from_fn(5, 5, |x, y| Rgb([100 + 20 * x as u8, 80 + 30 * y as u8, 0]));
    let (_folder, path) = saved(image, "red-green.png");
    let loaded = read_normal_map(&path, &NormalReading::default()).unwrap();
    assert_eq!(loaded.notes[1], "blue is empty: z is found from x and y");
    let [x, y, z, _] = loaded.map.texel(1, 0);
    assert!((x - (120.0 / 127.5 - 1.0)).abs() < 1e-6 && (y - (200.0 / 127.5 - 1.0)).abs() < 1e-6);
    assert!((z - (1.0 - x * x - y * y).sqrt()).abs() < 1e-6);
}

#[test]
fn heights_of_grey_colour_palette_and_depth() {
    let reading = HeightReading { height_scale: 10.0, wrap: Wrap::Clamp };
    let heights = |path: &Path| read_height_map(path, &reading).unwrap();
    // Two columns; the top row first in the file.
    let grey = GrayImage::from_vec(2, 2, vec![0, 51, 102, 255]).unwrap();
    let (_a, path) = saved(grey, "grey.png");
    assert_eq!(heights(&path).map.values(), [4.0, 10.0, 0.0, 2.0]);
    assert_eq!(heights(&path).map.wrap(), Wrap::Clamp);

    let deep = ImageBuffer::<Luma<u16>, _>::from_vec(2, 1, vec![13107, 65535]).unwrap();
    let (_b, path) = saved(DynamicImage::from(deep), "deep.png");
    assert_eq!(heights(&path).map.values(), [2.0, 10.0]);

    let alpha = ImageBuffer::<LumaA<u8>, _>::from_vec(1, 1, vec![51, 0]).unwrap();
    let (_c, path) = saved(DynamicImage::from(alpha), "alpha.png");
    assert_eq!(heights(&path).map.values(), [2.0]);

    let colour = RgbImage::from_vec(2, 1, vec![255, 0, 0, 51, 51, 51]).unwrap();
    let (_d, path) = saved(colour, "colour.png");
    let loaded = heights(&path);
    assert!((loaded.map.values()[0] - 2.126).abs() < 1e-12);
    assert_eq!(loaded.map.values()[1], 2.0);
    assert_eq!(loaded.notes[1], "1 pixels have a colour: their luma is the height");

    let (_e, path) = stored(&palette_png(), "palette.png");
    assert_eq!(heights(&path).map.values(), [2.0, 10.0]);
}

/// A 2 × 1 PNG with a palette of two greys, 51 and 255.
fn palette_png() -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |name: &[u8; 4], data: &[u8]| {
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(name);
        bytes.extend(data);
        let both: Vec<u8> = name.iter().chain(data).copied().collect();
        bytes.extend(crc(&both).to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 1, 8, 3, 0, 0, 0]);
    chunk(b"PLTE", &[51, 51, 51, 255, 255, 255]);
    // zlib: one stored block of three bytes (no filter, entries 0 and 1), then Adler-32.
    chunk(b"IDAT", &[0x78, 1, 1, 3, 0, 0xfc, 0xff, 0, 0, 1, 0, 5, 0, 2]);
    chunk(b"IEND", &[]);
    bytes
}

/// The check sum of PNG chunks.
fn crc(bytes: &[u8]) -> u32 {
    let step = |c: u32, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 };
    !bytes.iter().fold(u32::MAX, |c, &b| (0..8).fold(c ^ u32::from(b), step))
}

#[test]
fn bumps_come_with_the_heights_they_are_of() {
    let grey = GrayImage::from_fn(8, 8, |x, _| Luma([x as u8 * 32]));
    let (_folder, path) = saved(grey, "ramp.png");
    let reading = HeightReading { height_scale: 255.0 / 32.0, wrap: Wrap::Clamp };
    let bumps = read(&path, &Reading::Heights(reading)).unwrap();
    assert!(bumps.heights.is_some());
    for texel in bumps.normals.texels() {
        assert!((texel[0] / texel[2] + 1.0).abs() < 1e-6, "slope 1 leans to −x: {texel:?}");
    }
    assert!(read(&path, &Reading::Normals(NormalReading::default())).is_err());
}

/// The message of a file that is not read, without its folder.
fn complaint(path: &Path) -> String {
    let error = read_normal_map(path, &NormalReading::default()).unwrap_err();
    let message = error.to_string();
    let rest = message.strip_prefix(&path.parent().unwrap().display().to_string());
    rest.expect("a message starts with the file")[1..].to_owned()
}

/// The bytes of a sound image in a format told by `name`.
fn sound(name: &str) -> Vec<u8> {
    let image = ImageBuffer::from_fn(32, 32, |x, y| {
        Rgb([x as f32 / 31.0, y as f32 / 31.0, (x * y % 7) as f32 / 7.0])
    });
    let image = DynamicImage::ImageRgb32F(image);
    let image = if name.ends_with("exr") { image } else { image.to_rgb8().into() };
    let (_folder, path) = saved(image, name);
    std::fs::read(path).unwrap()
}

#[test]
fn what_is_not_there_or_not_an_image() {
    let folder = folder();
    insta::assert_snapshot!(complaint(&folder.path().join("none.png")), @"none.png: there is no such file; in an experiment file, a path is relative to that file");
    let (_a, path) = stored(b"", "empty.png");
    insta::assert_snapshot!(complaint(&path), @"empty.png: the image is empty; export it again");
    let (_b, path) = stored(b"# Hello", "text.png");
    insta::assert_snapshot!(complaint(&path), @"text.png: not an image that can be read here; save it as PNG, TIFF, WebP or EXR");
    let (_c, path) = stored(b"GIF89a and so on", "moving.gif");
    insta::assert_snapshot!(complaint(&path), @"moving.gif: not an image that can be read here; save it as PNG, TIFF, WebP or EXR");
    assert!(read_normal_map(folder.path(), &NormalReading::default()).is_err(), "a folder");
}

#[test]
fn a_name_does_not_tell_the_format() {
    let (_folder, path) = stored(&sound("a.png"), "a.tiff");
    assert_eq!(normals(&path).width(), 32);
}

#[test]
fn files_cut_short_say_so_wherever_they_are_cut() {
    for name in ["cut.png", "cut.webp", "cut.exr"] {
        let whole = sound(name);
        for percent in [50, 90] {
            let (_folder, path) = stored(&whole[..whole.len() * percent / 100], name);
            let message = complaint(&path);
            assert!(
                message.ends_with("the file is cut short; copy or export it again"),
                "{percent} %: {message}"
            );
        }
    }
}

#[test]
fn no_damage_makes_a_panic() {
    for name in ["a.png", "a.webp", "a.exr", "a.tiff"] {
        let whole = sound(name);
        for cut in (0..whole.len()).step_by(whole.len() / 40) {
            let (_folder, path) = stored(&whole[..cut], name);
            let _ = read_normal_map(&path, &NormalReading::default());
            let mut bent = whole.clone();
            bent[cut] ^= 0x55;
            let (_folder, path) = stored(&bent, name);
            let _ = read_normal_map(&path, &NormalReading::default());
        }
    }
}

#[test]
fn damage_and_what_is_not_supported() {
    let mut bytes = sound("a.png");
    bytes[12] = b'X'; // the name of the first chunk
    let (_a, path) = stored(&bytes, "bent.png");
    assert!(complaint(&path).contains("the file is damaged ("), "{}", complaint(&path));

    // A luminance channel instead of red.
    let mut bytes = sound("a.exr");
    let red = bytes.windows(6).position(|w| w == b"R\0\x02\0\0\0").unwrap();
    bytes[red] = b'Y';
    let (_b, path) = stored(&bytes, "luminance.exr");
    insta::assert_snapshot!(complaint(&path), @"luminance.exr: this kind of file is not supported (image does not contain non-deep rgb channels); save it again as PNG, or as EXR with ZIP compression and R, G and B channels");

    let mut bytes = sound("a.exr");
    let name = b"compression\0compression\0\x01\0\0\0";
    let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len();
    bytes[at] = 9;
    let (_d, path) = stored(&bytes, "lossy.exr");
    insta::assert_snapshot!(complaint(&path), @"lossy.exr: this kind of file is not supported (DWAB compression); save it again as PNG, or as EXR with ZIP compression and R, G and B channels");

    let (_c, path) = saved(GrayImage::new(2, 2), "grey.png");
    insta::assert_snapshot!(complaint(&path), @r#"grey.png: a grey image holds no normals; read it with kind = "height""#);
}

#[test]
fn a_sample_that_is_not_finite_is_pointed_at() {
    for (bad, name) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf")] {
        let image = ImageBuffer::from_fn(4, 3, |x, y| {
            Rgb([0.5, if (x, y) == (2, 1) { bad } else { 0.5 }, 1.0])
        });
        let (_folder, path) = saved(DynamicImage::ImageRgb32F(image), "bad.exr");
        let want = format!(
            "bad.exr: the pixel 2 from the left, 1 from the top (counted from 0) is {name}; \
             replace samples that are not finite"
        );
        assert_eq!(complaint(&path), want);
        assert!(matches!(
            read_height_map(&path, &HeightReading::default()),
            Err(ImageError::NotFinite { x: 2, y: 1, .. })
        ));
    }
}

#[test]
fn giants_are_refused_before_they_are_read() {
    let mut bytes = palette_png();
    bytes[16..20].copy_from_slice(&100_000u32.to_be_bytes());
    let sum = crc(&bytes[12..29]).to_be_bytes();
    bytes[29..33].copy_from_slice(&sum);
    let (_folder, path) = stored(&bytes, "giant.png");
    insta::assert_snapshot!(complaint(&path), @"giant.png: 100000 × 1 pixels are too many; scale it down to at most 16384 a side");
}

#[test]
fn stored_maps_are_what_the_example_makes() {
    let folder = folder();
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    for file in make_data::write_all(folder.path()).unwrap() {
        let made = std::fs::read(folder.path().join(file)).unwrap();
        assert!(made == std::fs::read(stored.join(file)).unwrap(), "{file} differs");
    }
}
