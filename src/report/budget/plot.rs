//! Budgets as stacked bars: a panel a scene, a bar a method.

use super::super::axis::Axis;
use super::super::canvas::{Anchor, Canvas, Point, Type};
use super::super::chart::{HALF_CAPITAL, SMALL, TEXT};
use super::super::colour::{BLACK, GREY, Ink, OKABE_ITO, PALE, Style};
use super::super::contest::{Comparison, Contest, Setting};
use super::super::figure::Figure;
use super::super::mark::legend;
use super::super::scale::Scale;
use super::super::{font, phrase, tables};
use super::balance;
use crate::render::Part;
use crate::scene::Balance;

/// Height of a bar, and from one bar to the next.
const BAR: f32 = 12.0;
const STEP: f32 = 18.0;
/// A panel's width, room for the figures right of it, room between panels and above each.
const WIDTH: f32 = 250.0;
const FIGURES: f32 = 46.0;
const ABOVE: f32 = 34.0;
/// Shares beyond these are cut off.
const LEAST: f64 = -1.0;
const MOST: f64 = 2.0;
/// A panel's title.
const TITLE: Type = Type { size: 13.0, ink: BLACK, bold: true, anchor: Anchor::Start };

/// The colour of a part.
fn ink(part: Part) -> Ink {
    match part {
        Part::Lookup => Ink::new(OKABE_ITO[0]),
        Part::Energy => Ink::new(OKABE_ITO[6]),
        Part::Direction => Ink::new(OKABE_ITO[1]),
        Part::Width => Ink::new(OKABE_ITO[2]),
        Part::Anisotropy => Ink::new(OKABE_ITO[5]),
        Part::Shape => Ink::new(OKABE_ITO[3]),
        Part::Centre => Ink::new(OKABE_ITO[4]),
        Part::Shadowing => Ink::new([0x55, 0x55, 0x55]),
    }
}

/// The colour of what remains.
const NOISE: Ink = Ink::new([0xbb, 0xbb, 0xbb]);

/// A method's bar.
struct Bar {
    label: String,
    /// (colour, share), in order.
    shares: Vec<(Ink, f64)>,
    /// RMSE over the mean radiance.
    error: f64,
}

impl Bar {
    fn of(label: String, balance: &Balance, mean: f64) -> Option<Self> {
        let inks = balance.entries.iter().map(|entry| ink(entry.part)).chain([NOISE]);
        let shares: Vec<(Ink, f64)> = inks.zip(balance.shares()).collect();
        let error = balance.whole.sqrt() / mean;
        (!shares.is_empty() && error.is_finite()).then_some(Self { label, shares, error })
    }

    /// The sums of the shares below 0 and above.
    fn ends(&self) -> [f64; 2] {
        let sum = |keep: fn(&f64) -> bool| {
            self.shares.iter().map(|(_, share)| *share).filter(keep).sum::<f64>()
        };
        [sum(|share| *share < 0.0), sum(|share| *share > 0.0)]
    }
}

/// The figure of a setting: a row a texture, a column a scale. `None` if there is no budget with an error.
pub(super) fn figure(comparison: &Comparison, setting: &Setting, number: usize) -> Option<Figure> {
    let cell = |texture: &str, scale: &Scale| {
        let contest = setting.at(scale).find(|c| c.scene.key.texture == texture);
        let bars = contest.map_or_else(Vec::new, |contest| bars(comparison, contest));
        (format!("{texture}, {}", scale.label), bars)
    };
    let textures = setting.textures().into_iter();
    let panels: Vec<(String, Vec<Bar>)> =
        textures.flat_map(|t| setting.scales.iter().map(move |s| cell(t, s))).collect();
    let drawing = draw(&panels, setting.scales.len())?;
    let caption = "Shares of the mean squared error, scene by scene. Right of 0: what replacing the part takes off, after \
                   those before it in the order of the legend; left of 0: what it adds. Beside each bar: RMSE over the \
                   mean radiance.";
    Some(Figure::drawing(format!("plots/budget-{number}.png"), caption.into(), &drawing))
}

fn bars(comparison: &Comparison, contest: &Contest) -> Vec<Bar> {
    let of = |method: &crate::experiment::results::MethodInfo| {
        Bar::of(tables::label(method), balance(contest.scene, &method.label)?, contest.mean)
    };
    comparison.results.methods.iter().filter_map(of).collect()
}

