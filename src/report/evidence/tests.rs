use super::*;
use crate::evidence::*;
use figures::of as draw;
use page::{Page, html, markdown};

fn written(evidence: &Evidence, secs: &[(String, f64)]) -> Vec<(String, Vec<u8>)> {
    let folder = tempfile::tempdir().unwrap();
    let files = write_evidence(evidence, secs, folder.path()).unwrap();
    let name = |f: &PathBuf| f.strip_prefix(folder.path()).unwrap().to_string_lossy().into_owned();
    files.iter().map(|file| (name(file), std::fs::read(file).unwrap())).collect()
}

#[test]
fn only_costs_vary() {
    let evidence = fixture::evidence();
    let once = written(&evidence, &fixture::secs());
    assert!(once == written(&evidence, &fixture::secs()), "the same evidence, the same bytes");
    let mut slower = evidence.clone();
    slower.exhibits[0].timed.claims[0] = Claim::at_most("minutes", "80", 80.0, 81.0);
    slower.exhibits[0].timed.tables.clear();
    let again = written(&slower, &[("fournier-f3".into(), 99.0)]);
    let differ = once.iter().zip(&again).filter(|(a, b)| a != b).map(|(a, _)| a.0.as_str());
    assert_eq!(differ.collect::<Vec<_>>(), ["costs.csv", "costs.md"]);
}

#[test]
fn every_claim_and_number_is_in_the_data() {
    let evidence = fixture::evidence();
    let bytes = data::csv(&evidence);
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), data::COLUMNS);
    let claims: usize = evidence.exhibits.iter().map(|e| e.claims.len()).sum();
    assert_eq!(reader.records().map(Result::unwrap).count(), claims);
    let manual = include_str!("../../../docs/results.md");
    for column in data::COLUMNS {
        assert!(manual.contains(&format!("| `{column}` |")), "{column} is not in the manual");
    }
    // What was read back is what was written, but for films, times and what is not finite.
    let text = String::from_utf8(data::json(&evidence)).unwrap();
    let read: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(read["exhibits"][0].get("timed").is_none());
    let figures = &read["exhibits"][0]["figures"];
    let disc: Disc = serde_json::from_value(figures[0]["drawing"]["discs"][0].clone()).unwrap();
    let Drawing::Discs(discs) = &evidence.exhibits[0].figures[0].drawing else { unreachable!() };
    assert_eq!(disc, discs[0]);
    let (name, table) = data::tables(&evidence).next().unwrap();
    assert_eq!(name, "tables/fournier-f3-levels.csv");
    let text = String::from_utf8(table).unwrap();
    assert_eq!(text.lines().nth(2), Some("16 × 16,256,52,0.012345"));
    assert_eq!(text.lines().nth(1), Some("32 × 32,1024,0,"));
}

#[test]
fn the_markdown_report() {
    let evidence = fixture::evidence();
    insta::assert_snapshot!(markdown(&Page::of(&evidence, draw(&evidence))));
}

#[test]
fn hostile_text_is_escaped_and_nothing_is_reached_for() {
    let mut evidence = fixture::evidence();
    let hostile = "<script>alert(1)</script>\" onload=\"x ../../up | `*_";
    let Evidence { title, question, paper, spec, .. } = &mut evidence;
    for text in [title, question, paper, spec] {
        *text = hostile.into();
    }
    evidence.parts = vec![(hostile.into(), hostile.into())];
    for exhibit in &mut evidence.exhibits {
        (exhibit.row, exhibit.title) = (hostile.into(), hostile.into());
        exhibit.remarks = vec![hostile.into()];
        exhibit.parts = vec![hostile.into(), "unknown".into()];
        for claim in &mut exhibit.claims {
            let Claim { what, rule, because, paper, here, .. } = claim;
            [what, rule, because].into_iter().for_each(|text| *text = hostile.into());
            [paper, here].into_iter().for_each(|quantity| *quantity = hostile.into());
        }
        for figure in &mut exhibit.figures {
            (figure.name, figure.caption) = (hostile.into(), hostile.into());
            if let Drawing::Images(images) = &mut figure.drawing {
                for panel in &mut images.panels {
                    let Panel { name, label, remark, .. } = panel;
                    [name, label, remark].into_iter().for_each(|text| *text = hostile.into());
                }
            }
        }
        for table in &mut exhibit.tables {
            (table.name, table.caption) = (hostile.into(), hostile.into());
            table.head = table.head.iter().map(|_| hostile.into()).collect();
        }
    }
    let page = html(&Page::of(&evidence, draw(&evidence)));
    assert!(page.contains("&lt;script&gt;alert(1)"));
    for outside in ["<script>alert", "\" onload=\"", "http:", "https:", "src=\"/", "url(", "<link"]
    {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(!page.contains("href=\".."));
    let text = markdown(&Page::of(&evidence, draw(&evidence)));
    // The spec stands as it is, as code.
    let (before, _) = text.split_once("```toml").unwrap();
    assert!(!before.contains("<script>"), "{text}");
    let files = written(&evidence, &[(hostile.into(), f64::NAN)]);
    assert!(files.iter().all(|(name, _)| !name.contains("/..") && !name.contains('<')));
}

#[test]
fn odd_evidence_has_a_report() {
    assert!(html(&Page::of(&Evidence::default(), vec![])).contains("Nothing of the paper"));
    let film = |width, height, value| {
        Some(std::sync::Arc::new(crate::render::Film::new(
            width,
            height,
            vec![value; width * height],
        )))
    };
    let panel =
        |film| Panel { name: String::new(), label: String::new(), remark: String::new(), film };
    let images = Images {
        panels: vec![
            panel(None),
            panel(film(0, 0, 0.0)),
            panel(film(3, 2, f32::NAN)),
            panel(film(2, 2, f32::INFINITY)),
        ],
        white: Some(f64::NAN),
        reference: Some(2),
        across: 0,
    };
    let none = Images { panels: vec![], white: None, reference: Some(7), across: 3 };
    let long = "long ".repeat(200);
    let drawings = [
        Drawing::Images(images),
        Drawing::Images(none),
        Drawing::Discs(vec![]),
        Drawing::Fields(vec![]),
        Drawing::Lobes(vec![]),
        Drawing::Nets(vec![]),
        Drawing::Sketches(vec![]),
    ];
    let figures = drawings.into_iter().map(|drawing| Figure::new(&long, long.clone(), drawing));
    let exhibit = Exhibit {
        row: long.clone(),
        claims: vec![Claim::near(long.clone(), f64::NAN, f64::INFINITY, 0.1)],
        figures: figures.collect(),
        tables: vec![Table { rows: vec![vec![], vec![1usize.into()]], ..Table::default() }],
        ..Exhibit::default()
    };
    let evidence = Evidence { exhibits: vec![Exhibit::default(), exhibit], ..Evidence::default() };
    assert!(written(&evidence, &[]).len() > 5);
}

#[test]
fn verdicts_are_told_in_words() {
    let evidence = fixture::evidence();
    let page = html(&Page::of(&evidence, draw(&evidence)));
    assert!(page.contains("6 rows of the paper: 1 is reproduced, 2 differ and 3 cannot be held"));
    assert!(page.contains("2 of 3 claims hold; of these with 7 peaks: paper 5, here 9"));
    assert!(page.contains("peaks for a hemisphere: paper 7, here not a number"));
}
