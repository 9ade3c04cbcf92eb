//! The options of a pattern or method, read against their description.

use super::limits::Limits;
use super::reader::Reader;
use crate::parameter::{Domain, Parameter, Value, Values};

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
    }
}
