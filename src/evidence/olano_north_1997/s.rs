//! The three ways to shade (§6): their errors and costs.

use super::super::{Claim, Exhibit, Halted, Row, Table, Task};
use super::common::{
    Compared, EXPONENT, compare, grid, maps, method, prefiltered, probes, sampled, truth,
};
use super::times::{cheapest, times};
use crate::lobe::BaseLobe;
use crate::method::Method;
use crate::parameter::Value;

/// The row.
pub const ROW: Row = Row {
    name: "olano-s",
    title: "Three ways to shade a 3D Gaussian: unnormalised, with a map of factors, as a 2D Gaussian",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 12.0,
    make,
};

/// The ways, cheapest first as the paper has it.
pub const WAYS: [(&str, &str, &[(&str, Value)]); 4] = [
    ("Pearson II, m = 8, unnormalised", "olano-north-printed", &[]),
    (
        "Pearson II with a map of factors",
        "olano-north-factors",
        &[("density", Value::Word("pearson"))],
    ),
    ("3D Gaussian with a map of factors", "olano-north-factors", &[]),
    ("2D Gaussian on the tangent plane", "olano-north", &[]),
];

/// What a way comes to over all maps.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: f64,
    distance: f64,
    shape: f64,
    least: f64,
    most: f64,
    /// Mean |gain − 1| in the middle of cells and between them, with counts.
    off: [[f64; 2]; 2],
}

impl Sums {
    fn add(&mut self, found: Compared, middle: bool) {
        self.count += 1.0;
        self.distance += found.distance;
        self.shape += found.shape;
        self.least = if self.count == 1.0 { found.gain } else { self.least.min(found.gain) };
        self.most = self.most.max(found.gain);
        let off = &mut self.off[usize::from(!middle)];
        *off = [off[0] + (found.gain - 1.0).abs(), off[1] + 1.0];
    }

    fn off(&self, between: bool) -> f64 {
        let [sum, count] = self.off[usize::from(between)];
        sum / count
    }
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let base = BaseLobe::BlinnPhong { exponent: task.values.number("exponent") };
    let methods = WAYS.map(|(_, name, options)| method(name, options));
    let (grid, probes, maps) = (grid(), probes(1), maps(task.seed));
    let mut sums = [Sums::default(); WAYS.len()];
    for (done, (_, map)) in maps.iter().enumerate() {
        let built = methods.each_ref().map(|m| prefiltered(m.as_ref(), map, &base));
        for probe in &probes {
            task.go_on()?;
            let (density, mean) = truth(&grid, map, &base, probe.block);
            for (sums, built) in sums.iter_mut().zip(&built) {
                let found = sampled(&grid, &built.lobes_at(&probe.footprint));
                sums.add(compare(&grid, &found, &density, mean), probe.middle);
            }
        }
        task.progress.advance(done + 1, maps.len());
    }
    let mut exhibit = ROW.exhibit();
    exhibit.claims = claims(&sums);
    exhibit.tables = vec![errors(&sums), lobes(&methods), generators()];
    exhibit.timed.tables = vec![times(&methods, &maps[0].1, &base)];
    exhibit.timed.claims = vec![cheapest(&exhibit.timed.tables[0])];
    exhibit.remarks.push(format!(
        "The text shows (1 − t/2ᵐ)ᵐ for Pearson II, which at m = 8 is {:.2} off a Gaussian; (1 − t/2m)ᵐ is {:.3} \
         off, and is what is used here.",
        gap(8, 256.0),
        gap(8, 16.0)
    ));
    exhibit.remarks.push(format!(
        "Truth is the sum of base lobes of exponent {} about all normals under a footprint; {} footprints on each of \
         {} maps, from 2 × 2 texels to all of the map. The paper does not say which lobe or maps its pictures have.",
        task.values.number("exponent"),
        probes.len(),
        maps.len()
    ));
    Ok(exhibit)
}

