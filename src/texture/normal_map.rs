//! Normal maps.

use std::sync::Arc;

use super::{HeightMap, Interpolation, Taps, Wrap};
use crate::geometry::Quad;

/// Smallest z a normal may have where a *slope* is asked of it. A slope is n_xy / n_z; a normal at or
/// below the horizon has none, so slopes are held to 64 (a tilt of 89.1°).
pub const MIN_COSINE: f32 = 1.0 / 64.0;

/// A normal and its weight: [x, y, z, w].
///
/// (x, y, z) is a unit normal in tangent space: x along +u, y along +v, z out of the surface. w ≥ 0 is
/// the texel's *amplitude* (Fournier 1992 §3): the light it sends is w times its lobe. A map from an
/// image has w = 1 everywhere; a map sampled from geometry seen from above has w = 1/z, so that
/// surface area counts; w = 0 marks a texel where there is no surface.
pub type Texel = [f32; 4];

/// A map of unit normals with weights.
///
/// Texel (i, j) has its centre at u = (i + ½)/width, v = (j + ½)/height; row 0 is at v = 0, the
/// *bottom* of the picture as image files show it.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalMap {
    width: usize,
    height: usize,
    wrap: Wrap,
    interpolation: Interpolation,
    texels: Vec<Texel>,
    /// The texels scaled to z = 1, where those are what is interpolated; else none.
    slopes: Vec<Texel>,
    heights: Option<Arc<HeightMap>>,
}

impl NormalMap {
    /// A map from `width · height` texels, row by row from v = 0. Normals are brought to unit length
    /// in double precision; one of length zero, or not finite, becomes (0, 0, 1). Weights that are
    /// negative or not finite become 0.
    ///
    /// # Panics
    /// If a side is 0 or the number of texels is not `width · height`: a programming error; loaders
    /// check their input first.
    pub fn new(width: usize, height: usize, wrap: Wrap, mut texels: Vec<Texel>) -> Self {
        assert!(width > 0 && height > 0 && texels.len() == width * height, "shape of a normal map");
        texels.iter_mut().for_each(|t| *t = unit(*t));
        let interpolation = Interpolation::default();
        Self { width, height, wrap, interpolation, texels, slopes: Vec::new(), heights: None }
    }

    /// A map of `width` × `height` texels whose normal at texel centre (u, v) is `f(u, v)` =
    /// [x, y, z, w].
    pub fn from_fn(
        width: usize,
        height: usize,
        wrap: Wrap,
        mut f: impl FnMut(f64, f64) -> [f64; 4],
    ) -> Self {
        let mut texels = Vec::with_capacity(width * height);
        for j in 0..height {
            let v = (j as f64 + 0.5) / height as f64;
            texels.extend((0..width).map(|i| {
                let u = (i as f64 + 0.5) / width as f64;
                f(u, v).map(|c| c as f32)
            }));
        }
        Self::new(width, height, wrap, texels)
    }

    /// The normals of a height map by central differences over one texel either side (Blinn 1978 §3),
    /// with heights in units of the texel's side times `scale`.
    pub fn from_heights(heights: &HeightMap, scale: f64) -> Self {
        let (width, height) = (heights.width(), heights.height());
        let mut texels = Vec::with_capacity(width * height);
        for j in 0..height as isize {
            texels.extend((0..width as isize).map(|i| {
                let [fu, fv] = heights.gradient(i, j).map(|d| (d * scale) as f32);
                [-fu, -fv, 1.0, 1.0]
            }));
        }
        Self::new(width, height, heights.wrap(), texels)
    }

    /// The same map, its normals between texels found by `interpolation`. A spline is one of its heights
    /// (see [`NormalMap::with_heights`], which comes first); where there are none, they are integrated.
    pub fn with_interpolation(mut self, interpolation: Interpolation) -> Self {
        self.interpolation = interpolation;
        self.slopes = match interpolation {
            Interpolation::Table => self.texels.iter().map(sloping).collect(),
            _ => Vec::new(),
        };
        if interpolation.spline().is_some() {
            self.heights = Some(self.heights_or_integrated());
        }
        self
    }

    /// The map `count` times along each side, as Blinn's "unit cell pattern to be replicated many times per
    /// patch" (1978 §3).
    pub fn replicated(&self, count: usize) -> Self {
        let (width, height) = (self.width * count, self.height * count);
        let cells = (0..width * height).map(|k| (k % width % self.width, k / width % self.height));
        Self {
            width,
            height,
            texels: cells.map(|(i, j)| self.texel(i, j)).collect(),
            heights: self.heights.as_ref().map(|heights| Arc::new(heights.replicated(count))),
            slopes: Vec::new(),
            ..*self
        }
        .with_interpolation(self.interpolation)
    }

