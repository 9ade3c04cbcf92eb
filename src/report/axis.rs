//! Logarithmic axes and their ticks.

use super::phrase;

/// The least distance of two labelled values, as a part of the axis.
const APART: f32 = 0.09;

/// A logarithmic axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The value at its low end.
    pub low: f64,
    /// The value at its high end.
    pub high: f64,
    /// Its ticks.
    pub ticks: Vec<Tick>,
}

/// A tick of an [`Axis`].
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where it stands.
    pub value: f64,
    /// Its label; empty for a tick between labelled ones.
    pub label: String,
}

impl Axis {
    /// An axis whose ticks are the values themselves, as far as there is room for them.
    pub fn at_values(mut values: Vec<f64>) -> Self {
        values.retain(|v| *v > 0.0 && v.is_finite());
        values.sort_by(f64::total_cmp);
        values.dedup();
        let (low, high) = spread(&values);
        let mut axis = Self { low, high, ticks: Vec::new() };
        let mut free = 0.0;
        for value in values {
            let place = axis.place(value);
            if place >= free {
                axis.ticks.push(Tick { value, label: phrase::scale(value) });
                free = place + APART;
            }
        }
        axis
    }

    /// An axis that spans the positive values, with ticks at powers of ten, and at 2 and 5 times
    /// them where few decades are seen.
    pub fn decades(values: impl Iterator<Item = f64>) -> Self {
        let positive: Vec<f64> = values.filter(|v| *v > 0.0 && v.is_finite()).collect();
        let (low, high) = spread(&positive);
        let few = libm::log10(high / low) < 2.0;
        let (first, last) = (libm::log10(low).floor() as i32, libm::log10(high).ceil() as i32);
        let decade = |e: i32| {
            (1..10u8).map(move |m| {
                let value = f64::from(m) * libm::pow(10.0, f64::from(e));
                Tick { value, label: tick_label(m, e, few) }
            })
        };
        let ticks = (first..=last).flat_map(decade);
        let ticks = ticks.filter(|t| (low..=high).contains(&t.value)).collect();
        Self { low, high, ticks }
    }

    /// Where a value stands, 0 at the low end and 1 at the high end.
    pub fn place(&self, value: f64) -> f32 {
        (libm::log10(value / self.low) / libm::log10(self.high / self.low)) as f32
    }
}

/// `10⁻³` at a power of ten, `0.02` at 2 and 5 times one if `few`, else nothing.
fn tick_label(multiple: u8, exponent: i32, few: bool) -> String {
    match multiple {
        1 if !few => format!("10^{{{}}}", exponent.to_string().replace('-', "−")),
        1 | 2 | 5 if few => {
            phrase::scale(f64::from(multiple) * libm::pow(10.0, f64::from(exponent)))
        }
        _ => String::new(),
    }
}

/// The range of positive values with some air; around 1 if there are none.
fn spread(values: &[f64]) -> (f64, f64) {
    const AIR: f64 = 1.3;
    let low = values.iter().copied().reduce(f64::min).unwrap_or(1.0);
    let high = values.iter().copied().reduce(f64::max).unwrap_or(1.0);
    let air = if high < 2.0 * low { 2.0 } else { AIR };
    ((low / air).max(f64::MIN_POSITIVE), high * air)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|t| t.label.as_str()).filter(|l| !l.is_empty()).collect()
    }

    #[test]
    fn many_decades_have_powers_and_few_have_numbers() {
        assert_eq!(
            labels(&Axis::decades([1e-4, 1.0].into_iter())),
            ["10^{−4}", "10^{−3}", "10^{−2}", "10^{−1}", "10^{0}"]
        );
        assert_eq!(labels(&Axis::decades([0.01, 0.06].into_iter())), ["0.01", "0.02", "0.05"]);
    }

    #[test]
    fn degenerate_axes_have_an_extent() {
        for values in [vec![], vec![0.0], vec![3.0], vec![f64::NAN, 2.0]] {
            let axis = Axis::decades(values.iter().copied());
            assert!(axis.low < axis.high && axis.place(axis.high) == 1.0, "{values:?}");
            let axis = Axis::at_values(values);
            assert!(axis.low < axis.high);
        }
    }

    #[test]
    fn ticks_at_values_thin_out() {
        let axis = Axis::at_values((0..20).map(|i| f64::from(1 << i)).collect());
        assert!((5..=11).contains(&axis.ticks.len()));
        let gap = |pair: &[Tick]| axis.place(pair[1].value) - axis.place(pair[0].value);
        assert!(axis.ticks.windows(2).all(|pair| gap(pair) >= APART));
        assert_eq!(labels(&Axis::at_values(vec![4.0, 1.0, 4.0])), ["1", "4"]);
    }
}
