//! `metrics.csv` and `metrics.json`: one row a trial and metric. docs/results.md is their manual.

use serde::Serialize;

use crate::experiment::results::{
    MethodInfo, Peak, Probe, ProbedMethod, RefusalInfo, Results, SceneKey, SceneResult,
    TextureInfo, mean_figures,
};
use crate::experiment::sequence::Sequence;
use crate::metric::{Step, Z};

/// The columns of `metrics.csv`, in order.
pub const COLUMNS: [&str; 16] = [
    "texture",
    "surface",
    "light",
    "lobe",
    "parameter",
    "shading",
    "texels_per_pixel",
    "distance",
    "elevation",
    "frame",
    "method",
    "spp",
    "metric",
    "value",
    "low",
    "high",
];

/// One figure.
pub(super) struct Row<'a> {
    key: &'a SceneKey,
    /// The method's label, or `reference`.
    pub method: &'a str,
    /// `None` for what has no samples: a distribution.
    pub spp: Option<u32>,
    /// Which figure it is.
    pub metric: &'a str,
    value: f64,
    interval: Option<[f64; 2]>,
}

/// `metrics.csv`.
pub fn csv(results: &Results) -> Vec<u8> {
    let cells = rows(results).map(|row| {
        let key = row.key;
        [
            key.texture.clone(),
            key.surface.clone(),
            key.light.clone(),
            key.lobe.clone(),
            round_trip(key.parameter),
            key.shading.clone(),
            round_trip(key.texels_per_pixel),
            round_trip(key.distance),
            round_trip(key.elevation),
            key.frame.map_or_else(String::new, |frame| frame.to_string()),
            row.method.to_owned(),
            row.spp.map_or_else(String::new, |spp| spp.to_string()),
            row.metric.to_owned(),
            round_trip(row.value),
            row.interval.map_or_else(String::new, |[low, _]| round_trip(low)),
            row.interval.map_or_else(String::new, |[_, high]| round_trip(high)),
        ]
    });
    table(COLUMNS, cells)
}

/// A CSV file of these columns.
pub fn table<const N: usize>(
    columns: [&str; N],
    rows: impl Iterator<Item = [String; N]>,
) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut write = |record: csv::StringRecord| {
        writer
            .write_record(&record)
            .expect("writing records of equal length to memory cannot fail");
    };
    write(columns.iter().collect());
    rows.for_each(|row| write(row.iter().collect()));
    writer.into_inner().expect("flushing to memory cannot fail")
}

/// The shortest decimal that reads back as the same number; empty if it is not finite.
pub fn round_trip(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        String::new()
    } else if size != 0.0 && !(1e-5..1e16).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

fn rows(results: &Results) -> impl Iterator<Item = Row<'_>> {
    results.scenes.iter().flat_map(scene_rows)
}

/// The reference's own error and mean first, then trials, then distributions.
pub(super) fn scene_rows(scene: &SceneResult) -> impl Iterator<Item = Row<'_>> {
    reference_rows(scene).into_iter().chain(trial_rows(scene)).chain(probe_rows(scene))
}

fn reference_rows(scene: &SceneResult) -> [Row<'_>; 2] {
    let spp = Some(scene.reference.spp);
    let row = |metric, value, interval| Row {
        key: &scene.key,
        method: "reference",
        spp,
        metric,
        value,
        interval,
    };
    let mean = super::contest::mean_radiance(scene);
    // Pixels are independent: the variance of their mean is the mean of their variances over their number.
    let error = Z * scene.reference.rmse / (scene.reference.variance.len() as f64).sqrt();
    [
        row("rmse", scene.reference.rmse, None),
        row("mean_radiance", mean, Some([mean - error, mean + error])),
    ]
}

fn trial_rows(scene: &SceneResult) -> impl Iterator<Item = Row<'_>> {
    scene.trials.iter().flat_map(move |trial| {
        trial.scores.iter().map(move |score| Row {
            key: &scene.key,
            method: &trial.method,
            spp: Some(trial.spp),
            metric: &score.metric,
            value: score.value,
            interval: score.interval,
        })
    })
}

/// A figure of a method's distribution of normals.
type Figured = fn(&ProbedMethod) -> Option<f64>;

/// The figures of distributions of normals.
const DISTRIBUTIONS: [(&str, Figured); 3] =
    [("ndf_l1", |m| Some(m.l1)), ("ndf_kl", |m| m.kl), ("ndf_wasserstein", |m| m.wasserstein)];

/// One row a method and figure: the mean over the scene's probes.
fn probe_rows(scene: &SceneResult) -> impl Iterator<Item = Row<'_>> {
    let probes = || scene.probes.iter().map(|probe| probe.methods.as_slice());
    DISTRIBUTIONS.into_iter().flat_map(move |(metric, figure)| {
        let row = move |(method, value)| Row {
            key: &scene.key,
            method,
            spp: None,
            metric,
            value,
            interval: None,
        };
        mean_figures(probes(), figure).into_iter().map(row)
    })
}

#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    experiment: &'a str,
    title: &'a str,
    question: &'a str,
    seed: u64,
    spec: &'a str,
    methods: &'a [MethodInfo],
    textures: &'a [TextureInfo],
    scenes: Vec<SceneJson<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    sequences: Vec<SequenceJson<'a>>,
}

