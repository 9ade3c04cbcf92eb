//! Random numbers that follow a distribution of normals: inverse cumulative distributions (Kautz et al. 2001 §4).

use crate::lobe::NdfImage;

/// The cumulative distributions of an NDF on the (x, y) map: the marginal M(x), and the conditional C(y|x). Densities
/// are even within a pixel, so M and the C of a column of pixels are piecewise linear; between the middles of two
/// columns C is blended, so that normals do not jump from column to column.
///
/// Coordinates here are x_n, y_n in [0, 1]: (n + 1)/2 of a normal's x and y.
#[derive(Clone, Debug, PartialEq)]
pub struct Cumulative {
    side: usize,
    /// M at the edges of columns: side + 1 values from 0 to 1.
    marginal: Vec<f64>,
    /// C at the edges of rows, column by column: side + 1 values each.
    conditional: Vec<f64>,
}

impl Cumulative {
    /// Of this NDF.
    pub fn of(ndf: &NdfImage) -> Self {
        let side = ndf.side();
        let column = |i: usize| (0..side).map(move |j| f64::from(ndf.values()[j * side + i]));
        let masses: Vec<f64> = (0..side).map(|i| column(i).sum()).collect();
        // A column without mass is never met, but is blended with its neighbour: it is like the nearest that has some.
        let nearest = |i: usize| {
            let has = |k: &usize| masses[*k] > 0.0;
            (0..side).filter(has).min_by_key(|k| k.abs_diff(i)).unwrap_or(i)
        };
        let conditional = (0..side).flat_map(|i| cumulated(column(nearest(i)))).collect();
        Self { side, marginal: cumulated(masses.into_iter()), conditional }
    }

    /// x_n = M⁻¹(u₁), y_n = C⁻¹(u₂ | x_n), for u₁ and u₂ in [0, 1].
    pub fn place(&self, [u1, u2]: [f64; 2]) -> [f64; 2] {
        let x = inverse(self.side, |k| self.marginal[k], u1);
        [x, inverse(self.side, self.conditional_at(x), u2)]
    }

    /// u₁ = M(x_n), u₂ = C(y_n | x_n): the way back (§7). Where the NDF is 0, nothing leads back to exactly (x_n, y_n).
    pub fn uniform(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [forward(self.side, |k| self.marginal[k], x), forward(self.side, self.conditional_at(x), y)]
    }

    /// C at the edges of rows, at some x_n.
    fn conditional_at(&self, x: f64) -> impl Fn(usize) -> f64 {
        let last = self.side - 1;
        let place = (x * self.side as f64 - 0.5).clamp(0.0, last as f64);
        let low = (place as usize).min(last.saturating_sub(1));
        let part = place - low as f64;
        let edges = |column: usize| &self.conditional[column * (self.side + 1)..][..=self.side];
        let (low, high) = (edges(low), edges((low + 1).min(last)));
        move |k| low[k] + part * (high[k] - low[k])
    }
}

/// Sums from 0 to 1 of masses; even ones if all are 0.
fn cumulated(masses: impl ExactSizeIterator<Item = f64>) -> Vec<f64> {
    let count = masses.len();
    let mut sums = Vec::with_capacity(count + 1);
    sums.push(0.0);
    let mut sum = 0.0;
    for mass in masses {
        sum += mass;
        sums.push(sum);
    }
    if sum > 0.0 {
        sums.iter_mut().for_each(|s| *s /= sum);
    } else {
        sums = (0..=count).map(|k| k as f64 / count as f64).collect();
    }
    sums
}

/// Where a rising piecewise linear function over [0, 1], given at the edges of so many equal steps, reaches `value`; the
/// first such place that has any mass.
pub(super) fn inverse(steps: usize, cumulative: impl Fn(usize) -> f64, value: f64) -> f64 {
    // The first edge above it; at 1 the place where all mass has been met.
    let met = |k: usize| {
        let sum = cumulative(k);
        if value < 1.0 { sum > value } else { sum >= 1.0 }
    };
    let (mut below, mut above) = (0, steps);
    while above - below > 1 {
        let middle = (below + above) / 2;
        if met(middle) { above = middle } else { below = middle }
    }
    let (low, high) = (cumulative(below), cumulative(above));
    let within = if high > low { ((value - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
    (below as f64 + within) / steps as f64
}

/// Such a function at `place` in [0, 1].
pub(super) fn forward(steps: usize, cumulative: impl Fn(usize) -> f64, place: f64) -> f64 {
    let at = place.clamp(0.0, 1.0) * steps as f64;
    let below = (at as usize).min(steps - 1);
    let (low, high) = (cumulative(below), cumulative(below + 1));
    low + (at - below as f64) * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::NdfImage;
    use proptest::prelude::*;

    /// Two hills and nothing between.
    fn hills() -> Cumulative {
        let hill = |x: f32, y: f32| (1.0 - 9.0 * (x * x + y * y)).max(0.0);
        let ndf =
            NdfImage::from_fn(48, |[x, y]| hill(x - 0.5, y + 0.1) + 2.0 * hill(x + 0.4, y - 0.3));
        Cumulative::of(&ndf.unwrap())
    }

    proptest! {
        #[test]
        fn there_and_back(u1 in 0.0f64..1.0, u2 in 0.0f64..1.0) {
            let of = hills();
            let at = of.place([u1, u2]);
            let back = of.uniform(at);
            prop_assert!((back[0] - u1).abs() < 1e-9 && (back[1] - u2).abs() < 1e-9, "{at:?} {back:?}");
        }

        #[test]
        fn any_numbers_lead_to_a_place(u1 in -1.0f64..2.0, u2 in prop_oneof![Just(0.0), Just(1.0), -1.0f64..2.0]) {
            let at = hills().place([u1, u2]);
            prop_assert!(at.iter().all(|c| (0.0..=1.0).contains(c)));
        }
    }

    #[test]
    fn ends_lie_at_the_ends_of_the_mass() {
        let of = hills();
        let ([low, _], [high, _]) = (of.place([0.0, 0.5]), of.place([1.0, 0.5]));
        // Hills reach from −0.4 − 1/3 to 0.5 + 1/3, within a pixel.
        assert!((2.0 * low - 1.0 + 0.733).abs() < 0.05, "{low}");
        assert!((2.0 * high - 1.0 - 0.833).abs() < 0.05, "{high}");
    }
}
