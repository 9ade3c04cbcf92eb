//! Twill, the weave of denim (Fournier 1992 §2.3 and §3).
//!
//! Warp threads run along v, weft threads along u, all one pitch wide and touching their neighbours. A
//! warp thread passes over `over` weft threads and under one; each warp thread does so one weft thread
//! further along v than the one before, which gives the diagonal lines of denim, up to the right.
//!
//! The geometry of the paper's own denim is not printed. With straight threads its count of 85 fits
//! comes out; which weave gave its 63 fits at seven peaks is lost.

use super::view::{Seen, WEIGHT, from_above};
use super::{Bumps, Card, Entry};
use crate::geometry::elementary::ln64;
use crate::parameter::{Domain, Parameter, Values};

/// Threads as half cylinders seen from above: straight, or each visible stretch bent to an arc.
///
/// With `bend = 0` the normal is the same all along a thread, so a map holds at most 2·`pitch` distinct
/// normals. The weave meets itself at the tile's edge if each side is a multiple of
/// `pitch` · (`over` + 1); the notes say so if it does not.
pub const ENTRY: Entry = Entry {
    card: Card {
        name: "twill",
        source: "Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces, §2.3 and §3",
        summary: "A twill weave (denim): threads along u and v in diagonal steps.",
    },
    parameters: &[
        Parameter {
            name: "over",
            meaning: "weft threads a warp thread passes over before it goes under one \
                      (1 plain weave, 2 is 2/1 twill, 3 is 3/1 twill)",
            domain: Domain::Whole { default: 2, min: 1, max: 16 },
        },
        Parameter {
            name: "pitch",
            meaning: "width of a thread, texels",
            domain: Domain::Whole { default: 8, min: 1, max: 1024 },
        },
        Parameter {
            name: "phase",
            meaning: "threads by which the weave is shifted along v",
            domain: Domain::Whole { default: 0, min: 0, max: 16 },
        },
        Parameter {
            name: "bend",
            meaning: "tilt of a thread where it dives under another, degrees (0: straight threads)",
            domain: Domain::Real { default: 0.0, min: 0.0, max: 80.0 },
        },
        WEIGHT,
    ],
    build,
};

fn build(width: usize, height: usize, values: &Values, _seed: u64) -> Bumps {
    let weave = Weave {
        over: values.whole("over"),
        pitch: values.whole("pitch"),
        phase: values.whole("phase"),
        bend: values.number("bend").to_radians(),
    };
    let (normals, heights) = from_above(width, height, values, |i, j| Some(weave.top(i, j)));
    let repeat = weave.pitch * (weave.over + 1);
    let meets = width.is_multiple_of(repeat) && height.is_multiple_of(repeat);
    let seam = (!meets).then(|| {
        format!("the weave repeats every {repeat} texels, so it does not meet itself at the edges")
    });
    Bumps { normals, heights: Some(heights), notes: seam.into_iter().collect() }
}

/// A twill's layout; lengths in texels, `bend` in radians.
struct Weave {
    over: usize,
    pitch: usize,
    phase: usize,
    bend: f64,
}

impl Weave {
    /// The thread on top at the centre of texel (i, j).
    fn top(&self, i: usize, j: usize) -> Seen {
        let (column, in_column) = self.thread(i);
        let (row, in_row) = self.thread(j);
        // Minus one column is plus `over` columns: the weave repeats after over + 1.
        let step = (self.over * column + row + self.phase) % (self.over + 1);
        if step == 0 {
            // The warp dives under this one weft thread.
            let Seen { normal: [across, along, z], height } =
                self.tube(2.0 * in_row - 1.0, 2.0 * in_column - 1.0, 1);
            Seen { normal: [along, across, z], height }
        } else {
            let stretch = ((step - 1) as f64 + in_row) / self.over as f64;
            self.tube(2.0 * in_column - 1.0, 2.0 * stretch - 1.0, self.over)
        }
    }

    /// Which thread texel centre `i` is on, and where across it, from 0 to 1.
    fn thread(&self, i: usize) -> (usize, f64) {
        (i / self.pitch, (2 * (i % self.pitch) + 1) as f64 / (2 * self.pitch) as f64)
    }

    /// A tube seen from above, its unit normal as [across, along, z]: a circle across, turned from −bend
    /// to bend along the visible stretch, which is `threads` pitches long. Both coordinates run from −1
    /// to 1.
    ///
    /// Its centre line, of slope −tan(bend · along), is the arc ln cos(bend · along) / bend times half the
    /// stretch, its crest at height 0. The top is above it by the radius over the cosine of the line's
    /// own tilt: the tube is taken for straight there, as it is in the normal.
    fn tube(&self, across: f64, along: f64, threads: usize) -> Seen {
        let up = (1.0 - across * across).sqrt();
        let (sin, cos) = libm::sincos(self.bend * along);
        let radius = self.pitch as f64 / 2.0;
        let arc = if self.bend > 0.0 { ln64(cos) / self.bend } else { 0.0 };
        let height = radius * (threads as f64 * arc + up / cos);
        Seen { normal: [across, up * sin, up * cos], height }
    }
}
