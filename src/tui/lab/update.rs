//! What keys, and what the threads tell, do to the lab.

use ratatui::layout::Position;

use super::view::Layout;
use super::{By, Finding, Focus, Lab, Look, Order, Row, Setting, Setup, Told, Wanted};
use crate::experiment::spec::Shape;
use crate::job;
use crate::method;
use crate::tui::keys::{Action, Pressed};
use crate::tui::message::Effect;
use crate::tui::model::Model;
use crate::tui::viewer::{self, Shot, Zoom};

/// Steps of the keys that change much.
const MUCH: i32 = 4;

/// Opens an experiment or a map.
pub fn open(model: &mut Model, name: &str) -> Vec<Effect> {
    model.lab.opening = Some(name.to_owned());
    vec![Effect::Lab(Order::Open(name.to_owned()))]
}

/// The lab is shown: goes on rendering, or opens what to begin with.
pub fn enter(model: &mut Model) -> Vec<Effect> {
    match &model.lab.setup {
        None if model.lab.opening.is_none() => open(model, job::DEFAULT),
        None => Vec::new(),
        Some(_) if model.lab.done => Vec::new(),
        Some(_) => show(&model.lab),
    }
}

/// Does what a key asks.
pub fn act(model: &mut Model, pressed: Pressed) -> Vec<Effect> {
    let look = Layout::of(model).look(model);
    let lab = &mut model.lab;
    let before = (lab.shown(), lab.viewer.cursor);
    let effects = match pressed.action {
        Action::NextFocus => return turn_focus(lab, 1),
        Action::PreviousFocus => return turn_focus(lab, -1),
        Action::Save => return save(model),
        Action::Up => return choose(model, -1),
        Action::Down => return choose(model, 1),
        Action::SortNext => {
            lab.by = match lab.by {
                By::Number => By::Error,
                By::Error => By::Time,
                By::Time => By::Number,
            };
            return Vec::new();
        }
        Action::Choose => {
            let order = lab.order();
            if let Some(method) = order.get(lab.row) {
                lab.viewer.pick(method + 1);
            }
            Vec::new()
        }
        action => match change(action, lab) {
            Some((setting, steps)) => return turn(model, setting, steps),
            None => {
                lab.viewer.act(pressed, look);
                Vec::new()
            }
        },
    };
    follow(model, before, effects)
}

/// What a key changes, and by how many steps.
fn change(action: Action, lab: &Lab) -> Option<(Setting, i32)> {
    let chosen = || {
        let all = Setting::all(lab.spec.as_ref()?);
        all.get(lab.setting.min(all.len().saturating_sub(1))).copied()
    };
    Some(match action {
        Action::Less => (chosen()?, -1),
        Action::More => (chosen()?, 1),
        Action::MuchLess => (chosen()?, -MUCH),
        Action::MuchMore => (chosen()?, MUCH),
        Action::Texture => (Setting::Texture, 1),
        Action::TextureBack => (Setting::Texture, -1),
        Action::Surface => (Setting::Surface, 1),
        Action::SurfaceBack => (Setting::Surface, -1),
        Action::Farther => (Setting::Texels, 1),
        Action::Nearer => (Setting::Texels, -1),
        Action::LightUp => (Setting::LightElevation, 1),
        Action::LightDown => (Setting::LightElevation, -1),
        Action::LightLeft => (Setting::LightAzimuth, 1),
        Action::LightRight => (Setting::LightAzimuth, -1),
        Action::CameraLeft => (Setting::CameraAzimuth, -1),
        Action::CameraRight => (Setting::CameraAzimuth, 1),
        // A wider Blinn-Phong lobe has a smaller exponent.
        Action::Wider => (Setting::Width, wider(lab)),
        Action::Narrower => (Setting::Width, -wider(lab)),
        Action::Lookup => (Setting::Lookup, 1),
        _ => return None,
    })
}

fn wider(lab: &Lab) -> i32 {
    let phong = |spec: &crate::experiment::spec::Spec| spec.sweep.lobes[0].name() == "blinn-phong";
    if lab.spec.as_ref().is_some_and(phong) { -1 } else { 1 }
}

