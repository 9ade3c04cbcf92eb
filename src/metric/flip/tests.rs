//! Properties of FLIP. Its agreement with other programs is tested with the other metrics' (`metric/agreement.rs`).

use super::*;
use crate::metric::PPD;

fn picture(channels: usize, f: impl Fn(usize, usize, usize) -> f64) -> Picture {
    let (width, height) = (40, 30);
    let channel = |c| (0..width * height).map(|i| f(c, i % width, i / width)).collect();
    Picture { width, channels: (0..channels).map(channel).collect() }
}

fn mean(a: &Picture, r: &Picture) -> f64 {
    difference(a, r, PPD).unwrap().mean()
}

#[test]
fn grey_is_what_three_equal_channels_are() {
    let (a, r) =
        (|x: usize, y: usize| ((x * 7 + y * 3) % 11) as f64 / 10.0, |x: usize, _| x as f64 / 40.0);
    let of = |channels| {
        mean(&picture(channels, |_, x, y| a(x, y)), &picture(channels, |_, x, y| r(x, y)))
    };
    // The inverse matrix has nine digits.
    assert!((of(1) - of(3)).abs() < 1e-7, "{} {}", of(1), of(3));
}

#[test]
fn it_is_a_symmetric_difference_from_0_to_1() {
    let a = picture(3, |c, x, y| ((x * (c + 1) + y * 3) % 11) as f64 / 10.0);
    let r = picture(3, |c, x, y| ((x + y * (c + 2)) % 7) as f64 / 6.0);
    assert_eq!(mean(&a, &a), 0.0);
    assert_eq!(mean(&a, &r), mean(&r, &a));
    let found = difference(&a, &r, PPD).unwrap();
    assert!(found.values.iter().all(|value| (0.0..=1.0).contains(value)));
    // Black against white: |ΔL*| = 100 everywhere, no features.
    let (black, white) = (picture(1, |_, _, _| 0.0), picture(1, |_, _, _| 1.0));
    let expected = colour_difference([0.0; 3], [100.0, 0.0, 0.0], greatest_difference());
    assert!((mean(&black, &white) - expected).abs() < 1e-12);
    // Green against blue is the greatest difference.
    let pure = |k: usize| picture(3, move |c, _, _| f64::from(u8::from(c == k)));
    assert!((mean(&pure(1), &pure(2)) - 1.0).abs() < 1e-6);
}

#[test]
fn a_farther_viewer_sees_less() {
    // A checkerboard of pixels against its mean.
    let fine = picture(1, |_, x, y| ((x + y) % 2) as f64);
    let even = picture(1, |_, _, _| 0.5);
    let seen = |ppd: f64| difference(&fine, &even, ppd).unwrap().mean();
    assert!(seen(20.0) > seen(40.0) && seen(40.0) > seen(80.0));
}

#[test]
fn exposures_of_a_black_reference_are_none() {
    assert_eq!(exposures(&[0.0; 4]), None);
    assert_eq!(exposures(&[]), None);
    assert_eq!(exposures(&[1.0, f64::INFINITY]), None);
    let even = exposures(&[1.0; 9]).unwrap();
    assert_eq!((even.start, even.count), (even.stop, 2));
    assert!((libm::exp2(even.start) - hdr_shoulder()).abs() < 1e-12);
}

/// Where ACES is 0.85.
fn hdr_shoulder() -> f64 {
    let tone = |x: f64| (0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14);
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if tone(middle) < 0.85 { low = middle } else { high = middle }
    }
    low
}
