//! Numbers and lists as a reader wants them.

use libm::{exp10, floor, log10};

use crate::metric::Equivalent;

/// Three significant digits, as `0.0123`, `12.3` or `1230`; `1.23×10⁻⁷` where zeros would pile up.
pub fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let scientific = format!("{value:.2e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    match exponent {
        -4..=2 => format!("{value:.*}", (2 - exponent) as usize),
        3..=5 => {
            let unit = [10.0, 100.0, 1000.0][(exponent - 3) as usize];
            format!("{:.0}", (value / unit).round() * unit)
        }
        _ => format!("{mantissa}×10{}", superscript(exponent)),
    }
}

/// A number, and how far from it the ends of its interval are at most, if that is more than its digits leave open:
/// `0.0123`, `0.0123 ± 0.0004`.
pub fn number_within(value: f64, interval: Option<[f64; 2]>) -> String {
    let text = number(value);
    let Some([low, high]) = interval else { return text };
    if !value.is_finite() || value == 0.0 {
        return text;
    }
    let either_way = (high - value).max(value - low);
    // A unit of the third digit.
    let unit = exp10(floor(log10(value.abs())) - 2.0);
    if either_way.is_nan() || either_way <= 0.5 * unit {
        return text;
    }
    format!("{text}\u{a0}±\u{a0}{}", rounded_up(either_way))
}

/// One digit, rounded up: what stands behind ± must not promise more than is known.
fn rounded_up(value: f64) -> String {
    if !value.is_finite() {
        return "∞".into();
    }
    let unit = exp10(floor(log10(value)));
    let up = (value / unit * (1.0 - 1e-9)).ceil() * unit;
    let text = number(up);
    if !text.contains('.') {
        return text;
    }
    match text.split_once('×') {
        Some((mantissa, power)) => format!("{}×{power}", trim(mantissa)),
        None => trim(&text).to_owned(),
    }
}

fn trim(text: &str) -> &str {
    text.trim_end_matches('0').trim_end_matches('.')
}

/// Three significant digits without trailing zeros: for scales, which are mostly round numbers.
pub fn scale(value: f64) -> String {
    let text = number(value);
    if text.contains('.') && !text.contains('×') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

/// The same with a proper minus sign.
pub fn signed_scale(value: f64) -> String {
    scale(value).replace('-', "−")
}

/// A factor, to two digits: `1.8`, `18`.
pub fn times(value: f64) -> String {
    if value < 9.95 {
        format!("{value:.1}")
    } else {
        number(value.round()).trim_end_matches(".0").into()
    }
}

/// A part of a whole, to two digits at least: `4.3 %`, `51 %`, `105 %`.
pub fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if percent < 9.95 {
        format!("{percent:.1}\u{a0}%")
    } else {
        format!("{}\u{a0}%", number(percent.round()).trim_end_matches(".0"))
    }
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    exponent.to_string().chars().map(digit).collect()
}

/// `1 scene`, `3 scenes`.
pub fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// `a`, `a and b`, `a, b and c`.
pub fn list<S: AsRef<str>>(items: &[S]) -> String {
    match items {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [most @ .., last] => {
            let most: Vec<&str> = most.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", most.join(", "), last.as_ref())
        }
    }
}

/// A number of samples: `37`, `more than 256`, `fewer than 1`.
pub fn samples(equivalent: Equivalent) -> String {
    match equivalent {
        Equivalent::Samples(n) if n < 10.0 => scale((n * 10.0).round() / 10.0),
        Equivalent::Samples(n) => number(n.round()).trim_end_matches(".0").to_owned(),
        Equivalent::MoreThan(n) => format!("more than {n}"),
        Equivalent::FewerThan(n) => format!("fewer than {n}"),
    }
}

/// The same for a table's cell: `37`, `> 256`, `< 1`.
pub fn samples_short(equivalent: Equivalent) -> String {
    samples(equivalent).replace("more than", ">").replace("fewer than", "<")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_told_where_the_digits_promise_more() {
        let told = |value, half| number_within(value, Some([value - half, value + half]));
        assert_eq!(told(0.01234, 0.00004), "0.0123");
        assert_eq!(told(0.01234, 0.00041), "0.0123\u{a0}±\u{a0}0.0005");
        assert_eq!(told(1.234, 0.2), "1.23\u{a0}±\u{a0}0.2");
        assert_eq!(told(12340.0, 130.0), "12300\u{a0}±\u{a0}200");
        assert_eq!(told(1.5e-7, 2e-8), "1.50×10⁻⁷\u{a0}±\u{a0}2×10⁻⁸");
        // The farther end counts.
        assert_eq!(number_within(1.0, Some([0.7, 1.0])), "1.00\u{a0}±\u{a0}0.3");
        assert_eq!(number_within(1.0, None), "1.00");
        assert_eq!(number_within(0.0, Some([0.0, 1.0])), "0");
    }

    #[test]
    fn numbers_keep_three_digits() {
        let cases = [
            (0.0, "0"),
            (0.012345, "0.0123"),
            (0.000_123_45, "0.000123"),
            (1.234_5e-7, "1.23×10⁻⁷"),
            (9.999, "10.00"),
            (12.345, "12.3"),
            (123.45, "123"),
            (12345.0, "12300"),
            (-0.5, "-0.500"),
            (2.5e12, "2.50×10¹²"),
        ];
        for (value, wanted) in cases {
            // 9.999 rounds up a digit: the exponent of the rounded value counts.
            let wanted = if value == 9.999 { "10.0" } else { wanted };
            assert_eq!(number(value), wanted);
        }
    }

    #[test]
    fn scales_drop_trailing_zeros() {
        assert_eq!(
            [scale(8.0), scale(0.5), scale(1000.0), scale(2.25)],
            ["8", "0.5", "1000", "2.25"]
        );
    }

    #[test]
    fn percentages_have_two_digits_or_the_whole() {
        let texts = [0.0432, 0.513, 0.0951, 1.05, 0.0].map(percent);
        assert_eq!(texts, ["4.3\u{a0}%", "51\u{a0}%", "9.5\u{a0}%", "105\u{a0}%", "0.0\u{a0}%"]);
    }

    #[test]
    fn lists_and_counts_read_as_english() {
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
        assert_eq!(
            (list(&["a"]), count(1, "scene"), count(0, "scene")),
            ("a".into(), "1 scene".into(), "0 scenes".into())
        );
    }

    #[test]
    fn samples_say_when_they_are_bounds() {
        assert_eq!(samples(Equivalent::Samples(36.7)), "37");
        assert_eq!(samples(Equivalent::Samples(1.04)), "1");
        assert_eq!(samples(Equivalent::MoreThan(256)), "more than 256");
        assert_eq!(samples_short(Equivalent::FewerThan(1)), "< 1");
    }
}
