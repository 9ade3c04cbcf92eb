//! The intervals against many noisy references.

use super::*;
use crate::geometry::elementary::{exp64, ln64};
use crate::metric::{entries, find};
use crate::render::{PixelSampler, stream};

const SIDE: usize = 48;
const DRAWS: usize = 300;

fn film(f: impl Fn(f64, f64) -> f64) -> Film {
    let pixel = |i: usize| f((i % SIDE) as f64, (i / SIDE) as f64) as f32;
    Film::new(SIDE, SIDE, (0..SIDE * SIDE).map(pixel).collect())
}

/// A standard normal number by Box and Muller, from the sampler's uniform ones.
fn normal(sampler: &PixelSampler, draw: usize, pixel: usize) -> f64 {
    let [u, v] = sampler.positions(stream(11, draw as u32, pixel))[0];
    (-2.0 * ln64(u)).sqrt() * f64::cos(std::f64::consts::TAU * v)
}

/// The truth, an image of it, and the variance of references: all uneven.
fn scene() -> (Film, Film, Vec<f64>) {
    let truth = film(|x, y| 0.6 + 0.4 * f64::sin(0.4 * x) * f64::cos(0.3 * y + 0.1 * x));
    let test = film(|x, y| 0.62 + 0.3 * f64::sin(0.4 * x + 0.1) * f64::cos(0.3 * y + 0.1 * x));
    let variance = film(|x, y| 2e-4 * exp64(-0.05 * x) + 1e-4 * (y / SIDE as f64));
    (truth, test, variance.pixels().iter().map(|v| f64::from(*v)).collect())
}

fn noisy(truth: &Film, variance: &[f64], draw: usize) -> Film {
    let sampler = PixelSampler::new(2);
    let pixels = truth.pixels().iter().zip(variance).enumerate();
    let pixels = pixels
        .map(|(i, (r, v))| (f64::from(*r) + v.sqrt() * normal(&sampler, draw, i)) as f32)
        .collect();
    Film::new(SIDE, SIDE, pixels)
}

/// Mean and standard deviation.
fn moments(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let scatter = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (count - 1.0);
    (mean, scatter.sqrt())
}

/// What noisy references make of a score, and what is told of it.
struct Found {
    /// The mean score, less the mean bias and the exact score.
    off: f64,
    bias: f64,
    scatter: f64,
    /// The root mean square of the standard errors.
    told: f64,
}

fn found(name: &str, draws: usize) -> Found {
    let (truth, test, variance) = scene();
    let metric = find(name).unwrap();
    let exact = metric.value(std::slice::from_ref(&test), std::slice::from_ref(&truth)).unwrap();
    let of = |draw| metric.uncertain(&test, &noisy(&truth, &variance, draw), &variance).unwrap();
    let scores: Vec<Uncertain> = (0..draws).map(of).collect();
    let all = |f: fn(&Uncertain) -> f64| -> Vec<f64> { scores.iter().map(f).collect() };
    let (mean, scatter) = moments(&all(|u| u.value));
    let (bias, _) = moments(&all(|u| u.bias));
    let told = (all(|u| u.error * u.error).iter().sum::<f64>() / draws as f64).sqrt();
    let off = (mean - bias - exact).abs();
    println!("{name}: bias {bias:.2e} off {off:.1e} scatter {scatter:.3e} told {told:.3e}");
    Found { off, bias, scatter, told }
}

/// 300 noisy references (seed 11). The mean score is off by the mean bias within 4 standard errors of the mean (a false
/// alarm in 16 000) and a tenth of the bias, and scores scatter as their errors say within 16 %: 4 standard deviations of
/// a standard deviation of 300 numbers. (The peak of PSNR and the threshold of highlights are drawn from the noisy
/// reference, which is not told.)
#[test]
fn scores_scatter_and_are_off_as_told() {
    for name in ["rmse", "mse", "mae", "relmse", "mape", "smape", "psnr:unit", "energy"] {
        let Found { off, bias, scatter, told } = found(name, DRAWS);
        let allowed = 4.0 * scatter / (DRAWS as f64).sqrt() + 0.1 * bias.abs();
        assert!(off < allowed, "{name}: {off} of {bias}");
        assert!((told / scatter - 1.0).abs() < 0.16, "{name}: {told} against {scatter}");
    }
}

/// 100 noisy references (seed 11). SSIM scatters as told within a third: 28 % for 4 standard deviations of a standard
/// deviation of 100 numbers, and 5 % for what crosses the borders of blocks. FLIP has roots with endless slopes
/// and wide filters; what is told of it is an order of size.
#[test]
fn neighbourhoods_are_told_roughly() {
    let draws = 100;
    let Found { off, bias, scatter, told } = found("ssim", draws);
    assert!(off < 4.0 * scatter / (draws as f64).sqrt() + 0.1 * bias.abs(), "{off} of {bias}");
    assert!((0.67..1.33).contains(&(told / scatter)), "{told} against {scatter}");
    let Found { scatter, told, .. } = found("flip", draws);
    assert!((0.5..2.0).contains(&(told / scatter)), "{told} against {scatter}");
}

