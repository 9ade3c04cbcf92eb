//! How near a round lobe comes to a base lobe: integrals over the angle to its axis.

use crate::lobe::BaseLobe;

/// Points of the midpoint rule.
const POINTS: usize = 800;

/// The relative error of distances here, of lobes up to exponent 10⁴ (see [`over_sphere`]).
pub(super) const ERROR: f64 = 2e-4;

/// ∫ f(x, cos θ) dω over the sphere, x = 1 − cos θ: the midpoint rule in z, x = 2z⁵, which resolves lobes of
/// exponents from 1 to 10⁶ to a relative error of 10⁻³, and those up to 10⁴ to 10⁻⁴.
pub(super) fn over_sphere(mut f: impl FnMut(f64, f64) -> f64) -> f64 {
    let rule = (0..POINTS).map(|i| {
        let z = (i as f64 + 0.5) / POINTS as f64;
        let z4 = z * z * z * z;
        let x = 2.0 * z4 * z;
        f(x, 1.0 - x) * 10.0 * z4
    });
    std::f64::consts::TAU / POINTS as f64 * rule.sum::<f64>()
}

/// tan² θ where 1 − cos θ is `x`.
pub(super) fn tan_squared(x: f64) -> f64 {
    x * (2.0 - x) / ((1.0 - x) * (1.0 - x))
}

/// ∫ D cos θ dω of a round lobe, D given x = 1 − cos θ; what it has below its horizon counts against it.
pub(super) fn energy(density: impl Fn(f64) -> f64) -> f64 {
    over_sphere(|x, cosine| density(x) * cosine)
}

/// ½ ∫ |D − D_base| |cos θ| dω, D given x = 1 − cos θ.
pub(super) fn total_variation(base: &BaseLobe, density: impl Fn(f64) -> f64) -> f64 {
    over_sphere(|x, cosine| {
        let want = if cosine > 0.0 { base.density(tan_squared(x)) } else { 0.0 };
        0.5 * (density(x) - want).abs() * cosine.abs()
    })
}

/// Where `f` is least between `low` > 0 and `high`, and what it is there: the least of a coarse scan in the
/// logarithm, made finer by golden sections. `f` need not have a single minimum, but one that is narrower
/// than the scan may be missed.
pub(super) fn least(low: f64, high: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    const SCAN: usize = 16;
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let of = |log: f64| f(libm::exp(log));
    let (from, step) = (libm::log(low), libm::log(high / low) / SCAN as f64);
    let scanned: Vec<f64> = (0..=SCAN).map(|k| of(from + step * k as f64)).collect();
    let best = (0..=SCAN).fold(0, |best, k| if scanned[k] < scanned[best] { k } else { best });
    let mut a = from + step * best.saturating_sub(1) as f64;
    let mut b = from + step * (best + 1).min(SCAN) as f64;
    let (mut x, mut y) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut at_x, mut at_y) = (of(x), of(y));
    for _ in 0..24 {
        if at_x <= at_y {
            (b, y, at_y) = (y, x, at_x);
            x = b - GOLDEN * (b - a);
            at_x = of(x);
        } else {
            (a, x, at_x) = (x, y, at_y);
            y = a + GOLDEN * (b - a);
            at_y = of(y);
        }
    }
    if at_x <= at_y { (libm::exp(x), at_x) } else { (libm::exp(y), at_y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base_lobes_have_unit_energy_and_are_themselves() {
        for exponent in [1.0, 60.0, 1e4, 1e6] {
            let base = BaseLobe::BlinnPhong { exponent };
            let density = |x: f64| if x < 1.0 { base.density(tan_squared(x)) } else { 0.0 };
            let off = if exponent > 1e4 { 1e-3 } else { 1e-4 };
            assert!((energy(density) - 1.0).abs() < off, "{exponent}: {}", energy(density));
            assert_eq!(total_variation(&base, density), 0.0);
        }
    }

    #[test]
    fn beckmann_against_phong_as_independently_integrated() {
        // An independent program found these for equal variance.
        for (exponent, distance) in [(10.0, 0.054), (30.0, 0.020), (100.0, 0.006)] {
            let beckmann = BaseLobe::Beckmann { alpha: f64::sqrt(2.0 / exponent) };
            let density = |x: f64| if x < 1.0 { beckmann.density(tan_squared(x)) } else { 0.0 };
            let found = total_variation(&BaseLobe::BlinnPhong { exponent }, density);
            assert!((found - distance).abs() < 5e-4, "{exponent}: {found}");
        }
    }

    #[test]
    fn the_least_is_found() {
        let (x, y) = least(0.01, 10.0, |x| (x - 0.3).abs() + 2.0);
        assert!((x - 0.3).abs() < 1e-4 && (y - 2.0).abs() < 1e-4);
        assert!(least(0.5, 10.0, |x| x).0 < 0.51);
    }
}
