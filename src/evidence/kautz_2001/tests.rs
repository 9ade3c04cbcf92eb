use super::PAPER;
use crate::evidence::{Task, Verdict};
use crate::method::Silent;
use crate::parameter::{Value, Values};

#[test]
fn the_table_row_finds_normals_that_follow_the_ndf() {
    let row = PAPER.rows.iter().find(|row| row.name == "kautz-l").unwrap();
    let mut values = Values::defaults(row.parameters);
    values.set("draws", Value::Number(20_000.0));
    let task = Task { values: &values, seed: 4, parts: &[], progress: &Silent };
    let exhibit = (row.make)(&task).unwrap();
    let follows = &exhibit.claims[0];
    assert_eq!(follows.verdict, Verdict::Reproduced, "{follows:?}");
    assert_eq!(exhibit.tables[0].rows.len(), 15);
}
