//! Horizons: how steeply a height map rises around each texel (Fournier 1992 §5, figure 12; Max 1988,
//! Horizon mapping).

use rayon::prelude::*;

use super::{HeightMap, Wrap};

/// The four directions of a horizon, in the order of its slopes: −x, +x, −y, +y of the texture.
pub const SIDES: usize = 4;

/// The slopes of the horizon seen from every texel of a height map.
///
/// Towards +x the horizon of texel p is the largest of (F(p + k) − F(p)) / k over all k ≥ 1, height per
/// length; the other directions likewise. The surface goes on for ever, as the map's [`Wrap`] says, so
/// what is far away stands at slope 0 and no horizon is below 0:
///
/// - where the map repeats, k up to the width sees everything: p + width is as high as p (slope 0), and
///   from p + k + width the rise is that from p + k over a longer way, so nearer to 0;
/// - where the edge texel goes on for ever, its rise is steepest where it begins and falls to 0.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizonMap {
    width: usize,
    height: usize,
    wrap: Wrap,
    slopes: Vec<[f32; SIDES]>,
}

impl HorizonMap {
    /// The horizons of a height map, in a time that grows with the number of its texels.
    pub fn of(heights: &HeightMap) -> Self {
        let (width, height, wrap) = (heights.width(), heights.height(), heights.wrap());
        let row = |j: usize| horizons(&heights.values()[j * width..(j + 1) * width], wrap);
        let column = |i: usize| {
            let line: Vec<f64> = (0..height).map(|j| heights.values()[j * width + i]).collect();
            horizons(&line, wrap)
        };
        let rows: Vec<_> = (0..height).into_par_iter().map(row).collect();
        let columns: Vec<_> = (0..width).into_par_iter().map(column).collect();
        let places = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
        let slopes = places.map(|(i, j)| {
            let ([left, right], [down, up]) = (rows[j][i], columns[i][j]);
            [left, right, down, up].map(|slope| slope.min(f32::MAX.into()) as f32)
        });
        Self { width, height, wrap, slopes: slopes.collect() }
    }

    /// Texels along u.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Texels along v.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The slopes towards −x, +x, −y, +y, each 0 or more; texels row by row from v = 0.
    pub fn slopes(&self) -> &[[f32; SIDES]] {
        &self.slopes
    }

    /// The slopes at folded texture coordinates, bilinear between texel centres.
    #[inline(always)]
    pub fn sample(&self, u: f32, v: f32) -> [f32; SIDES] {
        let (across, along) = (self.wrap.taps(u, self.width), self.wrap.taps(v, self.height));
        super::normal_map::bilinear(across, along, |i, j| self.slopes[j * self.width + i])
    }

    /// Memory it holds, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.slopes.as_slice())
    }
}

/// The horizon slopes [backwards, forwards] at each point of a line.
fn horizons(line: &[f64], wrap: Wrap) -> Vec<[f64; 2]> {
    let reversed: Vec<f64> = line.iter().rev().copied().collect();
    let (forwards, backwards) = (rises(line, wrap), rises(&reversed, wrap));
    backwards.into_iter().rev().zip(forwards).map(|(back, on)| [back, on]).collect()
}

