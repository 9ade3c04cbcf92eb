//! The figures of a report, a row each.

use std::path::Path;

use serde::Deserialize;

use super::bytes_of;
use super::text::clean;
use crate::report::check_format;

/// One figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The slug of its scene; of a figure of flicker, its sequence's; of what prefiltering costs, the texture's name.
    pub scene: String,
    /// The method's label, or `reference`.
    pub method: String,
    /// Samples a pixel; `None` of what has none.
    pub spp: Option<u32>,
    /// Which figure it is: as in the files, and `prefilter_seconds` and `bytes_per_texel` of costs.
    pub metric: String,
    /// The figure; finite.
    pub value: f64,
}

/// `metrics.json`, as far as it is looked at.
#[derive(Debug, Default, Deserialize)]
pub(super) struct Metrics {
    #[serde(default)]
    pub title: String,
    #[serde(default)]
    pub question: String,
    #[serde(default)]
    pub methods: Vec<Method>,
    pub scenes: Vec<Scene>,
}

/// A method of `metrics.json`.
#[derive(Debug, Deserialize)]
pub(super) struct Method {
    pub label: String,
    #[serde(default)]
    pub name: String,
}

/// A scene of `metrics.json`.
#[derive(Debug, Deserialize)]
pub(super) struct Scene {
    pub slug: String,
    #[serde(default)]
    pub metrics: Vec<Figure>,
}

/// A figure of `metrics.json`.
#[derive(Debug, Deserialize)]
pub(super) struct Figure {
    pub method: String,
    pub spp: Option<u32>,
    pub metric: String,
    pub value: Option<f64>,
}

/// `metrics.json` of a report; `None`, with a sentence, if it is of no use.
pub(super) fn metrics_json(folder: &Path, problems: &mut Vec<String>) -> Option<Metrics> {
    let bytes = bytes_of(&folder.join("metrics.json"), problems)?;
    if !is_known("metrics.json", &bytes, problems) {
        return None;
    }
    let read = serde_json::from_slice(&bytes);
    read.map_err(|error| problems.push(format!("metrics.json cannot be read: {error}"))).ok()
}

/// Whether a JSON file of a report is of a version that this program reads; a sentence if not. Version 1 does not say
/// which it is.
pub(super) fn is_known(name: &str, bytes: &[u8], problems: &mut Vec<String>) -> bool {
    #[derive(Deserialize)]
    struct Version {
        format: Option<u32>,
    }
    let version: Option<Version> = serde_json::from_slice(bytes).ok();
    let format = version.and_then(|version| version.format).unwrap_or(1);
    match check_format(format) {
        Ok(()) => true,
        Err(newer) => {
            problems.push(format!("{name}: {newer}"));
            false
        }
    }
}

impl Metrics {
    /// Its figures; those that are not finite are left out, as in the table.
    pub fn rows(&self) -> Vec<Row> {
        let of_scene = |scene: &Scene| {
            let slug = clean(&scene.slug);
            let rows = scene.metrics.iter().filter_map(move |figure| {
                Some(Row {
                    scene: slug.clone(),
                    method: clean(&figure.method),
                    spp: figure.spp,
                    metric: clean(&figure.metric),
                    value: figure.value.filter(|value| value.is_finite())?,
                })
            });
            rows.collect::<Vec<_>>()
        };
        self.scenes.iter().flat_map(of_scene).collect()
    }
}

/// The figures of `metrics.csv`, where scenes have no slugs: they are named by what tells them apart.
pub(super) fn metrics_csv(folder: &Path, problems: &mut Vec<String>) -> Vec<Row> {
    const KEY: [&str; 6] =
        ["texture", "lobe", "parameter", "texels_per_pixel", "elevation", "frame"];
    const REST: [&str; 4] = ["method", "spp", "metric", "value"];
    let columns: Vec<&str> = KEY.into_iter().chain(REST).collect();
    let rows = table(folder, "metrics.csv", &columns, problems);
    let (mut found, mut bad) = (Vec::new(), 0);
    for cells in rows {
        let told = cells[..KEY.len()].iter().filter(|cell| !cell.is_empty());
        let scene = told.map(String::as_str).collect::<Vec<_>>().join(" ");
        let [method, spp, metric, value] = [6, 7, 8, 9].map(|i: usize| cells[i].as_str());
        push(&mut found, &mut bad, scene, (method, spp), metric, value);
    }
    tell_bad("metrics.csv", bad, problems);
    found
}

/// The figures of `costs.csv`: of trials as they are, of prefilters under the texture's name.
pub(super) fn costs(folder: &Path, problems: &mut Vec<String>) -> Vec<Row> {
    let columns = ["kind", "scene", "method", "spp", "measure", "value"];
    let (mut found, mut bad) = (Vec::new(), 0);
    for cells in table(folder, "costs.csv", &columns, problems) {
        let [kind, scene, method, spp, measure, value] =
            [0, 1, 2, 3, 4, 5].map(|i: usize| cells[i].as_str());
        let metric = match (kind, measure) {
            ("prefilter", "seconds") => "prefilter_seconds",
            _ => measure,
        };
        push(&mut found, &mut bad, scene.to_owned(), (method, spp), metric, value);
    }
    tell_bad("costs.csv", bad, problems);
    found
}

