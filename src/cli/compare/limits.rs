//! What a metric may be at most, or at least.

use super::{Failure, Scored, named};
use crate::metric::{Best, Metric};

/// A limit of a metric.
pub(super) struct Limit {
    metric: &'static Metric,
    value: f64,
    /// Whether it is the most the metric may be.
    most: bool,
}

impl Limit {
    /// Those given on the command line.
    pub fn all(above: &[(String, f64)], below: &[(String, f64)]) -> Result<Vec<Self>, Failure> {
        let limit = |most: bool| {
            move |(name, value): &(String, f64)| {
                Ok(Self { metric: named(name)?, value: *value, most })
            }
        };
        above.iter().map(limit(true)).chain(below.iter().map(limit(false))).collect()
    }

    /// How it is broken, in a sentence; `None` if it holds. A metric without a value breaks every limit, unless it
    /// is infinitely good: PSNR of equal images.
    pub fn broken(&self, score: impl Fn(&'static Metric) -> Scored) -> Option<String> {
        let (Self { metric, value: limit, most }, name) = (self, self.metric.name);
        let way = if *most { "above" } else { "below" };
        let Some(value) = score(metric).1 else {
            let equal = || crate::metric::find("mse").and_then(|mse| score(mse).1) == Some(0.0);
            let endless = metric.best == Best::Highest && name.starts_with("psnr") && equal();
            return (!endless || *most).then(|| {
                format!("{name} has no value here, so it is not known not to be {way} {limit}")
            });
        };
        let by = if *most { value - limit } else { limit - value };
        (by > 0.0).then(|| format!("{name} is {value:.6}: {way} {limit} by {by:.6}"))
    }
}
