//! The formulas: covariances, factors, lobes, storage.

use proptest::prelude::*;

use super::roughness::{carried, covariance, factor, widest};
use super::*;
use crate::lobe::Spread;
use crate::method::one_lobe::OneLobe;
use crate::method::{Entry, Silent};
use crate::parameter::Value;
use crate::texture::{Footprint, Pyramid, Wrap};

fn printed(base: BaseLobe, anisotropic: bool, reading: Reading) -> Printed {
    let BaseLobe::BlinnPhong { exponent } = base else { panic!("{base} has no exponent") };
    Printed { shape: Shape::power(&base, exponent), reading, anisotropic, codes: None }
}

#[test]
fn the_recursive_rule_is_the_covariance_of_the_whole_cell() {
    // Schilling 1997: "equivalent to the calculation of the covariance matrix for all fu and fv
    // values in the highest resolution level". The rule, in double precision, level by level.
    let slope = |i: usize, k: f64| libm::sin(i as f64 * k) * 0.7;
    let slopes: Vec<[f64; 2]> = (0..64).map(|i| [slope(i, 1.7), slope(i, 2.9)]).collect();
    let mut cells: Vec<([f64; 2], [f64; 3])> = slopes.iter().map(|&b| (b, [0.0; 3])).collect();
    while cells.len() > 1 {
        cells = cells
            .chunks(4)
            .map(|four| {
                let mean = [0, 1].map(|c| four.iter().map(|f| f.0[c]).sum::<f64>() / 4.0);
                let mut k = [0.0; 3];
                for (b, below) in four {
                    let d = [b[0] - mean[0], b[1] - mean[1]];
                    for (c, outer) in [d[0] * d[0], d[0] * d[1], d[1] * d[1]].iter().enumerate() {
                        k[c] += (below[c] + outer) / 4.0;
                    }
                }
                (mean, k)
            })
            .collect();
    }
    let mean = [0, 1].map(|c| slopes.iter().map(|b| b[c]).sum::<f64>() / 64.0);
    let direct = |c: usize, d: usize| {
        slopes.iter().map(|b| (b[c] - mean[c]) * (b[d] - mean[d])).sum::<f64>() / 64.0
    };
    let (_, k) = cells[0];
    for (got, want) in k.iter().zip([direct(0, 0), direct(0, 1), direct(1, 1)]) {
        assert!((got - want).abs() < 5e-15);
    }
}

#[test]
fn the_pyramid_holds_that_covariance() {
    let base = BaseLobe::BlinnPhong { exponent: 50.0 };
    let map = NormalMap::from_fn(8, 8, Wrap::Repeat, |u, v| {
        [0.5 * libm::sin(9.0 * u + v), 0.4 * libm::cos(7.0 * v), 1.0, 1.0]
    });
    let pyramid = Pyramid::build(&map, printed(base, true, Reading::Deviation));
    let slopes: Vec<[f64; 2]> =
        map.texels().iter().map(|t| [f64::from(t[0] / t[2]), f64::from(t[1] / t[2])]).collect();
    let mean = [0, 1].map(|c| slopes.iter().map(|b| b[c]).sum::<f64>() / 64.0);
    let direct = |c: usize, d: usize| {
        slopes.iter().map(|b| (b[c] - mean[c]) * (b[d] - mean[d])).sum::<f64>() / 64.0
    };
    let [_, _, _, d1, d2, d3] = pyramid.cells(&map, 3)[0];
    let k = covariance(d1, d2, d3);
    let want = [direct(0, 0) + 0.02, direct(0, 1), direct(1, 1) + 0.02];
    for c in 0..3 {
        assert!((f64::from(k[c]) - want[c]).abs() < 1e-6, "{k:?} {want:?}");
    }
}

