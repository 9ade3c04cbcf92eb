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
        for (name, expected) in expected {
            let value = score(name, test, reference).unwrap();
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
    for metric in entries() {
        let Some(value) = score(metric.name, reference, reference) else {
            assert!(
                metric.name.starts_with("psnr") || metric.name.starts_with("ms_ssim"),
                "{}",
                metric.name
            );
            continue;
        };
        let best = if metric.best == Best::Lowest { 0.0 } else { 1.0 };
        assert!((value - best).abs() < 1e-12, "{}: {value}", metric.name);
    }
}

#[test]
fn what_has_no_value_is_left_out() {
    let names = |test: &Film, reference: &Film| -> Vec<&str> {
        scores(test, reference).into_iter().map(|(name, _)| name).collect()
    };
    let small = film(10, 40, |x, _| x as f64);
    let windowless = names(&small, &small);
    assert!(windowless.contains(&"rmse") && windowless.contains(&"energy"), "{windowless:?}");
    assert!(!windowless.contains(&"ssim") && !windowless.contains(&"psnr"), "{windowless:?}");
    let (black, lit) = (film(12, 12, |_, _| 0.0), film(12, 12, |_, _| 1.0));
    let unlit = names(&lit, &black);
    assert!(["rmse", "psnr", "ssim"].iter().all(|name| unlit.contains(name)), "{unlit:?}");
    let relative = ["relmse", "mape", "energy", "highlight_energy"];
    assert!(!relative.iter().any(|name| unlit.contains(name)), "{unlit:?}");
    assert_eq!(names(&film(0, 0, |_, _| 0.0), &film(0, 0, |_, _| 0.0)), [""; 0]);
}

#[test]
fn variants_are_what_their_tools_compute() {
    // Worked by hand: A = (1.5, 0, 3), R = (1, 0.25, 0).
    let (test, reference) =
        (Film::new(3, 1, vec![1.5, 0.0, 3.0]), Film::new(3, 1, vec![1.0, 0.25, 0.0]));
    let squares = [0.25, 0.0625, 9.0];
    let expected = [
        ("mse", squares.map(|s| s / 3.0)),
        ("mae", [0.5 / 3.0, 0.25 / 3.0, 1.0]),
        (
            "relmse:pbrt",
            [0.25 / 1.01f64.powi(2), 0.0625 / 0.26f64.powi(2), 9.0 / 1e-4].map(|s| s / 3.0),
        ),
        ("relmse:tev", [0.25 / 1.01, 0.0625 / 0.0725, 9.0 / 0.01].map(|s| s / 3.0)),
        ("relmse:jeri", [0.25 / 1.0001, 0.0625 / 0.0626, 9.0 / 1e-4].map(|s| s / 3.0)),
        ("mape:tev", [0.5 / 1.01, 0.25 / 0.26, 3.0 / 0.01].map(|s| s / 3.0)),
        ("mape:jeri", [0.5 / 1.01, 0.25 / 0.26, 3.0 / 0.01].map(|s| s / 3.0)),
        ("smape:jeri", [1.0 / 2.52, 0.5 / 0.27, 6.0 / 3.02].map(|s| s / 3.0)),
    ];
    for (name, terms) in expected {
        let (found, wanted) = (score(name, &test, &reference).unwrap(), terms.iter().sum::<f64>());
        assert!((found / wanted - 1.0).abs() < 1e-13, "{name}: {found} {wanted}");
    }
    // Signed and unsigned ε differ where the reference is below 0, as a filter of negative lobes makes it.
    let below = Film::new(1, 1, vec![-0.5]);
    let zero = Film::new(1, 1, vec![0.0]);
    assert!((score("mape:tev", &zero, &below).unwrap() + 0.5 / 0.49).abs() < 1e-14);
    assert!((score("mape:jeri", &zero, &below).unwrap() - 0.5 / 0.51).abs() < 1e-14);
}

#[test]
fn channels_are_scored_together() {
    let [(a, b), (c, d)] = pairs();
    let both = channel_scores(&[a.clone(), c.clone()], &[b.clone(), d.clone()]);
    let (one, two) = (score("mse", &a, &b).unwrap(), score("mse", &c, &d).unwrap());
    assert_eq!(both[0].0, "rmse");
    assert!((both[0].1 - (0.5 * (one + two)).sqrt()).abs() < 1e-15, "rmse over all channels");
    let mismatch = same_shape(std::slice::from_ref(&a), &[b, d]).unwrap_err();
    assert!(mismatch.to_string().contains("37 × 29 pixels in 1 channel(s) against 37 × 29 in 2"));
    assert!(same_shape(&[a], &[film(36, 29, |_, _| 0.0)]).is_err());
}

#[test]
fn names_are_unique_and_found() {
    for metric in entries() {
        assert_eq!(find(metric.name).map(|m| m.formula), Some(metric.formula));
        let base = metric.name.split(':').next().unwrap();
        assert!(find(base).is_some(), "{} is a variant of nothing", metric.name);
        assert!(entries().iter().filter(|other| other.name == metric.name).count() == 1);
    }
    assert!(find("beauty").is_none());
}

proptest! {
    #[test]
    fn all_but_plain_differences_do_not_depend_on_exposure(power in -6i32..6) {
        let (test, reference) = &pairs()[1];
        let exposed = |film: &Film| {
            let pixels = film.pixels().iter().map(|p| p * 2f32.powi(power)).collect();
            Film::new(film.width(), film.height(), pixels)
        };
        let scaled = scores(&exposed(test), &exposed(reference));
        for ((name, value), (_, scaled)) in scores(test, reference).into_iter().zip(scaled) {
            let plain = matches!(name, "rmse" | "mae");
            let expected = if plain { value * 2f64.powi(power) } else { value };
            prop_assert!((scaled - expected).abs() <= 1e-12 * expected.abs(), "{name}: {scaled} {expected}");
        }
    }
}