/// Changes a setting, unless the scene that comes of it is none.
fn turn(model: &mut Model, setting: Setting, steps: i32) -> Vec<Effect> {
    let (Some(setup), Some(spec)) = (&model.lab.setup, &model.lab.spec) else { return Vec::new() };
    if !Setting::all(spec).contains(&setting) {
        let name = setting.name(spec);
        model.say(format!("this scene has no setting `{name}`"), false);
        return Vec::new();
    }
    let mut changed = setup.clone();
    setting.change(&mut changed, spec, steps);
    match changed.spec() {
        Ok(spec) => {
            let what = format!("{}: {}", setting.name(&spec), setting.value(&changed, &spec));
            model.say(what, false);
            model.lab.setup = Some(changed);
            if setting == Setting::Surface {
                // A plane fills the picture; of others the outline is to be seen.
                let flat = spec.surface.shape == Shape::Plane;
                model.lab.viewer.zoom = if flat { Zoom::Natural } else { Zoom::Whole };
            }
            begin(model, spec)
        }
        Err(message) => {
            model.say(message, true);
            Vec::new()
        }
    }
}

/// Takes a scene for the one to be shown. Images of the one before stay until others come.
fn begin(model: &mut Model, spec: crate::experiment::spec::Spec) -> Vec<Effect> {
    let lab = &mut model.lab;
    let labels: Vec<&str> = spec.sweep.methods.iter().map(|m| m.label.as_str()).collect();
    let same = labels.iter().eq(lab.rows.iter().map(|row| &row.label));
    let built = |row: &Row| Row { score: None, ns_per_pixel: None, refused: None, ..row.clone() };
    lab.rows = match same {
        true => lab.rows.iter().map(built).collect(),
        false => spec.sweep.methods.iter().map(row).collect(),
    };
    let size = [spec.image.width, spec.image.height];
    if !same || lab.viewer.size().is_some_and(|old| old != size) {
        let shot =
            |label: &str| Shot { label: label.to_owned(), remark: String::new(), film: None };
        let mut shots = vec![shot("reference")];
        shots.extend(labels.iter().map(|label| shot(label)));
        lab.viewer.replace(shots);
        lab.viewer.cursor = size.map(|side| side / 2);
        if !same {
            // What an engine does today beside the truth.
            lab.viewer.sides = [1.min(labels.len()), 0];
        }
    }
    lab.scene += 1;
    lab.reference = None;
    lab.done = false;
    lab.failed = None;
    lab.working = Some(("preparing".to_owned(), 0.0));
    lab.stale = lab.viewer.shots.iter().map(|shot| shot.film.is_some()).collect();
    lab.spec = Some(spec);
    show(lab)
}

fn row(spec: &crate::experiment::spec::MethodSpec) -> Row {
    let summary = method::find(spec.name).map(|entry| entry.card.summary.to_owned());
    Row { label: spec.label.clone(), summary: summary.unwrap_or_default(), ..Row::default() }
}

/// Asks for the scene, what is looked at first.
fn show(lab: &Lab) -> Vec<Effect> {
    let (Some(spec), Some(setup)) = (&lab.spec, &lab.setup) else { return Vec::new() };
    let (spec, spp) = (spec.clone(), setup.spp);
    let wanted = Wanted { scene: lab.scene, spec, spp, first: lab.shown() };
    vec![Effect::Lab(Order::Show(Box::new(wanted)))]
}

/// After a key: asks for images that are now looked at and not there, and looks under the cursor if it moved.
fn follow(
    model: &Model,
    (shown, cursor): (Vec<usize>, [usize; 2]),
    mut effects: Vec<Effect>,
) -> Vec<Effect> {
    let lab = &model.lab;
    let now = lab.shown();
    if now != shown && now.iter().any(|method| lab.waits_for(*method)) {
        effects.extend(show(lab));
    }
    if now != shown || lab.viewer.cursor != cursor {
        effects.extend(look(lab));
    }
    effects
}