/// The horizon slope forwards at each point of a line.
///
/// From the far end on, `hull` is the upper convex hull of the points passed: the horizon of the next
/// point touches it, and what this tangent leaves below it is on no later hull (Andrew 1979). Every
/// point enters and leaves the hull once, so the time is linear.
fn rises(line: &[f64], wrap: Wrap) -> Vec<f64> {
    let count = line.len();
    let seen = if wrap == Wrap::Repeat { 2 * count } else { count };
    let mut hull: Vec<(usize, f64)> = Vec::with_capacity(count);
    let mut found = vec![0.0; count];
    for at in (0..seen).rev() {
        let height = line[at % count];
        let slope = |&(to, top): &(usize, f64)| (top - height) / (to - at) as f64;
        while let [.., further, nearest] = hull.as_slice()
            && slope(nearest) <= slope(further)
        {
            hull.pop();
        }
        if at < count {
            found[at] = hull.last().map_or(0.0, slope).max(0.0);
        }
        hull.push((at, height));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The definition, over a way long enough for any wrap.
    fn by_definition(map: &HeightMap, i: isize, j: isize) -> [f64; SIDES] {
        let far = 3 * map.width().max(map.height()) as isize;
        [(-1, 0), (1, 0), (0, -1), (0, 1)].map(|(x, y)| {
            let rise = |k: isize| (map.at(i + k * x, j + k * y) - map.at(i, j)) / k as f64;
            (1..=far).map(rise).fold(0.0, f64::max)
        })
    }

    fn assert_is_by_definition(map: &HeightMap) {
        let found = HorizonMap::of(map);
        for (at, slopes) in found.slopes().iter().enumerate() {
            let (i, j) = ((at % map.width()) as isize, (at / map.width()) as isize);
            for (got, want) in slopes.iter().zip(by_definition(map, i, j)) {
                let error = (f64::from(*got) - want).abs();
                assert!(error <= 2e-7 * want, "({i}, {j}): {got} {want}");
            }
        }
    }

    fn heights() -> impl Strategy<Value = HeightMap> {
        let wrap = prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp)];
        let value = prop_oneof![-1.0f64..1.0, Just(0.0), Just(1.0), -1e9f64..1e9];
        (1usize..=17, 1usize..=17, wrap).prop_flat_map(move |(width, height, wrap)| {
            prop::collection::vec(value.clone(), width * height)
                .prop_map(move |values| HeightMap::new(width, height, wrap, values))
        })
    }

    proptest! {
        #[test]
        fn a_horizon_is_the_largest_rise_however_far(map in heights()) {
            assert_is_by_definition(&map);
        }
    }

    #[test]
    fn a_single_spike_is_seen_from_everywhere_on_its_lines() {
        let mut values = vec![0.0; 9 * 7];
        values[3 * 9 + 2] = 6.0;
        let map = HorizonMap::of(&HeightMap::new(9, 7, Wrap::Repeat, values));
        let at = |i: usize, j: usize| map.slopes()[j * 9 + i];
        assert_eq!(at(2, 3), [0.0; 4]);
        // Three texels to its right; six to the left of its next copy.
        assert_eq!(at(5, 3), [2.0, 1.0, 0.0, 0.0]);
        assert_eq!(at(2, 1), [0.0, 0.0, 6.0 / 5.0, 3.0]);
        assert_eq!(at(5, 4), [0.0; 4]);
    }

    #[test]
    fn over_cylinders_that_touch_the_horizon_is_the_tangent_to_the_next() {
        // Circles of radius 1 at distance 2. The horizon towards +x is the tangent to the next one, or,
        // on a flank that rises more steeply, the flank itself.
        let (side, radius) = (4096usize, 1024.0);
        let place = |u: f64| (2.0 * u).fract() * 2.0 - 1.0;
        let circle = |u: f64, _| radius * (1.0 - place(u) * place(u)).sqrt();
        let map = HorizonMap::of(&HeightMap::from_fn(side, 1, Wrap::Repeat, circle));
        for i in (0..2048).step_by(31) {
            let x = place((i as f64 + 0.5) / 4096.0);
            let z = (1.0 - x * x).sqrt();
            let to_centre = (-z).atan2(2.0 - x);
            let opening = (1.0 / (2.0 - x).hypot(z)).asin();
            let want = (to_centre + opening).tan().max(-x / z).max(0.0);
            let got = f64::from(map.slopes()[i][1]);
            // The nearest texel is half a second difference off the flank's own slope.
            let step = 0.5 / (radius * z * z * z);
            assert!((got - want).abs() < 1.1 * step + 1e-5, "x = {x}: {got} {want}");
        }
    }

    #[test]
    fn extremes_stay_finite() {
        let values = vec![1e300, -1e300, 0.0, f64::NAN];
        let map = HorizonMap::of(&HeightMap::new(2, 2, Wrap::Repeat, values));
        assert!(map.slopes().iter().flatten().all(|s| *s >= 0.0 && s.is_finite()));
        let one = HorizonMap::of(&HeightMap::new(1, 1, Wrap::Repeat, vec![-7.0]));
        assert_eq!(one.slopes(), [[0.0; 4]]);
    }
}
