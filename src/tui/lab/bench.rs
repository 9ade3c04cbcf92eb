//! A scene under work: what is there of it, and what comes next.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::told::{Finding, Score, Wanted};
use crate::experiment::preview::{Stock, Wish};
use crate::method::{Method, PrefilterError, Prefiltered, Progress};
use crate::metric::{self, equivalent_samples};
use crate::render::{Converged, Film, Filtered, PixelSampler, average, reference_replicate, trial};
use crate::scene::StagedScene;

/// Samples a pixel of one replicate of the reference.
const REPLICATE: u32 = 16;
/// Replicates that make the first reference, a fair one, and the last: they need two to know their error.
const REPLICATES: [usize; 3] = [2, 8, 64];
/// Samples a pixel of the brute-force curve beyond the first.
const CURVE: [u32; 4] = [2, 4, 16, 64];
/// Prefilters of more work than this a texel, in unfiltered samples, wait until all else was looked at.
const SLOW: f64 = 20.0;
/// Prefiltered maps kept for scenes to come.
const KEPT: usize = 24;

/// A piece of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// One more replicate of the reference.
    Replicate,
    /// A method's image, its map built before if need be.
    Image(usize),
    /// The unfiltered image of this many samples.
    Curve(u32),
}

/// A scene under work.
pub struct Bench {
    /// What was asked for.
    pub wanted: Wanted,
    /// The scene.
    pub staged: Arc<StagedScene>,
    /// The maps that are built, one a method.
    pub maps: Vec<Option<Arc<dyn Prefiltered>>>,
    methods: Vec<Box<dyn Method>>,
    /// Why methods take no part, of those that do not.
    refused: Vec<Option<String>>,
    films: Vec<Option<Arc<Film>>>,
    replicates: Vec<Film>,
    reference: Option<Converged>,
    curve: Vec<(u32, Film)>,
}

/// Renderings that an image's time is the least of, as long as they take no longer than this.
const RENDERINGS: usize = 4;
const SHORT: Duration = Duration::from_millis(60);

/// Maps that were built, with what they are of, the latest last.
pub type Shelf = VecDeque<(String, Arc<dyn Prefiltered>)>;

impl Bench {
    /// Puts the scene together.
    ///
    /// # Errors
    /// Why that cannot be, a sentence.
    pub fn new(wanted: Wanted, stock: &mut Stock) -> Result<Self, String> {
        let wish = Wish { texture: None, texels_per_pixel: None, spp: wanted.spp, frame: 0 };
        let staged = stock.stage_one(&wanted.spec, &wish).map_err(|error| error.to_string())?;
        let methods: Vec<_> = wanted.spec.sweep.methods.iter().map(|m| m.build()).collect();
        let count = methods.len();
        Ok(Self {
            wanted,
            staged: Arc::new(staged),
            maps: vec![None; count],
            methods,
            refused: vec![None; count],
            films: vec![None; count],
            replicates: Vec::new(),
            reference: None,
            curve: Vec::new(),
        })
    }

    /// What to do next; None if all is done. What is looked at comes first, then what is fast, and the reference
    /// converges in between.
    pub fn next(&self) -> Option<Step> {
        let [first, fair, last] = REPLICATES;
        let missing = |m: &usize| self.refused[*m].is_none() && self.films[*m].is_none();
        let slow = |m: &usize| self.methods[*m].prefilter_work() > SLOW && self.maps[*m].is_none();
        let all = || (0..self.methods.len()).filter(missing);
        if self.replicates.len() < first {
            return Some(Step::Replicate);
        }
        let mut shown = self.wanted.first.iter().copied().filter(|m| *m < self.methods.len());
        if let Some(method) = shown.find(missing).or_else(|| all().find(|m| !slow(m))) {
            return Some(Step::Image(method));
        }
        if self.replicates.len() < fair {
            return Some(Step::Replicate);
        }
        let drawn = |spp: &u32| self.curve.iter().any(|(there, _)| there == spp);
        if let Some(spp) = CURVE.into_iter().find(|spp| !drawn(spp)) {
            return Some(Step::Curve(spp));
        }
        if let Some(method) = all().next() {
            return Some(Step::Image(method));
        }
        (self.replicates.len() < last).then_some(Step::Replicate)
    }