/// 300 noisy references (seed 11): the interval of ± 2 standard errors about the corrected mean square error holds the
/// true one in 95.4 % of cases, give or take 4 times 1.2 %.
#[test]
fn intervals_cover() {
    let (truth, test, variance) = scene();
    let exact = find("mse").unwrap();
    let value = exact.value(std::slice::from_ref(&test), std::slice::from_ref(&truth)).unwrap();
    let inside = (0..DRAWS).filter(|&draw| {
        let found = exact.uncertain(&test, &noisy(&truth, &variance, draw), &variance).unwrap();
        (found.value - found.bias - value).abs() < 2.0 * found.error
    });
    let share = inside.count() as f64 / DRAWS as f64;
    assert!((share - 0.954).abs() < 0.048, "{share}");
}

/// 300 noisy references (seed 11): the paired difference scatters as told within 16 %, is right on average within 4 standard
/// errors, and is told more sharply than the errors apart would be.
#[test]
fn a_gap_is_known_better_than_its_ends() {
    let (truth, test, variance) = scene();
    let other = film(|x, y| 0.61 + 0.31 * f64::sin(0.4 * x + 0.1) * f64::cos(0.3 * y + 0.1 * x));
    let mse = find("mse").unwrap();
    let of =
        |film: &Film| mse.value(std::slice::from_ref(film), std::slice::from_ref(&truth)).unwrap();
    let exact = of(&test) - of(&other);
    let noisy: Vec<Film> = (0..DRAWS).map(|draw| noisy(&truth, &variance, draw)).collect();
    let gaps: Vec<(f64, f64)> =
        noisy.iter().map(|r| mse_gap(&test, &other, r, &variance)).collect();
    let (mean, scatter) = moments(&gaps.iter().map(|g| g.0).collect::<Vec<f64>>());
    assert!((mean - exact).abs() < 4.0 * scatter / (DRAWS as f64).sqrt(), "{mean} {exact}");
    assert!(gaps.iter().all(|g| (g.1 / gaps[0].1 - 1.0).abs() < 1e-12), "it does not depend on R");
    assert!((gaps[0].1 / scatter - 1.0).abs() < 0.16, "{} {scatter}", gaps[0].1);
    let alone = mse.uncertain(&test, &noisy[0], &variance).unwrap().error;
    assert!(gaps[0].1 < 0.5 * alone, "{} against {alone}", gaps[0].1);
}

#[test]
fn without_noise_nothing_is_uncertain() {
    let (truth, test, variance) = scene();
    let none = vec![0.0; variance.len()];
    for metric in entries() {
        let Some(found) = metric.uncertain(&test, &truth, &none) else { continue };
        let value = metric.value(std::slice::from_ref(&test), std::slice::from_ref(&truth));
        assert_eq!(Some(found.value), value, "{}", metric.name);
        // The rounding of sums of 2304 pixels.
        assert!(found.bias.abs() <= 1e-12 * found.value.abs(), "{}: {found:?}", metric.name);
        assert!(found.error <= 1e-12 * found.value.abs(), "{}: {found:?}", metric.name);
    }
    assert_eq!(mse_gap(&test, &test, &truth, &variance), (0.0, 0.0));
}

/// Closed forms of a single pixel: (A − R)² has bias v and variance 4 (A − R)² v + 2 v².
#[test]
fn a_square_is_exact() {
    let one = |value: f32| Film::new(1, 1, vec![value]);
    let (v, d) = (0.04f64, 0.5f64);
    let found = find("mse").unwrap().uncertain(&one(1.5), &one(1.0), &[v]).unwrap();
    assert!((found.value - d * d).abs() < 1e-15 && (found.bias - v).abs() < 1e-15, "{found:?}");
    assert!((found.error - (4.0 * d * d * v + 2.0 * v * v).sqrt()).abs() < 1e-15, "{found:?}");
    // Through the root: to the corrected mean square, and by the error's own size.
    let root = find("rmse").unwrap().uncertain(&one(1.5), &one(1.0), &[v]).unwrap();
    assert!((root.value - root.bias - (d * d - v).sqrt()).abs() < 1e-15, "{root:?}");
    // Of an image equal to its noisy reference all is finite.
    let equal = find("rmse").unwrap().uncertain(&one(1.0), &one(1.0), &[v]).unwrap();
    assert!(equal.bias == 0.0 && equal.error.is_finite(), "{equal:?}");
    assert!(find("psnr").unwrap().uncertain(&one(1.0), &one(1.0), &[v]).is_none());
}
