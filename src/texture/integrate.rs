//! Heights from normals (Frankot and Chellappa 1988, A Method for Enforcing Integrability in Shape from
//! Shading Algorithms, IEEE PAMI 10(4), eq. 21).

use std::f64::consts::TAU;
use std::fmt;

use super::{HeightMap, NormalMap, Wrap};
use crate::geometry::Vec3;
use crate::geometry::elementary::atan2_64;
use crate::geometry::fourier::{Complex, conjugate, transform};

/// The heights nearest to a normal map, and how near they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Integrated {
    /// Heights in sides of a texel, their mean 0, of the map's size and wrap.
    pub heights: HeightMap,
    /// What of the normals they leave out.
    pub residual: Residual,
}

/// What no surface has of a normal map: the difference between its slopes and those of the nearest
/// surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// Root mean square of the angle between the normals, degrees.
    pub angle: f64,
    /// Root mean square of the difference of slopes, height per length.
    pub slope: f64,
    /// Σ |difference of slopes|² / Σ |slope|², from 0 (a surface's normals) to 1 (nothing of them is).
    pub share: f64,
}

impl fmt::Display for Residual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "heights are integrated from the normals (Frankot and Chellappa 1988); theirs differ by {:.2}° \
             rms, by a slope of {:.4} rms: {:.1} % of the squared slopes belong to no surface",
            self.angle,
            self.slope,
            100.0 * self.share
        )
    }
}

/// The heights whose slopes come nearest to a map's, by least squares over its texels.
///
/// With p and q the slopes along x and y, a hat for the transform and k for radians a texel,
/// F̂ = −i (k_x p̂ + k_y q̂) / (k_x² + k_y²). A map that repeats has no mean slope as a surface: that of
/// its normals counts as residual. A map whose edge goes on for ever is mirrored at its edges. Waves of
/// half a period a texel have no slope at texel centres and stay flat along their direction.
///
/// Time and memory: three transforms of the map, four times its size where it is mirrored.
pub fn integrate(map: &NormalMap) -> Integrated {
    let (width, height) = (map.width(), map.height());
    let mirrors = if map.wrap() == Wrap::Clamp { 2 } else { 1 };
    let whole = [mirrors * width, mirrors * height];
    let slopes = table(whole, |i, j| conjugate(mirrored_slope(map, i, j)));
    let spectrum = transform(whole[0], whole[1], &slopes);
    drop(slopes);
    let surface = table(whole, |m, n| surface_wave(&spectrum, whole, m, n));
    drop(spectrum);
    let scale = 1.0 / (whole[0] * whole[1]) as f64;
    let back = |spectrum: &[Complex]| transform(whole[0], whole[1], spectrum);
    let inside = |values: &[Complex], c: usize| -> Vec<f64> {
        let rows = values.chunks(whole[0]).take(height);
        rows.flat_map(|row| row[..width].iter().map(move |value| value[c] * scale)).collect()
    };
    let heights = inside(&back(&surface), 0);
    let found = back(&table(whole, |m, n| {
        let [kx, ky] = frequency(whole, m, n);
        let [re, im] = surface[n * whole[0] + m];
        // i k_x F̂ + i (i k_y F̂): both slopes at once, as a real and an imaginary part.
        [-kx * im - ky * re, kx * re - ky * im]
    }));
    let residual = residual(map, &inside(&found, 0), &inside(&found, 1));
    Integrated { heights: HeightMap::new(width, height, map.wrap(), heights), residual }
}

/// f(i, j) for every i and j, row by row.
fn table([width, height]: [usize; 2], f: impl Fn(usize, usize) -> Complex) -> Vec<Complex> {
    (0..height).flat_map(|j| (0..width).map(move |i| (i, j))).map(|(i, j)| f(i, j)).collect()
}

/// p + i q at texel (i, j) of the map, or of its mirror images beyond its far edges, where slopes turn.
fn mirrored_slope(map: &NormalMap, i: usize, j: usize) -> Complex {
    let fold = |i: usize, size: usize| if i < size { (i, 1.0) } else { (2 * size - 1 - i, -1.0) };
    let ((i, sign_x), (j, sign_y)) = (fold(i, map.width()), fold(j, map.height()));
    let [p, q] = map.slope(i, j);
    [sign_x * p, sign_y * q]
}

/// [k_x, k_y] of entry (m, n), radians a texel; 0 along an axis where the wave alternates.
fn frequency(size: [usize; 2], m: usize, n: usize) -> [f64; 2] {
    let along = |k: usize, size: usize| {
        let signed = if 2 * k > size { k as f64 - size as f64 } else { k as f64 };
        if 2 * k == size { 0.0 } else { TAU * signed / size as f64 }
    };
    [along(m, size[0]), along(n, size[1])]
}

/// F̂ at (m, n), from the transform with +i of p − i q, which is the conjugate of that of p + i q with
/// −i.
fn surface_wave(spectrum: &[Complex], size: [usize; 2], m: usize, n: usize) -> Complex {
    let [kx, ky] = frequency(size, m, n);
    let square = kx * kx + ky * ky;
    if square == 0.0 {
        return [0.0; 2];
    }
    let here = conjugate(spectrum[n * size[0] + m]);
    let [i, j] = [(size[0] - m) % size[0], (size[1] - n) % size[1]];
    let opposite = spectrum[j * size[0] + i];
    // p̂ is half their sum, i q̂ half their difference.
    let p = [0.5 * (here[0] + opposite[0]), 0.5 * (here[1] + opposite[1])];
    let iq = [0.5 * (here[0] - opposite[0]), 0.5 * (here[1] - opposite[1])];
    // −i k_x p̂ − k_y (i q̂).
    [(kx * p[1] - ky * iq[0]) / square, (-kx * p[0] - ky * iq[1]) / square]
}

