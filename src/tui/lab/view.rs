//! The lab on the screen.
//!
//! ```text
//!  ╔ quick: A fournier 1 spp ═══════════════╗┌ methods ──────────────────┐
//!  ║                                        ║│   method      RMSE  ns/px │
//!  ║              the picture               ║├ settings ─────────────────┤
//!  ║                                        ║│  texture      twill       │
//!  ║                                        ║├ normals ──────────────────┤
//!  ╚ (80, 60)  R 1.20  A 1.10 (−0.10) ══════╝│    truth         A        │
//!  working at ...                            └───────────────────────────┘
//! ```
//!
//! Where there is no room for all three panels on the right, the one with the focus has it.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Wrap};

use super::disc::Disc;
use super::{By, Focus, Held, Lab, Row, Setting};
use crate::metric::Equivalent;
use crate::report::phrase;
use crate::tui::model::Model;
use crate::tui::picture::{Gallery, Paint, Slot, Stamp};
use crate::tui::view::{panel, share};
use crate::tui::viewer::{Side, values};

/// Columns of the panels on the right, where there is room for more than the least.
const RIGHT: [u16; 2] = [38, 64];
/// Columns of the list of methods from which on it has times.
const TIMED: u16 = 42;
/// The lab's pictures.
const PICTURE: Slot = Slot(0);
const TRUTH: Slot = Slot(1);
const HELD: [Slot; 2] = [Slot(2), Slot(3)];

/// Where the lab's parts are; each is the inside of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The picture.
    pub picture: Rect,
    /// The line of what is being worked at.
    working: Rect,
    /// The list of methods, if it is shown.
    pub methods: Option<Rect>,
    /// The settings, if they are shown.
    pub settings: Option<Rect>,
    /// The distributions, if they are shown.
    pub normals: Option<Rect>,
}

/// A frame of one cell about an area taken away.
fn inside(area: Rect) -> Rect {
    area.inner(ratatui::layout::Margin::new(1, 1))
}

/// The frame about an area.
fn outside(area: Rect) -> Rect {
    Rect::new(area.x.saturating_sub(1), area.y.saturating_sub(1), area.width + 2, area.height + 2)
}

impl Layout {
    /// Lays the lab out.
    pub fn of(model: &Model) -> Self {
        let area = model.pane_area();
        let right = (area.width * 2 / 5).clamp(RIGHT[0], RIGHT[1]).min(area.width / 2);
        let left = area.width - right;
        let picture = inside(Rect::new(area.x, area.y, left, area.height.saturating_sub(1)));
        let working = Rect::new(area.x, area.bottom().saturating_sub(1), left, 1);
        let right = Rect::new(area.x + left, area.y, right, area.height);
        let lab = &model.lab;
        let rows = lab.rows.len() as u16 + 5;
        let settings = lab.spec.as_ref().map_or(0, |spec| Setting::all(spec).len()) as u16 + 2;
        let mut layout = Self { picture, working, methods: None, settings: None, normals: None };
        let slice = |from: u16, height: u16| {
            inside(Rect::new(right.x, right.y + from, right.width, height))
        };
        if right.height >= rows + settings + 10 {
            layout.methods = Some(slice(0, rows));
            layout.settings = Some(slice(rows, settings));
            layout.normals = Some(slice(rows + settings, right.height - rows - settings));
        } else if right.height >= rows.max(settings) + 10 {
            let upper = if lab.focus == Focus::Settings { settings } else { rows };
            let place = Some(slice(0, upper));
            match lab.focus {
                Focus::Settings => layout.settings = place,
                _ => layout.methods = place,
            }
            layout.normals = Some(slice(upper, right.height - upper));
        } else {
            let whole = Some(slice(0, right.height));
            match lab.focus {
                Focus::Settings => layout.settings = whole,
                Focus::Normals => layout.normals = whole,
                Focus::Methods | Focus::Picture => layout.methods = whole,
            }
        }
        layout
    }

