//! The formulas: moments, normalisation, storage, fits of the base lobe.

use super::integral::moment;
use super::*;
use crate::geometry::HemisphereGrid;
use crate::lobe::{Cut, RestrictedLobe, Spread};
use crate::method::Silent;
use crate::method::one_lobe::OneLobe;
use crate::parameter::Value;
use crate::texture::{Footprint, Moments, Pyramid, Wrap};

fn nine(variance: f64, storage: Storage) -> NineNumbers {
    let flat = NormalMap::from_fn(1, 1, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]);
    NineNumbers::new(variance, storage, &flat)
}

#[test]
fn moments_of_a_mixture_add_linearly() {
    // E₂ of the top level is the mean of uᵀu + vI over all texels (Olano and North 1997 §5).
    let map = NormalMap::from_fn(8, 8, Wrap::Repeat, |u, v| {
        [libm::sin(7.0 * u), 0.5 * libm::sin(9.0 * v), 1.0, 1.0]
    });
    let pyramid = Pyramid::build(&map, Projected { nine: nine(0.01, Storage::Float) });
    let cell = pyramid.cells(&map, 3)[0];
    let mean_of = |f: &dyn Fn(&crate::texture::Texel) -> f32| {
        map.texels().iter().map(|t| f64::from(f(t))).sum::<f64>() / 64.0
    };
    let top = pyramid.moments().nine.gaussian(cell);
    assert!((top.weight - 1.0).abs() < 1e-6);
    for (c, axis) in top.cut.axis.into_iter().enumerate() {
        let mean = f64::from(top.cut.length * axis);
        assert!((mean - mean_of(&|t| t[c])).abs() < 1e-6);
    }
    // S along n, by the texels.
    let n = top.cut.axis.map(f64::from);
    let along = mean_of(&|t| {
        let dot: f64 = (0..3).map(|c| n[c] * f64::from(t[c])).sum();
        (dot * dot) as f32
    });
    let want = along + 0.01 - f64::from(top.cut.length).powi(2);
    assert!((f64::from(top.cut.radial) - want).abs() < 1e-6);
}

#[test]
fn a_single_normal_projects_to_beckmann() {
    let base = BaseLobe::Beckmann { alpha: 0.3 };
    let projected = Projected { nine: nine(base.spread(), Storage::Float) };
    let lobe = projected.lobe(projected.encode([0.6, 0.0, 0.8, 2.0]));
    let spread = lobe.spread();
    assert!((spread[0] - 0.045).abs() < 1e-6 && spread[1].abs() < 1e-6, "{spread:?}");
}

/// Cuts from narrow to as wide as the sphere, round and long, with and without a lean.
fn cuts() -> Vec<Cut> {
    let axis = [0.0, 0.0, 1.0];
    let of = |length, radial, lean, across| Cut { axis, length, radial, lean, across };
    vec![
        of(1.0, 0.01, [0.0; 2], [0.01, 0.0, 0.01]),
        of(1.0, 0.5, [0.0; 2], [0.5, 0.0, 0.5]),
        of(0.9, 0.02, [0.1, 0.3], [0.1, 0.03, 0.04]),
        of(0.77, 0.02, [0.0; 2], [0.4, 0.0, 0.02]),
        of(0.5, 0.3, [0.4, -0.2], [0.3, -0.1, 0.2]),
        of(0.6, 0.05, [0.0, 0.5], [0.3, 0.0, 0.05]),
    ]
}

#[test]
fn the_moment_over_the_sphere_is_that_of_a_fine_grid() {
    let grid = HemisphereGrid::new(500, 1000);
    for generator in [Generator::Gaussian, Generator::Pearson { m: 8 }, Generator::Pearson { m: 1 }]
    {
        for cut in cuts() {
            let lobe = RestrictedLobe::new(cut, 1.0, generator);
            let want = grid.integrate(|d| {
                let h = [d.x, d.y, d.z].map(|c| c as f32);
                f64::from(lobe.density(h) - lobe.density(h.map(|c| -c))) * d.z
            });
            let off = (moment(&cut, generator) / want - 1.0).abs();
            // The density of m = 1 has a kink where it ends, which costs either rule.
            let allowed = if generator == (Generator::Pearson { m: 1 }) { 2e-3 } else { 2e-4 };
            assert!(off < allowed, "{generator:?} {cut:?}: {off}");
        }
    }
}

#[test]
fn a_round_gaussian_has_the_closed_form() {
    // von Mises-Fisher with κ = 1/v: ∫ e^(κ(cos − 1)) cos dω = 2π/κ (1 + e^(−2κ) − (1 − e^(−2κ))/κ).
    for v in [1e-4f64, 0.01, 0.3, 2.0] {
        let s = v as f32;
        let cut = Cut {
            axis: [0.0, 0.0, 1.0],
            length: 1.0,
            radial: s,
            lean: [0.0; 2],
            across: [s, 0.0, s],
        };
        let (kappa, back) = (1.0 / f64::from(s), (-2.0 / f64::from(s)).exp());
        let want = std::f64::consts::TAU / kappa * (1.0 + back - (1.0 - back) / kappa);
        let off = moment(&cut, Generator::Gaussian) / want - 1.0;
        assert!(off.abs() < 1e-5, "{v}: {off}");
    }
}