proptest! {
    #[test]
    fn factoring_is_undone(a in 0.0f32..2.0, b in -1.0f32..1.0, c in 0.01f32..2.0) {
        prop_assume!(a * c > b * b + 1e-4);
        let [d1, d2, d3] = factor([a, b, c]);
        for (got, want) in covariance(d1, d2, d3).into_iter().zip([a, b, c]) {
            prop_assert!((got - want).abs() < 1e-5);
        }
    }

    #[test]
    fn carrying_makes_a_tilted_base_lobe_round(x in -2.0f32..2.0, y in -2.0f32..2.0) {
        let lift = 1.0 + x * x + y * y;
        let tilted = [lift * (1.0 + x * x), lift * x * y, lift * (1.0 + y * y)];
        let [a, b, c] = carried(tilted, x, y);
        prop_assert!((a - 1.0).abs() < 1e-4 && b.abs() < 1e-4 && (c - 1.0).abs() < 1e-4);
    }
}

#[test]
fn isotropic_widths_do_not_pool() {
    // Half of a cell rough along u alone, half along v alone: K is the mean of the two, and its
    // largest eigenvalue half of theirs. Bilinear lookups between them agree.
    let (along_u, along_v) = ([0.3, 0.0, 0.0], [0.0, 0.0, 0.3]);
    assert_eq!(widest(along_u), widest(along_v));
    assert_eq!(widest([0.15, 0.0, 0.15]), [0.15, 0.0, 0.15]);
    assert_eq!(widest(along_u)[0], 0.3);
}

#[test]
fn between_cells_the_normalised_form_has_the_mean_covariance() {
    // Slopes along one diagonal in the left cell, along the other in the right.
    let (a, b) = ([0.3, 0.1, 1.0, 1.0], [-0.3, -0.1, 1.0, 1.0]);
    let (c, d) = ([0.3, -0.1, 1.0, 1.0], [-0.3, 0.1, 1.0, 1.0]);
    let map = NormalMap::new(4, 2, Wrap::Clamp, vec![a, b, c, d, b, a, d, c]);
    let base = BaseLobe::Beckmann { alpha: 0.2 };
    let pyramid = Pyramid::build(&map, Normalised { base, anisotropic: true, codes: None });
    let [_, _, _, a, b, c] = pyramid.trilinear(&map, 0.5, 0.5, 1.0);
    assert!((a - 0.09).abs() < 1e-6 && b.abs() < 1e-6 && (c - 0.01).abs() < 1e-6, "{a} {b} {c}");
}

#[test]
fn a_flat_direction_factors() {
    assert_eq!(factor([0.25, 0.0, 0.0]), [0.5, 0.0, 0.0]);
    // A covariance that rounding left without positivity stays bounded.
    assert_eq!(factor([0.25, 1e-9, 0.0]), [0.0, 0.5, 0.0]);
}

#[test]
fn read_literally_it_is_widest_along_a_wrong_axis() {
    // K = (2.5 1.5; 1.5 2.5) − I/m and base I/m: widest along 45°, but |Dd|² is largest along 63.4°.
    let m = 100.0;
    let [d1, d2, d3] = factor([2.5 / m, 1.5 / m, 2.5 / m]);
    let widest_at = |reading| {
        let base = BaseLobe::BlinnPhong { exponent: f64::from(m) };
        let lobe = printed(base, true, reading).lobe([1.0, 0.0, 0.0, d1, d2, d3]);
        let at = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            lobe.density([0.1 * c as f32, 0.1 * s as f32, 1.0])
        };
        let tenths = (0..1800).map(|k| f64::from(k) / 10.0);
        tenths.fold(0.0, |best, a| if at(a) > at(best) { a } else { best })
    };
    assert!((widest_at(Reading::Deviation) - 45.0).abs() < 0.2);
    assert!((widest_at(Reading::Elliptical) - 45.0).abs() < 0.2);
    assert!((widest_at(Reading::Literal) - 63.4).abs() < 0.2, "{}", widest_at(Reading::Literal));
}

