//! Derivatives are derivatives, and nothing that can be put in makes a fit hang or give what is not a number.

use std::sync::atomic::{AtomicUsize, Ordering};

use proptest::prelude::*;

use super::random::Random;
use super::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    /// Central differences with steps of h = 10⁻⁵ widths of the peak err by 10⁻¹⁰ of the derivative where it is
    /// smooth; from exponent 4 on it is smooth at the horizon too. A residual, as great as the peaks and the
    /// samples at most, is rounded to ε of itself, and cosⁿ to n ε, as its cosine is rounded to ε: over 2 h, that
    /// is the other part of the bound. It counts where a sharp peak falls between the grid's directions.
    #[test]
    fn the_jacobian_is_the_slope_of_the_residuals(seed in any::<u64>(), count in 1usize..5) {
        let mut random = Random::new(seed);
        let directions = grid();
        let distribution = spread(&[random.peak(1.0, 1000.0)], &directions);
        let problem = PeakProblem::new(&directions, &distribution);
        let at: Vec<Peak> = (0..count).map(|_| random.peak(4.0, 1000.0)).collect();
        let jacobian = problem.jacobian(&at).unwrap();
        let greatest = distribution.maximum() + at.iter().map(|peak| peak.amplitude).sum::<f64>();
        for unknown in 0..4 * count {
            let exponent = at[unknown / 4].exponent;
            let step = 1e-5 / exponent.sqrt();
            let along = |h: f64| {
                let mut by = DVector::zeros(4 * count);
                by[unknown] = h;
                problem.apply(&problem.moved(&at, &by)).unwrap()
            };
            let slope = (along(step) - along(-step)) / (2.0 * step);
            let column = jacobian.column(unknown);
            let gap = (slope - column).amax();
            let rounding = 2.0 * f64::EPSILON * (exponent + 4.0) * greatest / step;
            prop_assert!(gap < 1e-7 * column.amax() + rounding, "unknown {unknown} of {at:?}: {gap}");
        }
    }

    /// Whatever the numbers: an answer or a refusal, and no peak with a part that is not a number.
    #[test]
    fn no_normals_hang_it(
        parts in prop::collection::vec(prop::array::uniform5(prop::num::f64::ANY), 0..40),
        wild in any::<bool>(),
    ) {
        let directions = Directions::new(HemisphereGrid::new(5, 12));
        let tame = |x: f64, most: f64| if wild { x } else { x.abs().min(most).max(1e-3) };
        let normals: Vec<Peak> = parts
            .iter()
            .map(|&[a, x, y, z, n]| Peak {
                amplitude: tame(a, 1e300),
                direction: Vec3::new(tame(x, 9.0), tame(y, 9.0), tame(z, 9.0)),
                exponent: tame(n, 1e6),
            })
            .collect();
        if let Ok(found) = reconstruct(&normals, &directions, GreedyOptions::default(), &|| false) {
            for peak in found.unwrap().peaks {
                prop_assert!(peak.amplitude.is_finite() && peak.exponent.is_finite(), "{peak:?}");
                prop_assert!(peak.amplitude >= 0.0 && (peak.direction.norm() - 1.0).abs() < 1e-9);
            }
        }
    }

    /// The same of measured samples: any values, any number of directions, all alike or all apart.
    #[test]
    fn no_samples_hang_it(
        rows in prop::collection::vec(prop::array::uniform4(-2i8..3), 1..60),
        unit in -300i32..300,
        max_peaks in 1usize..9,
        restarts in 0usize..3,
    ) {
        let row = |r: &[i8; 4]| {
            let [x, y, z, v] = r.map(f64::from);
            format!("{x},{y},{z},{:e}\n", v.max(0.0) * libm::pow(10.0, f64::from(unit)))
        };
        let text: String = rows.iter().filter(|r| r[..3] != [0; 3]).map(row).collect();
        if let Ok(Samples { directions, distribution }) = Samples::parse(&text) {
            let options = GreedyOptions { max_peaks, stop: 0.01, restarts };
            let found = fit(&distribution, &directions, options, &|| false).unwrap();
            prop_assert!(found.rms.is_finite() && found.maximum.is_finite() && found.cost.is_finite());
            prop_assert!(found.termination.is_some() && found.fitted <= max_peaks);
            for peak in &found.peaks {
                prop_assert!(peak.amplitude >= 0.0 && peak.amplitude.is_finite(), "{peak:?}");
                prop_assert!((1e-3..=1e4).contains(&peak.exponent), "{peak:?}");
            }
        }
    }
}

/// A hundred thousand samples are asked for in pieces: whoever cancels waits for one.
#[test]
fn a_long_fit_is_cancelled_within_a_pass() {
    let mut random = Random::new(1);
    let vectors: Vec<Vec3> = (0..100_000).map(|_| random.direction(-1.0)).collect();
    let directions = Directions::scattered(&vectors).unwrap();
    let distribution = spread(&random.separate(3, 5.0, 50.0), &directions);
    for patience in [0, 1, 10, 30, 100] {
        let asked = AtomicUsize::new(0);
        let cancelled = || asked.fetch_add(1, Ordering::Relaxed) >= patience;
        assert_eq!(fit(&distribution, &directions, GreedyOptions::default(), &cancelled), None);
        assert!(asked.into_inner() <= patience + 3, "goes on after it was cancelled");
    }
    let asked = AtomicUsize::new(0);
    let count = || asked.fetch_add(1, Ordering::Relaxed) == usize::MAX;
    let one = GreedyOptions { max_peaks: 1, ..GreedyOptions::default() };
    let fit = fit(&distribution, &directions, one, &count).unwrap();
    let passes = fit.iterations as usize + 1;
    assert!(asked.into_inner() >= 20 * passes, "25 times a pass of 100 000");
}
