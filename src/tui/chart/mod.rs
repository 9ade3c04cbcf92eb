//! A chart drawn in characters: lines in braille, points marked by the key letters of their series, so that it can be
//! read without colour.
//!
//! ```text
//! RMSE
//!  1 ┤a⣀⣀                      a averaged
//!    │   ⠉⠉⢅u⠉⠒⠒⠤⠤a            u unfiltered
//! 0.1┤┄┄┄┄┄┄┄┄┄┄⠉⠉⢑u┄┄┄┄┄
//!    └┬──────┬─────┬────
//!     1      4     16
//!     samples a pixel
//! ```

mod axes;
mod bars;
mod key;
mod legend;

#[cfg(test)]
mod tests;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::symbols::Marker;
use ratatui::widgets::Widget;
use ratatui::widgets::canvas::{Canvas, Context, Line};

use crate::report::axis::Axis;
use crate::report::phrase;

pub use bars::{Bar, Bars};
pub use key::{Key, keys};

/// What an axis is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Logarithmic, with ticks at the values themselves: for sample counts.
    Counts,
    /// Logarithmic, with ticks at powers of ten, and at 2 and 5 times them where few are seen.
    Decades,
    /// Linear, with round ticks.
    Linear,
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// How it is told from others.
    pub key: Key,
    /// Its points, in the order of the line through them.
    pub points: Vec<(f64, f64)>,
}

/// A chart. What an axis cannot show (values that are not finite; on a logarithmic axis, not positive) is left out,
/// and the chart says how much.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart<'a> {
    /// What lies across, with its unit.
    pub across: (&'a str, Scale),
    /// What goes up, with its unit.
    pub up: (&'a str, Scale),
    /// The curves; a later one is drawn over an earlier one.
    pub series: &'a [Series],
    /// A level below which nothing can be told apart, and its name.
    pub floor: Option<(f64, &'a str)>,
    /// What is said where there is no point to show.
    pub nothing: &'a str,
    /// The series that is drawn above all others, bold.
    pub chosen: Option<usize>,
}

/// A cell where several series have a point.
const SEVERAL: &str = "*";

impl Chart<'_> {
    fn axes(&self) -> [Axis; 2] {
        let shown = || self.shown().flat_map(|(_, points)| points);
        let across = axis(self.across.1, shown().map(|p| p.0).collect());
        let mut values: Vec<f64> = shown().map(|p| p.1).collect();
        values.extend(self.seen_floor());
        [across, axis(self.up.1, values)]
    }

    /// The level of the floor, if it is not so far below all points that it would press them together.
    fn seen_floor(&self) -> Option<f64> {
        const FAR: f64 = 5.0;
        let least = self.shown().flat_map(|(_, points)| points).map(|p| p.1).reduce(f64::min)?;
        let (level, _) = self.floor?;
        (self.shows((1.0, level)) && least <= FAR * level).then_some(level)
    }

    /// The points of each series that can be shown.
    fn shown(&self) -> impl Iterator<Item = (&Series, Vec<(f64, f64)>)> {
        self.series.iter().map(|series| {
            let points = series.points.iter().copied().filter(|point| self.shows(*point));
            (series, points.collect())
        })
    }

    fn shows(&self, (x, y): (f64, f64)) -> bool {
        let on = |value: f64, scale| value.is_finite() && (scale == Scale::Linear || value > 0.0);
        on(x, self.across.1) && on(y, self.up.1)
    }

    /// What the chart does not show: a floor far below, points that have no place.
    fn unseen(&self) -> Vec<String> {
        let below = self
            .floor
            .filter(|(level, _)| self.shows((1.0, *level)) && self.seen_floor().is_none());
        let floor = below.map(|(level, name)| format!("{name}: {} ↓", phrase::number(level)));
        let points = self.series.iter().flat_map(|series| &series.points);
        let left_out = match points.filter(|point| !self.shows(**point)).count() {
            0 => None,
            1 => Some("1 point has no place here".to_owned()),
            count => Some(format!("{count} points have no place here")),
        };
        left_out.into_iter().chain(floor).collect()
    }

    /// Series in the order they are drawn: the chosen one last.
    fn order(&self) -> impl Iterator<Item = usize> {
        let chosen = self.chosen.filter(|chosen| *chosen < self.series.len());
        (0..self.series.len()).filter(move |i| Some(*i) != chosen).chain(chosen)
    }

    fn style(&self, place: usize) -> Style {
        let style = self.series[place].key.style;
        if self.chosen == Some(place) { style.add_modifier(Modifier::BOLD) } else { style }
    }
}

fn axis(scale: Scale, values: Vec<f64>) -> Axis {
    match scale {
        Scale::Counts => Axis::at_values(values),
        Scale::Decades => Axis::decades(values.into_iter()),
        Scale::Linear => Axis::linear(values.into_iter()),
    }
}

impl Widget for &Chart<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        const LEAST: (u16, u16) = (20, 6);
        if area.is_empty() {
            return;
        }
        if area.width < LEAST.0 || area.height < LEAST.1 {
            let text = "no room for a chart";
            buffer.set_stringn(area.x, area.y, text, area.width.into(), dim());
            return;
        }
        if self.shown().all(|(_, points)| points.is_empty()) {
            axes::heading(self, area, buffer);
            buffer.set_stringn(area.x, area.y + 2, self.nothing, area.width.into(), Style::new());
            return;
        }
        let (plot_and_axes, legend) = legend::split(self, area);
        let [x, y] = self.axes();
        let plot = axes::draw(self, [&x, &y], plot_and_axes, buffer);
        self.draw_floor(&y, plot, buffer);
        self.draw_lines([&x, &y], plot, buffer);
        let several = self.draw_points([&x, &y], plot, buffer);
        legend::draw(self, legend, several, buffer);
    }
}

