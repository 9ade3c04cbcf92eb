//! What a report on things that move shows, in its order; the templates turn it into Markdown and HTML.

use minijinja::context;
use minijinja::value::Serde;
use serde::Serialize;

use super::answer::answer;
use super::reel::Reel;
use super::standing::Race;
use crate::experiment::results::{MethodInfo, Results, TextureInfo};
use crate::report::contest::Comparison;
use crate::report::figures::texture_picture;
use crate::report::page::{Definition, metrics, shadings};
use crate::report::tables;
use crate::report::template::render;

/// Bytes of films, or of animations, that a page holds, as text; sequences have equal shares of it. The rest stands
/// beside it.
const ROOM: usize = 14 << 20;

/// A report before it is set.
#[derive(Serialize)]
pub struct Page<'a> {
    name: &'a str,
    title: &'a str,
    question: &'a str,
    answer: Vec<String>,
    reels: Vec<Reel>,
    dagger: Option<String>,
    methods: &'a [MethodInfo],
    textures: &'a [TextureInfo],
    pictures: Vec<Option<String>>,
    shadings: Vec<Definition<'a>>,
    metrics: Vec<Definition<'a>>,
    spec: &'a str,
    seed: u64,
}

/// The answer in words: what the report opens with.
pub fn lead(results: &Results) -> Vec<String> {
    let spp = Comparison::of(results).spp;
    answer(results, &Race::all(results, spp), spp)
}

impl<'a> Page<'a> {
    /// The report on these results.
    pub fn of(results: &'a Results) -> Self {
        let spp = Comparison::of(results).spp;
        let races = Race::all(results, spp);
        let room = ROOM / races.len().max(1);
        Self {
            name: &results.name,
            title: &results.title,
            question: &results.question,
            answer: answer(results, &races, spp),
            reels: races.iter().map(|race| Reel::of(results, race, spp, room)).collect(),
            dagger: tables::dagger(&results.methods),
            methods: &results.methods,
            textures: &results.textures,
            pictures: results.textures.iter().map(texture_picture).collect(),
            shadings: shadings(results),
            metrics: metrics(results),
            spec: &results.spec,
            seed: results.seed,
        }
    }

    /// Every picture's file with its bytes.
    pub fn files(&self) -> impl Iterator<Item = (String, &[u8])> {
        self.reels.iter().flat_map(Reel::files)
    }
}

/// `report.md`.
pub fn markdown(page: &Page) -> String {
    render("motion.md", context! { page => Serde(page) })
}

/// `report.html`.
pub fn html(page: &Page) -> String {
    render("motion.html", context! { page => Serde(page) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_markdown_report() {
        insta::assert_snapshot!(markdown(&Page::of(&fixture::moving())));
    }

    /// What a page would have to fetch.
    const OUTSIDE: [&str; 6] = ["http:", "https:", "src=\"/", "url(", "@import", "<link"];

    #[test]
    fn the_page_holds_its_films_and_shows_the_first_frame_where_no_script_runs() {
        let results = fixture::moving();
        let page = html(&Page::of(&results));
        assert_eq!(page.matches("<script type=\"application/octet-stream\">").count(), 7);
        assert_eq!(page.matches("alt=\"first frame of ").count(), 7);
        assert_eq!(page.matches("alt=\"flicker map of ").count(), 7);
        assert!(!page.contains("src=\"animations"));
        assert!(OUTSIDE.iter().all(|outside| !page.contains(outside)));
    }

    #[test]
    fn what_finds_no_room_in_the_page_stands_beside_it() {
        let results = fixture::moving();
        let races = Race::all(&results, 1);
        let mut page = Page::of(&results);
        page.reels = vec![Reel::of(&results, &races[0], 1, 0)];
        let text = html(&page);
        assert_eq!(text.matches("src=\"animations/").count(), 7);
        assert_eq!(text.matches("prefers-reduced-motion: reduce)\" srcset=\"data:").count(), 7);
        assert!(text.contains("no room for the films"));
        for (name, _) in page.files().filter(|(name, _)| name.starts_with("animations/")) {
            assert!(text.contains(&name), "{name}");
        }
    }

    #[test]
    fn a_still_reference_and_missing_trials_have_a_report() {
        let mut results = fixture::moving();
        results.scenes.iter_mut().for_each(|scene| scene.trials.clear());
        let still = results.scenes[0].reference.film.clone();
        results.scenes.iter_mut().for_each(|scene| scene.reference.film = still.clone());
        results.sequences = crate::experiment::sequence::sequences(&results.scenes);
        let page = Page::of(&results);
        let (text, page) = (markdown(&page), html(&page));
        assert!(text.contains("Nothing can be said of flicker") && page.contains("may be still"));
        assert!(!text.contains("NaN") && !text.contains("inf "), "{text}");
    }
}
