//! Axes and their ticks.

use super::phrase;

/// The least distance of two labelled values, as a part of the axis.
const APART: f32 = 0.09;

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Whether it is logarithmic.
    pub log: bool,
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
    /// A logarithmic axis whose ticks are the values themselves, as far as there is room for them.
    pub fn at_values(mut values: Vec<f64>) -> Self {
        values.retain(|v| *v > 0.0 && v.is_finite());
        values.sort_by(f64::total_cmp);
        values.dedup();
        let (low, high) = spread(&values);
        let mut axis = Self { log: true, low, high, ticks: Vec::new() };
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

    /// A logarithmic axis that spans the positive values, with ticks at powers of ten, and at 2 and 5 times
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
        Self { log: true, low, high, ticks }
    }

    /// A linear axis that spans the finite values, from 0 if they lie to one side of it and not far
    /// off, with up to eight round ticks.
    pub fn linear(values: impl Iterator<Item = f64>) -> Self {
        let finite: Vec<f64> = values.filter(|v| v.is_finite()).collect();
        let [low, high] = extent(&finite);
        let step = round_step((high - low) / 7.0);
        let (first, last) = ((low / step + 1e-9).floor(), (high / step - 1e-9).ceil());
        let tick = |i: i32| {
            let value = (first + f64::from(i)) * step;
            Tick { value, label: round_label(value, step) }
        };
        let ticks = (0..=(last - first) as i32).map(tick).collect();
        Self { log: false, low: first * step, high: last * step, ticks }
    }

    /// Whether a value has a place on it.
    pub fn shows(&self, value: f64) -> bool {
        if self.log { value > 0.0 } else { value.is_finite() }
    }

    /// Where a value stands, 0 at the low end and 1 at the high end.
    pub fn place(&self, value: f64) -> f32 {
        if self.log {
            (libm::log10(value / self.low) / libm::log10(self.high / self.low)) as f32
        } else {
            ((value - self.low) / (self.high - self.low)) as f32
        }
    }
}

/// The range of a linear axis: never empty.
fn extent(values: &[f64]) -> [f64; 2] {
    /// Values this much smaller than the range above them do not move its low end off 0.
    const NEAR_ZERO: f64 = 0.5;
    let low = values.iter().copied().reduce(f64::min).unwrap_or(0.0);
    let high = values.iter().copied().reduce(f64::max).unwrap_or(1.0);
    let [low, high] = match (low, high) {
        (l, h) if l > 0.0 && l < NEAR_ZERO * h => [0.0, h],
        (l, h) if h < 0.0 && h > NEAR_ZERO * l => [l, 0.0],
        ends => ends.into(),
    };
    let least = 1e-6 * low.abs().max(high.abs()).max(1e-300);
    // Halves keep the range finite whatever the values.
    if 0.5 * high - 0.5 * low > 0.5 * least {
        [low.max(-1e300), high.min(1e300)]
    } else if low == 0.0 {
        [0.0, 1.0]
    } else {
        let half = 0.5 * low.abs().min(1e300);
        [low.clamp(-1e300, 1e300) - half, low.clamp(-1e300, 1e300) + half]
    }
}

/// The least of 1, 2, 5, times a power of ten, that is not below `step` > 0.
fn round_step(step: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(step).floor());
    let round = [1.0, 2.0, 5.0].into_iter().find(|m| m * power >= 0.999_999 * step);
    round.unwrap_or(10.0) * power
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

/// A multiple of `step` with as many decimals as it needs.
fn round_label(value: f64, step: f64) -> String {
    if value.abs() < 1e-6 * step {
        "0".into()
    } else if (1e-5..1e6).contains(&step) {
        let decimals = (-libm::log10(step).floor()).max(0.0) as usize;
        format!("{value:.decimals$}").replace('-', "−")
    } else {
        phrase::signed_scale(value)
    }
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
    fn linear_axes_have_round_ticks() {
        let of = |values: &[f64]| Axis::linear(values.iter().copied());
        assert_eq!(labels(&of(&[0.1, 0.93])), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&of(&[-1.0, 3.0])), ["−1", "0", "1", "2", "3"]);
        for values in [vec![], vec![0.0], vec![-4.0], vec![f64::NAN], vec![1e308, -1e308]] {
            let axis = of(&values);
            assert!(axis.low < axis.high && (2..30).contains(&axis.ticks.len()), "{values:?}");
            assert!(axis.place(axis.low) == 0.0 && axis.place(axis.high) == 1.0, "{values:?}");
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
