//! The truth the filters are measured against: that it converges as its points promise, that it knows
//! its own error, and that filters agree with what can be written down in closed form.
#![allow(clippy::disallowed_methods, reason = "tests compare numbers within tolerances")]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use wrinkle::light::Light;
use wrinkle::lobe::{BaseLobe, Lobe, MultipleSurface, Shading};
use wrinkle::method::{self, Silent};
use wrinkle::parameter::{Value, Values};
use wrinkle::pattern;
use wrinkle::render::{Camera, Film, PixelSampler, View, average, direction, render};
use wrinkle::surface::{Plane, Shape};
use wrinkle::texture::{Footprint, Interpolation, Lookup, NormalMap, Wrap};

const SIDE: usize = 12;
const SEED: u64 = 1978;

/// A plane of bumps, about three texels a pixel, lit so that highlights are all over it.
struct Scene {
    view: View,
    map: Box<dyn method::Prefiltered>,
}

impl Scene {
    fn new(interpolation: Interpolation) -> Self {
        let map = NormalMap::from_fn(16, 16, Wrap::Repeat, |u, v| {
            [0.3 * (TAU * u).sin() + 0.1, 0.3 * (TAU * (u + v)).cos(), 1.0, 1.0]
        });
        let map = Arc::new(map.with_interpolation(interpolation));
        let base = BaseLobe::BlinnPhong { exponent: 30.0 };
        let view = View {
            camera: Camera::orbiting(4.0, 60.0, -90.0, 30.0, SIDE, SIDE),
            surface: Shape::Plane(Plane::new()).tiled(1.1, 1.0),
            light: Light::Directional { direction: direction(60.0, 90.0), irradiance: 1.0 },
            shading: Shading::Ndf,
            wrap: Wrap::Repeat,
            lookup: Lookup::default(),
        };
        let map = method::brute_force().prefilter(&map, &base, &Silent).unwrap();
        Self { view, map }
    }

    fn film(&self, spp: u32, replicate: u32) -> Film {
        let sampler = PixelSampler::new(spp);
        render(&self.view, self.map.as_ref(), &sampler, SEED, replicate, &|| false).unwrap()
    }
}

/// Mean over pixels of the squared difference.
fn mean_square(a: &Film, b: &Film) -> f64 {
    let squares = a.pixels().iter().zip(b.pixels()).map(|(a, b)| f64::from(a - b).powi(2));
    squares.sum::<f64>() / a.pixels().len() as f64
}

/// The slope of the line through these points that is nearest in y.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let along: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    along / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// Mean of `values` and the standard error of that mean.
fn estimate(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let scatter: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (scatter / (n * (n - 1.0))).sqrt())
}

/// Random points would give error ∝ spp^−½. Nets are never worse for long, and better where the
/// integrand is smooth (bilinear normals) or has jumps along lines (a mosaic of texels: about −¾).
///
/// A slope of log₂ error against log₂ spp over 4, 16, 64, 256 for each of N = 8 replicates, seed 1978,
/// against 64 times 256 samples. Claim: slope below −0.45, one-sided t-test with 7 degrees of freedom
/// at α = 5·10⁻⁴ (t = 5.41) for each of two scenes.
#[test]
fn the_error_falls_at_least_as_fast_as_random_points_would_have_it() {
    for interpolation in [Interpolation::Bilinear, Interpolation::Nearest] {
        let scene = Scene::new(interpolation);
        let truth = scene.film(64 * 256, 1000);
        let slopes: Vec<f64> = (0..8)
            .map(|replicate| {
                let error = |spp| mean_square(&scene.film(spp, replicate), &truth).sqrt();
                slope(&[2.0, 4.0, 6.0, 8.0].map(|k: f64| (k, error(k.exp2() as u32).log2())))
            })
            .collect();
        let (mean, standard_error) = estimate(&slopes);
        assert!(mean + 5.41 * standard_error < -0.45, "{interpolation:?}: {slopes:?}");
    }
}

