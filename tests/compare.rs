//! `wrinkle compare` on real files.

use std::path::Path;

use serde_json::Value;
use wrinkle::render::{Film, read_image};

mod common;
use common::output;

/// A folder with pictures of both kinds, whole and broken.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let ramp = |gain: f32| Film::new(20, 16, (0..320).map(|i| gain * (i % 20) as f32).collect());
    ramp(0.1).write_exr(&at("r.exr")).unwrap();
    ramp(0.11).write_exr(&at("a.exr")).unwrap();
    ramp(0.1).write_png(0.5, &at("r.png")).unwrap();
    ramp(0.11).write_png(0.5, &at("a.png")).unwrap();
    let colours: Vec<u16> = (0..20 * 16 * 4).map(|i| (i * 197 % 65536) as u16).collect();
    let deep: image::ImageBuffer<image::Rgba<u16>, _> =
        image::ImageBuffer::from_raw(20, 16, colours).unwrap();
    deep.save(at("deep.png")).unwrap();
    let light: Vec<f32> = (0..20 * 16 * 3).map(|i| (i % 60) as f32 / 10.0).collect();
    let bright: image::Rgb32FImage = image::ImageBuffer::from_raw(20, 16, light).unwrap();
    bright.save(at("light.hdr")).unwrap();
    let mut wild: Vec<f32> = ramp(0.1).pixels().to_vec();
    (wild[45], wild[46]) = (f32::NAN, f32::INFINITY);
    Film::new(20, 16, wild).write_exr(&at("wild.exr")).unwrap();
    for name in ["r.exr", "r.png"] {
        let bytes = std::fs::read(at(name)).unwrap();
        std::fs::write(at(&format!("cut_{name}")), &bytes[..bytes.len() / 2]).unwrap();
    }
    folder
}

/// How it ends, what it prints and what it says.
fn compare(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    let done = output(folder, &[&["compare"], args].concat());
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (done.status.code(), text(&done.stdout), text(&done.stderr))
}

fn json(folder: &Path, args: &[&str]) -> Value {
    let (code, out, err) = compare(folder, &[args, &["--json"]].concat());
    assert_eq!(code, Some(0), "{err}");
    serde_json::from_str(&out).unwrap()
}

#[test]
fn all_kinds_of_files_are_scored_by_every_metric() {
    let folder = folder();
    let path = folder.path();
    for (a, b) in [
        ("a.exr", "r.exr"),
        ("a.png", "r.png"),
        ("deep.png", "deep.png"),
        ("light.hdr", "light.hdr"),
    ] {
        let scores = json(path, &[a, b]);
        for metric in wrinkle::metric::entries() {
            // Too small for five scales, and what is equal has no PSNR.
            if metric.name.starts_with("ms_ssim") || (a == b && metric.name.starts_with("psnr")) {
                assert!(scores[metric.name].is_null());
                continue;
            }
            assert!(scores[metric.name].is_f64(), "{} of {a}", metric.name);
        }
    }
    // 9.5 · 0.01 is the mean error of a ramp to 1.9.
    let mae = json(path, &["a.exr", "r.exr"])["mae"].as_f64().unwrap();
    assert!((mae - 0.095).abs() < 1e-7, "{mae}");
}

