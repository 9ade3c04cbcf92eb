//! What a report shows, in the order it shows it; the templates turn it into Markdown and HTML.

use minijinja::context;
use minijinja::value::Serde;
use serde::Serialize;

use super::answer::answer;
use super::contest::{Comparison, unique};
use super::figure::Figure;
use super::figures::Figures;
use super::program::Program;
use super::ranking;
use super::source::Lines;
use super::split;
use super::tables::{self, Table};
use super::template::render;
use super::tidy;
use super::viewer::pack;
use super::words;
use crate::experiment::results::{Costs, MethodInfo, Results, TextureInfo};

/// A report before it is set.
#[derive(Serialize)]
pub struct Page<'a> {
    name: &'a str,
    title: &'a str,
    question: &'a str,
    answer: Vec<String>,
    ranking: Table,
    normalising: Option<Table>,
    dagger: Option<String>,
    settings: Vec<SettingTables>,
    others: Option<Table>,
    methods: &'a [MethodInfo],
    textures: &'a [TextureInfo],
    shadings: Vec<Definition<'a>>,
    metrics: Vec<Definition<'a>>,
    figures: &'a Figures,
    /// How to read the figures of distributions.
    reading: &'static str,
    spec: &'a str,
    seed: u64,
    program: Program,
    /// `metrics.csv`, packed, for the rows behind figures.
    rows: String,
}

/// The tables of one setting.
#[derive(Serialize)]
struct SettingTables {
    name: String,
    choice: Option<Table>,
    winners: Table,
    split: Option<Table>,
    tables: Vec<Table>,
}

/// A word and what it means.
#[derive(Serialize)]
pub struct Definition<'a> {
    word: &'a str,
    meaning: String,
}

impl<'a> Page<'a> {
    /// The report on these results.
    pub fn of(results: &'a Results, costs: &Costs, figures: &'a Figures) -> Self {
        let comparison = Comparison::of(results);
        let lines = Lines::of(results);
        let traced = |mut table: Table| {
            lines.trace(&mut table);
            table
        };
        let settings = comparison.settings.iter().map(|setting| SettingTables {
            name: setting.name.clone(),
            choice: ranking::choice(&comparison, setting).map(traced),
            winners: traced(tables::winners(setting)),
            split: split::split(&comparison, setting).map(traced),
            tables: setting
                .scales
                .iter()
                .map(|s| traced(tables::at_scale(&comparison, setting, s)))
                .collect(),
        });
        Self {
            name: &results.name,
            title: &results.title,
            question: &results.question,
            answer: answer(&comparison),
            ranking: traced(ranking::ranking(&comparison, costs)),
            normalising: ranking::normalising(&comparison).map(traced),
            dagger: tables::dagger(&results.methods),
            settings: settings.collect(),
            others: tables::other_metrics(&comparison).map(traced),
            methods: &results.methods,
            textures: &results.textures,
            shadings: shadings(results),
            metrics: metrics(results),
            figures,
            reading: words::DISTRIBUTIONS,
            spec: &results.spec,
            seed: results.seed,
            program: Program::this(),
            rows: pack::packed(&tidy::csv(results)),
        }
    }
}

/// The shadings that scenes use.
pub fn shadings(results: &Results) -> Vec<Definition<'_>> {
    let names = unique(results.scenes.iter().map(|s| s.key.shading.as_str()));
    let define = |word| Definition { word, meaning: words::shading_formula(word).into() };
    names.into_iter().map(define).collect()
}

/// The metrics that trials were scored by.
pub fn metrics(results: &Results) -> Vec<Definition<'_>> {
    let scores = results.scenes.iter().flat_map(|s| &s.trials).flat_map(|t| &t.scores);
    let probed = results.scenes.iter().any(|s| !s.probes.is_empty());
    let probed = ["ndf_l1", "ndf_kl", "ndf_wasserstein"].into_iter().filter(|_| probed);
    let names = unique(scores.map(|s| s.metric.as_str()).chain(probed));
    let define = |word| Some(Definition { word, meaning: words::metric_formula(word)? });
    names.into_iter().filter_map(define).collect()
}

/// `report.md`.
pub fn markdown(page: &Page) -> String {
    render("report.md", context! { page => Serde(page) })
}

/// `report.html`.
pub fn html(page: &Page) -> String {
    render("report.html", context! { page => Serde(page) })
}

/// `costs.md`.
pub fn costs(title: &str, intro: &str, plot: Option<&Figure>, tables: &[Table]) -> String {
    render("costs.md", context! { title, intro, plot => Serde(plot), tables => Serde(tables) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_markdown_report() {
        let (results, costs) = (fixture::results(), fixture::costs());
        let figures = Figures::of(&results, &costs);
        let mut page = Page::of(&results, &costs, &figures);
        page.program = Program::fixed();
        insta::assert_snapshot!(markdown(&page));
    }

    #[test]
    fn an_empty_experiment_has_a_report() {
        let mut results = fixture::results();
        results.scenes.clear();
        results.textures.clear();
        let figures = Figures::of(&results, &fixture::costs());
        let page = Page::of(&results, &fixture::costs(), &figures);
        assert!(markdown(&page).contains("Nothing was measured"));
        assert!(html(&page).contains("Nothing was measured"));
    }

    #[test]
    fn the_page_escapes_hostile_names_and_reaches_for_nothing() {
        let mut results = fixture::results();
        let hostile = "<script>alert(1)</script>\" onload=\"x";
        results.textures[0].name = hostile.into();
        results.title = hostile.into();
        for scene in &mut results.scenes {
            scene.key.texture = hostile.into();
        }
        let page =
            html(&Page::of(&results, &fixture::costs(), &Figures::of(&results, &fixture::costs())));
        assert!(page.contains("&lt;script&gt;alert(1)"));
        assert!(!page.contains("<script>alert"));
        assert!(!page.contains("\" onload=\""));
        for outside in ["http:", "https:", "src=\"/", "url(", "@import", "<link"] {
            assert!(!page.contains(outside), "{outside}");
        }
    }
}
