//! Papers' experiments: what is common, what is a part's own, and what is said of mistakes.

use std::path::Path;

use super::{Experiment, PaperKeys, PaperSpec, RowKeys};
use crate::parameter::{Domain, Parameter, Value};

const EXPONENT: Parameter = Parameter {
    name: "exponent",
    meaning: "",
    domain: Domain::Real { default: 50.0, min: 1.0, max: 100.0 },
};

fn papers() -> Vec<PaperKeys> {
    let rows = vec![
        RowKeys { name: "bumps-f1", parameters: &[EXPONENT], parts: &[] },
        RowKeys { name: "bumps-f2", parameters: &[], parts: &["near"] },
    ];
    vec![PaperKeys { name: "bumps-1990", rows }]
}

fn read(text: &str) -> Result<PaperSpec, String> {
    match Experiment::parse(text, Path::new("experiments/bumps.toml"), &papers()) {
        Ok(Experiment::Paper(spec)) => Ok(*spec),
        Ok(Experiment::Sweep(_)) => Err("a sweep".into()),
        Err(error) => Err(error.to_string()),
    }
}

const WHOLE: &str = r#"
paper = "bumps-1990"
[image]
width = 64
height = 32
[sweep]
texture = ["twill"]
method = ["unfiltered"]
[row.bumps-f1]
exponent = 30.0
[part.near]
title = "Near by"
image.width = 16
[part.far]
sweep.texel = 1
"#;

#[test]
fn a_part_is_what_is_common_and_its_own() {
    let spec = read(&WHOLE.replace("[part.far]\nsweep.texel = 1\n", "")).unwrap();
    assert_eq!((spec.name.as_str(), spec.paper), ("bumps", "bumps-1990"));
    let near = &spec.parts[0];
    assert_eq!((near.name.as_str(), near.title.as_str()), ("near", "Near by"));
    assert_eq!((near.image.width, near.image.height), (16, 32));
    let values: Vec<_> = spec.rows.iter().map(|row| (row.row, row.values.iter().next())).collect();
    let thirty = Some(("exponent", &Value::Number(30.0)));
    assert_eq!(values, [("bumps-f1", thirty), ("bumps-f2", None)]);
}

#[test]
fn parts_keep_the_order_of_the_file() {
    let text = WHOLE.replace("sweep.texel = 1", "seed = 2");
    let spec = read(&text).unwrap();
    let names: Vec<_> = spec.parts.iter().map(|part| (part.name.as_str(), part.seed)).collect();
    assert_eq!(names, [("near", 1), ("far", 2)]);
}

#[test]
fn mistakes_are_told_with_their_place() {
    let error = read(WHOLE).unwrap_err();
    assert!(error.contains("bumps.toml:15:7: unknown key `texel` in [sweep]"), "{error}");
    for (from, to, what) in [
        ("\"bumps-1990\"", "\"bump-1990\"", "did you mean \"bumps-1990\"?"),
        ("[row.bumps-f1]", "[row.bumps-f3]", "did you mean `bumps-f1`?"),
        ("exponent = 30.0", "exponent = 0.0", "must be a number from 1 to 100"),
        ("[part.near]", "[part.nearer]", "row `bumps-f2` needs a sweep under [part.near]"),
        ("height = 32", "hight = 32", "unknown key `hight` in [image]"),
    ] {
        let text = WHOLE.replace("sweep.texel = 1", "seed = 2").replace(from, to);
        let error = read(&text).unwrap_err();
        assert!(error.contains(what), "{to}: {error}");
        assert_eq!(error.matches(what).count(), 1, "said once: {error}");
    }
}

#[test]
fn of_a_paper_that_is_not_there_no_more_is_said() {
    let error = read("paper = \"cloth-1990\"\n[row.x]\n").unwrap_err();
    assert!(error.contains("must be \"bumps-1990\"") && !error.contains("unknown key"), "{error}");
}

#[test]
fn without_parts_the_keys_of_sweeps_are_strangers() {
    let error = read("paper = \"bumps-1990\"\n[image]\nwidth = 4\n").unwrap_err();
    assert!(error.contains("unknown key `image`"), "{error}");
}