#[test]
fn metrics_are_chosen_by_name_and_variant() {
    let folder = folder();
    let chosen = ["--metric", "relmse:pbrt,relmse:tev", "--metric", "flip"];
    let scores = json(folder.path(), &[&["a.exr", "r.exr"], chosen.as_slice()].concat());
    let names: Vec<&String> = scores.as_object().unwrap().keys().collect();
    assert_eq!(names, ["relmse:pbrt", "relmse:tev", "flip"]);
    let (code, _, err) = compare(folder.path(), &["a.exr", "r.exr", "--metric", "relmse:pbr"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("did you mean `relmse:pbrt`?"), "{err}");
}

#[test]
fn a_broken_limit_is_told_with_how_much() {
    let folder = folder();
    let limits =
        ["--fail-above", "mae=0.05", "--fail-below", "energy=1.05", "--fail-above", "energy=1.05"];
    let (code, _, err) = compare(folder.path(), &[&["a.exr", "r.exr"], limits.as_slice()].concat());
    assert_eq!(code, Some(1));
    assert_eq!(
        err,
        "mae is 0.095000: above 0.05 by 0.045000\nenergy is 1.100000: above 1.05 by 0.050000\n"
    );
    // Equal images have all the decibels there are; a metric without a value breaks its limit.
    let same = |limit: [&str; 2]| compare(folder.path(), &["a.exr", "a.exr", limit[0], limit[1]]).0;
    assert_eq!(same(["--fail-below", "psnr=60"]), Some(0));
    assert_eq!(same(["--fail-below", "ms_ssim=0.5"]), Some(1));
    assert_eq!(same(["--fail-above", "rmse=nan"]), Some(2));
}

#[test]
fn maps_hold_the_errors() {
    let folder = folder();
    let path = folder.path();
    let map = |kind: &str, name: &str| {
        let (code, _, err) = compare(path, &["a.exr", "r.exr", "--map", name, "--map-kind", kind]);
        assert_eq!(code, Some(0), "{err}");
        read_image(&path.join(name)).unwrap().channels
    };
    let signed = map("signed", "s.exr");
    assert!((signed[0].pixels()[19] - 0.19).abs() < 1e-6);
    let relative = map("relative", "rel.exr");
    assert!((relative[0].pixels()[10] - 0.1 / (1.0 + 0.095)).abs() < 1e-6);
    let flip = map("flip", "f.exr");
    let mean = flip[0].pixels().iter().map(|v| f64::from(*v)).sum::<f64>() / 320.0;
    let score = json(path, &["a.exr", "r.exr"])["flip"].as_f64().unwrap();
    assert!((mean - score).abs() < 1e-7, "{mean} {score}");
    for kind in ["absolute", "signed", "relative", "flip"] {
        assert_eq!(map(kind, "map.png").len(), 3, "{kind} in colour");
    }
    let (code, _, err) = compare(path, &["a.exr", "r.exr", "--map", "map.jpg"]);
    assert_eq!((code, err.contains("name it .png or .exr")), (Some(2), true), "{err}");
}

#[test]
fn codes_can_be_scored_as_light() {
    let folder = folder();
    let path = folder.path();
    let stored = json(path, &["a.png", "r.png"])["rmse"].as_f64().unwrap();
    let light = json(path, &["a.png", "r.png", "--encoding", "linear"])["rmse"].as_f64().unwrap();
    assert!(stored != light);
    let (code, _, err) = compare(path, &["a.png", "r.exr"]);
    assert_eq!((code, err.contains("--encoding linear")), (Some(2), true), "{err}");
    // The picture shows half the radiance, cut at 1.
    let mixed = json(path, &["r.png", "r.exr", "--encoding", "linear"]);
    assert!((mixed["energy"].as_f64().unwrap() - 0.5).abs() < 0.005);
}

#[test]
fn what_cannot_be_compared_is_told() {
    let folder = folder();
    let path = folder.path();
    let (code, _, err) = compare(path, &["wild.exr", "r.exr"]);
    assert_eq!(code, Some(1));
    assert!(
        err.contains(
            "wild.exr: 2 of 320 values are not finite; the first is NaN in column 5 and row 2"
        ),
        "{err}"
    );
    for cut in ["cut_r.exr", "cut_r.png"] {
        let (code, _, err) = compare(path, &[cut, "r.exr"]);
        assert_eq!(code, Some(2));
        assert!(err.contains(cut) && err.contains("cannot read the image"), "{err}");
    }
    let (_, _, err) = compare(path, &["deep.png", "deep.png"]);
    assert!(err.contains("deep.png: not compared: A"), "{err}");
    let (code, _, err) = compare(path, &["deep.png", "r.png"]);
    assert_eq!((code, err.contains("20 × 16 in 1")), (Some(2), true), "{err}");
}