/// Looks under the cursor.
fn look(lab: &Lab) -> Option<Effect> {
    lab.spec.as_ref()?;
    let (scene, pixel) = (lab.scene, lab.viewer.cursor);
    Some(Effect::Lab(Order::Probe(Look { scene, pixel, methods: lab.shown() })))
}

fn turn_focus(lab: &mut Lab, by: i32) -> Vec<Effect> {
    let at = Focus::ALL.iter().position(|focus| *focus == lab.focus).unwrap_or(0) as i32;
    lab.focus = Focus::ALL[(at + by).rem_euclid(Focus::ALL.len() as i32) as usize];
    Vec::new()
}

/// Another setting or method; of a method, what it does is said.
fn choose(model: &mut Model, by: isize) -> Vec<Effect> {
    let lab = &mut model.lab;
    let settings = lab.spec.as_ref().map_or(0, |spec| Setting::all(spec).len());
    let (at, count) = match lab.focus {
        Focus::Settings => (&mut lab.setting, settings),
        _ => (&mut lab.row, lab.rows.len()),
    };
    *at = at.saturating_add_signed(by).min(count.saturating_sub(1));
    if lab.focus == Focus::Methods
        && let Some(row) = lab.order().get(lab.row).and_then(|method| lab.rows.get(*method))
    {
        let said = row.refused.clone().unwrap_or_else(|| row.summary.clone());
        let said = format!("{}: {said}", row.label);
        model.say(said, false);
    }
    Vec::new()
}

fn save(model: &mut Model) -> Vec<Effect> {
    match &model.lab.setup {
        Some(setup) => vec![Effect::Lab(Order::Save(setup.experiment()))],
        None => Vec::new(),
    }
}

/// Puts the cursor where the mouse points, or chooses what it points at.
pub fn click(model: &mut Model, at: Position) -> Vec<Effect> {
    let layout = Layout::of(model);
    let before = (model.lab.shown(), model.lab.viewer.cursor);
    if let Some(area) = layout.methods.filter(|area| area.contains(at)) {
        model.lab.focus = Focus::Methods;
        let row = usize::from(at.y.saturating_sub(area.y + 1)) + layout.first_row(model);
        if row < model.lab.rows.len() {
            model.lab.row = row;
            let method = model.lab.order()[row];
            model.lab.viewer.pick(method + 1);
        }
    } else if let Some(area) = layout.settings.filter(|area| area.contains(at)) {
        model.lab.focus = Focus::Settings;
        let row = usize::from(at.y.saturating_sub(area.y));
        let count = model.lab.spec.as_ref().map_or(0, |spec| Setting::all(spec).len());
        model.lab.setting = row.min(count.saturating_sub(1));
    } else if layout.picture.contains(at) {
        model.lab.focus = Focus::Picture;
        let look = layout.look(model);
        let part = |at: u16, from: u16, side: u16, pixels: usize| {
            (f64::from(at - from) + 0.5) / f64::from(side.max(1)) * pixels as f64
        };
        let area = layout.picture;
        let x = part(at.x, area.x, area.width, look.size[0]) as usize;
        let y = part(at.y, area.y, area.height, look.size[1]) as usize;
        model.lab.viewer.point(x, y, look);
    }
    follow(model, before, Vec::new())
}

/// Takes in what the threads tell.
pub fn take(model: &mut Model, told: Told) -> Vec<Effect> {
    match told {
        Told::Opened(Ok(setup)) => opened(model, *setup),
        Told::Opened(Err(message)) => {
            model.lab.opening = None;
            model.say(message, true);
            Vec::new()
        }
        Told::Saved(Ok(path)) => {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            model.say(format!("written to {}: run it as `{name}`", path.display()), false);
            vec![Effect::Experiments(crate::tui::experiments::Order::List)]
        }
        Told::Saved(Err(message)) => {
            model.say(message, true);
            Vec::new()
        }
        Told::Of(scene, finding) if scene == model.lab.scene => found(model, finding),
        // Of a scene that has been left.
        Told::Of(..) => Vec::new(),
    }
}

