//! §4: the table L(r₁, r₂), and whether its normals follow the NDF.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::common::{anisotropic, isotropic, several};
use crate::evidence::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use crate::geometry::noise::Turbulence;
use crate::lobe::NdfImage;
use crate::lobe::vector::V3;
use crate::parameter::{Domain, Parameter};
use crate::synthesis::{
    Agreement, ENTRIES, Noise, NoiseValues, Normals, Synthesis, by_chance, index, total_variation,
};

/// The row.
pub const ROW: Row = Row {
    name: "kautz-l",
    title: "The table L(r₁, r₂): do normals from turbulence follow the distribution?",
    parts: &[],
    parameters: &[Parameter {
        name: "draws",
        meaning: "normals drawn a test",
        domain: Domain::Whole { default: 200_000, min: 10_000, max: 10_000_000 },
    }],
    secs: 4.0,
    make,
};

/// Squares a side in which normals are counted.
const SQUARES: usize = 32;
/// Significance at which following the NDF is refused, a test.
const ALPHA: f64 = 1e-3;
/// Octaves of the noise.
const OCTAVES: f64 = 8.0;
/// Lattice cells a side of a domain so large that random places in it are all but independent.
const WIDE: u32 = 1 << 20;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let draws = task.values.whole("draws");
    let caption = format!(
        "{draws} normals at random places of turbulence of {OCTAVES} octaves, seed {}, counted in {SQUARES} × {SQUARES} \
         squares of the (x, y) map: χ² with its degrees of freedom and p-value, the total variation distance, and what as \
         many draws from the distribution itself have of that on average.",
        task.seed
    );
    let head = ["distribution", "way", "χ²", "degrees", "p", "total variation", "by chance alone"];
    let mut table = Table::new("follow", caption, &head);
    let mut entries = entry_table();
    let (mut least, mut table_apart, mut without, mut aligned) = (1.0f64, 0.0f64, 1.0f64, 1.0f64);
    for (label, ndf) in [
        ("isotropic", isotropic(12.0)),
        ("anisotropic", anisotropic()),
        ("several lobes", several()),
    ] {
        let ways = Ways::new(ndf, task.seed, draws);
        let chance = by_chance(&ways.synthesis.ndf, draws, SQUARES);
        let apart = entries_apart(&ways.synthesis);
        table_apart = table_apart.max(apart[0]);
        let mut row = vec![label.into()];
        row.extend(apart.map(Into::into));
        entries.push(row);
        for (way, found) in ways.all() {
            task.go_on()?;
            let p = found.p_value();
            match way {
                EXACT => least = least.min(p),
                STRAIGHT => without = without.min(found.total_variation),
                ALIGNED => aligned = aligned.min(p),
                _ => {}
            }
            table.push(vec![
                label.into(),
                way.into(),
                found.chi_squared.into(),
                found.degrees.into(),
                p.into(),
                found.total_variation.into(),
                chance.into(),
            ]);
        }
    }
    let noise = noise_claims(&mut table_of_noise());
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::shown(
            format!(
                "least p of three distributions, exact indices, N = {draws}, seed {}",
                task.seed
            ),
            "normals are distributed according to the NDF (§3.3)",
            least,
            format!("above a significance of {ALPHA} each"),
            least > ALPHA,
        ),
        Claim::at_most(
            "total variation of the 256 × 256 table's own distribution, nothing drawn, at most",
            "a full lookup table with 256 × 256 entries (§4)",
            0.03,
            table_apart,
        )
        .because(
            "indices near the middle of the noise are frequent: there an entry stands for many normals; see the readings of \
             where entries stand",
        ),
        Claim::shown(
            "total variation without the mapping through G, at least",
            "we have to do the additional mapping (§4)",
            without,
            "above 0.2: it is needed",
            without > 0.2,
        ),
    ];
    exhibit.claims.extend(noise);
    let mut of_noise = vec![];
    let figure = chart(&mut of_noise);
    exhibit.tables = vec![table, entries, table_of_noise()];
    exhibit.figures = vec![figure];
    exhibit.remarks = vec![format!(
        "Gradient noise is 0 at lattice points whatever its settings. Two turbulences on one lattice are therefore small \
         together and not independent: p falls to {aligned:.1e}. Here the second one's lattice stands a quarter of a cell \
         apart in every octave. The paper says only that the noise is evaluated twice with different settings (§5.1)."
    )];
    Ok(exhibit)
}

