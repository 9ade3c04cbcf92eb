//! The metrics against other programs, on the picture pairs of `tests/data/metrics`.

use wrinkle::metric::{Exposures, Values, Viewing, exposures, find};
use wrinkle::render::{Film, read_image};

/// A pair, with what other programs say of it.
struct Pair {
    test: &'static str,
    reference: &'static str,
    /// By scikit-image: rmse, psnr, ssim, ssim of luminance.
    scikit: [f64; 4],
    /// By numpy: ms_ssim, ms_ssim of luminance.
    numpy: [f64; 2],
    /// By an independent program in double precision: FLIP of sRGB codes, and of the same numbers taken as light.
    flip: [f64; 2],
    /// By NVIDIA's evaluator in single precision: the same, and HDR-FLIP of the numbers taken as light.
    nvidia: [f64; 3],
    /// Its exposures: start, stop, count.
    exposures: (f64, f64, usize),
}

const PAIRS: [Pair; 3] = [
    Pair {
        test: "gradient_noisy",
        reference: "gradient",
        scikit: [0.0771687991, 22.2511652, 0.198412636, 0.241303187],
        numpy: [0.763818417, 0.784877973],
        flip: [0.1589514, 0.137407792],
        nvidia: [0.158951685, 0.137408331, 0.162486717],
        exposures: (1.15189326, 2.08096576, 2),
    },
    Pair {
        test: "bumps_blurred",
        reference: "bumps",
        scikit: [0.257576874, 11.7818626, 0.485518528, 0.483595612],
        numpy: [0.816891301, 0.815459925],
        flip: [0.352291569, 0.4228263],
        nvidia: [0.352291554, 0.422826916, 0.485942125],
        exposures: (1.08329725, 2.37054849, 2),
    },
    Pair {
        test: "weave_aliased",
        reference: "weave",
        scikit: [0.168920551, 15.4463502, 0.82009573, 0.820486799],
        numpy: [0.958881638, 0.958966778],
        flip: [0.185323078, 0.202870402],
        nvidia: [0.18532078, 0.20286943, 0.302365273],
        exposures: (1.08329725, 5.17733431, 5),
    },
];

fn picture(name: &str) -> Vec<Film> {
    let path = format!("{}/tests/data/metrics/{name}.webp", env!("CARGO_MANIFEST_DIR"));
    read_image(path.as_ref()).unwrap().channels
}

/// How far our value of a metric is from another program's.
fn off(pair: &Pair, metric: &str, values: Values, theirs: f64) -> f64 {
    let viewing = Viewing { values, ..Viewing::default() };
    let (test, reference) = (picture(pair.test), picture(pair.reference));
    let ours = find(metric).unwrap().value_seen(&test, &reference, &viewing).unwrap();
    println!("{metric} of {}: {ours:.9} against {theirs:.9}", pair.test);
    (ours - theirs).abs()
}

/// To the nine digits they are given with.
#[test]
fn scikit_image_agrees_to_all_digits() {
    let metrics = ["rmse", "psnr", "ssim", "ssim:luminance"];
    let digits = [1e-9, 1e-7, 1e-9, 1e-9];
    for pair in &PAIRS {
        for ((metric, theirs), digits) in metrics.iter().zip(pair.scikit).zip(digits) {
            assert!(off(pair, metric, Values::Codes, theirs) < digits, "{metric} of {}", pair.test);
        }
    }
}

#[test]
fn ms_ssim_is_as_defined() {
    for pair in &PAIRS {
        for (metric, theirs) in ["ms_ssim", "ms_ssim:luminance"].iter().zip(pair.numpy) {
            assert!(off(pair, metric, Values::Codes, theirs) < 1e-9, "{metric} of {}", pair.test);
        }
    }
}

#[test]
fn flip_agrees_to_a_millionth_in_double_precision_and_with_nvidias() {
    for pair in &PAIRS {
        for (k, values) in [Values::Codes, Values::Light].into_iter().enumerate() {
            assert!(off(pair, "flip", values, pair.flip[k]) < 1e-6, "{}", pair.test);
            assert!(off(pair, "flip", values, pair.nvidia[k]) < 1e-4, "{}", pair.test);
        }
    }
}

#[test]
fn hdr_flip_agrees_with_nvidias_in_value_and_exposures() {
    for pair in &PAIRS {
        assert!(off(pair, "flip:hdr", Values::Light, pair.nvidia[2]) < 1e-4, "{}", pair.test);
        let reference = picture(pair.reference);
        let luminance = |i: usize| {
            let [r, g, b] = [0, 1, 2].map(|c| f64::from(reference[c].pixels()[i]));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let all: Vec<f64> = (0..reference[0].pixels().len()).map(luminance).collect();
        let Exposures { start, stop, count } = exposures(&all).unwrap();
        let (their_start, their_stop, their_count) = pair.exposures;
        assert!((start - their_start).abs() < 1e-6, "{start} {their_start}");
        assert!((stop - their_stop).abs() < 1e-6, "{stop} {their_stop}");
        assert_eq!(count, their_count);
    }
}

#[test]
fn equal_pictures_do_not_differ() {
    let picture = picture("bumps");
    for values in [Values::Codes, Values::Light, Values::Radiances] {
        let viewing = Viewing { values, ..Viewing::default() };
        let of = |name: &str| find(name).unwrap().value_seen(&picture, &picture, &viewing);
        assert_eq!((of("flip"), of("rmse"), of("psnr")), (Some(0.0), Some(0.0), None));
        assert!(["ssim", "ms_ssim"].iter().all(|name| (of(name).unwrap() - 1.0).abs() < 1e-12));
    }
}
