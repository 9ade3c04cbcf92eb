//! Charts: numbers against numbers.

use crate::evidence::{self, Chart, Series};
use crate::report::axis::Axis;
use crate::report::canvas::{Anchor, Canvas, Type};
use crate::report::chart::{Panel, SMALL, TEXT};
use crate::report::colour::{Ink, Style, series};
use crate::report::font;
use crate::report::mark::{legend, mark};

/// Where the axes meet their ends, units.
const SIZE: [f32; 2] = [520.0, 300.0];
const LEFT: f32 = 70.0;
const BELOW: f32 = 52.0;
/// Curves with more points than these are drawn without their markers.
const MARKED: usize = 24;
/// Names longer than this are cut, units.
const NAME: f32 = 240.0;

/// The chart, with names beside the ends of its curves, or above it where there are none.
pub fn draw(chart: &Chart) -> Canvas {
    let points = || chart.series.iter().flat_map(|series| &series.points);
    let finite = |p: &&[f64; 2]| p.iter().all(|c| c.is_finite());
    let axis = |axis: &evidence::Axis, c: usize| {
        let values = points().filter(finite).map(|p| p[c]);
        if axis.log { Axis::decades(values) } else { Axis::linear(values) }
    };
    let (x, y) = (axis(&chart.x, 0), axis(&chart.y, 1));
    let names: Vec<(String, Style)> = chart.series.iter().enumerate().map(named).collect();
    let beside = chart.series.iter().all(|s| ends_right(s, &x)) && names.len() * 16 < 300;
    let widest = names.iter().map(|(name, _)| font::width(name, TEXT.size, false));
    let right = if beside { 36.0 + widest.fold(0.0, f32::max) } else { 24.0 };
    let key =
        if beside { 0.0 } else { legend(&mut Canvas::new(1.0, 1.0), [0.0; 2], SIZE[0], &names) };
    let corner = [LEFT, 16.0 + key];
    let mut canvas = Canvas::new(LEFT + SIZE[0] + right, corner[1] + SIZE[1] + BELOW);
    let panel = Panel { corner, size: SIZE, x, y };
    panel.draw(&mut canvas, (true, true));
    for (series, (_, style)) in chart.series.iter().zip(&names) {
        draw_series(&mut canvas, &panel, series, *style);
    }
    if beside {
        let ends = chart.series.iter().zip(names);
        let ends = ends.filter_map(|(s, (name, style))| Some((last(s, &panel)?[1], name, style)));
        panel.name_curves(&mut canvas, ends.collect());
    } else {
        legend(&mut canvas, [LEFT - 6.0, 4.0], SIZE[0], &names);
    }
    titles(&mut canvas, &panel, chart);
    canvas
}

fn titles(canvas: &mut Canvas, panel: &Panel, chart: &Chart) {
    let middle = Type { anchor: Anchor::Middle, ..TEXT };
    let [left, top] = panel.corner;
    let fitted = |text: &str, room: f32| font::fitted(text, TEXT.size, false, room);
    let x = fitted(&chart.x.label, panel.size[0]);
    canvas.text([left + 0.5 * panel.size[0], panel.bottom() + 38.0], &x, middle);
    let y = fitted(&chart.y.label, panel.size[1]);
    canvas.upright_text([16.0, top + 0.5 * panel.size[1]], &y, middle);
    let nothing = chart.series.iter().all(|s| last(s, panel).is_none());
    if nothing {
        let at = [left + 0.5 * panel.size[0], top + 0.5 * panel.size[1]];
        canvas.text(at, "no values", Type { anchor: Anchor::Middle, ..SMALL });
    }
}

fn named((i, of): (usize, &Series)) -> (String, Style) {
    (font::fitted(&of.label, TEXT.size, false, NAME), series(i))
}

/// Whether a series is a curve that ends near the right edge, where its name can stand.
fn ends_right(series: &Series, x: &Axis) -> bool {
    let last = series.points.iter().rfind(|p| x.shows(p[0]) && p[1].is_finite());
    series.joined && last.is_some_and(|p| x.place(p[0]) > 0.7)
}

fn shown<'a>(series: &'a Series, panel: &Panel) -> impl Iterator<Item = [f64; 2]> + use<'a> {
    let (x, y) = (panel.x.clone(), panel.y.clone());
    let shows =
        move |p: &[f64; 2]| p.iter().all(|c| c.is_finite()) && x.shows(p[0]) && y.shows(p[1]);
    series.points.iter().copied().filter(shows)
}

fn last(series: &Series, panel: &Panel) -> Option<[f64; 2]> {
    shown(series, panel).last()
}

fn draw_series(canvas: &mut Canvas, panel: &Panel, series: &Series, style: Style) {
    let points: Vec<_> = shown(series, panel).map(|[x, y]| panel.at(x, y)).collect();
    if series.joined {
        canvas.line(&points, style.ink, 1.8, None);
    }
    if !series.joined && points.len() > MARKED {
        let ink = Ink { opacity: 150, ..style.ink };
        points.iter().for_each(|point| canvas.disc(*point, 2.2, ink));
    } else if points.len() <= MARKED {
        points.iter().for_each(|point| mark(canvas, *point, style));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(log: bool, points: Vec<[f64; 2]>) -> Chart {
        let axis = |label: &str| {
            if log { evidence::Axis::log(label) } else { evidence::Axis::linear(label) }
        };
        let series = [true, false].map(|joined| Series {
            label: "a series of a name that goes on and on and on and on and on".into(),
            points: points.clone(),
            joined,
        });
        Chart { x: axis("peaks"), y: axis("error"), series: series.into() }
    }

    #[test]
    fn odd_charts_are_drawn() {
        for log in [false, true] {
            for points in [
                vec![],
                vec![[f64::NAN, 1.0]],
                vec![[0.0, 0.0]],
                vec![[-1.0, -1.0], [f64::INFINITY, 2.0]],
                vec![[1e300, 1e-300], [1e-300, 1e300]],
            ] {
                assert!(draw(&chart(log, points)).width() > 0);
            }
        }
        assert!(draw(&Chart { series: vec![], ..chart(false, vec![]) }).width() > 0);
    }
}