const EXACT: &str = "exact indices";
const TABLE: &str = "nearest entry of the table";
const SMOOTH: &str = "table, interpolated";
const STRAIGHT: &str = "without G";
const ALIGNED: &str = "both noises on one lattice";

/// Normals drawn in several ways.
struct Ways {
    synthesis: Synthesis,
    seed: u64,
    draws: usize,
}

impl Ways {
    fn new(ndf: NdfImage, seed: u64, draws: usize) -> Self {
        let noise = Noise { cells: [WIDE; 2], seed, ..Noise::default() };
        Self { synthesis: Synthesis::new(ndf, noise), seed, draws }
    }

    fn all(&self) -> [(&'static str, Agreement); 5] {
        let Synthesis { normals, table, .. } = &self.synthesis;
        let indices = |place: [f64; 2]| self.synthesis.indices(place[0], place[1], OCTAVES);
        let one_lattice = |k: u64| Turbulence {
            cells: [WIDE; 2],
            gain: Noise::default().gain,
            seed: self.seed.wrapping_add(1000 + k),
            offset: 0.0,
        };
        let aligned = [0, 1].map(one_lattice);
        let of_aligned = |[u, v]: [f64; 2]| aligned.map(|noise| index(noise.at(u, v, OCTAVES)));
        let same = NoiseValues::measured(Noise::default().gain, 0.0);
        let same = Normals { values: [same.clone(), same], cumulative: normals.cumulative.clone() };
        let straight = |r: [f64; 2]| {
            let [x, y] = normals.cumulative.place(r).map(|c| (2.0 * c - 1.0) as f32);
            [x, y, 0.0]
        };
        [
            (EXACT, self.count(|at| normals.at(indices(at)))),
            (TABLE, self.count(|at| table.nearest(indices(at).map(|r| r as f32))[2])),
            (SMOOTH, self.count(|at| table.smooth(indices(at).map(|r| r as f32))[2])),
            (STRAIGHT, self.count(|at| straight(indices(at)))),
            (ALIGNED, self.count(|at| same.at(of_aligned(at)))),
        ]
    }

    fn count(&self, normal: impl Fn([f64; 2]) -> V3) -> Agreement {
        let mut random = Pcg64Mcg::seed_from_u64(self.seed);
        let mut part = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let normals = (0..self.draws).map(|_| normal([part(), part()]));
        Agreement::of(&self.synthesis.ndf, normals, SQUARES)
    }
}

fn entry_table() -> Table {
    let caption = format!(
        "Total variation distance of what the table holds, each entry by the noise's probability of its cell, over {SQUARES} × \
         {SQUARES} squares. Nothing is drawn. Entries stand at the middles of {ENTRIES} equal cells, as a texture's do and as \
         they are here; or at i/{} with cells about them; or the noise is mapped through G first, so that all are met alike.",
        ENTRIES - 1
    );
    let head = [
        "distribution",
        "entries at (i + ½)/256",
        "entries at i/255",
        "entries of equal probability",
    ];
    Table::new("entries", caption, &head)
}

/// The total variation distances of the table's distribution, by the readings of [`entry_table`].
fn entries_apart(Synthesis { ndf, normals, table, .. }: &Synthesis) -> [f64; 3] {
    let n = ENTRIES as f64;
    let middle = |k: usize| (k as f64 + 0.5) / n;
    let below = |k: usize, r: f64| normals.values[k].below(r);
    let own = |entry: [usize; 2]| table.nearest(entry.map(|k| middle(k) as f32))[2];
    let ends = |entry: [usize; 2]| normals.at(entry.map(|k| k as f64 / (n - 1.0)));
    let even = |entry: [usize; 2]| {
        let [x, y] = normals.cumulative.place(entry.map(middle));
        [2.0 * x - 1.0, 2.0 * y - 1.0, 0.0].map(|c| c as f32)
    };
    let about = |k: f64| ((k - 0.5) / (n - 1.0)).clamp(0.0, 1.0);
    [
        distribution_apart(ndf, |k, i| below(k, i / n), own),
        distribution_apart(ndf, |k, i| below(k, about(i)), ends),
        distribution_apart(ndf, |_, i| i / n, even),
    ]
}

/// The same of these normals, of which those of entries before the i-th along either axis have the probability `below(axis,
/// i)` there.
fn distribution_apart(
    ndf: &NdfImage,
    below: impl Fn(usize, f64) -> f64,
    normal: impl Fn([usize; 2]) -> V3,
) -> f64 {
    let [across, along] = [0, 1].map(|axis| {
        let edge = |i: usize| below(axis, i as f64);
        (0..ENTRIES).map(|i| edge(i + 1) - edge(i)).collect::<Vec<f64>>()
    });
    let entries = (0..ENTRIES * ENTRIES).map(|k| {
        let (i, j) = (k % ENTRIES, k / ENTRIES);
        (normal([i, j]), across[i] * along[j])
    });
    total_variation(ndf, entries, SQUARES)
}

/// Octaves that are compared.
const COUNTS: [u32; 5] = [1, 2, 3, 4, 8];

/// Values of turbulence of so many octaves, as indices.
fn values(octaves: u32) -> NoiseValues {
    let noise = Turbulence { cells: [WIDE; 2], gain: Noise::default().gain, seed: 3, offset: 0.0 };
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let mut part = move || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    NoiseValues::of((0..1 << 17).map(|_| index(noise.at(part(), part(), f64::from(octaves)))))
}

/// The greatest distance of two cumulative distributions.
fn distance(a: impl Fn(f64) -> f64, b: impl Fn(f64) -> f64) -> f64 {
    (0..=1000).map(|k| f64::from(k) / 1000.0).map(|r| (a(r) - b(r)).abs()).fold(0.0, f64::max)
}

fn normal(mean: f64, variance: f64) -> impl Fn(f64) -> f64 {
    move |r| 0.5 * libm::erfc((mean - r) / (2.0 * variance).sqrt())
}

fn table_of_noise() -> Table {
    let head = [
        "octaves",
        "standard deviation of r",
        "skewness",
        "excess kurtosis",
        "distance from a normal distribution",
        "distance from 8 octaves",
    ];
    let caption = "Values of turbulence as indices r in [0, 1], 131072 of each; distances are the greatest between \
                   cumulative distributions.";
    let mut table = Table::new("noise", caption, &head);
    let eight = values(8);
    for count in COUNTS {
        let of = values(count);
        let [mean, variance, skewness, kurtosis] = of.moments();
        table.push(vec![
            (count as usize).into(),
            variance.sqrt().into(),
            skewness.into(),
            kurtosis.into(),
            distance(|r| of.below(r), normal(mean, variance)).into(),
            distance(|r| of.below(r), |r| eight.below(r)).into(),
        ]);
    }
    table
}

fn noise_claims(table: &mut Table) -> Vec<Claim> {
    use crate::evidence::Quantity;
    let number = |row: usize, column: usize| match &table.rows[row][column] {
        Quantity::Number(x) => *x,
        _ => f64::NAN,
    };
    let last = COUNTS.len() - 1;
    vec![
        Claim::at_most(
            "greatest distance of turbulence's distribution from a normal one of its mean and variance",
            "random numbers with a Gaussian distribution (§4)",
            0.02,
            number(last, 4),
        ),
        Claim::at_most(
            "greatest distance of the distribution of 3 octaves from that of 8",
            "the distribution remains constant independent of the number of octaves, a valid approximation (§4)",
            0.03,
            number(2, 5),
        ),
        Claim::at_most(
            "the same of a single octave",
            "independent of the number of octaves (§4)",
            0.03,
            number(0, 5),
        )
        .because("the first octave has three quarters of the variance of all"),
    ]
}

fn chart(series: &mut Vec<Series>) -> Figure {
    const BINS: usize = 100;
    let density = |below: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        (0..BINS)
            .map(|k| {
                let [a, b] = [k, k + 1].map(|k| k as f64 / BINS as f64);
                [0.5 * (a + b), (below(b) - below(a)) * BINS as f64]
            })
            .collect()
    };
    for count in [1, 3, 8] {
        let of = values(count);
        let label = format!("{count} octave{}", if count == 1 { "" } else { "s" });
        series.push(Series { label, points: density(&|r| of.below(r)), joined: true });
    }
    let [mean, variance, ..] = values(8).moments();
    let bell = normal(mean, variance);
    series.push(Series { label: "normal".into(), points: density(&bell), joined: true });
    let chart = Chart {
        x: Axis::linear("index value r"),
        y: Axis::linear("density"),
        series: std::mem::take(series),
    };
    let caption = "How the values of turbulence are distributed, by octaves, and a normal distribution of the mean and \
                   variance of 8.";
    Figure::new("noise", caption, Drawing::Chart(chart))
}
