//! Axes with their ticks, labels and titles.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span;

use super::{Chart, cell, dim};
use crate::report::axis::Axis;
use crate::report::phrase;

/// Draws both axes into `area`; what remains between them.
pub(super) fn draw(chart: &Chart, [x, y]: [&Axis; 2], area: Rect, buffer: &mut Buffer) -> Rect {
    let below = if area.height >= 9 { 3 } else { 2 };
    let labels = labelled(y, area.height - 1 - below, 8);
    let widest =
        labels.iter().map(|(_, label)| width(label)).max().unwrap_or(0).min(area.width / 3);
    // Above: the title of what goes up. Below: the axis, its labels, its title.
    let plot = Rect {
        x: area.x + widest + 1,
        y: area.y + 1,
        width: area.width - widest - 1,
        height: area.height - 1 - below,
    };
    heading(chart, area, buffer);
    upright(y, &labels, plot, widest, buffer);
    level(x, plot, area, buffer);
    let title = chart.across.0;
    if below == 3 {
        let from = plot.x + (plot.width.saturating_sub(width(title))) / 2;
        buffer.set_stringn(from, plot.bottom() + 2, title, plot.width.into(), dim());
    }
    plot
}

/// What goes up, and what is not shown.
pub(super) fn heading(chart: &Chart, area: Rect, buffer: &mut Buffer) {
    buffer.set_stringn(area.x, area.y, chart.up.0, area.width.into(), dim());
    let mut unseen = chart.unseen();
    while !unseen.is_empty() {
        let text = unseen.join(" · ");
        let from = area.right().saturating_sub(width(&text));
        if from > area.x + width(chart.up.0) {
            buffer.set_string(from, area.y, text, dim());
            return;
        }
        unseen.pop();
    }
}

fn upright(y: &Axis, labels: &[(f64, String)], plot: Rect, widest: u16, buffer: &mut Buffer) {
    let line = plot.x - 1;
    for row in plot.top()..plot.bottom() {
        buffer.set_string(line, row, "│", dim());
    }
    buffer.set_string(line, plot.bottom(), "└", dim());
    let mut taken = Vec::new();
    for (value, label) in labels {
        let row = cell(plot, 0.0, y.place(*value).into()).1;
        if taken.contains(&row) {
            continue;
        }
        taken.push(row);
        let from = line.saturating_sub(width(label).min(widest));
        buffer.set_stringn(from, row, label, widest.into(), dim());
        buffer.set_string(line, row, "┤", dim());
    }
}

fn level(x: &Axis, plot: Rect, area: Rect, buffer: &mut Buffer) {
    for column in plot.left()..plot.right() {
        buffer.set_string(column, plot.bottom(), "─", dim());
    }
    let mut free = area.x;
    for (value, label) in labelled(x, plot.width, 24) {
        let column = cell(plot, x.place(value).into(), 0.0).0;
        let long = width(&label);
        // Below its tick, but within the area.
        let from = column.saturating_sub(long / 2).min(area.right().saturating_sub(long));
        if from < free.max(area.x) {
            continue;
        }
        buffer.set_string(column, plot.bottom(), "┬", dim());
        buffer.set_string(from, plot.bottom() + 1, &label, dim());
        free = from + long + 1;
    }
}

/// The ticks that have labels on an axis of so many cells. Where `apart` cells or more are between powers of ten, 2 and
/// 5 times them have labels as well.
fn labelled(axis: &Axis, cells: u16, apart: u16) -> Vec<(f64, String)> {
    let powers = axis.ticks.iter().any(|tick| tick.label.contains("^{"));
    let decades = libm::log10(axis.high / axis.low);
    if powers && f64::from(cells) >= decades * f64::from(apart) {
        let round = |value: f64| {
            let times = value / libm::pow(10.0, libm::log10(value * (1.0 + 1e-9)).floor());
            [1.0, 2.0, 5.0].iter().any(|of| (times - of).abs() < 1e-6)
        };
        let values = axis.ticks.iter().map(|tick| tick.value).filter(|value| round(*value));
        return values.map(|value| (value, phrase::scale(value))).collect();
    }
    let ticks = axis.ticks.iter().filter(|tick| !tick.label.is_empty());
    ticks.map(|tick| (tick.value, raised(&tick.label))).collect()
}

/// `10^{−3}` as `10⁻³`.
fn raised(label: &str) -> String {
    let Some((base, rest)) = label.split_once("^{") else { return label.to_owned() };
    let raise = |c: char| match c {
        '−' => '⁻',
        c => c
            .to_digit(10)
            .map_or(c, |digit| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize]),
    };
    let exponent: String = rest.trim_end_matches('}').chars().map(raise).collect();
    format!("{base}{exponent}")
}

fn width(text: &str) -> u16 {
    Span::raw(text).width().try_into().unwrap_or(u16::MAX)
}
