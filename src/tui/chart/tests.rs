use super::*;
use proptest::prelude::*;

fn series(names: &[&str], points: &[&[(f64, f64)]]) -> Vec<Series> {
    let labels: Vec<_> = names.iter().map(|n| ((*n).to_owned(), (*n).to_owned())).collect();
    let made = labels.iter().zip(keys(&labels)).zip(points);
    made.map(|(((name, _), key), points)| Series {
        name: name.clone(),
        key,
        points: points.to_vec(),
    })
    .collect()
}

fn chart<'a>(series: &'a [Series], floor: Option<f64>) -> Chart<'a> {
    Chart {
        across: ("samples a pixel", Scale::Counts),
        up: ("RMSE", Scale::Decades),
        series,
        floor: floor.map(|level| (level, "the reference’s own error")),
        nothing: "nothing measured yet",
        chosen: None,
    }
}

fn drawn(chart: &Chart, width: u16, height: u16) -> String {
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    chart.render(buffer.area, &mut buffer);
    text(&buffer)
}

fn text(buffer: &Buffer) -> String {
    let rows = buffer.content.chunks(buffer.area.width.max(1).into());
    let row = |cells: &[ratatui::buffer::Cell]| {
        cells.iter().map(ratatui::buffer::Cell::symbol).collect::<String>().trim_end().to_owned()
    };
    rows.map(row).collect::<Vec<_>>().join("\n")
}

fn example() -> Vec<Series> {
    let brute = [(1.0, 1.5), (4.0, 0.75), (16.0, 0.38), (64.0, 0.19)];
    let (flat, falling) = ([(1.0, 1.0), (4.0, 0.9)], [(1.0, 0.4), (4.0, 0.2)]);
    series(&["unfiltered", "averaged", "olano-north"], &[&brute, &flat, &falling])
}

#[test]
fn a_chart_beside_its_legend() {
    insta::assert_snapshot!(drawn(&chart(&example(), Some(0.05)), 72, 18));
}

#[test]
fn a_narrow_chart_above_its_legend() {
    insta::assert_snapshot!(drawn(&chart(&example(), Some(0.05)), 36, 14));
}

#[test]
fn linear_axes_and_a_chosen_series() {
    let series = example();
    let mut chart = chart(&series, None);
    (chart.up, chart.chosen) = (("flicker", Scale::Linear), Some(1));
    insta::assert_snapshot!(drawn(&chart, 60, 12));
}

#[test]
fn what_has_no_place_is_counted() {
    let odd = [(1.0, 0.5), (4.0, 0.0), (16.0, -1.0), (64.0, f64::NAN), (0.0, 1.0)];
    let text = drawn(&chart(&series(&["averaged"], &[&odd]), Some(0.0)), 70, 12);
    assert!(text.contains("4 points have no place here"), "{text}");
    assert_eq!(text.lines().skip(1).take(8).filter(|line| line.contains('a')).count(), 2, "{text}");
}

#[test]
fn no_point_and_points_on_each_other() {
    assert!(drawn(&chart(&[], None), 60, 12).contains("nothing measured yet"));
    let equal = series(&["averaged", "lean"], &[&[(4.0, 0.5)], &[(4.0, 0.5)]]);
    let text = drawn(&chart(&equal, None), 60, 12);
    assert!(text.contains('*') && text.contains("a averaged") && text.contains("l lean"), "{text}");
    assert_eq!(drawn(&chart(&equal, None), 15, 12).trim(), "no room for a c");
}

#[test]
fn bars_end_with_their_values() {
    let labels = ["unfiltered", "averaged", "olano-north"].map(|n| (n.to_owned(), n.to_owned()));
    let bar = |((name, _), (key, value)): (&(String, String), (Key, f64))| Bar {
        name: name.clone(),
        key,
        value,
    };
    let values = [0.81, 0.4, 0.0123];
    let bars: Vec<Bar> =
        labels.iter().zip(keys(&labels).into_iter().zip(values)).map(bar).collect();
    let drawn = |width, height| {
        let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
        Bars { title: "distance", bars: &bars }.render(buffer.area, &mut buffer);
        text(&buffer)
    };
    insta::assert_snapshot!([drawn(50, 5), drawn(30, 3), drawn(5, 1)].join("\n\n"));
}

proptest! {
    #[test]
    fn nothing_panics(
        values in proptest::collection::vec((any::<f64>(), any::<f64>()), 0..6),
        floor in any::<Option<f64>>(),
        size in (0u16..90, 0u16..30),
        scales in (0usize..3, 0usize..3),
    ) {
        let series = series(&["a", "b"], &[&values, &values[..values.len() / 2]]);
        let mut chart = chart(&series, floor);
        let all = [Scale::Counts, Scale::Decades, Scale::Linear];
        (chart.across.1, chart.up.1) = (all[scales.0], all[scales.1]);
        drawn(&chart, size.0, size.1);
    }
}