fn options(entry: &Entry, set: &[(&'static str, Value)]) -> Box<dyn Method> {
    (entry.build)(&Values::defaults(entry.parameters).with(set))
}

#[test]
fn with_a_constant_exponent_the_base_lobe_is_as_near_as_its_shape() {
    let entry = &entries()[2];
    let base = BaseLobe::BlinnPhong { exponent: 60.0 };
    let error =
        |m: f64| options(entry, &[("exponent", Value::Number(m))]).base_error(&base).unwrap();
    assert_eq!((error(0.0), error(60.0)), (0.0, 0.0));
    // Heavier tails are further away, and so, a little, is none at all: the Gaussian.
    assert!(error(4.0) > error(10.0) && error(10.0) > error(30.0) && error(30.0) > 0.0);
    let gaussian = options(entry, &[("fall", Value::Word("gaussian"))]);
    let near = gaussian.base_error(&base).unwrap();
    assert!(0.0 < near && near < error(10.0), "{near}");
    // A width is all that a constant exponent takes of the base lobe.
    let beckmann = BaseLobe::Beckmann { alpha: 0.2 };
    assert!(options(entry, &[]).base_error(&beckmann).is_err());
    assert!(gaussian.base_error(&beckmann).unwrap() < 0.05);
    assert!(gaussian.base_error(&BaseLobe::Ggx { alpha: 0.2 }).is_err());
}

#[test]
fn shapes_of_any_exponent_have_unit_energy_and_the_curvature_of_their_variance() {
    let base = BaseLobe::BlinnPhong { exponent: 50.0 };
    for shape in [3.0, 10.0, 50.0, 1000.0]
        .map(|m| Shape::power(&base, m))
        .into_iter()
        .chain([Shape::gaussian(&base)])
    {
        assert!((nearness::energy(|x| shape.density(x)) - 1.0).abs() < 1e-4);
        let (peak, near) = (shape.density(0.0), shape.density(1e-6));
        // ln D falls by |x|²/2v: 1 − cos α = 10⁻⁶ is |x|² = 2·10⁻⁶.
        assert!(((peak / near).ln() / (1e-6 * 50.0) - 1.0).abs() < 1e-3);
    }
}

/// Slopes of about 0.3 with a correlation, beside a flat texel.
fn bumps() -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(16, 16, Wrap::Repeat, |u, v| {
        let x = 0.4 * libm::sin(40.0 * u + 7.0 * v);
        [x, 0.5 * x + 0.2 * libm::cos(31.0 * v), 1.0, 1.0]
    }))
}

#[test]
fn storage_is_as_large_as_it_says_and_as_exact_as_its_bits() {
    let (map, base) = (bumps(), BaseLobe::BlinnPhong { exponent: 50.0 });
    let cells = 64 + 16 + 4 + 1;
    for (entry, numbers) in entries().iter().zip([4, 6, 4, 6]) {
        let built = ["float", "16-bit", "8-bit"].map(|word| {
            let method = options(entry, &[("storage", Value::Word(word))]);
            method.prefilter(&map, &base, &Silent).unwrap()
        });
        let normalised = entry.card.normalised;
        let float = if normalised { 6 * 4 } else { numbers * 4 };
        let bytes = [float, numbers * 2, numbers].map(|b| b * cells);
        assert_eq!([0, 1, 2].map(|k| built[k].bytes()), bytes, "{}", entry.card.name);
        let at = Footprint::whole();
        let [exact, fine, coarse] =
            built.each_ref().map(|b| f64::from(b.lobes_at(&at).density([0.1, 0.05, 1.0])));
        let (fine, coarse) = ((fine / exact - 1.0).abs(), (coarse / exact - 1.0).abs());
        assert!(
            fine < 2e-4 && coarse < 0.03 && coarse > fine,
            "{} {fine} {coarse}",
            entry.card.name
        );
    }
}