fn claims(sums: &[Sums; WAYS.len()]) -> Vec<Claim> {
    let [printed, pearson, factors, projected] = sums;
    let drift = printed.most.max(1.0 / printed.least);
    vec![
        Claim::shown(
            "unnormalised: the most that a footprint is too bright or too dark, times",
            "a partial normalisation by √det S works reasonably well (§6)",
            drift,
            "at most 1.5",
            drift <= 1.5,
        )
        .because(
            "√det S holds the variance along the mean direction too, which a sphere cut through the Gaussian does not \
             see: where normals spread, brightness drifts with √S_rr",
        ),
        Claim::shown(
            "unnormalised: distance from the truth, over that with factors",
            "as a final option an unnormalised density (§6): worse than a normalised one",
            printed.distance / pearson.distance,
            "above 1",
            printed.distance > pearson.distance,
        ),
        Claim::shown(
            "factors: mean error of brightness between cells, and in their middle",
            "interpolated factors are only an approximation to the true one (§6)",
            format!("{:.2e}, {:.2e}", factors.off(true), factors.off(false)),
            "the first above the second",
            factors.off(true) > factors.off(false),
        ),
        Claim::at_most(
            "largest difference of Pearson II's g(t) from the Gaussian's, m = 8, of the peak",
            "does a good job of approximating a Gaussian (§6)",
            0.05,
            gap(8, 16.0),
        ),
        Claim::shown(
            "2D Gaussian on the tangent plane: distance from the truth, over that of the 3D Gaussian with factors",
            "a possible approximation, more expensive than none (§6)",
            projected.distance / factors.distance,
            "within a factor of 1.5",
            (1.0 / 1.5..=1.5).contains(&(projected.distance / factors.distance)),
        ),
    ]
}

fn errors(sums: &[Sums; WAYS.len()]) -> Table {
    let mut table = Table::new(
        "errors",
        "Mean distance ½ ∫ |D − D_true| cos θ dω over all footprints, that of the shape alone (energy set right), and \
         how bright footprints are over their truth.",
        &[
            "way",
            "distance",
            "of the shape",
            "darkest",
            "brightest",
            "error mid-cell",
            "error between cells",
        ],
    );
    for ((label, _, _), s) in WAYS.iter().zip(sums) {
        let means = [s.distance / s.count, s.shape / s.count, s.least, s.most];
        let values = means.into_iter().chain([s.off(false), s.off(true)]).map(Into::into);
        table.push(std::iter::once((*label).into()).chain(values).collect());
    }
    table
}

/// How near each way's single normal comes to base lobes.
fn lobes(methods: &[Box<dyn Method>; WAYS.len()]) -> Table {
    let mut table = Table::new(
        "lobes",
        "Distance of a single normal from the base lobe, the variance of the bottom level fitted.",
        &["base lobe", WAYS[0].0, WAYS[1].0, WAYS[2].0, WAYS[3].0],
    );
    let phong = [10.0, 50.0, 200.0].map(|exponent| BaseLobe::BlinnPhong { exponent });
    let others = [BaseLobe::Beckmann { alpha: 0.2 }, BaseLobe::Ggx { alpha: 0.2 }];
    for base in phong.into_iter().chain(others) {
        let errors = methods.iter().map(|m| match m.base_error(&base) {
            Ok(error) => error.into(),
            Err(refusal) => refusal.to_string().into(),
        });
        table.push(std::iter::once(base.to_string().into()).chain(errors).collect());
    }
    table
}

/// The print's (1 − t/2ᵐ)ᵐ and (1 − t/2m)ᵐ against e^(−t/2).
fn generators() -> Table {
    let mut table = Table::new(
        "generators",
        "Largest difference of Pearson II's g(t) from e^(−t/2), t ≥ 0.",
        &["m", "(1 − t/2m)ᵐ", "(1 − t/2ᵐ)ᵐ, as the text shows"],
    );
    for m in [1, 2, 4, 8, 16, 32] {
        let meant = gap(m, f64::from(2 * m));
        let printed = gap(m, libm::exp2(f64::from(m)));
        table.push(vec![f64::from(m).into(), meant.into(), printed.into()]);
    }
    table
}

/// The largest difference of (1 − t/scale)ᵐ from e^(−t/2).
fn gap(m: u32, scale: f64) -> f64 {
    let of = |k: u32| {
        let t = f64::from(k) * 0.01;
        let base = (1.0 - t / scale).max(0.0);
        let power = (0..m).fold(1.0, |product, _| product * base);
        (power - libm::exp(-0.5 * t)).abs()
    };
    (0..4000).map(of).fold(0.0, f64::max)
}
