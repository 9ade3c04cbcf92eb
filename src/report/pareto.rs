//! Pareto fronts: error against what it costs, in bytes a texel and in nanoseconds a pixel. What is on the front is
//! beaten by nothing in both.

use super::axis::{Axis, Tick};
use super::canvas::{Canvas, Type};
use super::chart::{Panel, TEXT};
use super::colour::{BLACK, Ink};
use super::contest::{Comparison, median};
use super::curves::{axis_titles, mean_curve, shared_scenes, styled};
use super::font;
use super::grid::{Curve, draw_curves, error_axis};
use super::tables::label;
use crate::experiment::results::Costs;

/// The front's colour, behind the curves.
const FRONT: Ink = Ink::new([0xb8, 0xc4, 0xce]);
/// The widest name, units.
const NAMES: f32 = 260.0;

/// Error at the fewest samples against the bytes a texel that a method holds beside the normal map.
pub fn memory(comparison: &Comparison, costs: &Costs) -> Option<Canvas> {
    let (scenes, _) = shared_scenes(comparison);
    let points = styled(comparison).map(|(method, style)| {
        let of = costs.prefilters.iter().filter(|p| p.method == method.label);
        let bytes = median(of.map(|p| p.bytes_per_texel).collect(), |v| v);
        let curve = mean_curve(&scenes, &method.label).into_iter();
        let error = curve.filter(|(spp, _)| *spp == f64::from(comparison.spp)).map(|p| p.1).next();
        Curve { method, style, points: bytes.zip(error).into_iter().collect() }
    });
    let mut curves: Vec<Curve> = points.filter(|c| !c.points.is_empty()).collect();
    let counts = curves.iter().flat_map(|c| &c.points).map(|p| p.0);
    let least = counts.filter(|bytes| *bytes > 0.0).fold(f64::INFINITY, f64::min);
    // A logarithm has no place for nothing: it stands apart at the left, named for what it is.
    let nothing = if least.is_finite() { 0.5 * least } else { 1.0 };
    let points = curves.iter_mut().flat_map(|c| &mut c.points);
    points.filter(|p| p.0 <= 0.0).for_each(|p| p.0 = nothing);
    let mut x = Axis::at_values(curves.iter().flat_map(|c| &c.points).map(|p| p.0).collect());
    x.ticks.retain(|tick| tick.value != nothing);
    x.ticks.insert(0, Tick { value: nothing, label: "0".into() });
    draw(&curves, x, "bytes a texel beside the normal map")
}

/// Error against nanoseconds a pixel, at every number of samples measured.
pub fn time(comparison: &Comparison, costs: &Costs) -> Option<Canvas> {
    let (scenes, _) = shared_scenes(comparison);
    let nanoseconds = |label: &str, spp: f64| {
        let of = costs.trials.iter().filter(|t| t.method == label && f64::from(t.spp) == spp);
        let shared = of.filter(|t| scenes.iter().any(|scene| scene.slug == t.scene));
        median(shared.map(|t| t.ns_per_pixel).collect(), |v| v).filter(|ns| *ns > 0.0)
    };
    let curves = styled(comparison).map(|(method, style)| {
        let curve = mean_curve(&scenes, &method.label).into_iter();
        let points = curve.filter_map(|(spp, e)| Some((nanoseconds(&method.label, spp)?, e)));
        Curve { method, style, points: points.collect() }
    });
    let curves: Vec<Curve> = curves.filter(|c| !c.points.is_empty()).collect();
    let x = Axis::decades(curves.iter().flat_map(|c| &c.points).map(|p| p.0));
    draw(&curves, x, "CPU nanoseconds a pixel")
}

/// The points that none is better than in both, by rising cost.
fn front(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut least = f64::INFINITY;
    points.retain(|(_, error)| {
        let better = *error < least;
        least = least.min(*error);
        better
    });
    points
}

fn draw(curves: &[Curve], x: Axis, across: &str) -> Option<Canvas> {
    if curves.is_empty() {
        return None;
    }
    let names: Vec<_> = curves.iter().map(|c| label(c.method)).collect();
    let widest = names.iter().map(|n| font::width(n, TEXT.size, false)).fold(0.0, f32::max);
    let mut canvas = Canvas::new(670.0 + widest.min(NAMES), 430.0);
    let y = error_axis(curves.iter(), std::iter::empty());
    let panel = Panel { corner: [64.0, 16.0], size: [560.0, 360.0], x, y };
    panel.draw(&mut canvas, (true, true));
    let found = front(curves.iter().flat_map(|c| c.points.iter().copied()).collect());
    let corners = found.windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]);
    let end = found.last().map(|last| (panel.x.high, last.1));
    let steps = corners.chain(found.last().copied()).chain(end);
    let line: Vec<_> = steps.map(|(cost, error)| panel.at(cost, error)).collect();
    canvas.line(&line, FRONT, 5.0, None);
    draw_curves(&mut canvas, &panel, curves);
    let ends = curves.iter().zip(names).filter_map(|(curve, name)| {
        let error = curve.points.last()?.1;
        Some((error, font::fitted(&name, TEXT.size, false, NAMES), curve.style))
    });
    panel.name_curves(&mut canvas, ends.filter(|(error, ..)| *error > 0.0).collect());
    axis_titles(&mut canvas, &panel, across);
    let on_it = Type { ink: BLACK, ..TEXT };
    canvas.text(
        [panel.corner[0] + 8.0, panel.bottom() - 8.0],
        "broad line: the Pareto front",
        on_it,
    );
    Some(canvas)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_front_holds_what_nothing_beats_in_both() {
        let points = vec![(4.0, 2.0), (1.0, 5.0), (2.0, 6.0), (4.0, 1.0), (8.0, 1.0), (2.0, 3.0)];
        assert_eq!(front(points), [(1.0, 5.0), (2.0, 3.0), (4.0, 1.0)]);
        assert!(front(vec![]).is_empty());
    }

    #[test]
    fn methods_that_hold_nothing_and_missing_costs_are_drawn_or_left_out() {
        let (results, mut costs) = (fixture::results(), fixture::costs());
        let comparison = Comparison::of(&results);
        costs.prefilters[0].bytes_per_texel = 0.0;
        assert!(memory(&comparison, &costs).is_some() && time(&comparison, &costs).is_some());
        costs.prefilters.iter_mut().for_each(|p| p.bytes_per_texel = 0.0);
        assert!(memory(&comparison, &costs).is_some());
        assert!(memory(&comparison, &Costs::default()).is_none());
        assert!(time(&comparison, &Costs::default()).is_none());
    }
}