    /// The first row of the list of methods that is shown.
    pub fn first_row(&self, model: &Model) -> usize {
        let room = self.methods.map_or(0, |area| usize::from(area.height.saturating_sub(1)));
        first(model.lab.row, room)
    }
}

/// The first of a list's lines, so that the chosen one is seen.
fn first(chosen: usize, room: usize) -> usize {
    (chosen + 1).saturating_sub(room.max(1))
}

/// Draws the lab.
pub fn draw(model: &Model, gallery: &Gallery, _area: Rect, frame: &mut Frame) {
    let layout = Layout::of(model);
    picture(model, gallery, &layout, frame);
    working(&model.lab, layout.working, frame);
    if let Some(area) = layout.methods {
        methods(model, area, frame);
    }
    if let Some(area) = layout.settings {
        settings(&model.lab, area, frame);
    }
    if let Some(area) = layout.normals {
        normals(&model.lab, gallery, area, frame);
    }
}

fn picture(model: &Model, gallery: &Gallery, layout: &Layout, frame: &mut Frame) {
    let (lab, area) = (&model.lab, layout.picture);
    let name = lab.setup.as_ref().map_or("Lab", |setup| setup.name.as_str());
    let stale = if lab.is_stale() { " …" } else { "" };
    let title = format!("{name}: {}{stale}", lab.viewer.caption());
    let under = lab.viewer.under_cursor().unwrap_or_default();
    let block = panel(&title, lab.focus == Focus::Picture).title_bottom(format!(" {under} "));
    frame.render_widget(block, outside(area));
    if let Some(message) = empty(lab) {
        frame.render_widget(Paragraph::new(message).wrap(Wrap { trim: true }), area);
        return;
    }
    if lab.viewer.numbers {
        values(&lab.viewer, area, frame.buffer_mut());
        return;
    }
    let sight = lab.viewer.sight();
    let stamp = Stamp { picture: sight.look_stamp(), version: sight.stamp() };
    let paint: std::sync::Arc<dyn Paint> = std::sync::Arc::new(sight);
    gallery.show(PICTURE, stamp, &paint, area, frame.buffer_mut());
}

/// What is said in place of a picture.
fn empty(lab: &Lab) -> Option<String> {
    if let Some(message) = &lab.failed {
        return Some(format!("This scene cannot be rendered: {message}"));
    }
    if lab.setup.is_none() {
        let opening = lab.opening.as_ref().map(|name| format!("Opening {name} …"));
        return Some(opening.unwrap_or_else(|| {
            "Nothing is open. Choose an experiment and press v, or start with `wrinkle tui my_normals.png`."
                .to_owned()
        }));
    }
    if lab.viewer.numbers || lab.viewer.split.is_some() {
        return None;
    }
    let side = lab.viewer.side(lab.viewer.on);
    let refused = side.checked_sub(1).and_then(|m| lab.rows.get(m)?.refused.as_deref());
    if let Some(reason) = refused {
        return Some(format!("{} takes no part: {reason}", lab.rows[side - 1].label));
    }
    lab.viewer.film(lab.viewer.on).is_none().then(|| "Rendering …".to_owned())
}

fn working(lab: &Lab, area: Rect, frame: &mut Frame) {
    let text = match (&lab.working, lab.reference) {
        (Some((what, part)), _) if *part > 0.0 => {
            format!(" {what} {} {:.0} %", share(*part, 8), 100.0 * part)
        }
        (Some((what, _)), None) => format!(" {what}"),
        (working, Some((spp, rmse))) => {
            let more = if working.is_some() { ", converging" } else { "" };
            let notes = lab.notes.first().map_or(String::new(), |note| format!("   {note}"));
            format!(" reference: {spp} spp, own RMSE {rmse:.2e}{more}{notes}")
        }
        (None, None) => String::new(),
    };
    frame.render_widget(Paragraph::new(crate::tui::model::plain_line(&text)), area);
}

