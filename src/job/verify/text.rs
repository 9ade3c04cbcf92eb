//! How two tables, documents or texts differ.

use serde_json::Value as Json;

/// Two tables of comma-separated values with a line of headings; `None` if one is no table, or the same cells stand
/// in both.
pub(super) fn cells(one: &[u8], two: &[u8]) -> Option<String> {
    let [a, b] = [one, two].map(|bytes| {
        let mut reader =
            csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(bytes);
        reader.records().collect::<Result<Vec<_>, _>>().ok()
    });
    let (a, b) = (a?, b?);
    let (headings, others) = (a.first()?, b.first()?);
    if headings != others {
        let [a, b] = [headings, others].map(|row| row.iter().collect::<Vec<_>>().join(","));
        return Some(format!("other columns: {a} and {b}"));
    }
    let (mut first, mut count) = (None, 0usize);
    for (number, (a, b)) in a.iter().zip(&b).enumerate().skip(1) {
        for column in 0..a.len().max(b.len()) {
            let [a, b] = [a, b].map(|row| row.get(column).unwrap_or_default());
            if a != b {
                count += 1;
                let heading = headings.get(column).unwrap_or_default();
                first.get_or_insert_with(|| format!("row {number}, {heading}: {}", apart(a, b)));
            }
        }
    }
    let rows = (a.len() != b.len()).then(|| format!("{} and {} rows", a.len() - 1, b.len() - 1));
    let cells =
        first.map(|first| format!("{first}; {}", counted(count, "cell differs", "cells differ")));
    let told: Vec<_> = rows.into_iter().chain(cells).collect();
    (!told.is_empty()).then(|| told.join("; "))
}

/// Two JSON documents; `None` if one is none, or they hold the same in the same order.
pub(super) fn values(one: &[u8], two: &[u8]) -> Option<String> {
    let [a, b] = [one, two].map(|bytes| serde_json::from_slice::<Json>(bytes).ok());
    let (mut first, mut count) = (None, 0);
    compare(&a?, &b?, &mut String::new(), &mut |told| {
        count += 1;
        first.get_or_insert(told);
    });
    Some(format!("{}; {}", first?, counted(count, "place differs", "places differ")))
}

/// Tells of every place where two values differ; `path` leads to them.
fn compare(one: &Json, two: &Json, path: &mut String, tell: &mut dyn FnMut(String)) {
    let length = path.len();
    match (one, two) {
        (Json::Object(a), Json::Object(b)) => {
            for (key, a) in a {
                path.push('.');
                path.push_str(key);
                match b.get(key) {
                    Some(b) => compare(a, b, path, tell),
                    None => tell(format!("{path} is not written again")),
                }
                path.truncate(length);
            }
            for key in b.keys().filter(|key| !a.contains_key(*key)) {
                tell(format!("{path}.{key} is missing"));
            }
        }
        (Json::Array(a), Json::Array(b)) => {
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                path.push_str(&format!("[{i}]"));
                compare(a, b, path, tell);
                path.truncate(length);
            }
            if a.len() != b.len() {
                tell(format!("{path}: {} and {} of them", a.len(), b.len()));
            }
        }
        (a, b) if a == b => {}
        (a, b) => {
            let told =
                |value: &Json| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            tell(format!("{path}: {}", apart(&told(a), &told(b))));
        }
    }
}

/// Two texts; `None` if one is none.
pub(super) fn lines(one: &[u8], two: &[u8]) -> Option<String> {
    let [a, b] = [std::str::from_utf8(one).ok()?, std::str::from_utf8(two).ok()?];
    let [a, b] = [a, b].map(|text| text.split_inclusive('\n').collect::<Vec<_>>());
    let count = a.iter().zip(&b).filter(|(a, b)| a != b).count() + a.len().abs_diff(b.len());
    let line = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let [x, y] = [&a, &b].map(|lines| lines.get(line).copied().unwrap_or_default());
    let column = x.chars().zip(y.chars()).take_while(|(x, y)| x == y).count();
    let rest = |text: &str| text.trim_end().chars().skip(column).collect::<String>();
    Some(format!(
        "line {}, column {}: {}; {}",
        line + 1,
        column + 1,
        format_args!("`{}` recorded, `{}` again", short(&rest(x)), short(&rest(y))),
        counted(count, "line differs", "lines differ")
    ))
}

/// Two values side by side; of numbers, how far apart they are.
fn apart(one: &str, two: &str) -> String {
    let told = format!("`{}` recorded, `{}` again", short(one), short(two));
    match (one.parse::<f64>(), two.parse::<f64>()) {
        (Ok(a), Ok(b)) if a.is_finite() && b.is_finite() && a != b => {
            let relative = (a - b).abs() / a.abs().max(b.abs());
            format!("{told}, apart by {relative:.1e} of the greater")
        }
        _ => told,
    }
}

/// The beginning of a text that may be long.
fn short(text: &str) -> String {
    const ENOUGH: usize = 48;
    let mut short: String = text.chars().take(ENOUGH).flat_map(char::escape_debug).collect();
    if text.chars().nth(ENOUGH).is_some() {
        short.push('…');
    }
    short
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_told_by_row_and_column() {
        let told = |a: &str, b: &str| cells(a.as_bytes(), b.as_bytes());
        let one = "method,value\nfournier,0.5\nlean,0.25\n";
        assert_eq!(told(one, one), None);
        assert_eq!(
            told(one, &one.replace("0.25", "0.2").replace("0.5", "0.5000")).unwrap(),
            "row 1, value: `0.5` recorded, `0.5000` again; 2 cells differ"
        );
        assert_eq!(
            told(one, &one.replace("0.25", "0.2")).unwrap(),
            "row 2, value: `0.25` recorded, `0.2` again, apart by 2.0e-1 of the greater; 1 cell differs"
        );
        assert_eq!(told(one, "method,value\nfournier,0.5\n").unwrap(), "2 and 1 rows");
        let other = told(one, &one.replace("method", "filter")).unwrap();
        assert_eq!(other, "other columns: method,value and filter,value");
    }

    #[test]
    fn values_are_told_by_path() {
        let told = |a: &str, b: &str| values(a.as_bytes(), b.as_bytes());
        let one = r#"{ "scenes": [{ "slug": "a", "value": 1.0 }], "seed": 1 }"#;
        assert_eq!(told(one, one), None);
        assert_eq!(
            told(one, r#"{ "scenes": [{ "slug": "a", "value": 2.0 }, {}], "format": 2 }"#).unwrap(),
            ".scenes[0].value: `1.0` recorded, `2.0` again, apart by 5.0e-1 of the greater; 4 places differ"
        );
        assert_eq!(told(one, "{"), None);
    }

    #[test]
    fn lines_are_told_by_line_and_column() {
        let told = lines("one\ntwo 2.5\n".as_bytes(), "one\ntwo 2.75\nthree\n".as_bytes());
        assert_eq!(told.unwrap(), "line 2, column 7: `5` recorded, `75` again; 2 lines differ");
        assert_eq!(lines(b"a", &[0xff]), None);
    }
}
