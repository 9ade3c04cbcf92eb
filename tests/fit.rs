//! `wrinkle fit`: measured samples in, peaks out.

mod common;

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Output;

use common::output;
use nalgebra::Vector3;
use serde_json::Value;

/// Amplitude, direction (any length) and exponent.
const PLANTED: [(f64, [f64; 3], f64); 3] =
    [(1.0, [0.1, 0.2, 1.0], 40.0), (0.7, [-0.6, 0.1, 0.8], 15.0), (0.4, [0.3, -0.7, 0.6], 80.0)];

/// Samples of the planted peaks in `count` directions on a spiral (equal areas), with noise of a hundredth
/// of the largest, lengths that differ, a comment and a header.
fn samples(count: usize, unit: f64) -> String {
    let mut text = String::from("# planted\nx,y,z,value\n\n");
    let mut state = 1u64; // Knuth's generator: seed 1
    let mut noise = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for i in 0..count {
        let z = 1.0 - (i as f64 + 0.5) / count as f64;
        let turn = 2.399_963 * i as f64;
        let across = (1.0 - z * z).sqrt();
        let (sin, cos) = libm::sincos(turn);
        let d = Vector3::new(across * cos, across * sin, z);
        let peak = |(a, q, n): &(f64, [f64; 3], f64)| {
            a * libm::pow(d.dot(&Vector3::from(*q).normalize()).max(0.0), *n)
        };
        let value = PLANTED.iter().map(peak).sum::<f64>() + 0.01 * noise();
        let d = d * (2.0 + noise());
        writeln!(text, "{}, {}, {}, {:e}", d.x, d.y, d.z, value.max(0.0) * unit).unwrap();
    }
    text
}

fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.csv"), text).unwrap();
    folder
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn json(folder: &Path, args: &[&str]) -> Value {
    let done = output(folder, &[&["fit", "s.csv", "--json"], args].concat());
    assert_eq!((done.status.code(), err(&done).as_str()), (Some(0), ""));
    serde_json::from_slice(&done.stdout).expect("JSON and nothing else")
}

/// Noise of 0.6 % rms on the hundreds of samples under each peak: parts of a percent.
#[test]
fn planted_peaks_come_back_whatever_the_unit() {
    for unit in [1.0, 1e-300, 1e300] {
        let folder = folder(&samples(3000, unit));
        let found = json(folder.path(), &["--max-peaks", "3"]);
        let peaks = found["peaks"].as_array().unwrap();
        assert_eq!(peaks.len(), 3);
        for (amplitude, direction, exponent) in PLANTED {
            let direction = Vector3::from(direction).normalize();
            let near = |p: &&Value| {
                let at = |c: usize| p["direction"][c].as_f64().unwrap();
                (Vector3::new(at(0), at(1), at(2)) - direction).norm() < 0.005
            };
            let one = peaks.iter().find(near).expect("a peak in the planted direction");
            let off = |key: &str, want: f64| (one[key].as_f64().unwrap() / want - 1.0).abs();
            assert!(off("amplitude", amplitude * unit) < 0.01, "{one}");
            assert!(off("exponent", exponent) < 0.02, "{one}");
        }
        let weight =
            |p: &Value| p["amplitude"].as_f64().unwrap() / (p["exponent"].as_f64().unwrap() + 2.0);
        assert!(peaks.windows(2).all(|pair| weight(&pair[0]) >= weight(&pair[1])), "in order");
    }
}

#[test]
fn json_has_its_keys_in_their_units() {
    let folder = folder(&samples(500, 1.0));
    let found = json(folder.path(), &["--max-peaks", "2", "--stop", "0.1"]);
    let keys: Vec<&str> = found.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys[..5], ["peaks", "cost", "rms", "max", "termination"]);
    assert_eq!(keys[5..], ["met", "samples", "largest", "fitted", "failures", "iterations"]);
    let of_peak: Vec<&String> = found["peaks"][0].as_object().unwrap().keys().collect();
    assert_eq!(of_peak, ["amplitude", "direction", "exponent"]);

    // The same from the samples and the peaks, as docs/fit.md defines it.
    let peak = |p: &Value, d: Vector3<f64>| {
        let at = |c: usize| p["direction"][c].as_f64().unwrap();
        let cosine = d.dot(&Vector3::new(at(0), at(1), at(2))).max(0.0);
        p["amplitude"].as_f64().unwrap() * libm::pow(cosine, p["exponent"].as_f64().unwrap())
    };
    let (mut squares, mut left, mut largest, mut most) = (0.0, 0.0, 0.0f64, 0.0f64);
    let text = samples(500, 1.0);
    for row in text.lines().skip(3) {
        let n: Vec<f64> = row.split(", ").map(|word| word.parse().unwrap()).collect();
        let d = Vector3::new(n[0], n[1], n[2]).normalize();
        let fit: f64 = found["peaks"].as_array().unwrap().iter().map(|p| peak(p, d)).sum();
        squares += n[3] * n[3];
        left += (n[3] - fit) * (n[3] - fit);
        largest = largest.max(n[3]);
        most = most.max((n[3] - fit).abs());
    }
    let is = |key: &str, want: f64| {
        let got = found[key].as_f64().unwrap();
        assert!((got / want - 1.0).abs() < 1e-9, "{key}: {got}, not {want}");
    };
    is("cost", 0.5 * left / (largest * largest));
    is("rms", (left / squares).sqrt());
    is("max", most / largest);
    is("largest", largest);
    let met = (left / squares).sqrt() < 0.1 && most / largest < 0.1;
    assert_eq!(found["met"], met);
    assert_eq!((&found["samples"], &found["fitted"]), (&500.into(), &2.into()));
}

