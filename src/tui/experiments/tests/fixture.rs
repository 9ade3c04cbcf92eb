//! A pane with something in it.

use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use crate::experiment::results::Score;
use crate::experiment::runner::RunEvent;
use crate::tui::experiments::{Board, Experiments, Told};
use crate::tui::library::{Kind, Listed, Report};

/// A time of day that is easy to tell: 12:00:00 and some seconds.
pub fn at(secs: u64) -> SystemTime {
    SystemTime::UNIX_EPOCH + Duration::from_secs(20_000 * 86_400 + 43_200 + secs)
}

/// The methods of all sweeps here.
pub fn methods() -> Vec<(String, String)> {
    let named = |label: &str, name: &str| (label.to_owned(), name.to_owned());
    vec![
        named("unfiltered", "unfiltered"),
        named("averaged", "averaged"),
        named("fournier", "fournier"),
        named("olano-north", "olano-north"),
        named("olano-north-printed", "olano-north-printed"),
    ]
}

fn listed(name: &str, title: &str, question: &str) -> Listed {
    Listed {
        name: name.into(),
        path: PathBuf::from(format!("experiments/{name}.toml")),
        title: title.into(),
        question: question.into(),
        kind: Some(Kind::Sweep),
        size: "8 scenes, 5 methods, 96 trials".into(),
        methods: methods(),
        problem: None,
    }
}

/// Experiments: one with a report, one whose file is wrong, one without a report, a paper.
pub fn list() -> Vec<Listed> {
    let mut odd = listed("odd", "odd", "");
    odd.problem = Some("experiments/odd.toml:5:1: unknown key `widht` in [image]".into());
    let mut paper =
        listed("blinn-1978", "Blinn 1978", "Which of the paper's figures come out the same?");
    (paper.kind, paper.size) = (Some(Kind::Paper), "12 rows, 9 sweeps, 410 trials".into());
    vec![
        paper,
        odd,
        listed(
            "quick",
            "A quick look at every filter",
            "Does each filter keep the highlight of a weave and of random bumps, small and smaller?",
        ),
        listed("sphere", "Bumps on a ball", "What does a silhouette do to filters?"),
    ]
}

/// The report of `quick`, three hours old.
pub fn reports() -> Vec<Report> {
    vec![Report {
        name: "quick".into(),
        folder: "reports/quick".into(),
        kind: Kind::Sweep,
        written: Some(at(0) - Duration::from_secs(3 * 3600)),
        lead: vec![
            "Choose fournier at 16 texels a pixel: it leaves 16 % of the RMSE of unfiltered."
                .into(),
            "In 1 of 8 scenes no filter was closer than unfiltered.".into(),
        ],
        problems: vec![],
    }]
}

/// Samples a pixel and RMSE of a method's trials.
fn curve(method: usize, scene: usize) -> Vec<(u32, f64)> {
    let scale = 1.0 + 0.5 * scene as f64;
    match method {
        0 => (0..5).map(|i| (4u32.pow(i), scale * 1.2 / f64::from(2u32.pow(i)))).collect(),
        1 => vec![(1, 0.9 * scale), (4, 0.8 * scale)],
        m => vec![(1, scale * 0.6 / m as f64), (4, scale * 0.5 / m as f64)],
    }
}

/// What a run tells of a scene: its reference, then its trials up to this method.
pub fn scene(number: usize, slug: &str, methods_done: usize) -> Vec<RunEvent> {
    let name = slug.to_owned();
    let mut told = vec![
        RunEvent::Scene { slug: name.clone(), part: None, number, of: 8 },
        RunEvent::Converged { scene: name.clone(), rmse: 0.02 },
    ];
    for (place, (label, _)) in methods().into_iter().enumerate().take(methods_done) {
        for (spp, rmse) in curve(place, number) {
            let score =
                |metric: &str, value| Score { metric: metric.into(), value, interval: None };
            told.push(RunEvent::Scored {
                scene: name.clone(),
                method: label.clone(),
                spp,
                scores: vec![
                    score("rmse", rmse),
                    score("ssim", 1.0 - 0.4 * rmse),
                    score("energy", 1.0),
                ],
                ns_per_pixel: f64::from(spp) * (40.0 + 30.0 * place as f64),
                kept: false,
            });
        }
    }
    let distances: Vec<(String, f64)> =
        methods().into_iter().zip([0.8, 0.6, 0.12, 0.3, 0.33]).map(|((m, _), d)| (m, d)).collect();
    if methods_done == methods().len() {
        told.push(RunEvent::Probed { scene: name, distances });
    }
    told
}

/// The figures of a report of two scenes.
pub fn board() -> Board {
    let mut board = Board::new(&methods());
    for (number, slug) in [(1, "twill-2-texels"), (2, "twill-16-texels")] {
        scene(number, slug, 5).iter().for_each(|event| board.take(None, event));
    }
    board
}

/// A pane that has read its list and the figures of `quick`, which is chosen.
pub fn pane() -> Experiments {
    let mut pane = Experiments::default();
    pane.prefer("quick");
    pane.hear(Told::Listed(list(), reports()), at(0));
    let told = Told::Read { name: "quick".into(), board: Box::new(board()), problems: vec![] };
    pane.hear(told, at(0));
    pane
}