impl Chart<'_> {
    fn draw_floor(&self, y: &Axis, plot: Rect, buffer: &mut Buffer) {
        let (Some(level), Some((_, name))) = (self.seen_floor(), self.floor) else { return };
        let row = cell(plot, 0.0, y.place(level).into()).1;
        for column in plot.left()..plot.right() {
            buffer[(column, row)].set_symbol("┄").set_style(dim());
        }
        let width = name.chars().count() as u16;
        if width + 2 < plot.width {
            buffer.set_string(plot.right() - width, row, name, dim());
        }
    }

    fn draw_lines(&self, [x, y]: [&Axis; 2], plot: Rect, buffer: &mut Buffer) {
        // Braille is drawn on its own and laid over: it must not wipe out what lies below blank cells.
        let mut above = Buffer::empty(plot);
        let paint = |context: &mut Context| {
            for place in self.order() {
                let points = self.series[place].points.iter().filter(|point| self.shows(**point));
                let placed = points.map(|p| (f64::from(x.place(p.0)), f64::from(y.place(p.1))));
                let placed: Vec<(f64, f64)> = placed.collect();
                let colour = self.style(place).fg.unwrap_or(Color::Reset);
                for pair in placed.windows(2) {
                    context.draw(&Line::new(pair[0].0, pair[0].1, pair[1].0, pair[1].1, colour));
                }
                context.layer();
            }
        };
        let canvas = Canvas::default().marker(Marker::Braille);
        canvas.x_bounds([0.0, 1.0]).y_bounds([0.0, 1.0]).paint(paint).render(plot, &mut above);
        for position in plot.positions() {
            let drawn = &above[position];
            if !matches!(drawn.symbol(), " " | "\u{2800}") {
                buffer[position].set_symbol(drawn.symbol()).set_style(Style::new().fg(drawn.fg));
            }
        }
    }

    /// Draws the points; whether some cell stands for several.
    fn draw_points(&self, [x, y]: [&Axis; 2], plot: Rect, buffer: &mut Buffer) -> bool {
        let mut several = false;
        let mut taken: Vec<((u16, u16), usize)> = Vec::new();
        for place in self.order() {
            let series = &self.series[place];
            for point in series.points.iter().filter(|point| self.shows(**point)) {
                let at = cell(plot, x.place(point.0).into(), y.place(point.1).into());
                let shared = taken.iter().any(|(other, by)| *other == at && *by != place);
                let style = self.style(place).remove_modifier(Modifier::DIM);
                let (mut letter, mut style) = (series.key.letter.to_string(), style);
                if shared && self.chosen != Some(place) {
                    (letter, style) = (SEVERAL.to_owned(), Style::new());
                    several = true;
                }
                buffer[at].set_symbol(&letter).set_style(style);
                taken.push((at, place));
            }
        }
        several
    }
}

/// The cell of a place on both axes, each from 0 to 1.
fn cell(plot: Rect, x: f64, y: f64) -> (u16, u16) {
    // As the canvas does it, in dots of braille: 2 across and 4 down a cell.
    let dot = |place: f64, cells: u16, dots: u16| {
        let last = f64::from(cells * dots - 1);
        ((place.clamp(0.0, 1.0) * last).round() as u16) / dots
    };
    (plot.x + dot(x, plot.width, 2), plot.y + dot(1.0 - y, plot.height, 4))
}

/// Text of the second rank.
fn dim() -> Style {
    Style::new().add_modifier(Modifier::DIM)
}
