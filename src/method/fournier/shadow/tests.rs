use std::sync::Arc;

use super::*;
use crate::fit::{Directions, Peak};
use crate::geometry::{HemisphereGrid, Vec3};
use crate::lobe::BaseLobe;
use crate::lobe::vector::unit;
use crate::method::fournier::{Fournier, lookup, pyramid};
use crate::method::{BATCH, Method, Silent, shade_by_lobes};
use crate::texture::{HeightMap, NormalMap, Wrap};

const EXPONENT: f64 = 20.0;

/// Heights with their normals, all different.
fn hills(side: usize) -> Arc<NormalMap> {
    let height = |u: f64, v: f64| 2.0 * (6.3 * u + 0.3).sin() + 1.5 * (12.6 * v - 3.0 * u).cos();
    let heights = HeightMap::from_fn(side, side, Wrap::Repeat, height);
    Arc::new(NormalMap::from_heights(&heights, 1.0).with_heights(Arc::new(heights)))
}

fn built(map: &Arc<NormalMap>, texels: HorizonMap) -> ShadowedPeakMap {
    let method = Fournier::default();
    let levels = pyramid::build(&method, map, EXPONENT, &Silent).unwrap();
    let stored = levels.iter().map(lookup::StoredLevel::new).collect();
    let peaks = PeakMap::new(Arc::clone(map), method, EXPONENT, stored);
    let grid = HemisphereGrid::fournier();
    let collector = Collector {
        map,
        texels,
        exponent: EXPONENT,
        directions: Directions::new(grid.clone()),
        grid,
        max_peaks: method.greedy.max_peaks,
        cancelled: &|| false,
    };
    shadowed(peaks, collector, false).unwrap()
}

/// A batch of many footprints, lights and eyes.
fn batch(map: &NormalMap) -> Batch {
    let mut batch = Batch { len: BATCH, ..Batch::default() };
    for i in 0..BATCH {
        let t = i as f32;
        (batch.u[i], batch.v[i]) = ((0.37 * t).fract(), (0.61 * t).fract());
        let side = (0.05 * t - 1.0).exp2() / map.width() as f32;
        (batch.jacobian[0][i], batch.jacobian[3][i]) = (side, side);
        let light = unit([(1.3 * t).sin(), (0.7 * t).cos(), 0.2 + (0.1 * t).fract()]);
        let view = unit([(0.9 * t).cos(), (1.7 * t).sin(), 0.3 + (0.23 * t).fract()]);
        for c in 0..3 {
            (batch.light[c][i], batch.view[c][i]) = (light[c], view[c]);
            batch.half[c][i] = light[c] + view[c];
        }
        batch.irradiance[i] = 1.5;
    }
    batch
}

fn shade(map: &Arc<NormalMap>, shadowing: Shadowing, batch: &Batch, shading: Shading) -> [Lane; 2] {
    let method = Fournier { shadowing, ..Fournier::default() };
    let base = BaseLobe::BlinnPhong { exponent: EXPONENT };
    let filtered = method.prefilter(map, &base, &Silent).unwrap();
    assert_eq!(filtered.needs_directions(), shadowing != Shadowing::None);
    let mut both = [[f32::NAN; BATCH]; 2];
    filtered.shade(batch, shading, &mut both[0]);
    shade_by_lobes(filtered.as_ref(), batch, shading, &mut both[1]);
    both
}

#[test]
fn flat_ground_is_neither_masked_nor_in_shadow() {
    let flat = NormalMap::from_fn(8, 8, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]);
    let flat = Arc::new(flat);
    let batch = batch(&flat);
    for shading in [Shading::Ndf, Shading::Microfacet] {
        let plain = shade(&flat, Shadowing::None, &batch, shading);
        assert_eq!(shade(&flat, Shadowing::Printed, &batch, shading), plain);
        for (got, want) in shade(&flat, Shadowing::Ratioed, &batch, shading)[0].iter().zip(plain[0])
        {
            assert!((got - want).abs() <= 1e-6 * want, "{got} {want}");
        }
    }
}

#[test]
fn shadowed_kernels_are_the_lobes() {
    let map = hills(16);
    let batch = batch(&map);
    for shadowing in [Shadowing::Printed, Shadowing::Ratioed] {
        for shading in [Shading::Ndf, Shading::Microfacet] {
            let [kernel, lobes] = shade(&map, shadowing, &batch, shading);
            for (a, b) in kernel.iter().zip(lobes) {
                assert!((a - b).abs() <= 1e-5 * b + 1e-7, "{a} {b}");
            }
        }
    }
}

