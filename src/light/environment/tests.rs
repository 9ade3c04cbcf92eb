//! Cones against brute force.

use std::f64::consts::PI;

use super::*;
use crate::geometry::Frame;

/// A picture with a small bright disc, a wide band, and noise.
fn busy(height: usize) -> Environment {
    let radiance = |d: &Vec3| {
        let disc = if d.dot(&Vec3::new(0.48, 0.6, 0.64)) > 0.99 { 20.0 } else { 0.0 };
        let band = if (d.z * 7.0).sin() > 0.3 { 1.0 } else { 0.2 };
        disc + band + 0.5 * (9.0 * d.x).cos().powi(2)
    };
    Environment::of(&radiance, height, 0.0, 1.0)
}

/// The mean over all pixels, weighted by `weight`.
fn brute(environment: &Environment, weight: impl Fn(&Vec3) -> f64) -> f64 {
    let map = &environment.map;
    let (mut sum, mut total) = (0.0, 0.0);
    for row in 0..map.height {
        let area = map.solid_angle(row);
        for column in 0..map.width {
            let across = (column as f64 + 0.5) / map.width as f64;
            let down = (row as f64 + 0.5) / map.height as f64;
            let w = area * weight(&Spot { across, down }.direction());
            sum += w * map.cell(column, row);
            total += w;
        }
    }
    sum / total
}

fn directions() -> Vec<Vec3> {
    let mut all = vec![Vec3::z(), -Vec3::z(), Vec3::new(0.01, 0.0, 1.0).normalize()];
    all.push(Vec3::new(0.48, 0.6, 0.64).normalize());
    all.extend((0..20).map(|k| {
        let (z, turn) = (1.0 - (f64::from(k) + 0.5) / 10.0, 2.4 * f64::from(k));
        let flat = (1.0 - z * z).sqrt();
        Vec3::new(flat * turn.cos(), flat * turn.sin(), z)
    }));
    all
}

#[test]
fn round_cones_are_what_they_say() {
    let environment = busy(128);
    let (mut worst, mut sum, mut count) = (0.0f64, 0.0, 0.0);
    for sigma in [0.06, 0.08, 0.1, 0.14, 0.2, 0.33, 0.5, 0.9, 1.5] {
        let kappa = 1.0 / (sigma * sigma);
        for d in directions() {
            let want = brute(&environment, |w| (kappa * (w.dot(&d) - 1.0)).exp());
            let error = (environment.cone(&d, sigma * sigma) - want).abs();
            worst = worst.max(error / want.max(1.0));
            sum += error / want.max(1.0);
            count += 1.0;
        }
    }
    // Half way between levels a blend of a narrow and a wide kernel stands for one between: near the
    // edge of the bright disc that is a few percent.
    assert!(worst < 0.1 && sum / count < 0.01, "worst {worst}, mean {}", sum / count);
}

#[test]
fn elliptic_cones_are_what_they_say() {
    let environment = busy(128);
    let (mut worst, mut sum, mut count) = (0.0f64, 0.0, 0.0);
    for (long, short, degrees) in
        [(0.2f64, 0.1f64, 20.0f64), (0.3, 0.1, -50.0), (0.5, 0.07, 90.0), (0.3, 0.29, 10.0)]
    {
        let (s, c) = degrees.to_radians().sin_cos();
        let (l, m) = (long * long, short * short);
        let covariance = [l * c * c + m * s * s, (l - m) * s * c, l * s * s + m * c * c];
        for d in directions() {
            let frame = Frame::about(d);
            let axes = [frame.tangent, frame.bitangent];
            // A Gaussian in the angles along and across the long axis.
            let (along, across) = (axes[0] * c + axes[1] * s, axes[1] * c - axes[0] * s);
            let want = brute(&environment, |w| {
                let angle = libm::atan2(w.dot(&along), w.dot(&d));
                let side = libm::asin(w.dot(&across).clamp(-1.0, 1.0));
                (-0.5 * (angle * angle / l + side * side / m)).exp()
            });
            let error = (environment.elliptic_cone(&d, &axes, covariance) - want).abs();
            worst = worst.max(error / want.max(1.0));
            sum += error / want.max(1.0);
            count += 1.0;
        }
    }
    assert!(worst < 0.1 && sum / count < 0.015, "worst {worst}, mean {}", sum / count);
}

#[test]
fn white_stays_white() {
    let white = Environment::of(&|_| 1.0, 32, 30.0, 1.0);
    let frame = |d: &Vec3| {
        let f = Frame::about(*d);
        [f.tangent, f.bitangent]
    };
    for d in directions() {
        assert_eq!(white.radiance(&d), 1.0);
        for variance in [0.0, 1e-4, 0.003, 0.05, 0.7, 30.0, 1e9] {
            assert!((white.cone(&d, variance) - 1.0).abs() < 1e-6);
            let long = [variance, 0.3 * variance, 0.2 * variance];
            assert!((white.elliptic_cone(&d, &frame(&d), long) - 1.0).abs() < 1e-6);
        }
    }
}

#[test]
fn every_level_keeps_the_mean() {
    let environment = busy(64);
    for variance in [0.01, 0.1, 1.0] {
        let smooth = |d: &Vec3| environment.cone(d, variance);
        let mean = Environment::of(&smooth, 64, 0.0, 1.0).mean();
        assert!((mean / environment.mean() - 1.0).abs() < 2e-3, "{variance}: {mean}");
    }
}

#[test]
fn a_turn_turns_the_light() {
    let plain = busy(64);
    let map = plain.map.clone();
    let turned = Environment::new(64, &map.values, 90.0, 3.0);
    // At a pole itself all longitudes meet, and a lookup takes one of them.
    for d in directions().into_iter().filter(|d| d.x.hypot(d.y) > 1e-9) {
        let there = Vec3::new(-d.y, d.x, d.z);
        // Values up to 70 in single precision.
        assert!((turned.radiance(&there) - 3.0 * plain.radiance(&d)).abs() < 1e-5);
        assert!((turned.cone(&there, 0.03) - 3.0 * plain.cone(&d, 0.03)).abs() < 1e-5);
    }
    let (direction, density) = turned.sample(0.3, 0.8);
    assert!((turned.density(&direction) / density - 1.0).abs() < 1e-9);
}

#[test]
fn drawn_directions_integrate() {
    // ∫ L dω = Σ L(d)/p(d) / n over a lattice of draws; bilinear L differs from the pixel's own.
    let environment = busy(128);
    let n = 40_000;
    let mut sum = 0.0;
    for k in 0..n {
        let (u1, u2) = ((f64::from(k) + 0.5) / f64::from(n), (f64::from(k) * 0.618_034).fract());
        let (d, density) = environment.sample(u1, u2);
        sum += environment.radiance(&d) / density / f64::from(n);
    }
    assert!((sum / (4.0 * PI * environment.mean()) - 1.0).abs() < 0.01, "{sum}");
}

#[test]
fn the_same_at_any_thread_count() {
    let build = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| busy(48))
    };
    assert_eq!(build(1), build(3));
}