/// The mark of a side that a method is on.
fn sides(lab: &Lab, number: usize) -> &'static str {
    match lab.viewer.sides.map(|side| side == number) {
        [true, true] => "AB",
        [true, false] => "A ",
        [false, true] => " B",
        [false, false] => "  ",
    }
}

fn methods(model: &Model, area: Rect, frame: &mut Frame) {
    let lab = &model.lab;
    let by = match lab.by {
        By::Number => "by number",
        By::Error => "by error",
        By::Time => "by time",
    };
    let title = format!("Methods, {by}");
    frame.render_widget(panel(&title, lab.focus == Focus::Methods), outside(area));
    let timed = area.width >= TIMED;
    let numbered = if timed { 22 } else { 15 };
    let name = usize::from(area.width).saturating_sub(5 + numbered).max(8);
    let time = if timed { format!(" {:>6}", "ns/px") } else { String::new() };
    let head = format!("{:5}{:name$} {:>7}{time} {:>6}", "", "", "RMSE", "worth");
    let mut lines = vec![Line::styled(head, Style::new().add_modifier(Modifier::UNDERLINED))];
    let room = usize::from(area.height.saturating_sub(1));
    for (place, method) in lab.order().into_iter().enumerate().skip(first(lab.row, room)).take(room)
    {
        let row = &lab.rows[method];
        let key = if method < 9 { (method + 1).to_string() } else { " ".to_owned() };
        let text = format!(
            "{key} {} {:name$} {}",
            sides(lab, method + 1),
            short(&row.label, name),
            numbers(row, timed)
        );
        let mut style = Style::new();
        if place == lab.row && lab.focus == Focus::Methods {
            style = style.add_modifier(Modifier::REVERSED);
        }
        lines.push(Line::styled(text, style));
    }
    if lines.len() + 2 <= usize::from(area.height) {
        lines.extend([Side::A, Side::B].iter().filter_map(|side| costs(lab, *side)).map(Line::raw));
    }
    frame.render_widget(Paragraph::new(lines), area);
}

/// A label that fits: of one that is too long its beginning, which tells the method, and the last three letters, which
/// tell its form.
fn short(label: &str, room: usize) -> String {
    let letters: Vec<char> = label.chars().collect();
    if letters.len() <= room || room < 5 {
        return letters.into_iter().take(room).collect();
    }
    let (front, back) = (&letters[..room - 4], &letters[letters.len() - 3..]);
    front.iter().chain(&['…']).chain(back).collect()
}

/// What the method on a side costs.
fn costs(lab: &Lab, side: Side) -> Option<String> {
    let row = lab.rows.get(lab.viewer.side(side).checked_sub(1)?)?;
    let (time, (secs, bytes)) = (row.ns_per_pixel?, row.built?);
    Some(format!(
        "{side:?} {time:.0} ns/px, built in {} s, {} B/texel",
        phrase::number(secs),
        phrase::number(bytes)
    ))
}

/// A method's numbers: error, time if asked for, worth.
fn numbers(row: &Row, timed: bool) -> String {
    if row.refused.is_some() {
        return if timed {
            format!("{:>21}", "takes no part")
        } else {
            format!("{:>14}", "takes no part")
        };
    }
    let error = row.score.map_or_else(|| "…".to_owned(), |score| phrase::number(score.rmse));
    let time = row.ns_per_pixel.map_or_else(|| "…".to_owned(), |ns| format!("{ns:.0}"));
    let worth =
        row.score.and_then(|score| score.worth).map_or_else(String::new, |worth| match worth {
            Equivalent::Samples(n) => phrase::number(n),
            Equivalent::MoreThan(n) => format!("> {n}"),
            Equivalent::FewerThan(n) => format!("< {n}"),
        });
    let time = if timed { format!(" {time:>6}") } else { String::new() };
    format!("{error:>7}{time} {worth:>6}")
}