#[test]
fn shadows_take_light_away_and_ratios_give_some_back() {
    let map = hills(16);
    let batch = batch(&map);
    let of = |shadowing| shade(&map, shadowing, &batch, Shading::Ndf)[0];
    let (plain, printed) = (of(Shadowing::None), of(Shadowing::Printed));
    let ratioed = of(Shadowing::Ratioed);
    for i in 0..BATCH {
        assert!(printed[i] <= plain[i] * (1.0 + 1e-6), "lane {i}");
        assert!(printed[i] <= ratioed[i] * (1.0 + 1e-6), "lane {i}");
        assert!(ratioed[i].is_finite());
    }
    let sum = |lane: Lane| lane.iter().sum::<f32>();
    assert!(sum(printed) < 0.95 * sum(plain));
}

#[test]
fn a_kept_normal_has_the_mean_and_deviation_of_its_texels() {
    // Two normals, left and right; the heights, and so the horizons, differ from texel to texel.
    let texel = |u: f64, _| [if u < 0.5 { 0.3 } else { -0.3 }, 0.0, 1.0, 1.0 + u];
    let map = Arc::new(NormalMap::from_fn(4, 2, Wrap::Repeat, texel));
    let heights = HeightMap::from_fn(4, 2, Wrap::Repeat, |u, v| 5.0 * u * u + v + 3.0 * u * v);
    let texels = HorizonMap::of(&heights);
    let shadowed = built(&map, texels.clone());
    let peaks = shadowed.peaks.levels.last().unwrap().cell(0, 0);
    assert_eq!(peaks.len(), 2);
    for (peak, horizon) in peaks.iter().zip(shadowed.levels.last().unwrap()) {
        for side in 0..4 {
            let (mut weights, mut sum, mut squares) = (0.0, 0.0, 0.0);
            for (k, slopes) in texels.slopes().iter().enumerate() {
                let [x, _, _, weight] = map.texel(k % 4, k / 4);
                if x.signum() == peak.direction[0].signum() {
                    weights += weight;
                    sum += weight * slopes[side];
                    squares += weight * slopes[side] * slopes[side];
                }
            }
            let mean = sum / weights;
            let deviation = (squares / weights - mean * mean).max(0.0).sqrt();
            assert!((horizon.mean[side] - mean).abs() < 1e-5, "{mean}");
            assert!((horizon.deviation[side] - deviation).abs() < 2e-3, "{deviation}");
        }
    }
}

#[test]
fn a_fitted_peak_collects_by_the_law_of_total_variance() {
    let map = hills(8);
    let texels = HorizonMap::of(map.heights().unwrap());
    let shadowed = built(&map, texels.clone());
    let grid = HemisphereGrid::fournier();
    let peaks = shadowed.peaks.levels.last().unwrap().cell(0, 0);
    let normals: Vec<Peak> = map
        .texels()
        .iter()
        .map(|&[x, y, z, w]| Peak {
            amplitude: w.into(),
            direction: Vec3::from([x, y, z].map(f64::from)).normalize(),
            exponent: EXPONENT,
        })
        .collect();
    for (peak, horizon) in peaks.iter().zip(shadowed.levels.last().unwrap()) {
        let shape = Peak {
            amplitude: 1.0,
            direction: Vec3::from(peak.direction.map(f64::from)),
            exponent: peak.exponent.into(),
        };
        for side in 0..4 {
            // At each direction a mean and a variance; over the directions the mean of means, and the
            // mean of variances plus the variance of means.
            let (mut total, mut means, mut variances, mut squares) = (0.0, 0.0, 0.0, 0.0);
            for sample in grid.samples() {
                let each =
                    || normals.iter().map(|n| n.value(sample.direction)).zip(texels.slopes());
                let n: f64 = each().map(|(w, _)| w).sum();
                let mean = each().map(|(w, s)| w * f64::from(s[side])).sum::<f64>() / n;
                let off = |s: &[f32; 4]| f64::from(s[side]) - mean;
                let variance = each().map(|(w, s)| w * off(s) * off(s)).sum::<f64>() / n;
                let weight = sample.solid_angle * n * shape.value(sample.direction);
                if weight > 0.0 {
                    total += weight;
                    means += weight * mean;
                    variances += weight * variance;
                    squares += weight * mean * mean;
                }
            }
            let mean = means / total;
            let deviation = (variances / total + squares / total - mean * mean).sqrt();
            assert!((f64::from(horizon.mean[side]) - mean).abs() < 1e-5 * (1.0 + mean));
            assert!((f64::from(horizon.deviation[side]) - deviation).abs() < 1e-5 * (1.0 + mean));
            assert!(deviation > 0.0);
        }
    }
}

#[test]
fn equal_horizons_stay_what_they_are() {
    // A tilted lattice of equal steps: every texel sees the same.
    let map = hills(8);
    let flat = HeightMap::from_fn(8, 8, Wrap::Repeat, |_, _| 3.0);
    let shadowed = built(&map, HorizonMap::of(&flat));
    for horizon in shadowed.levels.iter().flatten() {
        assert_eq!(*horizon, Horizon::default());
    }
}
