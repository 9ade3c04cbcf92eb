//! The metrics against values of an independent program, and against identities.

use proptest::prelude::*;

use super::*;

fn film(width: usize, height: usize, f: impl Fn(usize, usize) -> f64) -> Film {
    let pixel = |i: usize| f(i % width, i / width) as f32;
    Film::new(width, height, (0..width * height).map(pixel).collect())
}

/// Two pairs of images (test, reference) of 37 × 29 pixels, exact in single precision.
fn pairs() -> [(Film, Film); 2] {
    let make = |f: fn(usize, usize) -> f64| film(37, 29, f);
    [
        (
            make(|x, y| ((x * x + 3 * y * y + x * y + (5 * x + 7 * y) % 9) % 64) as f64 / 64.0),
            make(|x, y| ((x * x + 3 * y * y + x * y) % 64) as f64 / 64.0),
        ),
        (
            make(|x, y| (2 + (x * x + y * y) % 16 + (x + 2 * y) % 3) as f64 / 16.0),
            make(|x, y| (2 + (x * x + y * y) % 16) as f64 / 16.0),
        ),
    ]
}

#[test]
fn scores_are_those_of_an_independent_program() {
    // SSIM by scikit-image 0.26 (structural_similarity with gaussian_weights, sigma 1.5, no sample
    // covariance, data_range max R), the others by numpy in double precision from the formulas.
    let expected = [
        [
            ("rmse", 0.234307034258482),
            ("relmse", 0.272103674120251),
            ("psnr", 12.467504969739),
            ("ssim", 0.703576228436),
            ("energy", 1.003_926_858_513_19),
            ("highlight_energy", 0.918248818393015),
        ],
        [
            ("rmse", 0.080702191188518),
            ("relmse", 0.076747705432702),
            ("psnr", 21.301718995099),
            ("ssim", 0.973626180736),
            ("energy", 1.127464956046567),
            ("highlight_energy", 1.081515909903468),
        ],
    ];
    for ((test, reference), expected) in pairs().iter().zip(expected) {
        let scores = scores(test, reference);
        assert_eq!(scores.len(), expected.len());
        for ((name, value), (expected_name, expected)) in scores.into_iter().zip(expected) {
            assert_eq!(name, expected_name);
            assert!((value - expected).abs() < 1e-11, "{name}: {value} against {expected}");
        }
    }
}

#[test]
fn ssim_takes_its_data_range_as_given() {
    let (test, reference) = &pairs()[0];
    // By the same program with data_range 1.
    let value = ssim(test, reference, 1.0).unwrap();
    assert!((value - 0.703626588140).abs() < 1e-11, "{value}");
}

#[test]
fn equal_images_have_the_best_scores() {
    let (_, reference) = &pairs()[0];
    let scores = scores(reference, reference);
    let best =
        [("rmse", 0.0), ("relmse", 0.0), ("ssim", 1.0), ("energy", 1.0), ("highlight_energy", 1.0)];
    for ((name, value), (expected_name, expected)) in scores.into_iter().zip(best) {
        assert_eq!(name, expected_name, "PSNR of equal images is infinite and left out");
        assert!((value - expected).abs() < 1e-12, "{name}: {value}");
    }
}

#[test]
fn what_has_no_value_is_left_out() {
    let names = |test: &Film, reference: &Film| -> Vec<&str> {
        scores(test, reference).into_iter().map(|(name, _)| name).collect()
    };
    let small = film(10, 40, |x, _| x as f64);
    assert_eq!(names(&small, &small), ["rmse", "relmse", "energy", "highlight_energy"]);
    let black = film(12, 12, |_, _| 0.0);
    let lit = film(12, 12, |_, _| 1.0);
    assert_eq!(names(&lit, &black), ["rmse", "psnr", "ssim"]);
    assert_eq!(names(&film(0, 0, |_, _| 0.0), &film(0, 0, |_, _| 0.0)), [""; 0]);
}

#[test]
fn channels_are_scored_together() {
    let [(a, b), (c, d)] = pairs();
    let both = channel_scores(&[a.clone(), c.clone()], &[b.clone(), d.clone()]);
    let (one, two) = (scores(&a, &b), scores(&c, &d));
    let mse = 0.5 * (one[0].1 * one[0].1 + two[0].1 * two[0].1);
    assert!((both[0].1 - mse.sqrt()).abs() < 1e-15, "rmse over all channels");
    let mismatch = same_shape(std::slice::from_ref(&a), &[b, d]).unwrap_err();
    assert!(mismatch.to_string().contains("37 × 29 pixels in 1 channel(s) against 37 × 29 in 2"));
    assert!(same_shape(&[a], &[film(36, 29, |_, _| 0.0)]).is_err());
}

#[test]
fn names_are_unique_and_found() {
    for metric in entries() {
        assert_eq!(find(metric.name).map(|m| m.formula), Some(metric.formula));
        assert!(entries().iter().filter(|other| other.name == metric.name).count() == 1);
    }
    assert!(find("flip").is_none());
}

proptest! {
    #[test]
    fn all_but_rmse_do_not_depend_on_exposure(power in -6i32..6) {
        let (test, reference) = &pairs()[1];
        let exposed = |film: &Film| {
            let pixels = film.pixels().iter().map(|p| p * 2f32.powi(power)).collect();
            Film::new(film.width(), film.height(), pixels)
        };
        let scaled = scores(&exposed(test), &exposed(reference));
        for ((name, value), (_, scaled)) in scores(test, reference).into_iter().zip(scaled) {
            let expected = if name == "rmse" { value * 2f64.powi(power) } else { value };
            prop_assert!((scaled - expected).abs() <= 1e-12 * expected.abs(), "{name}: {scaled} {expected}");
        }
    }
}