/// Compares a map's slopes with those found.
fn residual(map: &NormalMap, p: &[f64], q: &[f64]) -> Residual {
    let (mut angles, mut differences, mut squares) = (0.0, 0.0, 0.0);
    for (at, (&x, &y)) in p.iter().zip(q).enumerate() {
        let [u, v] = map.slope(at % map.width(), at / map.width());
        let (given, found) = (Vec3::new(-u, -v, 1.0), Vec3::new(-x, -y, 1.0));
        let angle = atan2_64(given.cross(&found).norm(), given.dot(&found));
        angles += angle * angle;
        differences += (u - x) * (u - x) + (v - y) * (v - y);
        squares += u * u + v * v;
    }
    let count = p.len() as f64;
    Residual {
        angle: (angles / count).sqrt().to_degrees(),
        slope: (differences / count).sqrt(),
        share: if squares > 0.0 { (differences / squares).min(1.0) } else { 0.0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A surface of waves that a map of this size holds, with its exact slopes.
    fn waves(width: usize, height: usize) -> (Vec<f64>, NormalMap) {
        let terms = [(1.0, 2.0, 0.8, 0.3), (-2.0, 1.0, 0.5, 1.0), (0.0, 1.0, 0.7, 2.0)];
        let at = |u: f64, v: f64| {
            let mut sum = [0.0; 3];
            for (m, n, a, phase) in terms {
                let angle = TAU * (m * u + n * v) + phase;
                sum[0] += a * angle.cos();
                sum[1] -= a * TAU * m / width as f64 * angle.sin();
                sum[2] -= a * TAU * n / height as f64 * angle.sin();
            }
            sum
        };
        let heights = HeightMap::from_fn(width, height, Wrap::Repeat, |u, v| at(u, v)[0]);
        let slopes = |u, v| {
            let [_, p, q] = at(u, v);
            [-p, -q, 1.0, 1.0]
        };
        (heights.values().to_vec(), NormalMap::from_fn(width, height, Wrap::Repeat, slopes))
    }

    #[test]
    fn a_surface_comes_back_from_its_normals() {
        // Odd, even, prime sides; normals are in single precision.
        for (width, height) in [(15, 9), (16, 8), (71, 16), (7, 127)] {
            let (heights, map) = waves(width, height);
            let Integrated { heights: found, residual } = integrate(&map);
            for (got, want) in found.values().iter().zip(&heights) {
                assert!((got - want).abs() < 1e-5, "{width}×{height}: {got} {want}");
            }
            assert!(residual.share < 1e-10 && residual.angle < 1e-3, "{residual:?}");
        }
    }

    #[test]
    fn a_slope_between_clamped_edges_stays_a_slope() {
        let ramp = HeightMap::from_fn(32, 5, Wrap::Clamp, |u, _| 0.4 * 32.0 * u);
        let Integrated { heights, residual } = integrate(&NormalMap::from_heights(&ramp, 1.0));
        assert!(residual.share < 1e-10, "{residual:?}");
        for (i, want) in (0..32).map(|i| 0.4 * (f64::from(i) - 15.5)).enumerate() {
            // The mirrored ramp's peaks are rounded by what waves can hold.
            assert!((heights.at(i as isize, 2) - want).abs() < 0.1, "{i}");
        }
    }

    #[test]
    fn a_whirl_is_no_surface() {
        // Slopes (−∂G/∂y, ∂G/∂x) have no part in common with any surface's.
        let (_, map) = waves(24, 24);
        let turned = map.texels().iter().map(|&[x, y, z, w]| [-y, x, z, w]).collect();
        let whirl = integrate(&NormalMap::new(24, 24, Wrap::Repeat, turned));
        assert!(whirl.residual.share > 1.0 - 1e-6, "{:?}", whirl.residual);
        assert!(whirl.heights.values().iter().all(|h| h.abs() < 1e-5));
        assert!(whirl.residual.to_string().contains("100.0 %"));
    }

    #[test]
    fn one_texel_and_flat_maps_are_flat() {
        for (width, height, wrap) in
            [(1, 1, Wrap::Repeat), (1, 1, Wrap::Clamp), (1, 6, Wrap::Repeat), (2, 2, Wrap::Clamp)]
        {
            let flat = NormalMap::from_fn(width, height, wrap, |_, _| [0.0, 0.0, 1.0, 1.0]);
            let found = integrate(&flat);
            assert_eq!(found.residual, Residual { angle: 0.0, slope: 0.0, share: 0.0 });
            assert!(found.heights.values().iter().all(|h| *h == 0.0));
        }
        // Leaning all over: as a surface that repeats, it is flat.
        let leaning = NormalMap::from_fn(4, 4, Wrap::Repeat, |_, _| [0.6, 0.0, 0.8, 1.0]);
        let found = integrate(&leaning);
        assert!((found.residual.share - 1.0).abs() < 1e-12);
        assert!(found.heights.values().iter().all(|h| h.abs() < 1e-12));
    }
}