/// The figures of `flicker.csv`; none where nothing moves.
pub(super) fn flicker(folder: &Path, problems: &mut Vec<String>) -> Vec<Row> {
    if !folder.join("flicker.csv").exists() {
        return Vec::new();
    }
    let columns = ["sequence", "method", "spp", "metric", "value"];
    let (mut found, mut bad) = (Vec::new(), 0);
    for cells in table(folder, "flicker.csv", &columns, problems) {
        let [sequence, method, spp, metric, value] =
            [0, 1, 2, 3, 4].map(|i: usize| cells[i].as_str());
        push(&mut found, &mut bad, sequence.to_owned(), (method, spp), metric, value);
    }
    tell_bad("flicker.csv", bad, problems);
    found
}

/// Adds a figure, or one to `bad` where it is none. A value left empty is not finite, and has no row.
fn push(
    found: &mut Vec<Row>,
    bad: &mut usize,
    scene: String,
    (method, spp): (&str, &str),
    metric: &str,
    value: &str,
) {
    let count = if spp.is_empty() { Some(None) } else { spp.parse().ok().map(Some) };
    match (count, value.parse::<f64>()) {
        (Some(spp), Ok(value)) if value.is_finite() => {
            let (method, metric) = (method.to_owned(), metric.to_owned());
            found.push(Row { scene, method, spp, metric, value });
        }
        _ if value.is_empty() => {}
        _ => *bad += 1,
    }
}

fn tell_bad(name: &str, bad: usize, problems: &mut Vec<String>) {
    if bad > 0 {
        let lines = if bad == 1 { "line" } else { "lines" };
        problems.push(format!("{bad} {lines} of {name} cannot be read: left out"));
    }
}

/// The cells of a CSV file, these columns of each line; what is wrong becomes a sentence.
pub(super) fn table(
    folder: &Path,
    name: &str,
    columns: &[&str],
    problems: &mut Vec<String>,
) -> Vec<Vec<String>> {
    let Some(bytes) = bytes_of(&folder.join(name), problems) else { return Vec::new() };
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(bytes.as_slice());
    let text = |cell: &[u8]| clean(&String::from_utf8_lossy(cell));
    let heads: Vec<String> = match reader.byte_headers() {
        Ok(heads) => heads.iter().map(text).collect(),
        Err(error) => {
            problems.push(format!("{name} cannot be read: {error}"));
            return Vec::new();
        }
    };
    let mut places = Vec::new();
    for column in columns {
        match heads.iter().position(|head| head == column) {
            Some(place) => places.push(place),
            None => problems.push(format!("{name} has no column `{column}`")),
        }
    }
    if places.len() < columns.len() {
        return Vec::new();
    }
    let (mut rows, mut short) = (Vec::new(), 0);
    for record in reader.byte_records().flatten() {
        let cells: Option<Vec<String>> =
            places.iter().map(|&place| record.get(place).map(text)).collect();
        match cells {
            Some(cells) => rows.push(cells),
            None => short += 1,
        }
    }
    tell_bad(name, short, problems);
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(name: &str, text: &[u8]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
        folder
    }

    #[test]
    fn lines_that_are_none_are_counted_and_left_out() {
        let text = b"kind,scene,method,lobe,parameter,spp,measure,value\n\
            trial,s,m,,,4,ns_per_pixel,12.5\n\
            prefilter,t,m,ggx,0.2,,seconds,1e-3\n\
            trial,s,m,,,4,ns_per_pixel,NaN\n\
            trial,s,m,,,four,ns_per_pixel,1\n\
            trial,s\n\
            trial,s,\xff\x1bm,,,1,ns_per_pixel,3\n\
            trial,s,m,,,1,ns_per_pixel,\n";
        let mut problems = Vec::new();
        let rows = costs(with("costs.csv", text).path(), &mut problems);
        let short: Vec<_> = rows.iter().map(|r| (r.spp, r.metric.as_str(), r.value)).collect();
        let expected = [
            (Some(4), "ns_per_pixel", 12.5),
            (None, "prefilter_seconds", 1e-3),
            (Some(1), "ns_per_pixel", 3.0),
        ];
        assert_eq!(short, expected);
        assert_eq!(rows[2].method, "\u{fffd} m");
        let told = [
            "1 line of costs.csv cannot be read: left out",
            "2 lines of costs.csv cannot be read: left out",
        ];
        assert_eq!(problems, told);
    }

    #[test]
    fn a_file_without_its_columns_is_told_of() {
        let mut problems = Vec::new();
        assert!(
            metrics_csv(with("metrics.csv", b"texture,value\na,1\n").path(), &mut problems)
                .is_empty()
        );
        assert!(
            problems.contains(&"metrics.csv has no column `metric`".to_owned()),
            "{problems:?}"
        );
        problems.clear();
        assert!(costs(with("x", b"").path(), &mut problems).is_empty());
        assert_eq!(problems, ["costs.csv is missing"]);
        problems.clear();
        assert!(
            metrics_json(with("metrics.json", b"{\"scenes\": [{\"slug").path(), &mut problems)
                .is_none()
        );
        assert!(problems[0].starts_with("metrics.json cannot be read: EOF"), "{problems:?}");
    }
}