    /// Does a step; what it gave. Stops early if `cancelled` says so, and then has done nothing. A long one tells how
    /// far it is as it goes.
    pub fn work(&mut self, step: Step, shelf: &mut Shelf, watch: &Watch) -> Vec<Finding> {
        match step {
            Step::Replicate => self.replicate(watch),
            Step::Image(method) => self.image(method, shelf, watch),
            Step::Curve(spp) => self.extend_curve(spp, watch),
        }
    }

    fn replicate(&mut self, watch: &Watch) -> Vec<Finding> {
        let (staged, spec) = (&self.staged, &self.wanted.spec);
        let truth = (spec.reference.truth, &staged.map, &staged.material.base);
        let sampler = PixelSampler::new(REPLICATE);
        // Replicate 0 is the methods' own.
        let number = 1 + self.replicates.len() as u32;
        let (view, cancelled) = (&staged.view, watch.cancelled);
        let film = reference_replicate(view, truth, &sampler, spec.seed, number, cancelled);
        let Ok(film) = film else { return Vec::new() };
        self.replicates.push(film);
        let count = self.replicates.len();
        if !count.is_power_of_two() || count < 2 {
            return Vec::new();
        }
        let converged = average(&self.replicates, REPLICATE * count as u32);
        let (film, spp, rmse) = (Arc::new(converged.film.clone()), converged.spp, converged.rmse);
        self.reference = Some(converged);
        vec![Finding::Reference { film, spp, rmse }, Finding::Scores(self.scores())]
    }

    fn image(&mut self, method: usize, shelf: &mut Shelf, watch: &Watch) -> Vec<Finding> {
        let mut findings = Vec::new();
        let map = match self.map(method, shelf, watch) {
            Some((map, built)) => {
                findings.push(built);
                map
            }
            None if self.refused[method].is_some() => {
                let reason = self.refused[method].clone().unwrap_or_default();
                return vec![Finding::Refused { method, reason }];
            }
            None => return findings,
        };
        if let Some((film, secs)) = self.timed(method, map.as_ref(), watch) {
            let cpu_secs = secs * rayon::current_num_threads() as f64;
            let ns_per_pixel = cpu_secs * 1e9 / film.pixels().len() as f64;
            let film = Arc::new(film);
            self.films[method] = Some(Arc::clone(&film));
            findings.push(Finding::Image { method, film, ns_per_pixel });
            findings.push(Finding::Scores(self.scores()));
        }
        findings
    }

    /// A method's map, the one there is, the one of an earlier scene, or one built now, and what it took. None if the
    /// method refuses, which is kept, or if the work is cancelled.
    fn map(
        &mut self,
        method: usize,
        shelf: &mut Shelf,
        watch: &Watch,
    ) -> Option<(Arc<dyn Prefiltered>, Finding)> {
        let texels = (self.staged.map.width() * self.staged.map.height()) as f64;
        let built = |map: Arc<dyn Prefiltered>, secs: f64| {
            let bytes_per_texel = map.bytes() as f64 / texels;
            (map, Finding::Built { method, secs, bytes_per_texel })
        };
        let key = self.key(method);
        let kept = || shelf.iter().find(|(kept, _)| *kept == key).map(|(_, map)| Arc::clone(map));
        if let Some(map) = self.maps[method].clone().or_else(kept) {
            self.maps[method] = Some(Arc::clone(&map));
            return Some(built(map, 0.0));
        }
        let progress = Telling { label: &self.wanted.spec.sweep.methods[method].label, watch };
        let start = Instant::now();
        let base = &self.staged.material.base;
        match self.methods[method].prefilter(&self.staged.map, base, &progress) {
            Ok(map) => {
                let map: Arc<dyn Prefiltered> = map.into();
                shelf.push_back((key, Arc::clone(&map)));
                if shelf.len() > KEPT {
                    shelf.pop_front();
                }
                self.maps[method] = Some(Arc::clone(&map));
                Some(built(map, start.elapsed().as_secs_f64()))
            }
            Err(PrefilterError::Refused(reason)) => {
                self.refused[method] = Some(reason.to_string());
                None
            }
            Err(PrefilterError::Cancelled) => None,
        }
    }

