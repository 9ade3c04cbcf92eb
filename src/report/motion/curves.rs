//! Charts over time: error of every frame, and change from frame to frame.

use super::standing::{Race, Standing};
use crate::experiment::results::MethodInfo;
use crate::metric::Step;
use crate::report::axis::Axis;
use crate::report::canvas::{Canvas, Type};
use crate::report::chart::{Panel, TEXT};
use crate::report::colour::{BLACK, GREY, Style, styles};
use crate::report::font;
use crate::report::grid::MIDDLE;
use crate::report::tables::label;

/// RMSE of every frame, a line a method, on a logarithmic scale. `None` if nothing was measured.
pub fn errors(methods: &[MethodInfo], race: &Race) -> Option<Canvas> {
    let lines = lines(methods, race, |standing| standing.errors.clone(), 1.0);
    let own = race.frames.iter().map(|frame| frame.reference.rmse);
    let floor = own.fold(0.0, f64::max);
    // The floor is mostly far below: it is drawn where it is in sight.
    let y = Axis::decades(lines.iter().flat_map(|line| &line.points).map(|p| p.1));
    Chart { lines, y, y_title: "RMSE", x_title: "frame", floor }.draw()
}

/// Change from each frame to the next as `of` tells it, a line a method, from 0. With `truth`, the reference's as
/// well, dotted.
pub fn changes(
    methods: &[MethodInfo],
    race: &Race,
    of: fn(&Step) -> f64,
    y_title: &'static str,
) -> Option<Canvas> {
    let each = |standing: &Standing| standing.flicker.steps.iter().map(of).collect();
    let mut lines = lines(methods, race, each, 1.5);
    let truth = race.standings.first()?.flicker.steps.iter().map(|step| step.truth_change);
    let style = Style { ink: GREY, marker: 0, hollow: true, heavy: true };
    lines.push(Line { name: "the truth".into(), style, points: numbered(truth, 1.5) });
    let values = lines.iter().flat_map(|line| &line.points).map(|p| p.1);
    let y = Axis::linear(values.chain(std::iter::once(0.0)));
    Chart { lines, y, y_title, x_title: "between frames", floor: 0.0 }.draw()
}

/// A method's values over time.
struct Line {
    name: String,
    style: Style,
    points: Vec<(f64, f64)>,
}

fn lines(
    methods: &[MethodInfo],
    race: &Race,
    values: impl Fn(&Standing) -> Vec<f64>,
    first: f64,
) -> Vec<Line> {
    let styles = styles(methods);
    let line = |standing: &Standing| {
        let place = methods.iter().position(|m| m.label == standing.method.label)?;
        let points = numbered(values(standing).into_iter(), first);
        Some(Line { name: label(standing.method), style: styles[place], points })
    };
    race.standings.iter().filter_map(line).collect()
}

/// Finite values with their places in time, counted from `first`.
fn numbered(values: impl Iterator<Item = f64>, first: f64) -> Vec<(f64, f64)> {
    let places = (0..).map(|t| first + f64::from(t));
    places.zip(values).filter(|(_, value)| value.is_finite()).collect()
}

/// A panel of lines over time.
struct Chart {
    lines: Vec<Line>,
    y: Axis,
    y_title: &'static str,
    x_title: &'static str,
    /// What is below this, the reference cannot tell.
    floor: f64,
}

impl Chart {
    fn draw(&self) -> Option<Canvas> {
        let times = || self.lines.iter().flat_map(|line| &line.points).map(|p| p.0);
        times().next()?;
        let names = self.lines.iter().map(|l| font::width(&l.name, TEXT.size, false));
        let widest = names.fold(0.0, f32::max).min(260.0);
        let mut canvas = Canvas::new(70.0 + 560.0 + 40.0 + widest, 330.0);
        let x = Axis::linear(times()).cut_to(times());
        let panel = Panel { corner: [64.0, 14.0], size: [560.0, 262.0], x, y: self.y.clone() };
        panel.floor(&mut canvas, self.floor);
        panel.draw(&mut canvas, (true, true));
        for heavy in [false, true] {
            for line in self.lines.iter().filter(|line| line.style.heavy == heavy) {
                let shown = line.points.iter().filter(|(_, y)| panel.y.shows(*y));
                let points: Vec<_> = shown.map(|&(x, y)| panel.at(x, y)).collect();
                let dash = line.style.hollow.then_some([5.0, 3.0]);
                canvas.line(&points, line.style.ink, if heavy { 2.4 } else { 1.5 }, dash);
            }
        }
        let ends = self.lines.iter().filter_map(|line| {
            let last = line.points.iter().rfind(|(_, y)| panel.y.shows(*y))?;
            Some((last.1, font::fitted(&line.name, TEXT.size, false, 260.0), line.style))
        });
        panel.name_curves(&mut canvas, ends.collect());
        let black = Type { ink: BLACK, ..MIDDLE };
        let middle = [panel.corner[0] + 0.5 * panel.size[0], panel.bottom() + 36.0];
        canvas.text(middle, self.x_title, black);
        canvas.upright_text([14.0, panel.corner[1] + 0.5 * panel.size[1]], self.y_title, black);
        Some(canvas)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn charts_are_drawn_whatever_is_missing() {
        let mut results = fixture::moving();
        let draw = |results: &crate::experiment::results::Results| {
            let races = Race::all(results, 1);
            let all = |step: &Step| step.change;
            [
                errors(&results.methods, &races[0]),
                changes(&results.methods, &races[0], all, "change"),
            ]
            .map(|chart| chart.is_some())
        };
        assert_eq!(draw(&results), [true, true]);
        results.scenes[0].trials.iter_mut().for_each(|trial| trial.scores.clear());
        assert_eq!(draw(&results), [true, true]);
        results.scenes[0].trials.clear();
        results.sequences = crate::experiment::sequence::sequences(&results.scenes);
        assert_eq!(draw(&results), [false, false]);
    }
}