/// Eight replicates say how far their mean is from the truth; a film of 64 times as many samples says
/// it too.
///
/// With σᵢ² the variance of pixel i's mean, the true squared error is Σ σᵢ² χ²₁ / P over P pixels and
/// the estimate Σ σᵢ² χ²₇/7 / P, so their ratio scatters about 1 with variance (2 + 2/7)/n, n = (Σσ²)²/Σσ⁴ the
/// number of pixels that count. Four standard deviations, seed 1978: a false alarm has a chance of
/// about 10⁻⁴ in each of two scenes.
#[test]
fn a_reference_knows_its_own_error() {
    const REPLICATES: u32 = 8;
    for interpolation in [Interpolation::Bilinear, Interpolation::Nearest] {
        let scene = Scene::new(interpolation);
        let films: Vec<Film> = (0..REPLICATES).map(|r| scene.film(16, r)).collect();
        let converged = average(&films, 16 * REPLICATES);
        let truth = scene.film(64 * 16 * REPLICATES, 1000);
        let ratio = mean_square(&converged.film, &truth) / converged.rmse.powi(2);
        let variances: Vec<f64> = (0..SIDE * SIDE)
            .map(|i| {
                estimate(&films.iter().map(|f| f64::from(f.pixels()[i])).collect::<Vec<_>>())
                    .1
                    .powi(2)
            })
            .collect();
        let (sum, squares) = variances.iter().fold((0.0, 0.0), |s, v| (s.0 + v, s.1 + v * v));
        // E[s⁴] is σ⁴ (1 + 2/7).
        let counting = sum * sum / squares * (9.0 / 7.0);
        let deviation = (16.0 / 7.0 / counting).sqrt();
        assert!((ratio - 1.0).abs() < 4.0 * deviation, "{interpolation:?}: {ratio} ± {deviation}");
    }
}

/// A pattern's map with some parameters set.
fn make(name: &str, [width, height]: [usize; 2], set: &[(&str, Value)]) -> Arc<NormalMap> {
    let entry = pattern::find(name).unwrap();
    let mut values = Values::defaults(entry.parameters);
    for (name, value) in set {
        let parameter = entry.parameters.iter().find(|p| p.name == *name).unwrap();
        values.set(parameter.name, value.clone());
    }
    Arc::new((entry.build)(width, height, &values, 5).normals)
}

/// What a method makes of the whole of a map.
fn top(name: &str, map: &Arc<NormalMap>, base: &BaseLobe) -> MultipleSurface {
    let filtered = method::build(name).unwrap().prefilter(map, base, &Silent).unwrap();
    let whole = Footprint::whole();
    filtered.lobes_at(&whole)
}

/// The spread of the one elliptic lobe of a method, the base lobe's variance taken off.
fn covariance(name: &str, map: &Arc<NormalMap>) -> [f64; 3] {
    let base = BaseLobe::Beckmann { alpha: 0.2 };
    match top(name, map, &base).lobes() {
        [Lobe::Elliptic(lobe)] => {
            let [a, b, c] = lobe.spread().map(f64::from);
            [a - base.spread(), b, c - base.spread()]
        }
        other => panic!("{name}: {other:?} is not one elliptic lobe"),
    }
}