fn opened(model: &mut Model, setup: Setup) -> Vec<Effect> {
    model.lab.opening = None;
    match setup.spec() {
        Ok(spec) => {
            model.say(format!("{} is open", setup.name), false);
            model.lab.setting = 0;
            model.lab.setup = Some(setup);
            begin(model, spec)
        }
        Err(message) => {
            model.say(message, true);
            Vec::new()
        }
    }
}

fn found(model: &mut Model, finding: Finding) -> Vec<Effect> {
    let lab = &mut model.lab;
    match finding {
        Finding::Notes(notes) => lab.notes = notes,
        Finding::Working(what, part) => lab.working = Some((what, part)),
        Finding::Reference { film, spp, rmse } => {
            let first = lab.reference.is_none();
            lab.reference = Some((spp, rmse));
            lab.hang(0, film);
            lab.viewer.shots[0].remark = format!("{spp} spp");
            lab.working = Some(("converging the reference".to_owned(), 0.0));
            return if first { look(lab).into_iter().collect() } else { Vec::new() };
        }
        Finding::Built { method, secs, bytes_per_texel } => {
            if let Some(row) = lab.rows.get_mut(method) {
                // A map taken from the shelf took the time it took when it was built.
                let secs = if secs > 0.0 { secs } else { row.built.map_or(0.0, |(secs, _)| secs) };
                row.built = Some((secs, bytes_per_texel));
            }
        }
        Finding::Image { method, film, ns_per_pixel } => {
            if let Some(row) = lab.rows.get_mut(method) {
                row.ns_per_pixel = Some(ns_per_pixel);
                lab.hang(method + 1, film);
                if lab.shown().contains(&method) {
                    return look(lab).into_iter().collect();
                }
            }
        }
        Finding::Refused { method, reason } => {
            let shown = lab.shown().contains(&method);
            if let Some(row) = lab.rows.get_mut(method) {
                let said = format!("{}: {reason}", row.label);
                row.refused = Some(reason);
                lab.unhang(method + 1);
                if shown {
                    model.say(said, false);
                }
            }
        }
        Finding::Scores(scores) => {
            lab.rows.iter_mut().zip(scores).for_each(|(row, score)| row.score = score);
        }
        Finding::Under(under) => lab.under = Some(*under),
        Finding::Done => (lab.working, lab.done) = (None, true),
        Finding::Failed(message) => {
            lab.working = None;
            lab.viewer.shots.iter_mut().for_each(|shot| shot.film = None);
            lab.failed = Some(message.clone());
            model.say(message, true);
        }
    }
    Vec::new()
}

impl Lab {
    /// Whether there is no image yet of a method of this scene, and may be one.
    fn waits_for(&self, method: usize) -> bool {
        let row = self.rows.get(method);
        row.is_some_and(|row| row.refused.is_none() && row.ns_per_pixel.is_none())
    }

    /// Hangs an image of this scene.
    fn hang(&mut self, number: usize, film: std::sync::Arc<crate::render::Film>) {
        let fresh = self.viewer.size().is_none();
        if let Some(shot) = self.viewer.shots.get_mut(number) {
            shot.film = Some(film);
        }
        if let Some(stale) = self.stale.get_mut(number) {
            *stale = false;
        }
        if fresh {
            self.viewer.centre();
        }
    }

    /// Takes an image down.
    fn unhang(&mut self, number: usize) {
        if let Some(shot) = self.viewer.shots.get_mut(number) {
            shot.film = None;
        }
    }

    /// Whether the images on the sides are of a scene that has been left, and others are on their way.
    pub fn is_stale(&self) -> bool {
        let stale = |side: &usize| self.stale.get(*side).copied().unwrap_or(false);
        stale(&self.viewer.sides[self.viewer.on as usize])
            || self.viewer.split.is_some() && self.viewer.sides.iter().any(stale)
    }
}

/// The room of the lab's picture.
impl Layout {
    /// The room of the picture, in pixels.
    pub fn look(&self, model: &Model) -> viewer::Look {
        viewer::Look { size: model.screen.pixels(self.picture), aspect: model.screen.aspect() }
    }
}