fn settings(lab: &Lab, area: Rect, frame: &mut Frame) {
    frame.render_widget(panel("Settings", lab.focus == Focus::Settings), outside(area));
    let (Some(setup), Some(spec)) = (&lab.setup, &lab.spec) else { return };
    let all = Setting::all(spec);
    let chosen = lab.setting.min(all.len().saturating_sub(1));
    let room = usize::from(area.height);
    let lines = all.iter().enumerate().skip(first(chosen, room)).take(room);
    let line = |(place, setting): (usize, &Setting)| {
        let here = place == chosen && lab.focus == Focus::Settings;
        let value = setting.value(setup, spec);
        let value = if here { format!("◂ {value} ▸") } else { format!("  {value}") };
        let style = if here { Style::new().add_modifier(Modifier::REVERSED) } else { Style::new() };
        Line::from(vec![
            Span::raw(format!("{:16}", setting.name(spec))),
            Span::styled(value, style),
        ])
    };
    frame.render_widget(Paragraph::new(lines.map(line).collect::<Vec<_>>()), area);
}

/// The true distribution and those of the sides' methods, each with its words above.
fn normals(lab: &Lab, gallery: &Gallery, area: Rect, frame: &mut Frame) {
    let across = lab.under.as_ref().and_then(|under| under.texels_across);
    let title = match across {
        Some(texels) => format!("Normals, {} texels across", phrase::number(texels)),
        None => "Normals".to_owned(),
    };
    frame.render_widget(panel(&title, lab.focus == Focus::Normals), outside(area));
    let Some(under) = &lab.under else { return };
    if across.is_none() {
        frame.render_widget(Paragraph::new("The cursor is beside the surface."), area);
        return;
    }
    let held = |side: Side| {
        let method = lab.viewer.side(side).checked_sub(1)?;
        under.methods.iter().find(|held| held.method == method).map(|held| (side, held))
    };
    let mut shown: Vec<(Side, &Held)> = [Side::A, Side::B].into_iter().filter_map(held).collect();
    if shown.len() == 2 && shown[0].1.method == shown[1].1.method {
        shown.pop();
    }
    // Side by side where that is larger than one above the other.
    let discs = shown.len() as u16 + 1;
    let width = area.width / discs;
    let place =
        |i: u16| Rect::new(area.x + i * width, area.y, width.saturating_sub(1), area.height);
    let truth = ["truth".to_owned(), String::new()];
    disc(gallery, TRUTH, Disc::truth(under), truth, place(0), frame);
    for (i, (side, held)) in shown.into_iter().enumerate() {
        let label = lab.rows.get(held.method).map_or("", |row| row.label.as_str());
        let lobes = held.axes.len();
        let words = [
            format!("{side:?} {label}"),
            format!(
                "off {:.2}, {lobes} {}",
                held.distance,
                if lobes == 1 { "lobe" } else { "lobes" }
            ),
        ];
        disc(gallery, HELD[i], Disc::held(under, held), words, place(i as u16 + 1), frame);
    }
}

fn disc(
    gallery: &Gallery,
    slot: Slot,
    disc: Disc,
    words: [String; 2],
    area: Rect,
    frame: &mut Frame,
) {
    let lines: Vec<Line> = words.into_iter().map(Line::raw).collect();
    let head = Rect { height: area.height.min(2), ..area };
    frame.render_widget(Paragraph::new(lines), head);
    let room = Rect { y: area.y + head.height, height: area.height - head.height, ..area };
    // The cursor's move makes another version of the same picture.
    let stamp = Stamp { picture: 0, version: disc.stamp() };
    let paint: std::sync::Arc<dyn Paint> = std::sync::Arc::new(disc);
    gallery.show(slot, stamp, &paint, room, frame.buffer_mut());
}

#[cfg(test)]
mod tests;
