//! Plots of error: against samples a pixel, over all scenes and scene by scene, and against scale.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Type};
use super::chart::{Panel, SMALL, TEXT};
use super::colour::{BLACK, GREY, Style, styles};
use super::contest::{Comparison, Contest, Setting, curve, geometric_mean, unique};
use super::font;
use super::grid::{Cell, Curve, Grid, MIDDLE, draw_curves, error_axis};
use super::scale::Scale;
use super::tables::label;
use crate::experiment::results::{MethodInfo, SceneResult};

/// The methods with their styles.
pub fn styled<'a>(comparison: &Comparison<'a>) -> impl Iterator<Item = (&'a MethodInfo, Style)> {
    comparison.results.methods.iter().zip(styles(&comparison.results.methods))
}

/// A plot and what it averages over.
pub struct Overall {
    /// The plot.
    pub drawing: Canvas,
    /// Number of scenes averaged.
    pub scenes: usize,
    /// Whether every method took part in each of them.
    pub complete: bool,
    /// Exponent of the number of samples in the brute-force error, from first point to last.
    pub slope: Option<f64>,
}

/// The scenes that every method took part in, and true; all scenes, and false, if there are none.
pub fn shared_scenes<'a>(comparison: &Comparison<'a>) -> (Vec<&'a SceneResult>, bool) {
    let labels = comparison.results.methods.iter().map(|m| &m.label);
    let takes_part = |scene: &SceneResult, label: &str| !curve(scene, label).is_empty();
    let full = |scene: &SceneResult| labels.clone().all(|label| takes_part(scene, label));
    let measured: Vec<_> = comparison.contests().map(|c| c.scene).collect();
    let shared: Vec<_> = measured.iter().copied().filter(|s| full(s)).collect();
    if shared.is_empty() { (measured, false) } else { (shared, true) }
}

/// Error against samples a pixel, the geometric mean over the scenes that every method took part in
/// (over all scenes if there are none). `None` if nothing was measured.
pub fn overall(comparison: &Comparison) -> Option<Overall> {
    let (scenes, complete) = shared_scenes(comparison);
    let curves: Vec<_> = styled(comparison)
        .map(|(method, style)| Curve { method, style, points: mean_curve(&scenes, &method.label) })
        .filter(|c| !c.points.is_empty())
        .collect();
    let floor = geometric_mean(scenes.iter().map(|s| s.reference.rmse));
    (!curves.is_empty()).then(|| Overall {
        drawing: draw_overall(&curves, floor),
        scenes: scenes.len(),
        complete,
        slope: curves.iter().find(|c| c.method.name == "unfiltered").and_then(|c| slope(&c.points)),
    })
}

/// The geometric mean of a method's errors at each number of samples that all its scenes have.
pub fn mean_curve(scenes: &[&SceneResult], label: &str) -> Vec<(f64, f64)> {
    let curves: Vec<_> = scenes.iter().map(|s| curve(s, label)).filter(|c| !c.is_empty()).collect();
    let mut counts = unique(curves.iter().flatten().map(|(spp, _)| *spp));
    counts.sort_unstable();
    let at = |spp: u32| {
        let found = curves.iter().filter_map(|c| c.iter().find(|(n, _)| *n == spp));
        let errors: Vec<f64> = found.map(|(_, error)| *error).collect();
        let shared = errors.len() == curves.len();
        shared.then(|| geometric_mean(errors.into_iter())).flatten()
    };
    counts.into_iter().filter_map(|spp| Some((f64::from(spp), at(spp)?))).collect()
}

/// d ln error / d ln samples between the ends of a curve.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let [first, .., last] = points[..] else { return None };
    let slope = libm::log(last.1 / first.1) / libm::log(last.0 / first.0);
    slope.is_finite().then_some(slope)
}

fn draw_overall(curves: &[Curve], floor: Option<f64>) -> Canvas {
    let names: Vec<_> = curves.iter().map(|c| label(c.method)).collect();
    let widest = names.iter().map(|n| font::width(n, TEXT.size, false)).fold(0.0, f32::max);
    let mut canvas = Canvas::new(70.0 + 560.0 + 40.0 + widest.min(260.0), 430.0);
    const FLOOR_ROOM: f64 = 1.5;
    let counts = curves.iter().flat_map(|c| &c.points).map(|p| p.0);
    let panel = Panel {
        corner: [64.0, 16.0],
        size: [560.0, 360.0],
        x: Axis::at_values(counts.collect()),
        y: error_axis(curves.iter(), floor.map(|f| f / FLOOR_ROOM).into_iter()),
    };
    let floor_value = floor.unwrap_or(0.0);
    panel.floor(&mut canvas, floor_value);
    panel.draw(&mut canvas, (true, true));
    slope_guide(&mut canvas, &panel, curves);
    draw_curves(&mut canvas, &panel, curves);
    let ends = curves.iter().zip(names).filter_map(|(c, name)| {
        let error = c.points.last()?.1;
        Some((error, font::fitted(&name, TEXT.size, false, 260.0), c.style))
    });
    panel.name_curves(&mut canvas, ends.filter(|(error, ..)| *error > 0.0).collect());
    if floor_value > 0.0 {
        let [_, y] = panel.at(1.0, floor_value);
        let at = [panel.corner[0] + 8.0, (y + 14.0).min(panel.bottom() - 5.0)];
        canvas.text(at, "the reference’s own error", SMALL);
    }
    axis_titles(&mut canvas, &panel, "samples a pixel");
    canvas
}