    /// All that a method's map depends on.
    fn key(&self, method: usize) -> String {
        let spec = &self.wanted.spec;
        let of = &spec.sweep.methods[method];
        let (texture, lobe) = (&spec.sweep.textures[0], self.staged.material.base);
        format!("{texture:?} {lobe:?} {} {:?}", of.name, of.values)
    }

    fn render(
        &self,
        method: usize,
        map: &dyn Prefiltered,
        spp: u32,
        watch: &Watch,
    ) -> Option<Film> {
        let lookup = self.wanted.spec.sweep.methods[method].lookup;
        let view = crate::render::View { lookup, ..self.staged.view.clone() };
        let card = self.methods[method].card();
        let filtered = Filtered { map: &self.staged.map, card, prefiltered: map };
        let sampler = PixelSampler::new(spp);
        trial(&view, &filtered, &sampler, self.wanted.spec.seed, 0, watch.cancelled).ok()
    }

    /// An image and the seconds it took: the least of a few renderings where one is short, as others share the cores.
    fn timed(&self, method: usize, map: &dyn Prefiltered, watch: &Watch) -> Option<(Film, f64)> {
        let start = Instant::now();
        let film = self.render(method, map, self.wanted.spp, watch)?;
        let mut least = start.elapsed();
        for _ in 1..RENDERINGS {
            let again = Instant::now();
            if start.elapsed() > SHORT || self.render(method, map, self.wanted.spp, watch).is_none()
            {
                break;
            }
            least = least.min(again.elapsed());
        }
        Some((film, least.as_secs_f64()))
    }

    fn extend_curve(&mut self, spp: u32, watch: &Watch) -> Vec<Finding> {
        let map = self.brute_force().and_then(|m| Some((m, self.maps[m].clone()?)));
        let film = match map {
            Some((method, map)) => match self.render(method, map.as_ref(), spp, watch) {
                Some(film) => film,
                None => return Vec::new(),
            },
            // No such method in this spec: a curve without this point.
            None => Film::new(0, 0, Vec::new()),
        };
        self.curve.push((spp, film));
        vec![Finding::Scores(self.scores())]
    }

    /// The place of the method without a filter.
    fn brute_force(&self) -> Option<usize> {
        self.wanted.spec.sweep.methods.iter().position(|method| method.label == "unfiltered")
    }

    /// The errors of all images there are, once there is a reference.
    fn scores(&self) -> Vec<Option<Score>> {
        let Some(reference) = &self.reference else { return vec![None; self.films.len()] };
        let rmse = |film: &Film| metric::score("rmse", film, &reference.film);
        let errors: Vec<Option<f64>> =
            self.films.iter().map(|film| film.as_ref().and_then(|film| rmse(film))).collect();
        let first = self.brute_force().and_then(|m| errors[m]).map(|e| (self.wanted.spp, e));
        let drawn = self
            .curve
            .iter()
            .filter(|(spp, film)| *spp > self.wanted.spp && !film.pixels().is_empty());
        let rest = drawn.filter_map(|(spp, film)| Some((*spp, rmse(film)?)));
        let curve: Vec<(u32, f64)> = first.into_iter().chain(rest).collect();
        let score = |error: Option<f64>| {
            let rmse = error?;
            let worth = if curve.len() > 1 { equivalent_samples(&curve, rmse) } else { None };
            Some(Score { rmse, worth })
        };
        errors.into_iter().map(score).collect()
    }
}

/// Who watches over the work.
pub struct Watch<'a> {
    /// Whether to stop.
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
    /// Hears how far a long step is.
    pub tell: &'a (dyn Fn(Finding) + Sync),
}

