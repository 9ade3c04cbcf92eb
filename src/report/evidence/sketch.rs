//! Diagrams of lines and arrows.

use crate::evidence::{Sketch, Stroke};
use crate::report::canvas::{Canvas, Point, Type};
use crate::report::chart::TEXT;
use crate::report::colour::{BLACK, Ink, series};
use crate::report::font;

/// Units that the longer side of a diagram takes, and around it.
const LONG: f64 = 400.0;
const GAP: f32 = 36.0;
const TITLE: f32 = 22.0;
/// Length of an arrow's head, units.
const HEAD: f32 = 9.0;

/// Diagrams side by side, each to its own scale.
pub fn draw(sketches: &[Sketch]) -> Canvas {
    let papers: Vec<Paper> = sketches.iter().map(Paper::of).collect();
    let width: f32 = papers.iter().map(|paper| paper.size[0] + 2.0 * GAP).sum();
    let height = papers.iter().map(|paper| paper.size[1]).fold(0.0, f32::max);
    let mut canvas = Canvas::new(width.max(1.0), height + 2.0 * GAP + TITLE);
    let mut left = GAP;
    for (paper, sketch) in papers.iter().zip(sketches) {
        let label = font::fitted(&sketch.label, TEXT.size, true, paper.size[0] + GAP);
        canvas.text([left, 18.0], &label, Type { bold: true, ..TEXT });
        for stroke in &sketch.strokes {
            let points: Vec<Point> =
                stroke.points.iter().filter_map(|p| paper.at(left, *p)).collect();
            draw_stroke(&mut canvas, stroke, &points);
        }
        left += paper.size[0] + 2.0 * GAP;
    }
    canvas
}

fn draw_stroke(canvas: &mut Canvas, stroke: &Stroke, points: &[Point]) {
    let ink = match stroke.ink {
        0 => BLACK,
        i => series(i - 1).ink,
    };
    let Some(&end) = points.last() else { return };
    canvas.line(points, ink, 1.6, None);
    if let (true, [.., from, _]) = (stroke.arrow, points) {
        head(canvas, *from, end, ink);
    }
    let place = [end[0] + 6.0, end[1] - 5.0];
    canvas.text(place, &font::fitted(&stroke.name, TEXT.size, false, 160.0), Type { ink, ..TEXT });
}

fn head(canvas: &mut Canvas, from: Point, end: Point, ink: Ink) {
    let [x, y] = [end[0] - from[0], end[1] - from[1]];
    let length = (x * x + y * y).sqrt();
    if length > 1e-3 {
        let [x, y] = [x / length * HEAD, y / length * HEAD];
        let side = |s: f32| [end[0] - x - s * y, end[1] - y + s * x];
        canvas.polygon(&[end, side(0.35), side(-0.35)], ink);
    }
}

/// The plane of a diagram on paper.
struct Paper {
    low: [f64; 2],
    scale: f64,
    size: [f32; 2],
}

impl Paper {
    fn of(sketch: &Sketch) -> Self {
        let points = || sketch.strokes.iter().flat_map(|s| &s.points);
        let ends = [0, 1].map(|c| {
            let all = points().map(|p| p[c]).filter(|x| x.is_finite());
            let (low, high) = all.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
            if low <= high { [low, high] } else { [0.0, 1.0] }
        });
        let long = ends.map(|[low, high]| high - low).into_iter().fold(0.0, f64::max);
        let scale = if long > 0.0 && long.is_finite() { LONG / long } else { 1.0 };
        let size = ends.map(|[low, high]| ((high - low) * scale).clamp(1.0, LONG) as f32);
        Self { low: ends.map(|[low, _]| low), scale, size }
    }

    fn at(&self, left: f32, point: [f64; 2]) -> Option<Point> {
        let [x, y] = [0, 1].map(|c| (point[c] - self.low[c]) * self.scale);
        let finite = x.is_finite() && y.is_finite();
        finite.then(|| [left + x as f32, TITLE + GAP + self.size[1] - y as f32])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sketch(points: Vec<[f64; 2]>) -> Sketch {
        let stroke = Stroke { points, arrow: true, name: "N".into(), ink: 1 };
        Sketch { label: "a diagram".into(), strokes: vec![stroke] }
    }

    #[test]
    fn up_is_up() {
        let paper = Paper::of(&sketch(vec![[0.0, 0.0], [2.0, 1.0]]));
        let [low, high] = [[0.0, 0.0], [2.0, 1.0]].map(|p| paper.at(0.0, p).unwrap());
        assert!(low[1] > high[1] && (high[0] - low[0] - 400.0).abs() < 1e-3);
    }

    #[test]
    fn odd_diagrams_are_drawn() {
        for points in [
            vec![],
            vec![[f64::NAN, 1.0]],
            vec![[1.0, 1.0], [1.0, 1.0]],
            vec![[-1e308, 0.0], [1e308, 0.0]],
        ] {
            assert!(draw(&[sketch(points)]).width() > 0);
        }
        assert!(draw(&[]).width() > 0);
    }
}