/// Lines of slope −½ and −1 from the start of the brute-force curve: how independent samples converge, and how
/// well-spread ones may at best where the integrand is not smooth.
fn slope_guide(canvas: &mut Canvas, panel: &Panel, curves: &[Curve]) {
    let Some(brute) = curves.iter().find(|c| c.style.heavy) else { return };
    let [first, .., last] = brute.points[..] else { return };
    let steep = (last.0, (first.1 * first.0 / last.0).max(panel.y.low));
    let cut = (first.1 * first.0 / steep.1).min(last.0);
    let line = [panel.at(first.0, first.1), panel.at(cut, steep.1)];
    canvas.line(&line, GREY, 1.0, Some([1.0, 4.0]));
    canvas.text([line[1][0] - 34.0, line[1][1] - 8.0], "−1", SMALL);
    let end = (last.0, first.1 * (first.0 / last.0).sqrt());
    let line = [panel.at(first.0, first.1), panel.at(end.0, end.1)];
    canvas.line(&line, GREY, 1.2, Some([1.5, 2.5]));
    // The line falls to the right: text that clears it where it begins clears it all along.
    const NAME: &str = "independent samples, slope −½";
    let ([left, top], [right, bottom]) = (line[0], line[1]);
    let along = font::width(NAME, SMALL.size, false) / (right - left).max(1.0);
    let at = [right, bottom - along * (bottom - top) - 6.0];
    canvas.text(at, NAME, Type { anchor: Anchor::End, ..SMALL });
}

/// Names both axes; the one that goes up is RMSE.
pub fn axis_titles(canvas: &mut Canvas, panel: &Panel, across: &str) {
    let middle = [panel.corner[0] + 0.5 * panel.size[0], panel.bottom() + 36.0];
    canvas.text(middle, across, Type { ink: BLACK, ..MIDDLE });
    let left = [panel.corner[0] - 48.0, panel.corner[1] + 0.5 * panel.size[1]];
    canvas.upright_text(left, "RMSE", Type { ink: BLACK, ..MIDDLE });
}

fn names(comparison: &Comparison) -> Vec<(String, Style)> {
    styled(comparison).map(|(m, style)| (label(m), style)).collect()
}

/// Error against samples a pixel: a row a texture, a column a scale.
pub fn by_scene(comparison: &Comparison, setting: &Setting) -> Option<Canvas> {
    let cell = |texture: &str, scale: &Scale| {
        let title = format!("{texture}, {}", scale.label);
        let contest = setting.at(scale).find(|c| c.scene.key.texture == texture);
        let curves = contest.map_or_else(Vec::new, |c| scene_curves(comparison, c));
        Cell { title, curves, floor: contest.map_or(0.0, |c| c.scene.reference.rmse) }
    };
    let rows = setting.textures().into_iter();
    let panels = rows.flat_map(|t| setting.scales.iter().map(move |s| cell(t, s)));
    let (panels, across) = (panels.collect(), setting.scales.len());
    Grid { panels, across, x_title: "samples a pixel" }.draw(&names(comparison))
}

fn scene_curves<'a>(comparison: &Comparison<'a>, contest: &Contest<'a>) -> Vec<Curve<'a>> {
    let points = |label: &str| curve(contest.scene, label).into_iter();
    let curves = styled(comparison).map(|(method, style)| Curve {
        method,
        style,
        points: points(&method.label).map(|(spp, error)| (f64::from(spp), error)).collect(),
    });
    curves.filter(|c| !c.points.is_empty()).collect()
}

/// Error against texels a pixel at the fewest samples: a panel a texture, a line a method. `None` if
/// there is but one scale.
pub fn by_scale(comparison: &Comparison, setting: &Setting) -> Option<Canvas> {
    if setting.scales.len() < 2 {
        return None;
    }
    let cell = |texture: &str| {
        let contests = setting.contests.iter().filter(|c| c.scene.key.texture == texture);
        let contests: Vec<_> = contests.collect();
        let floor = geometric_mean(contests.iter().map(|c| c.scene.reference.rmse));
        let curves = styled(comparison).map(|(method, style)| Curve {
            method,
            style,
            points: scale_points(&contests, &method.label),
        });
        let curves = curves.filter(|c| !c.points.is_empty()).collect();
        Cell { title: texture.to_owned(), curves, floor: floor.unwrap_or(0.0) }
    };
    let panels: Vec<_> = setting.textures().into_iter().map(cell).collect();
    // Rows as even as they can be, of four at most.
    let across = panels.len().div_ceil(panels.len().div_ceil(4).max(1));
    Grid { panels, across, x_title: "texels a pixel" }.draw(&names(comparison))
}

fn scale_points(contests: &[&Contest], label: &str) -> Vec<(f64, f64)> {
    let point = |c: &&Contest| Some((c.scene.key.texels_per_pixel, c.standing(label)?.error));
    let mut points: Vec<_> = contests.iter().filter_map(point).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn the_mean_is_over_scenes_that_every_method_took_part_in() {
        let results = fixture::results();
        let plot = overall(&Comparison::of(&results)).unwrap();
        assert_eq!((plot.scenes, plot.complete), (8, true));
    }

    #[test]
    fn nothing_to_plot_is_no_plot() {
        let mut results = fixture::results();
        results.scenes.iter_mut().for_each(|s| s.trials.clear());
        let comparison = Comparison::of(&results);
        assert!(overall(&comparison).is_none());
        assert!(by_scene(&comparison, &comparison.settings[0]).is_none());
    }

    #[test]
    fn perfect_methods_and_single_counts_are_drawn() {
        let mut results = fixture::results();
        for scene in &mut results.scenes {
            scene.reference.rmse = 0.0;
            scene.trials.retain(|t| t.spp == 1);
            scene.trials[0].scores[0].value = 0.0;
        }
        let comparison = Comparison::of(&results);
        assert!(overall(&comparison).is_some());
        assert!(by_scale(&comparison, &comparison.settings[0]).is_some());
    }
}