/// Tells how far a prefilter is.
struct Telling<'a> {
    label: &'a str,
    watch: &'a Watch<'a>,
}

impl Progress for Telling<'_> {
    fn advance(&self, done: usize, total: usize) {
        let part = done as f64 / total.max(1) as f64;
        (self.watch.tell)(Finding::Working(format!("prefiltering for {}", self.label), part));
    }

    fn cancelled(&self) -> bool {
        (self.watch.cancelled)()
    }
}

#[cfg(test)]
mod tests {
    use super::super::setup::Setup;
    use super::*;

    fn bench() -> Bench {
        let text = r#"
            [image]
            width = 24
            height = 18
            [material]
            lobe = "ggx"
            [sweep]
            texture = ["small"]
            method = ["unfiltered"]
            [texture.small]
            pattern = "twill"
            width = 16
            height = 16
        "#;
        let mut setup = Setup::of_draft(
            "t",
            crate::experiment::spec::Draft::of_text(text, None, std::path::Path::new("t.toml"))
                .unwrap(),
        )
        .unwrap();
        setup.draft.set("image", "width", 24);
        setup.draft.set("image", "height", 18);
        let wanted = Wanted { scene: 1, spec: setup.spec().unwrap(), spp: 1, first: vec![4] };
        Bench::new(wanted, &mut Stock::default()).unwrap()
    }

    fn work(bench: &mut Bench, shelf: &mut Shelf, steps: usize) -> Vec<Finding> {
        let watch = Watch { cancelled: &|| false, tell: &|_| () };
        let mut told = Vec::new();
        for _ in 0..steps {
            let Some(step) = bench.next() else { break };
            told.extend(bench.work(step, shelf, &watch));
        }
        told
    }

    #[test]
    fn what_is_looked_at_comes_first() {
        let mut bench = bench();
        let mut shelf = Shelf::new();
        work(&mut bench, &mut shelf, 2);
        assert_eq!(bench.next(), Some(Step::Image(4)));
        bench.wanted.first = vec![7, 0];
        assert_eq!(bench.next(), Some(Step::Image(7)));
    }

    #[test]
    fn all_is_done_in_the_end_and_every_method_has_an_image_or_a_reason() {
        let mut bench = bench();
        let mut shelf = Shelf::new();
        let told = work(&mut bench, &mut shelf, 1000);
        assert_eq!(bench.next(), None);
        let refused = told.iter().filter(|f| matches!(f, Finding::Refused { .. })).count();
        let images = told.iter().filter(|f| matches!(f, Finding::Image { .. })).count();
        assert!(refused > 0, "Fournier takes no GGX lobe");
        assert_eq!(refused + images, bench.methods.len());
        let Some(Finding::Scores(scores)) =
            told.iter().rev().find(|f| matches!(f, Finding::Scores(_)))
        else {
            panic!("no scores")
        };
        let unfiltered = scores[0].unwrap();
        assert_eq!(unfiltered.worth, Some(metric::Equivalent::Samples(1.0)));
        assert_eq!(scores[2], None);
        // A second scene of the same texture and lobe takes the maps from the shelf.
        let mut again = self::bench();
        let told = work(&mut again, &mut shelf, 1000);
        let built = |f: &Finding| matches!(f, Finding::Built { secs, .. } if *secs > 0.0);
        assert!(!told.iter().any(built));
    }

    #[test]
    fn the_same_scene_gives_the_same_images() {
        let films = |bench: &mut Bench| {
            work(bench, &mut Shelf::new(), 1000);
            bench.films.iter().flatten().map(|film| film.digest()).collect::<Vec<_>>()
        };
        assert_eq!(films(&mut bench()), films(&mut bench()));
    }

    #[test]
    fn what_is_cancelled_was_not_done() {
        let mut bench = bench();
        let watch = Watch { cancelled: &|| true, tell: &|_| panic!("told something") };
        assert!(bench.work(Step::Replicate, &mut Shelf::new(), &watch).is_empty());
        assert_eq!(bench.next(), Some(Step::Replicate));
        assert!(bench.replicates.is_empty());
    }
}
