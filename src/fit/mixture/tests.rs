use std::f64::consts::TAU;

use proptest::prelude::*;

use super::fisher::kappa_of;
use super::*;
use crate::geometry::{HemisphereGrid, Vec3};

const S: f64 = 50.0;

fn gathered(exponent: f64, normals: &[(Vec3, f64)]) -> NormalBins {
    let mut bins = NormalBins::new(exponent, 7);
    normals.iter().for_each(|&(normal, weight)| bins.add(normal, weight));
    bins
}

/// `count` normals about a few directions, none alike.
fn normals(count: usize) -> Vec<(Vec3, f64)> {
    let one = |i: usize| {
        let t = i as f64;
        let (x, y) = (0.5 * (0.7 * t).sin() + 0.2 * (3.1 * t).cos(), 0.6 * (1.3 * t).sin());
        (Vec3::new(x, y, 1.0), 0.5 + (0.37 * t).fract())
    };
    (0..count).map(one).collect()
}

fn mixed(bins: &NormalBins, max_peaks: usize, stop: f64) -> Mixture {
    let options = GreedyOptions { max_peaks, stop, ..GreedyOptions::default() };
    mixture(bins, options, &|| false).unwrap()
}

fn moment(peaks: &[Peak]) -> Vec3 {
    peaks.iter().fold(Vec3::zeros(), |sum, p| sum + p.moment())
}

/// ∫ f dω over the whole sphere.
fn integrate(f: impl Fn(Vec3) -> f64) -> f64 {
    let grid = HemisphereGrid::new(400, 400);
    grid.integrate(&f) + grid.integrate(|w| f(-w))
}

#[test]
fn closed_forms_are_the_integrals() {
    let lobe = |d: [f64; 3], n, m| Fisher::new(Vec3::from(d).normalize(), n, m);
    let value = |f: &Fisher, w: Vec3| (f.log_peak + f.natural.dot(&w) - f.kappa).exp();
    let (a, b) = (lobe([0.3, 0.1, 1.0], 12.0, 0.7), lobe([-0.4, 0.5, 0.2], 3.0, 2.0));
    for f in [&a, &b] {
        let moment = integrate(|w| value(f, w) * w.dot(&f.direction()));
        assert!((moment / f.strength() - 1.0).abs() < 1e-5, "{moment}");
    }
    let (sum, t, scale) = a.times(&b);
    let (axis, integrals) = (sum / t, fisher::Integrals::at(t));
    for (k, want) in [integrals.zeroth, integrals.first, integrals.second].into_iter().enumerate() {
        let got = integrate(|w| value(&a, w) * value(&b, w) * w.dot(&axis).powi(k as i32));
        assert!((got / (scale * want) - 1.0).abs() < 1e-5, "{k}: {got}");
    }
}

#[test]
fn a_component_is_near_the_peak_it_stands_for() {
    for (exponent, gap) in [(3.0f64, 0.09), (10.0, 0.04), (60.0, 0.01)] {
        let fisher = Fisher::new(Vec3::z(), exponent, 1.0);
        let kappa = kappa_of(exponent);
        let peak = |w: Vec3| (exponent + 2.0) / TAU * w.z.max(0.0).powf(exponent);
        let apart = |w: Vec3| ((fisher.log_peak + kappa * (w.z - 1.0)).exp() - peak(w)).powi(2);
        let relative = (integrate(apart) / integrate(|w| peak(w).powi(2))).sqrt();
        assert!(relative < gap, "{exponent}: {relative}");
    }
}

#[test]
fn a_single_normal_is_the_base_lobe() {
    let normal = Vec3::new(0.6, -0.3, 0.8);
    let found = mixed(&gathered(S, &[(normal, 0.25); 100]), 7, 0.05);
    let [peak] = found.peaks[..] else { panic!("{found:?}") };
    assert_eq!((found.fitted, peak.exponent, peak.direction), (0, S, normal.normalize()));
    assert!((peak.amplitude / (25.0 * (S + 2.0) / TAU) - 1.0).abs() < 1e-14);
}

