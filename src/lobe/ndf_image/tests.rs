use super::*;
use crate::lobe::vector::unit;

const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 20.0 };

fn of_base(side: usize) -> NdfImage {
    NdfImage::of_surface(&[BASE.about([0.0, 0.0, 1.0], 1.0)].into_iter().collect(), side).unwrap()
}

#[test]
fn a_base_lobe_is_kept() {
    let image = of_base(128);
    let sum: f64 = image.values().iter().map(|d| f64::from(*d)).sum();
    assert!((sum * 4.0 / (128.0 * 128.0) - 1.0).abs() < 1e-6);
    for [x, y] in [[0.0f32, 0.0], [0.2, 0.1], [-0.4, 0.3], [0.0, -0.7]] {
        let t = f64::from((x * x + y * y) / (1.0 - x * x - y * y));
        let (want, got) = (BASE.density(t), f64::from(image.at(x, y)));
        assert!((got - want).abs() < 3e-3 * BASE.density(0.0), "{x} {y}: {got} {want}");
    }
    let [xx, xy, yy] = image.slope_covariance();
    // Holding slopes to 4 hides next to nothing at exponent 20: variance 1/20.
    assert!((xx - 0.05).abs() < 1e-3 && (yy - xx).abs() < 1e-5 && xy.abs() < 1e-6);
    assert!((image.mean_normal()[2] - 22.0 / 23.0).abs() < 1e-3);
}

#[test]
fn normals_spread_by_the_base_lobe_are_their_mixture() {
    let texels: Vec<[f32; 4]> = [[0.3, 0.0, 1.0], [-0.3, 0.1, 1.0], [0.0, -0.4, 1.0]]
        .into_iter()
        .map(|n| {
            let [x, y, z] = unit(n);
            [x, y, z, 1.0]
        })
        .collect();
    let lobe = |n: &[f32; 4]| BASE.about([n[0], n[1], n[2]], 1.0 / 3.0);
    let want = NdfImage::of_surface(&texels.iter().map(lobe).collect(), 128).unwrap();
    let got = NdfImage::of_normals(&texels, Some(&BASE), 128).unwrap();
    let apart: f32 = want.values().iter().zip(got.values()).map(|(a, b)| (a - b).abs()).sum();
    assert!(apart * 4.0 / (128.0 * 128.0) < 0.01, "{apart}");
    let counted = NdfImage::of_normals(&texels, None, 128).unwrap();
    let mean = counted.mean_normal();
    for c in 0..2 {
        let want: f32 = texels.iter().map(|t| t[c]).sum::<f32>() / 3.0;
        assert!((mean[c] - f64::from(want)).abs() < 1e-5);
    }
}

#[test]
fn what_is_no_distribution_is_refused_with_its_place() {
    let good = vec![1.0; 16 * 16];
    let read = |values: &[f32]| NdfImage::of_image((16, 16), values, Measure::Map);
    assert!(matches!(read(&good), Err(NdfError::Outside { x: 0, y: 0, .. })));
    let round: Vec<f32> =
        (0..256).map(|k| if off_disc(centre(16, k)) { 0.0 } else { 1.0 }).collect();
    let even = read(&round).unwrap();
    assert!((even.at(0.3, 0.2) - even.at(-0.5, 0.0)).abs() < 1e-6);
    assert_eq!(read(&[0.0; 256]), Err(NdfError::Empty));
    let mut bad = round.clone();
    bad[17] = -1.0;
    assert_eq!(read(&bad), Err(NdfError::Value { x: 1, y: 1, value: -1.0 }));
    bad[17] = f32::NAN;
    assert!(matches!(read(&bad), Err(NdfError::Value { x: 1, y: 1, .. })));
    let wide = NdfImage::of_image((16, 8), &[1.0; 128], Measure::Map);
    assert!(matches!(wide, Err(NdfError::Size { width: 16, height: 8, .. })));
    assert!(NdfImage::of_normals(&[[0.0, 0.0, 1.0, 0.0]], None, 64).is_err());
}

#[test]
fn solid_angle_and_map_differ_by_the_cosine() {
    let side = 64;
    let even: Vec<f32> =
        (0..side * side).map(|k| if off_disc(centre(side, k)) { 0.0 } else { 1.0 }).collect();
    let per_angle = NdfImage::of_image((side, side), &even, Measure::SolidAngle).unwrap();
    // Even over the hemisphere, D is 1/(2π cosθ).
    for x in [0.0f32, 0.3, 0.6] {
        let want = 1.0 / (std::f32::consts::TAU * (1.0 - x * x).sqrt());
        assert!((per_angle.at(x, 0.0) / want - 1.0).abs() < 0.03, "{x}");
    }
}

#[test]
fn a_floor_leaves_no_normal_without_density() {
    let narrow = NdfImage::from_fn(64, |[x, y]| if x * x + y * y < 0.01 { 1.0 } else { 0.0 });
    let floored = narrow.unwrap().with_floor(0.05);
    assert!(floored.at(0.7, 0.5) > 0.0);
    let sum: f64 = floored.values().iter().map(|d| f64::from(*d)).sum();
    assert!((sum * 4.0 / (64.0 * 64.0) - 1.0).abs() < 1e-5);
}

#[test]
fn a_mixture_holds_shares_of_normals_whatever_the_sums_of_shares() {
    let half = |sign: f32| NdfImage::from_fn(64, move |[x, _]| f32::from(sign * x > 0.0)).unwrap();
    let mixed = NdfImage::mixed(&[(3.0, &half(1.0)), (1.0, &half(-1.0))]).unwrap();
    assert!((mixed.at(0.5, 0.0) / mixed.at(-0.5, 0.0) - 3.0).abs() < 1e-5);
    assert!((mixed.mean_normal()[0] - 0.5 * half(1.0).mean_normal()[0]).abs() < 1e-6);
    assert_eq!(NdfImage::mixed(&[(0.0, &half(1.0))]), Err(NdfError::Empty));
}