    /// The same map, with the heights that its normals are of: texel sides, of the same size and wrap.
    /// What is masked or in shadow can only be told from them.
    ///
    /// # Panics
    /// If the sizes differ: a programming error.
    pub fn with_heights(mut self, heights: Arc<HeightMap>) -> Self {
        let sizes = [(self.width, self.height), (heights.width(), heights.height())];
        assert_eq!(sizes[0], sizes[1], "heights of a normal map");
        self.heights = Some(heights);
        self
    }

    /// The heights that its normals are of, where they are known.
    pub fn heights(&self) -> Option<&Arc<HeightMap>> {
        self.heights.as_ref()
    }

    /// The heights that its normals are of, or else those that come nearest (see
    /// [`integrate`](super::integrate())).
    pub fn heights_or_integrated(&self) -> Arc<HeightMap> {
        let integrated = || Arc::new(super::integrate(self).heights);
        self.heights.clone().unwrap_or_else(integrated)
    }

    /// [∂F/∂x, ∂F/∂y] of the surface whose normal texel (i, j) is; z is held at [`MIN_COSINE`].
    pub fn slope(&self, i: usize, j: usize) -> [f64; 2] {
        let [x, y, z, _] = self.texel(i, j);
        [x, y].map(|c| f64::from(-c) / f64::from(z.max(MIN_COSINE)))
    }

    /// Texels along u.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Texels along v.
    pub fn height(&self) -> usize {
        self.height
    }

    /// What lies beyond the edge.
    pub fn wrap(&self) -> Wrap {
        self.wrap
    }

    /// How normals between texel centres are found.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// All texels, row by row from v = 0.
    pub fn texels(&self) -> &[Texel] {
        &self.texels
    }

    /// Texel (i, j); both must be inside.
    #[inline(always)]
    pub fn texel(&self, i: usize, j: usize) -> Texel {
        self.texels[j * self.width + i]
    }

    /// The normal and weight at folded texture coordinates (see [`Wrap::fold`]). The normal is *not*
    /// brought to unit length: shading needs its direction alone.
    #[inline(always)]
    pub fn sample(&self, u: f32, v: f32) -> Texel {
        let (across, along) = (self.wrap.taps(u, self.width), self.wrap.taps(v, self.height));
        match self.interpolation {
            Interpolation::Bilinear => {
                bilinear(across, along, |i, j| self.texels[j * self.width + i])
            }
            Interpolation::Table => bilinear(across, along, |i, j| self.slopes[j * self.width + i]),
            Interpolation::Nearest => {
                let pick = |t: Taps| if t.blend < 0.5 { t.first } else { t.second };
                self.texel(pick(across), pick(along))
            }
            Interpolation::CatmullRom | Interpolation::BSpline => self.of_spline(u, v),
        }
    }

    /// The normal of the spline through the heights, not of unit length; weights are bilinear.
    #[inline(never)]
    fn of_spline(&self, u: f32, v: f32) -> Texel {
        let (across, along) = (self.wrap.taps(u, self.width), self.wrap.taps(v, self.height));
        let [weight] = bilinear(across, along, |i, j| [self.texels[j * self.width + i][3]]);
        let spline = self.interpolation.spline().zip(self.heights.as_ref());
        let (spline, heights) = spline.expect("splines come with heights");
        let [_, fx, fy] = spline.at(heights, u.into(), v.into());
        [-fx as f32, -fy as f32, 1.0, weight]
    }

    /// The unit normal and weight at folded texture coordinates.
    #[inline(always)]
    pub fn normal_at(&self, u: f32, v: f32) -> Texel {
        let [x, y, z, weight] = self.sample(u, v);
        let length = (x * x + y * y + z * z).sqrt().max(f32::MIN_POSITIVE);
        [x / length, y / length, z / length, weight]
    }

