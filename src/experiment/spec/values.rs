//! The options of a pattern or method, read against their description.

use super::item::Item;
use super::limits::Limits;
use super::reader::Reader;
use crate::parameter::{Column, Domain, Parameter, Value, Values, row_form};

/// Reads a value for every parameter; a silent or wrong one has its default.
pub(super) fn read_values(reader: &Reader, parameters: &[Parameter]) -> Values {
    let mut values = Values::defaults(parameters);
    for parameter in parameters {
        if let Some(value) = read_value(reader, parameter) {
            values.set(parameter.name, value);
        }
    }
    values
}

fn read_value(reader: &Reader, parameter: &Parameter) -> Option<Value> {
    let item = reader.option(parameter.name)?;
    match parameter.domain {
        Domain::Real { min, max, .. } => item.real(Limits::from_to(min, max)).map(Value::Number),
        Domain::Whole { min, max, .. } => {
            item.whole(min.into(), max.into()).map(|whole| Value::Number(whole as f64))
        }
        Domain::Choice { words } => {
            let choices: Vec<_> = words.iter().map(|word| (*word, *word)).collect();
            item.choice(&choices).map(Value::Word)
        }
        Domain::Text { check, .. } => {
            let text = item.text()?;
            match check(text) {
                Ok(()) => Some(Value::Text(text.to_owned())),
                Err(wrong) => {
                    item.error(format!("`{}` {wrong}", parameter.name), None);
                    None
                }
            }
        }
        Domain::Rows { columns, most, .. } => {
            let form = row_form(columns);
            let expected = format!("a list of 1 to {most} rows {form}");
            let rows = item.members(1..=most, &expected)?;
            // All rows are read before any is missed, so that all errors are told.
            let rows: Vec<_> = rows.iter().map(|row| read_row(row, columns, &form)).collect();
            rows.into_iter().collect::<Option<_>>().map(Value::Rows)
        }
    }
}

fn read_row(row: &Item, columns: &[Column], form: &str) -> Option<Vec<f64>> {
    let numbers = row.members(columns.len()..=columns.len(), form)?;
    let read = |(number, column): (&Item, &Column)| {
        let number = number.called(format!("`{}` of each row", column.name));
        if column.whole {
            number.integer_from(column.min as i64, column.max as i64).map(|whole| whole as f64)
        } else {
            number.real(Limits::from_to(column.min, column.max))
        }
    };
    let read: Vec<_> = numbers.iter().zip(columns).map(read).collect();
    read.into_iter().collect()
}
