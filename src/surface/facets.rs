//! Flat triangles before a ray.

use super::hierarchy::{Corners, Hierarchy};
use crate::geometry::Vec3;

/// Triangles in space, without anything on them, in a [`Hierarchy`].
#[derive(Clone, Debug)]
pub(super) struct Facets {
    /// In the order of the hierarchy's leaves, so that neighbours in space are neighbours in memory.
    facets: Vec<Facet>,
    hierarchy: Hierarchy,
}

/// A triangle with area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    /// Its corner 0.
    from: Vec3,
    /// Unit normal: from there its corners run counter-clockwise.
    pub normal: Vec3,
    /// How barycentric coordinates 1 and 2 grow over its plane.
    pub growth: [Vec3; 2],
}

/// Where a ray first meets a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// Distance along the ray, in lengths of its direction.
    pub t: f64,
    /// The triangle's place.
    pub facet: usize,
    /// Its barycentric coordinates 1 and 2.
    pub at: [f64; 2],
}

impl Meeting {
    /// What the corners have, interpolated.
    pub(super) fn blend(&self, corners: [f64; 3]) -> f64 {
        let [b, c] = self.at;
        corners.iter().zip([1.0 - b - c, b, c]).map(|(corner, weight)| weight * corner).sum()
    }
}

impl Facet {
    /// `None` if it has no area: no more than a line of this length has by rounding.
    fn new([a, b, c]: [Vec3; 3]) -> Option<Self> {
        let (e1, e2) = (b - a, c - a);
        let cross = e1.cross(&e2);
        const THINNEST: f64 = 1e-12;
        let longest = e1.norm_squared().max(e2.norm_squared()).max((c - b).norm_squared());
        let square = cross.norm_squared();
        let normal = cross.try_normalize(0.0)?;
        let growth = [e2.cross(&cross) / square, cross.cross(&e1) / square];
        let finite = growth.iter().all(|g| g.iter().all(|x| x.is_finite()));
        (square > 0.0 && square.sqrt() > THINNEST * longest && finite).then_some(Self {
            from: a,
            normal,
            growth,
        })
    }

    /// Where a ray meets its plane within its sides: the distance along the ray and the barycentric
    /// coordinates 1 and 2.
    fn meet(&self, origin: Vec3, direction: Vec3) -> Option<(f64, [f64; 2])> {
        // Neighbours overlap by a hair, so that no ray slips between them.
        const SLACK: f64 = 1e-9;
        let t = (self.from - origin).dot(&self.normal) / direction.dot(&self.normal);
        let within = origin + direction * t - self.from;
        let [b, c] = self.growth.map(|g| g.dot(&within));
        (t > 0.0 && t.is_finite() && b >= -SLACK && c >= -SLACK && b + c <= 1.0 + SLACK)
            .then_some((t, [b, c]))
    }
}

/// The box of a triangle, a hair larger: neighbours overlap.
fn corners_of(triangle: &[Vec3; 3]) -> Corners {
    let [a, b, c] = triangle;
    let (low, high) = (a.inf(b).inf(c), a.sup(b).sup(c));
    let hair = Vec3::repeat(1e-9 * low.amax().max(high.amax()) + 1e-30);
    [low - hair, high + hair]
}

impl Facets {
    /// Those of triangles 0 to `count` that have area, and which they are: facet k is triangle `order[k]`.
    pub(super) fn new(
        count: usize,
        triangle: impl Fn(usize) -> Option<[Vec3; 3]>,
    ) -> (Self, Vec<u32>) {
        let facet = |k: usize| Some((k as u32, Facet::new(triangle(k)?)?));
        let (kept, facets): (Vec<u32>, Vec<Facet>) = (0..count).filter_map(facet).unzip();
        let solid = |&k: &u32| triangle(k as usize).map(|t| corners_of(&t)).expect("it has area");
        let (hierarchy, leaves) = Hierarchy::new(kept.iter().map(solid));
        let facets = leaves.iter().map(|&leaf| facets[leaf as usize]).collect();
        let order = leaves.iter().map(|&leaf| kept[leaf as usize]).collect();
        (Self { facets, hierarchy }, order)
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.facets.len()
    }

    /// One of them.
    pub(super) fn facet(&self, place: usize) -> &Facet {
        &self.facets[place]
    }

    /// The first that a ray meets at t > 0, from either side.
    pub(super) fn first(&self, origin: Vec3, direction: Vec3) -> Option<Meeting> {
        let meet = |facet: usize| {
            let (t, at) = self.facets[facet].meet(origin, direction)?;
            Some((t, Meeting { t, facet, at }))
        };
        Some(self.hierarchy.nearest(origin, direction, meet)?.1)
    }
}