    /// [`NormalMap::sample`] for `N` lanes (a multiple of 4) at once, the result channel by channel. `REPEAT` must say
    /// whether the map repeats; it is a constant so that the loop need not ask at every lane.
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "lanes run through several arrays at once")]
    pub fn sample_lanes<const N: usize, const REPEAT: bool>(
        &self,
        u: &[f32; N],
        v: &[f32; N],
        out: &mut [[f32; N]; 4],
    ) {
        let nodes = match self.interpolation {
            Interpolation::Bilinear | Interpolation::Nearest => &self.texels,
            Interpolation::Table => &self.slopes,
            Interpolation::CatmullRom | Interpolation::BSpline => {
                for i in 0..N {
                    let texel = self.of_spline(u[i], v[i]);
                    (0..4).for_each(|c| out[c][i] = texel[c]);
                }
                return;
            }
        };
        let wrap = if REPEAT { Wrap::Repeat } else { Wrap::Clamp };
        let (mut right, mut up) = ([0.0f32; N], [0.0f32; N]);
        let mut corners = [[0u32; N]; 4];
        for i in 0..N {
            let across = wrap.taps(u[i], self.width);
            let along = wrap.taps(v[i], self.height);
            let [low, high] = [along.first, along.second].map(|j| j as u32 * self.width as u32);
            (right[i], up[i]) = (across.blend, along.blend);
            corners[0][i] = low + across.first as u32;
            corners[1][i] = low + across.second as u32;
            corners[2][i] = high + across.first as u32;
            corners[3][i] = high + across.second as u32;
        }
        if self.interpolation == Interpolation::Nearest {
            let step = |blend: &mut f32| *blend = if *blend < 0.5 { 0.0 } else { 1.0 };
            right.iter_mut().for_each(step);
            up.iter_mut().for_each(step);
        }
        // One check for all, so that the loop below has none.
        let last = corners.iter().flatten().fold(0, |last, &i| last.max(i));
        assert!((last as usize) < nodes.len(), "texel {last} is outside the map");
        let lane = |i: usize| {
            let at = |corner: usize| {
                // SAFETY: no index is larger than `last`, which is inside.
                #[expect(unsafe_code, reason = "checked once for all lanes, above")]
                let texel = unsafe { nodes.get_unchecked(corners[corner][i] as usize) };
                Quad::from(*texel)
            };
            let low = Quad::lerp(at(0), at(1), right[i]);
            Quad::lerp(low, Quad::lerp(at(2), at(3), right[i]), up[i])
        };
        let [x, y, z, w] = out;
        for i in (0..N).step_by(4) {
            // Written out: the compiler leaves `map` over an array as a call.
            let [a, b, c, d] = Quad::transpose([lane(i), lane(i + 1), lane(i + 2), lane(i + 3)]);
            a.store(&mut x[i..i + 4]);
            b.store(&mut y[i..i + 4]);
            c.store(&mut z[i..i + 4]);
            d.store(&mut w[i..i + 4]);
        }
    }

    /// How many texels lean so far (z below [`MIN_COSINE`]) that their slope is held; methods that
    /// work in slopes misread these.
    pub fn below_horizon(&self) -> usize {
        self.texels.iter().filter(|t| t[2] < MIN_COSINE && t[3] > 0.0).count()
    }

    /// The map with so many texels, its normals between its own found as its interpolation has it. Meant for more texels
    /// than it has: of fewer, most of its own would be passed over. Its heights are left out.
    ///
    /// # Panics
    /// If a side is 0: a programming error.
    pub fn resampled(&self, width: usize, height: usize) -> Self {
        if (width, height) == (self.width, self.height) {
            return Self { heights: None, ..self.clone() };
        }
        let place = |k: usize, side: usize| ((k as f64 + 0.5) / side as f64) as f32;
        let texel = |k: usize| self.sample(place(k % width, width), place(k / width, height));
        let texels = (0..width * height).map(texel).collect();
        Self::new(width, height, self.wrap, texels)
    }

    /// The map turned by 90° counter-clockwise about its centre: normals, heights and positions alike.
    pub fn rotated(&self) -> Self {
        let (width, height) = (self.height, self.width);
        let mut texels = vec![[0.0; 4]; width * height];
        for (k, &[x, y, z, w]) in self.texels.iter().enumerate() {
            let (i, j) = (k % self.width, k / self.width);
            texels[i * width + (width - 1 - j)] = [-y, x, z, w];
        }
        let heights = self.heights.as_ref().map(|heights| Arc::new(heights.rotated()));
        let turned = Self { width, height, texels, slopes: Vec::new(), heights, ..*self };
        turned.with_interpolation(self.interpolation)
    }

    /// The map with every slope multiplied by `factor` (its bumps that much higher).
    pub fn scaled(&self, factor: f32) -> Self {
        let scale = |&[x, y, z, w]: &Texel| unit([x * factor, y * factor, z, w]);
        let heights = self.heights.as_ref().map(|h| Arc::new(h.scaled(factor.into())));
        let texels = self.texels.iter().map(scale).collect();
        Self { texels, heights, ..self.clone() }.with_interpolation(self.interpolation)
    }
}

/// The texel scaled to z = 1, which is held at [`MIN_COSINE`]: its slopes, negative.
fn sloping(&[x, y, z, w]: &Texel) -> Texel {
    let z = z.max(MIN_COSINE);
    [x / z, y / z, 1.0, w]
}

