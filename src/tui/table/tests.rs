use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::*;

fn table() -> Table {
    let mut table = Table::new(vec![
        Column::text("method", 0),
        Column::numbers("spp", 1),
        Column::numbers("RMSE", 2),
        Column::text("scene", 3),
    ]);
    let row = |method: &str, spp, rmse, scene: &str| {
        let text = |text: &str| Cell::Text(text.to_owned());
        vec![text(method), Cell::count(Some(spp)), Cell::number(rmse), text(scene)]
    };
    table.set_rows(vec![
        row("unfiltered", 16, Some(0.3), "twill-2-texels"),
        row("unfiltered", 4, Some(0.6), "twill-2-texels"),
        row("averaged", 1, Some(f64::NAN), "twill-2-texels"),
        row("lean", 1, Some(0.045_61), "twill-2-texels"),
        row("lean", 1, Some(0.045_61), "平織り-texels"),
    ]);
    table
}

fn drawn(table: &Table, width: u16, height: u16) -> String {
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    TableView { table, focused: true }.render(buffer.area, &mut buffer);
    let row = |cells: &[ratatui::buffer::Cell]| {
        cells.iter().map(ratatui::buffer::Cell::symbol).collect::<String>().trim_end().to_owned()
    };
    buffer.content.chunks(width.max(1).into()).map(row).collect::<Vec<_>>().join("\n")
}

fn methods(table: &Table) -> Vec<String> {
    table.shown().map(|cells| format!("{} {}", cells[0].shown(), cells[1].shown())).collect()
}

#[test]
fn numbers_are_sorted_as_numbers_and_what_is_missing_comes_last() {
    let mut table = table();
    table.sort_by(2);
    let rising = methods(&table);
    assert_eq!(rising, ["lean 1", "lean 1", "unfiltered 16", "unfiltered 4", "averaged 1"]);
    table.sort_by(2);
    let falling = methods(&table);
    assert_eq!(falling, ["unfiltered 4", "unfiltered 16", "lean 1", "lean 1", "averaged 1"]);
    table.sort_by(2);
    assert_eq!(table.sorted_by(), None);
    assert_eq!(methods(&table)[0], "unfiltered 16");
    table.sort_by(9);
    assert_eq!(table.sorted_by(), None);
}

#[test]
fn equal_rows_stay_in_their_order() {
    let mut table = table();
    table.sort_by(0);
    assert_eq!(methods(&table)[3..], ["unfiltered 16", "unfiltered 4"]);
    table.sort_by(0);
    assert_eq!(methods(&table)[..2], ["unfiltered 16", "unfiltered 4"]);
}

#[test]
fn the_chosen_row_stays_chosen() {
    let mut table = table();
    table.go(3);
    let lean = table.chosen_row().unwrap().to_vec();
    table.sort_by(2);
    assert_eq!((table.chosen(), table.chosen_row().unwrap()), (0, lean.as_slice()));
    let mut more: Vec<Vec<Cell>> = table.shown().map(<[Cell]>::to_vec).collect();
    more.push(vec![Cell::Text("best".into()), Cell::None, Cell::number(Some(1e-3))]);
    // What is measured meanwhile makes no other row of it.
    more[0][2] = Cell::number(Some(2e-3));
    table.set_rows(more);
    assert_eq!((table.chosen(), &table.chosen_row().unwrap()[..2]), (1, &lean[..2]));
    table.go(100);
    assert_eq!(table.chosen(), 5);
    table.set_rows(Vec::new());
    assert_eq!((table.chosen(), table.chosen_row()), (0, None));
}

#[test]
fn sorting_goes_around_the_columns() {
    let mut table = table();
    table.sort_by_next(1);
    table.sort_by_next(-1);
    assert_eq!(table.sorted_by(), Some((3, false)));
    table.turn_around();
    assert_eq!(table.sorted_by(), Some((3, true)));
}

#[test]
fn columns_leave_where_there_is_no_room() {
    let mut table = table();
    table.sort_by(2);
    insta::assert_snapshot!([60, 34, 22, 8].map(|width| drawn(&table, width, 6)).join("\n\n"));
}

#[test]
fn the_chosen_row_is_always_seen() {
    let mut table = table();
    for place in 0..5 {
        assert!(drawn(&table, 60, 3).contains('▸'), "{place}");
        table.go(1);
    }
}

proptest! {
    #[test]
    fn no_size_panics(width in 0u16..80, height in 0u16..9, steps in 0isize..9, by in 0usize..5) {
        let mut table = table();
        table.sort_by(by);
        table.go(steps);
        drawn(&table, width, height);
        drawn(&Table::default(), width, height);
    }
}
