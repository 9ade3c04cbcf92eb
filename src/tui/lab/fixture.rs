//! A lab with a small scene in it, for tests.

use std::sync::Arc;
use std::time::SystemTime;

use super::setup::tests::setup;
use super::{Finding, Held, Score, Told, Under};
use crate::metric::Equivalent;
use crate::render::Film;
use crate::tui::message::Message;
use crate::tui::model::{Model, Pane};
use crate::tui::picture::{Depth, Screen};
use crate::tui::update;

/// The lab on a terminal of this size, nothing open.
pub fn empty(size: [u16; 2], depth: Depth) -> Model {
    let mut model = Model::new(size, Screen::plain(depth), SystemTime::UNIX_EPOCH);
    model.pane = Pane::Lab;
    model
}

/// An image: a ramp to the right, so bright.
pub fn film(bright: f32) -> Arc<Film> {
    let pixels = (0..32 * 24).map(|i| bright * (i % 32) as f32 / 32.0).collect();
    Arc::new(Film::new(32, 24, pixels))
}

/// What the threads tell of a scene when it is done: a reference, images of all methods but Fournier's, which takes no
/// part, and what lies under the cursor.
pub fn findings(methods: usize) -> Vec<Finding> {
    let mut all = vec![Finding::Reference { film: film(1.0), spp: 1024, rmse: 0.0125 }];
    for method in 0..methods {
        if method == 2 {
            let reason = "Fournier's peaks are Phong lobes".to_owned();
            all.push(Finding::Refused { method, reason });
            continue;
        }
        all.push(Finding::Built { method, secs: 0.01, bytes_per_texel: 16.0 });
        let ns_per_pixel = 100.0 + 10.0 * method as f64;
        let bright = 1.0 + 0.1 * method as f32;
        all.push(Finding::Image { method, film: film(bright), ns_per_pixel });
    }
    let score = |method: usize| {
        let worth = Some(match method {
            0 => Equivalent::Samples(1.0),
            1 => Equivalent::FewerThan(1),
            3 => Equivalent::MoreThan(64),
            _ => Equivalent::Samples(3.25),
        });
        (method != 2).then(|| Score { rmse: 0.5 / (1.0 + method as f64), worth })
    };
    all.push(Finding::Scores((0..methods).map(score).collect()));
    all.push(Finding::Under(Box::new(under())));
    all.push(Finding::Done);
    all
}

fn under() -> Under {
    let density: Vec<f32> = (0..1297).map(|i| (i % 36) as f32).collect();
    let held =
        Held { method: 0, density: density.clone(), axes: vec![[0.0, 0.5, 0.866]], distance: 0.25 };
    let texels_across = Some(8.0);
    Under { pixel: [16, 12], texels_across, truth: density, methods: vec![held] }
}

/// The lab with a scene that is done.
pub fn full(size: [u16; 2], depth: Depth) -> Model {
    let mut model = empty(size, depth);
    let mut setup = setup();
    setup.draft.set("image", "width", 32);
    setup.draft.set("image", "height", 24);
    let opened = Told::Opened(Ok(Box::new(setup)));
    update(&mut model, Message::Lab(opened));
    let scene = model.lab.scene;
    for finding in findings(model.lab.rows.len()) {
        update(&mut model, Message::Lab(Told::Of(scene, finding)));
    }
    model
}
