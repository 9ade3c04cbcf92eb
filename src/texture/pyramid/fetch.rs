//! Lookups in a pyramid of moments.

use super::{Level, Moments, Pyramid};
use crate::geometry::Quad;
use crate::texture::normal_map::bilinear;
use crate::texture::{Footprint, Lookup, NormalMap, Taps, Texel};

/// The channels of a cell as three vectors: the first four, the next four, the last four. Those that are not
/// there hold others'.
type Quads = [Quad; 3];

/// Vectors that `C` channels fill.
const fn quads(channels: usize) -> usize {
    channels.div_ceil(4)
}

/// Where vector `q` of `channels` begins: the last ends with the last channel.
const fn first(q: usize, channels: usize) -> usize {
    let last = channels.saturating_sub(4);
    if 4 * q < last { 4 * q } else { last }
}

/// The most points of an exact lookup.
const MOST_POINTS: usize = 1 << 14;

impl<M: Moments<C>, const C: usize> Pyramid<M, C> {
    /// The channels under a footprint on the map this pyramid was built from, by the footprint's lookup.
    #[inline]
    pub fn fetch(&self, map: &NormalMap, at: &Footprint) -> [f32; C] {
        match at.lookup {
            Lookup::Trilinear => {
                self.trilinear(map, at.u, at.v, at.level(map.width(), map.height()))
            }
            Lookup::Anisotropic => self.anisotropic(map, at),
            Lookup::Ewa => self.weighted(map, at),
            Lookup::Exact => self.exact(map, at),
        }
    }

    /// The channels at folded coordinates (u, v) of the map this pyramid was built from, bilinear
    /// within the two levels around `level` and linear between them (*trilinear*, Williams 1983).
    /// A `level` outside the pyramid is held to its ends.
    #[inline]
    pub fn trilinear(&self, map: &NormalMap, u: f32, v: f32, level: f32) -> [f32; C] {
        let held = level.clamp(0.0, self.levels.len() as f32);
        let below = held as usize;
        let blend = held - below as f32;
        let low = self.at_level(map, below, u, v);
        if blend == 0.0 {
            return low;
        }
        let high = self.at_level(map, below + 1, u, v);
        std::array::from_fn(|c| low[c] + blend * (high[c] - low[c]))
    }

    #[inline(never)]
    fn anisotropic(&self, map: &NormalMap, at: &Footprint) -> [f32; C] {
        let mut sum = [0.0; C];
        at.each_probe(&self.form(map), |probe| {
            let found = self.trilinear(map, probe.u, probe.v, probe.level);
            for c in 0..C {
                sum[c] += probe.weight * found[c];
            }
        });
        sum
    }

    #[inline(never)]
    fn weighted(&self, map: &NormalMap, at: &Footprint) -> [f32; C] {
        let mut sum = [0.0; C];
        at.each_weighted(&self.form(map), &mut |cell| {
            let found = self.cell(map, cell.level, cell.i, cell.j);
            for c in 0..C {
                sum[c] += cell.weight * found[c];
            }
        });
        sum
    }

    /// The moments of the normals at points spread over the footprint: what the surface has there.
    #[inline(never)]
    fn exact(&self, map: &NormalMap, at: &Footprint) -> [f32; C] {
        let mut sum = [0.0f64; C];
        at.each_point(&self.form(map), MOST_POINTS, |u, v, count| {
            let moments = self.moments.encode(map.normal_at(u, v));
            for c in 0..C {
                sum[c] += f64::from(moments[c]) / count as f64;
            }
        });
        self.moments.store(sum.map(|s| s as f32))
    }

    /// The channels of a cell.
    #[inline(always)]
    fn cell(&self, map: &NormalMap, level: usize, i: usize, j: usize) -> [f32; C] {
        match level.checked_sub(1) {
            None => self.of_texel(map.texel(i, j)),
            Some(above) => {
                let Level { width, start, .. } = self.levels[above];
                let at = (start + j * width + i) * C;
                *self.channels[at..].first_chunk().expect("cells are whole")
            }
        }
    }

    /// The channels at folded coordinates (u, v), bilinear within `level`.
    #[inline(never)]
    fn at_level(&self, map: &NormalMap, level: usize, u: f32, v: f32) -> [f32; C] {
        let Some(above) = level.checked_sub(1) else {
            let (across, along) =
                (map.wrap().taps(u, map.width()), map.wrap().taps(v, map.height()));
            return bilinear(across, along, |i, j| self.of_texel(map.texel(i, j)));
        };
        let found = self.at_stored(map, above, u, v);
        let mut out = [0.0; C];
        for (q, quad) in found.into_iter().enumerate().take(quads(C)) {
            let values = <[f32; 4]>::from(quad);
            for (k, value) in values.into_iter().enumerate() {
                if let Some(channel) = out.get_mut(first(q, C) + k) {
                    *channel = value;
                }
            }
        }
        out
    }