#[derive(Serialize)]
struct SequenceJson<'a> {
    slug: &'a str,
    frames: Vec<&'a str>,
    truth_change: f64,
    noise: f64,
    trials: Vec<FlickerJson<'a>>,
}

#[derive(Serialize)]
struct FlickerJson<'a> {
    method: &'a str,
    spp: u32,
    flicker: Option<f64>,
    error_flicker: Option<f64>,
    steps: &'a [Step],
}

#[derive(Serialize)]
struct SceneJson<'a> {
    slug: &'a str,
    key: &'a SceneKey,
    metrics: Vec<Figure<'a>>,
    refusals: &'a [RefusalInfo],
    probes: Vec<ProbeJson<'a>>,
}

#[derive(Serialize)]
struct Figure<'a> {
    method: &'a str,
    spp: Option<u32>,
    metric: &'a str,
    value: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    low: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    high: Option<f64>,
}

#[derive(Serialize)]
struct ProbeJson<'a> {
    pixel: [usize; 2],
    texels_across: f64,
    methods: Vec<ProbedJson<'a>>,
}

#[derive(Serialize)]
struct ProbedJson<'a> {
    method: &'a str,
    ndf_l1: f64,
    ndf_kl: Option<f64>,
    ndf_wasserstein: Option<f64>,
    peaks: &'a [Peak],
}

/// `metrics.json`: the same figures scene by scene, with refusals, probes, methods and the spec.
pub fn json(results: &Results) -> Vec<u8> {
    let document = Document {
        format: super::FORMAT,
        experiment: &results.name,
        title: &results.title,
        question: &results.question,
        seed: results.seed,
        spec: &results.spec,
        methods: &results.methods,
        textures: &results.textures,
        scenes: results.scenes.iter().map(scene_json).collect(),
        sequences: results.sequences.iter().map(|s| sequence_json(results, s)).collect(),
    };
    let mut bytes = serde_json::to_vec_pretty(&document).expect("the document has string keys");
    bytes.push(b'\n');
    bytes
}

fn sequence_json<'a>(results: &'a Results, sequence: &'a Sequence) -> SequenceJson<'a> {
    let trials = sequence.trials.iter().map(|trial| FlickerJson {
        method: &trial.method,
        spp: trial.spp,
        flicker: trial.flicker.ratio(),
        error_flicker: trial.flicker.error_ratio(),
        steps: &trial.flicker.steps,
    });
    SequenceJson {
        slug: &sequence.slug,
        frames: sequence.of(&results.scenes).iter().map(|frame| frame.slug.as_str()).collect(),
        truth_change: sequence.truth_change,
        noise: sequence.noise,
        trials: trials.collect(),
    }
}

fn scene_json(scene: &SceneResult) -> SceneJson<'_> {
    let metrics = scene_rows(scene).map(|row| Figure {
        method: row.method,
        spp: row.spp,
        metric: row.metric,
        value: row.value,
        low: row.interval.map(|[low, _]| low),
        high: row.interval.map(|[_, high]| high),
    });
    SceneJson {
        slug: &scene.slug,
        key: &scene.key,
        metrics: metrics.collect(),
        refusals: &scene.refusals,
        probes: scene.probes.iter().map(probe_json).collect(),
    }
}

fn probe_json(probe: &Probe) -> ProbeJson<'_> {
    let methods = probe.methods.iter().map(|m| ProbedJson {
        method: &m.method,
        ndf_l1: m.l1,
        ndf_kl: m.kl,
        ndf_wasserstein: m.wasserstein,
        peaks: &m.peaks,
    });
    ProbeJson { pixel: probe.pixel, texels_across: probe.texels_across, methods: methods.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_columns_are_those_of_the_manual() {
        let text = String::from_utf8(csv(&fixture::results())).unwrap();
        assert_eq!(text.lines().next(), Some(COLUMNS.join(",").as_str()));
        let manual = include_str!("../../docs/results.md");
        for column in COLUMNS {
            assert!(manual.contains(&format!("| `{column}` |")), "{column} is not in the manual");
        }
    }

    #[test]
    fn values_read_back_as_they_were() {
        let results = fixture::results();
        let bytes = csv(&results);
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let read: Vec<f64> = reader.records().map(|r| r.unwrap()[13].parse().unwrap()).collect();
        assert_eq!(read, rows(&results).map(|row| row.value).collect::<Vec<_>>());
        for value in [0.1 + 0.2, 1e-300, 5e-324, 1e22, -0.0, 123_456.789] {
            assert_eq!(round_trip(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert_eq!(round_trip(f64::NAN), "");
    }

    #[test]
    fn reference_and_distributions_have_rows() {
        let text = String::from_utf8(csv(&fixture::results())).unwrap();
        assert_eq!(text.matches(",reference,4096,rmse,0.0004").count(), 12);
        assert!(text.contains(",fournier,,ndf_l1,"));
    }

    #[test]
    fn json_holds_refusals_and_is_never_broken_by_a_value() {
        let mut results = fixture::results();
        results.scenes[0].trials[0].scores[0].value = f64::NAN;
        let read: serde_json::Value = serde_json::from_slice(&json(&results)).unwrap();
        assert!(read["scenes"][0]["metrics"][2]["value"].is_null());
        assert_eq!(read["scenes"][8]["refusals"][0]["method"], "kautz");
    }
}