#[test]
fn without_json_it_is_a_table_and_a_verdict() {
    let folder = folder(&samples(800, 1.0));
    let told = |args: &[&str]| {
        let done = output(folder.path(), &[&["fit", "s.csv"], args].concat());
        assert_eq!((done.status.code(), err(&done).as_str()), (Some(0), ""));
        out(&done)
    };
    let enough = told(&["--max-peaks", "3", "--stop", "0.06"]);
    assert_eq!(enough.lines().count(), 1 + 3 + 1, "{enough}");
    assert!(enough.contains("both below 6 %."), "{enough}");
    assert!(enough.contains("The last fit ended because "), "{enough}");
    let short = told(&["--max-peaks", "1"]);
    assert!(short.contains("not below 5 %, and there may be no more than 1 peak."), "{short}");
    assert_eq!(told(&[]), told(&[]), "the same twice");
    let tried = json(folder.path(), &["--max-peaks", "2", "--restarts", "4"]);
    let once = json(folder.path(), &["--max-peaks", "2"]);
    assert!(tried["cost"].as_f64() <= once["cost"].as_f64());
    assert!(tried["iterations"].as_u64() > once["iterations"].as_u64());
}

#[test]
fn what_is_wrong_with_a_file_is_said_with_its_line() {
    let refused = |text: &str| {
        let folder = folder(text);
        let done = output(folder.path(), &["fit", "s.csv"]);
        assert_eq!((done.status.code(), out(&done).as_str()), (Some(2), ""), "{}", err(&done));
        err(&done)
    };
    for (row, said) in [
        ("0,0,1", "line 5: give four columns"),
        ("0,0,1,1,1", "line 5: give four columns, x,y,z,value, with commas between; it has 5"),
        ("0,0,up,1", "line 5: z is `up`, which is not a number"),
        ("0,0,1,nan", "line 5: value is nan: it must be a finite number"),
        ("inf,0,1,1", "line 5: x is inf"),
        ("0,0,1,-1", "line 5: the value is -1"),
        ("0,0,0,1", "line 5: the direction is 0,0,0"),
    ] {
        let message =
            refused(&samples(9, 1.0).replacen("\n\n", &format!("\n\n0,0,1,1\n{row}\n"), 1));
        assert!(message.starts_with(&format!("error: s.csv: {said}")), "{message}");
        assert_eq!(message.lines().count(), 1);
    }
    assert!(refused("").starts_with("error: s.csv: no samples"));
    assert!(refused("0,0,1,0\n".repeat(9).as_str()).starts_with("error: s.csv: every value is 0"));
    assert!(refused("0,0,1,1\n0,0,1,1\n").starts_with("error: s.csv: 2 samples cannot tell"));

    let folder = folder("0,0,1,1\n");
    fs::write(folder.path().join("b.csv"), [0xff, 0xfe, 0x00]).unwrap();
    let says = |args: &[&str]| {
        let done = output(folder.path(), &[&["fit"], args].concat());
        assert_eq!((done.status.code(), out(&done).as_str()), (Some(2), ""), "{}", err(&done));
        err(&done)
    };
    assert_eq!(says(&["no.csv"]), "error: there is no file no.csv\n");
    assert_eq!(says(&["b.csv"]), "error: b.csv: not a text\n");
    assert!(says(&["."]).starts_with("error: .: cannot read"));
    assert!(says(&["s.csv", "--plot", "fit.jpg"]).contains("name it .png"));
    assert!(says(&["s.csv", "--plot", "no/fit.png"]).contains("there is no folder no"));
    for wrong in ["--max-peaks=0", "--max-peaks=99", "--stop=nan", "--stop=-1", "--restarts=-1"] {
        assert!(says(&["s.csv", wrong]).starts_with("error: "), "{wrong}");
    }
}

#[test]
fn few_samples_have_few_peaks_and_it_is_said() {
    let folder = folder(&samples(9, 1.0));
    let done = output(folder.path(), &["fit", "s.csv", "--json"]);
    assert_eq!(done.status.code(), Some(0));
    assert_eq!(err(&done), "9 samples can tell 2 of 7 peaks: a peak has four unknowns\n");
    let found: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert!(found["fitted"].as_u64().unwrap() <= 2);
}

#[test]
fn a_plot_is_drawn_the_same_twice() {
    let below = "0,0,-1,0.5\n";
    let folder = folder(&(samples(300, 1.0) + below));
    let plot = |name: &str| {
        let done = output(folder.path(), &["fit", "s.csv", "--plot", name]);
        assert_eq!(done.status.code(), Some(0), "{}", err(&done));
        fs::read(folder.path().join(name)).unwrap()
    };
    let bytes = plot("a.png");
    assert_eq!(bytes, plot("b.PNG"));
    let picture = image::load_from_memory(&bytes).unwrap();
    assert!(picture.width() > 3 * picture.height(), "three discs and two bars in a row");
}

/// Directions below the horizon are directions like others, and samples may repeat.
#[test]
fn repeated_and_lower_directions_are_fitted() {
    let folder = folder(&"0,0,-3,2\n".repeat(30));
    let found = json(folder.path(), &[]);
    assert_eq!(found["met"], true);
    assert_eq!(found["peaks"][0]["direction"][2], -1.0);
    assert!((found["peaks"][0]["amplitude"].as_f64().unwrap() - 2.0).abs() < 1e-9);
}