    /// The same within stored level `above` + 1, as vectors.
    #[inline(always)]
    fn at_stored(&self, map: &NormalMap, above: usize, u: f32, v: f32) -> Quads {
        let Level { width, height, start } = self.levels[above];
        let (across, along) = (map.wrap().taps(u, width), map.wrap().taps(v, height));
        let corner = |i: usize, j: usize| (start + j * width + i) * C;
        let [a, b] = [across.first, across.second].map(|i| corner(i, along.first));
        let [c, d] = [across.first, across.second].map(|i| corner(i, along.second));
        let mut out = [Quad::from([0.0; 4]); 3];
        for (q, quad) in out.iter_mut().enumerate().take(quads(C)) {
            let load = |corner: usize| Quad::load(&self.channels[corner + first(q, C)..]);
            let low = Quad::lerp(load(a), load(b), across.blend);
            let high = Quad::lerp(load(c), load(d), across.blend);
            *quad = Quad::lerp(low, high, along.blend);
        }
        out
    }

    /// [`Pyramid::trilinear`] for the first `len` of `N` lanes, the result channel by channel. Texels of the map
    /// itself are encoded for eight lanes at once.
    #[inline(always)]
    pub fn trilinear_lanes<const N: usize>(
        &self,
        map: &NormalMap,
        (u, v, level): (&[f32; N], &[f32; N], &[f32; N]),
        len: usize,
        out: &mut [[f32; N]; C],
    ) {
        let top = self.levels.len() as f32;
        for start in (0..len).step_by(GROUP) {
            let lanes = start..(start + GROUP).min(len);
            let mut share = [0.0; GROUP];
            for (k, i) in lanes.clone().enumerate() {
                let held = level[i].clamp(0.0, top);
                let below = held as usize;
                let blend = held - below as f32;
                share[k] = if below == 0 { 1.0 - blend } else { 0.0 };
                self.store_levels(map, (u[i], v[i]), below, blend, |c, value| out[c][i] = value);
            }
            if share.iter().any(|share| *share > 0.0) {
                self.add_texels(map, u, v, lanes, &share, out);
            }
        }
    }

    /// Tells the part of a trilinear lookup that comes from stored levels.
    #[inline(always)]
    fn store_levels(
        &self,
        map: &NormalMap,
        (u, v): (f32, f32),
        below: usize,
        blend: f32,
        mut put: impl FnMut(usize, f32),
    ) {
        let nothing = [Quad::from([0.0; 4]); 3];
        let low = if below > 0 { self.at_stored(map, below - 1, u, v) } else { nothing };
        let high = if blend > 0.0 { self.at_stored(map, below, u, v) } else { low };
        for q in 0..quads(C) {
            let values = <[f32; 4]>::from(Quad::lerp(low[q], high[q], blend));
            for (k, value) in values.into_iter().enumerate() {
                let c = first(q, C) + k;
                if c < C {
                    put(c, value);
                }
            }
        }
    }

    /// Adds `share` of the map's own level, lane by lane.
    #[inline(always)]
    fn add_texels<const N: usize>(
        &self,
        map: &NormalMap,
        u: &[f32; N],
        v: &[f32; N],
        lanes: std::ops::Range<usize>,
        share: &[f32; GROUP],
        out: &mut [[f32; N]; C],
    ) {
        let mut corners = [[[0.0f32; GROUP]; 4]; 4];
        let mut weights = [[0.0f32; GROUP]; 4];
        for (k, i) in lanes.clone().enumerate() {
            let (across, along) =
                (map.wrap().taps(u[i], map.width()), map.wrap().taps(v[i], map.height()));
            for (corner, (x, y, weight)) in four(across, along).into_iter().enumerate() {
                let texel: Texel = map.texel(x, y);
                for c in 0..4 {
                    corners[corner][c][k] = texel[c];
                }
                weights[corner][k] = share[k] * weight;
            }
        }
        let mut sum = [[0.0f32; GROUP]; C];
        for (texels, weight) in corners.iter().zip(&weights) {
            for k in 0..GROUP {
                let found = self.of_texel([texels[0][k], texels[1][k], texels[2][k], texels[3][k]]);
                for c in 0..C {
                    sum[c][k] += weight[k] * found[c];
                }
            }
        }
        for c in 0..C {
            for (k, i) in lanes.clone().enumerate() {
                out[c][i] += sum[c][k];
            }
        }
    }
}

/// Lanes whose texels are encoded together.
const GROUP: usize = 8;

/// The texels of a bilinear lookup with their weights.
#[inline(always)]
fn four(across: Taps, along: Taps) -> [(usize, usize, f32); 4] {
    let (r, t) = (across.blend, along.blend);
    [
        (across.first, along.first, (1.0 - r) * (1.0 - t)),
        (across.second, along.first, r * (1.0 - t)),
        (across.first, along.second, (1.0 - r) * t),
        (across.second, along.second, r * t),
    ]
}