fn draw(panels: &[(String, Vec<Bar>)], across: usize) -> Option<Canvas> {
    let all = || panels.iter().flat_map(|(_, bars)| bars);
    let most = panels.iter().map(|(_, bars)| bars.len()).max().filter(|most| *most > 0)?;
    let ends = all().flat_map(Bar::ends).map(|end| end.clamp(LEAST, MOST));
    let axis = Axis::linear(ends.chain([0.0, 1.0]));
    let names = all().map(|bar| font::width(&bar.label, TEXT.size, false)).fold(0.0, f32::max);
    let left = names.min(240.0) + 16.0;
    let (step, height) = (WIDTH + FIGURES + 14.0, STEP * most as f32);
    let shown = |part: Part| (part.name().to_owned(), swatch(ink(part)));
    let key: Vec<(String, Style)> =
        Part::ALL.into_iter().map(shown).chain([("noise".to_owned(), swatch(NOISE))]).collect();
    let width = left + across as f32 * step;
    let top = legend(&mut Canvas::new(1.0, 1.0), [0.0, 0.0], width, &key);
    let rows = panels.len().div_ceil(across);
    let mut canvas = Canvas::new(width, top + rows as f32 * (height + ABOVE) + 44.0);
    legend(&mut canvas, [6.0, 4.0], width, &key);
    for (i, (title, bars)) in panels.iter().enumerate() {
        let (row, column) = (i / across, i % across);
        let corner = [left + column as f32 * step, top + ABOVE + row as f32 * (height + ABOVE)];
        let at = [corner[0], corner[1] - 8.0];
        canvas.text(at, &font::fitted(title, TITLE.size, true, WIDTH), TITLE);
        panel(&mut canvas, corner, &axis, bars, (column == 0, i + across >= panels.len()));
    }
    let below = [left + 0.5 * (width - left), top + rows as f32 * (height + ABOVE) + 36.0];
    let middle = Type { anchor: Anchor::Middle, ink: BLACK, ..SMALL };
    canvas.text(below, "share of the mean squared error", middle);
    Some(canvas)
}

fn swatch(ink: Ink) -> Style {
    Style { ink, marker: 1, hollow: false, heavy: false }
}

/// One panel: its grid, its bars, and if `labels` say so the methods' names (left) and the ticks' (below).
fn panel(canvas: &mut Canvas, [left, top]: Point, axis: &Axis, bars: &[Bar], labels: (bool, bool)) {
    let x = |share: f64| left + WIDTH * axis.place(share).clamp(0.0, 1.0);
    let bottom = top + STEP * bars.len() as f32;
    for tick in &axis.ticks {
        let at = x(tick.value);
        canvas.line(&[[at, top], [at, bottom]], PALE, 0.9, None);
        if labels.1 {
            let text = format!("{:.0} %", 100.0 * tick.value).replace('-', "−");
            canvas.text([at, bottom + 15.0], &text, Type { anchor: Anchor::Middle, ..SMALL });
        }
    }
    for (k, bar) in bars.iter().enumerate() {
        let y = top + STEP * k as f32 + 0.5 * (STEP - BAR);
        let base = y + 0.5 * BAR + HALF_CAPITAL * TEXT.size;
        draw_bar(canvas, bar, y, &x);
        if labels.0 {
            let name = font::fitted(&bar.label, TEXT.size, false, 240.0);
            canvas.text([left - 10.0, base], &name, Type { anchor: Anchor::End, ..TEXT });
        }
        canvas.text([left + WIDTH + 6.0, base], &phrase::percent(bar.error), SMALL);
    }
    canvas.line(&[[x(0.0), top], [x(0.0), bottom]], GREY, 1.0, None);
    canvas.line(&[[x(1.0), top], [x(1.0), bottom]], GREY, 0.8, Some([2.0, 2.0]));
}

/// Shares above 0 stand one after the other to the right, those below to the left.
fn draw_bar(canvas: &mut Canvas, bar: &Bar, y: f32, x: &impl Fn(f64) -> f32) {
    let [mut low, mut high] = [0.0f64; 2];
    for &(ink, share) in &bar.shares {
        let (from, to) = if share < 0.0 {
            low += share;
            (low, low - share)
        } else {
            high += share;
            (high - share, high)
        };
        let (from, to) = (x(from), x(to));
        canvas.rectangle([from, y], [to - from, BAR], ink);
    }
}