#[test]
fn one_direction_gathered_from_many_normals_is_nearly_the_base_lobe() {
    // 100 normals within a hundredth of the lobe's width: no longer "few".
    let near = |i: usize| Vec3::new(1e-5 * i as f64, 2e-5 * (i % 7) as f64, 1.0);
    let all: Vec<(Vec3, f64)> = (0..100).map(|i| (near(i), 0.01)).collect();
    let found = mixed(&gathered(S, &all), 7, 0.05);
    let [peak] = found.peaks[..] else { panic!("{found:?}") };
    assert!((peak.exponent / S - 1.0).abs() < 1e-4, "{peak:?}");
}

#[test]
fn planted_clusters_are_found() {
    let centres = [[0.0, 0.0], [0.8, 0.0], [-0.5, 0.9]];
    let cluster = |i: usize| {
        let [x, y] = centres[i % 3];
        let t = i as f64;
        (Vec3::new(x + 0.02 * t.sin(), y + 0.02 * (2.0 * t).cos(), 1.0), 1.0)
    };
    let all: Vec<_> = (0..90).map(cluster).collect();
    let found = mixed(&gathered(200.0, &all), 7, 0.05);
    assert_eq!(found.peaks.len(), 3, "{found:?}");
    for [x, y] in centres {
        let centre = Vec3::new(x, y, 1.0).normalize();
        assert!(found.peaks.iter().any(|p| p.direction.dot(&centre) > 0.9999), "{found:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn the_vector_moment_is_kept(
        count in 8usize..300, exponent in 0.3f64..400.0, max_peaks in 1usize..=7, turn in -1.0f64..1.0,
    ) {
        let turned = |(n, w): (Vec3, f64)| (Vec3::new(n.x + turn * n.z, n.y, n.z - turn * n.x), w);
        let bins = gathered(exponent, &normals(count).into_iter().map(turned).collect::<Vec<_>>());
        let found = mixed(&bins, max_peaks, 0.02);
        let (got, want) = (moment(&found.peaks), bins.total());
        prop_assert!((got - want).norm() < 1e-9 * want.norm(), "{got} {want}");
        prop_assert!(found.peaks.iter().all(|p| p.exponent > 0.0 && p.exponent <= exponent * (1.0 + 1e-9)));
        prop_assert!(found.error.is_finite() && found.error <= 1.0 + 1e-9, "{found:?}");
    }
}

#[test]
fn more_peaks_are_never_further() {
    let bins = gathered(S, &normals(200));
    let errors: Vec<f64> = (1..=7).map(|most| mixed(&bins, most, 0.0).error).collect();
    for pair in errors.windows(2) {
        assert!(pair[1] <= pair[0] * (1.0 + 1e-3), "{errors:?}");
    }
    assert!(errors[6] < 0.1, "{errors:?}");
}

#[test]
fn bins_are_bounded_and_keep_the_moments() {
    let mut bins = NormalBins::new(5e4, 7);
    let (mut vector, mut weight) = (Vec3::zeros(), 0.0);
    for (normal, w) in normals(20_000) {
        bins.add(normal, w);
        vector += normal.normalize() * w;
        weight += w;
    }
    assert!(bins.resultants().count() <= 1024);
    assert!((bins.total() - vector).norm() < 1e-10 * weight);
    let total: f64 = bins.resultants().map(|bin| bin.weight).sum();
    assert!((total - weight).abs() < 1e-10 * weight);
}

#[test]
fn what_has_no_answer_is_answered_anyway() {
    let none = gathered(S, &[(Vec3::zeros(), 1.0), (Vec3::z(), 0.0), (Vec3::z(), f64::NAN)]);
    assert!(mixed(&none, 7, 0.05).peaks.is_empty());
    // Normals all around, some opposite to each other: little is left of their sum.
    let around = |i: usize| (Vec3::new((0.7 * i as f64).sin(), (0.7 * i as f64).cos(), 0.01), 1.0);
    for exponent in [1e-3, 1.0, 60.0, 1e6] {
        let found = mixed(&gathered(exponent, &(0..40).map(around).collect::<Vec<_>>()), 7, 0.05);
        for peak in &found.peaks {
            let finite = peak.amplitude.is_finite() && peak.exponent.is_finite();
            assert!(finite && peak.amplitude >= 0.0, "{exponent}: {peak:?}");
            assert!((peak.direction.norm() - 1.0).abs() < 1e-9, "{exponent}: {peak:?}");
        }
    }
    assert!(mixture(&gathered(S, &normals(99)), GreedyOptions::default(), &|| true).is_none());
}