/// Moments of a Gaussian surface of slope variances σᵤ², σᵥ² (as in LEAN mapping: Olano and Baker 2010).
///
/// The fourth moments of Gaussian slopes give what weights and projection change, to first order:
/// - Schilling: E[x² n_z]/E[n_z], n_z ≈ 1 − (x² + y²)/2, is σᵤ² (1 − σᵤ²);
/// - Olano and North: E[n_x²] = E[x²/(1 + x² + y²)] is σᵤ² (1 − 3σᵤ² − σᵥ²).
///
/// The tolerance: second order, 15 σ⁴ relative, and 1 % for the fourth moments of a single tile, which are
/// not a Gaussian's exactly as its second moments are.
#[test]
fn a_gaussian_surface_gives_back_its_slope_variances() {
    let (u, v) = (0.01, 0.0025);
    let set = [("slope_variance_u", u), ("slope_variance_v", v), ("correlation_length", 3.0)];
    let map = make("gaussian", [128, 128], &set.map(|(name, x)| (name, Value::Number(x))));
    let forms: [(&str, [f64; 2]); 2] = [
        ("schilling-anisotropic", [u * (1.0 - u), v * (1.0 - v)]),
        ("olano-north", [u * (1.0 - 3.0 * u - v), v * (1.0 - 3.0 * v - u)]),
    ];
    for (name, [want_u, want_v]) in forms {
        let [a, b, c] = covariance(name, &map);
        assert!((a / want_u - 1.0).abs() < 0.012, "{name}: {a}, not {want_u}");
        assert!((c / want_v - 1.0).abs() < 0.012, "{name}: {c}, not {want_v}");
        assert!(b.abs() < 0.012 * v, "{name}: no covariance, not {b}");
    }
}

const PHONG: BaseLobe = BaseLobe::BlinnPhong { exponent: 30.0 };

/// Mean of D/want − 1 over half vectors, and its root mean square.
fn deviation(surface: &MultipleSurface, half: &[[f64; 3]], want: f64) -> (f64, f64) {
    let off = half.iter().map(|h| f64::from(surface.density(h.map(|c| c as f32))) / want - 1.0);
    let n = half.len() as f64;
    let (sum, squares) = off.fold((0.0, 0.0), |s, d| (s.0 + d, s.1 + d * d));
    (sum / n, (squares / n).sqrt())
}

/// A half cylinder's normals are equally distributed in angle (Fournier 1992 §2.3). Seen from above
/// their weight is 1/n_z, so a unit of the map holds ½ dφ of them, and in the cylinder's plane
/// D = ½ (s+2)/2π ∫ cosˢ dφ, the integral √π Γ((s+1)/2) / Γ(s/2 + 1), as long as the lobe's width (10°) keeps
/// the ends at ±90° out of sight. Held to the fit's stopping rule, 5 % in rms.
#[test]
fn fourniers_cylinder_is_flat_in_angle() {
    let map = make("cylinders", [64, 2], &[("weight", Value::Word("area"))]);
    let integral = PI.sqrt() * libm::tgamma(15.5) / libm::tgamma(16.0);
    let want = 0.5 * 32.0 / TAU * integral;
    let angles = (-50..=50).step_by(5).map(|degrees| f64::from(degrees).to_radians().sin_cos());
    let half: Vec<[f64; 3]> = angles.map(|(s, c)| [s, 0.0, c]).collect();
    let (mean, rms) = deviation(&top("fournier", &map, &PHONG), &half, want);
    assert!(mean.abs() < 0.05 && rms < 0.05, "mean {mean}, rms {rms}");
}

/// A hemisphere's normals are equally distributed over directions (Fournier 1992 §2.3): ¼ dω a unit of
/// the map around it, so D = ¼ (s+2)/2π · 2π/(s+1) away from the horizon. The paper's 7 peaks do not bring
/// the top of a sphere within 5 % everywhere (its §2.3 says so); in rms they do.
#[test]
fn fourniers_hemisphere_is_uniform_over_directions() {
    let set = [("weight", Value::Word("area")), ("background", Value::Word("none"))];
    let map = make("hemispheres", [32, 32], &set);
    let want = 0.25 * 32.0 / 31.0;
    let grid = wrinkle::geometry::HemisphereGrid::fournier();
    let high = grid.samples().iter().map(|s| s.direction).filter(|d| d.z > 0.7);
    let half: Vec<[f64; 3]> = high.map(|d| [d.x, d.y, d.z]).collect();
    let (mean, rms) = deviation(&top("fournier", &map, &PHONG), &half, want);
    assert!(mean.abs() < 0.05 && rms < 0.06, "mean {mean}, rms {rms}");
}