/// The weighted sum of four values around a point, channel by channel.
#[inline(always)]
pub(super) fn bilinear<const C: usize>(
    across: Taps,
    along: Taps,
    read: impl Fn(usize, usize) -> [f32; C],
) -> [f32; C] {
    let (a, b) = (read(across.first, along.first), read(across.second, along.first));
    let (c, d) = (read(across.first, along.second), read(across.second, along.second));
    let mut out = [0.0; C];
    for k in 0..C {
        let low = a[k] + across.blend * (b[k] - a[k]);
        let high = c[k] + across.blend * (d[k] - c[k]);
        out[k] = low + along.blend * (high - low);
    }
    out
}

/// The texel with its normal at unit length; (0, 0, 1) where it has no direction.
fn unit([x, y, z, w]: Texel) -> Texel {
    let (dx, dy, dz) = (f64::from(x), f64::from(y), f64::from(z));
    let length = (dx * dx + dy * dy + dz * dz).sqrt();
    let weight = if w.is_finite() && w > 0.0 { w } else { 0.0 };
    if length.is_finite() && length > 0.0 {
        [(dx / length) as f32, (dy / length) as f32, (dz / length) as f32, weight]
    } else {
        [0.0, 0.0, 1.0, weight]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> NormalMap {
        NormalMap::from_fn(5, 3, Wrap::Repeat, |u, v| [u, v - 0.5, 1.0, 1.0 + u])
    }

    #[test]
    fn more_texels_lie_between_those_there_are() {
        let map = ramp();
        assert_eq!(map.resampled(5, 3), map);
        // Three times as many: every third has the place of one of the map's own.
        let more = map.resampled(15, 9);
        for (i, j) in [(0, 0), (2, 1), (4, 2)] {
            let (got, want) = (more.texel(3 * i + 1, 3 * j + 1), map.texel(i, j));
            assert!((0..4).all(|c| (got[c] - want[c]).abs() < 1e-5), "{got:?} {want:?}");
        }
    }

    #[test]
    fn a_texel_centre_gives_that_texel() {
        for interpolation in [Interpolation::Bilinear, Interpolation::Nearest] {
            let map = ramp().with_interpolation(interpolation);
            for j in 0..3 {
                for i in 0..5 {
                    let got = map.sample((i as f32 + 0.5) / 5.0, (j as f32 + 0.5) / 3.0);
                    let want = map.texel(i, j);
                    for c in 0..4 {
                        assert!((got[c] - want[c]).abs() < 1e-5, "{i},{j}: {got:?} {want:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn four_quarter_turns_are_none() {
        let map = ramp();
        assert_eq!(map.rotated().rotated().rotated().rotated(), map);
        assert_eq!((map.rotated().width(), map.rotated().height()), (3, 5));
    }

    #[test]
    fn a_replicated_map_is_the_map_folded() {
        let map = ramp().with_interpolation(Interpolation::Table);
        let three = map.replicated(3);
        assert_eq!((three.width(), three.height()), (15, 9));
        for (u, v) in [(0.1f32, 0.2f32), (0.4, 0.9), (0.95, 0.05)] {
            let fold = |c: f32| Wrap::Repeat.fold((3.0 * c).into()) as f32;
            let (all, one) = (three.sample(u, v), map.sample(fold(u), fold(v)));
            (0..4).for_each(|c| assert!((all[c] - one[c]).abs() < 1e-5, "{all:?} {one:?}"));
        }
        assert_eq!(map.replicated(1), map);
    }

    #[test]
    fn a_quarter_turn_carries_the_picture() {
        // What stood at the right (u near 1) leaning right stands at the top leaning up.
        let mut texels = vec![[0.0, 0.0, 1.0, 1.0]; 16];
        texels[4 + 3] = [0.6, 0.0, 0.8, 1.0]; // i = 3, j = 1
        let turned = NormalMap::new(4, 4, Wrap::Repeat, texels).rotated();
        assert_eq!(turned.texel(2, 3), [0.0, 0.6, 0.8, 1.0]);
    }

    #[test]
    fn what_has_no_direction_becomes_flat() {
        let bad = vec![[0.0, 0.0, 0.0, 1.0], [f32::NAN, 0.0, 1.0, f32::NAN]];
        let map = NormalMap::new(2, 1, Wrap::Clamp, bad);
        assert_eq!(map.texels(), [[0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 0.0]]);
    }

    #[test]
    fn heights_lean_away_from_the_rise() {
        // F = x: slope 1, the normal leans towards −x by 45°.
        let heights = HeightMap::new(4, 1, Wrap::Clamp, vec![0.0, 1.0, 2.0, 3.0]);
        let map = NormalMap::from_heights(&heights, 1.0);
        let half = std::f32::consts::FRAC_1_SQRT_2;
        assert!((map.texel(1, 0)[0] + half).abs() < 1e-6);
        assert!((map.texel(1, 0)[2] - half).abs() < 1e-6);
    }
}