#[test]
fn eight_bits_leave_most_single_normals_without_a_covariance_and_sixteen_none() {
    // Base exponent 200; normals all over the hemisphere down to 60°.
    let broken = |storage| {
        let nine = nine(1.0 / 200.0, storage);
        let normals = HemisphereGrid::new(60, 60);
        let high = normals.samples().iter().map(|s| s.direction).filter(|d| d.z > 0.5);
        let all: Vec<bool> = high
            .map(|d| {
                let m = nine
                    .round(nine.encode([d.x as f32, d.y as f32, d.z as f32, 1.0]))
                    .map(f64::from);
                let s = nalgebra::Matrix3::new(
                    m[3] - m[0] * m[0],
                    m[4] - m[0] * m[1],
                    m[5] - m[0] * m[2],
                    m[4] - m[0] * m[1],
                    m[6] - m[1] * m[1],
                    m[7] - m[1] * m[2],
                    m[5] - m[0] * m[2],
                    m[7] - m[1] * m[2],
                    m[8] - m[2] * m[2],
                );
                s.symmetric_eigenvalues().min() <= 0.0
            })
            .collect();
        all.iter().filter(|b| **b).count() as f64 / all.len() as f64
    };
    assert_eq!(broken(Storage::Bits(16)), 0.0);
    let share = broken(Storage::Bits(8));
    assert!(share > 0.5, "{share}");
    println!("{share}");
}

#[test]
fn what_is_read_is_a_covariance_whatever_was_written() {
    let nine = nine(0.005, Storage::Bits(8));
    let mut state = 1u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    for _ in 0..2000 {
        let mut moments = [0.0; 9].map(|_: f32| next());
        for square in [3, 6, 8] {
            moments[square] = moments[square].abs();
        }
        let cut = nine.gaussian(nine.round(moments)).cut;
        let [a, b, c] = cut.across;
        assert!(cut.radial > 0.0 && a > 0.0 && a * c - b * b > 0.0, "{cut:?}");
    }
}

fn options(entry: &Entry, set: &[(&'static str, Value)]) -> Box<dyn Method> {
    (entry.build)(&Values::defaults(entry.parameters).with(set))
}

#[test]
fn a_fitted_variance_is_nearer_than_a_matched_one_and_no_other_is_nearer() {
    let matched = [("variance", Value::Word("matched"))];
    for entry in entries() {
        for base in [BaseLobe::BlinnPhong { exponent: 30.0 }, BaseLobe::Beckmann { alpha: 0.25 }] {
            let (fitted, plain) = (options(&entry, &[]), options(&entry, &matched));
            let (fitted, plain) =
                (fitted.base_error(&base).unwrap(), plain.base_error(&base).unwrap());
            assert!(fitted <= plain, "{}: {fitted} {plain}", entry.card.name);
        }
    }
    let base = BaseLobe::BlinnPhong { exponent: 30.0 };
    for family in [Family::Projected, Family::Restricted(Generator::Pearson { m: 8 })] {
        let best = family.fitted(&base);
        for part in [0.5, 0.9, 0.98, 1.02, 1.1, 2.0] {
            assert!(family.distance(&base, part * best.variance) > best.error - 2e-4, "{part}");
        }
    }
    // Equal variances of Gaussian and Phong lobes: 0.020 apart at exponent 30, as independently found.
    let same = Family::Projected.matched(&base).error;
    assert!((same - 0.020).abs() < 1e-3, "{same}");
}

#[test]
fn ggx_is_taken_fitted_and_refused_matched() {
    let ggx = BaseLobe::Ggx { alpha: 0.2 };
    for entry in entries() {
        let error = options(&entry, &[]).base_error(&ggx).unwrap();
        assert!(0.1 < error && error < 0.4, "{}: {error}", entry.card.name);
        assert!(options(&entry, &[("variance", Value::Word("matched"))]).base_error(&ggx).is_err());
    }
}

#[test]
fn storage_is_as_large_as_it_says() {
    let map = Arc::new(NormalMap::from_fn(16, 16, Wrap::Repeat, |u, v| {
        [0.3 * libm::sin(20.0 * u), 0.2 * libm::cos(31.0 * v), 1.0, 1.0]
    }));
    let base = BaseLobe::BlinnPhong { exponent: 50.0 };
    let cells = 64 + 16 + 4 + 1;
    for (entry, floats) in entries().iter().zip([0, 1, 0]) {
        let built = ["float", "16-bit", "8-bit"].map(|word| {
            let method = options(entry, &[("storage", Value::Word(word))]);
            method.prefilter(&map, &base, &Silent).unwrap()
        });
        for (built, bytes) in built.iter().zip([4, 2, 1]) {
            assert_eq!(built.bytes(), cells * (9 * bytes + 4 * floats));
        }
        let at = Footprint::whole();
        let [exact, fine, coarse] =
            built.each_ref().map(|b| f64::from(b.lobes_at(&at).density([0.1, 0.05, 1.0])));
        let (fine, coarse) = ((fine / exact - 1.0).abs(), (coarse / exact - 1.0).abs());
        assert!(
            fine < 2e-3 && coarse < 0.2 && fine < coarse,
            "{} {fine} {coarse}",
            entry.card.name
        );
    }
}
