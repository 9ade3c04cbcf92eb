//! Boxes within boxes around many small things, and the first of them that a ray meets.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::{Bvh, BvhNode, BvhNodeBuildArgs};

use crate::geometry::Vec3;

/// Corners of a box along the axes, world space: least and greatest coordinates.
pub(super) type Corners = [Vec3; 2];

/// A binary tree of boxes. It is built by the crate `bvh`; rays walk a compact copy, nearest box first, that
/// takes a tree of any depth and forgets what lies behind the nearest hit.
#[derive(Clone, Debug)]
pub(super) struct Hierarchy {
    nodes: Vec<Node>,
    /// The topmost node or leaf; `None` if there is nothing at all.
    root: Option<u32>,
}

/// Two children, each with a box around it.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: [Bounds; 2],
    /// Index of a node, or of a leaf if [`LEAF`] is set.
    children: [u32; 2],
}

/// Marks the index of a leaf.
const LEAF: u32 = 1 << 31;

/// A box in single precision, rounded outwards.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: [f32; 3],
    high: [f32; 3],
}

impl Bounds {
    fn around([low, high]: &Corners) -> Self {
        Self {
            low: [low.x, low.y, low.z].map(|c| (c as f32).next_down()),
            high: [high.x, high.y, high.z].map(|c| (c as f32).next_up()),
        }
    }

    fn join(self, other: Self) -> Self {
        let pick =
            |a: [f32; 3], b: [f32; 3], f: fn(f32, f32) -> f32| [0, 1, 2].map(|k| f(a[k], b[k]));
        Self {
            low: pick(self.low, other.low, f32::min),
            high: pick(self.high, other.high, f32::max),
        }
    }

    /// Distance at which a ray enters the box, 0 within it; infinity if it passes by, or enters beyond `far`.
    #[inline(always)]
    fn entered(&self, origin: Vec3, per_step: Vec3, far: f64) -> f64 {
        // No ray slips between boxes that touch, however distances round.
        const SLACK: f64 = 1.0 + 1e-12;
        let (mut enter, mut exit) = (0.0f64, far);
        for k in 0..3 {
            let a = (f64::from(self.low[k]) - origin[k]) * per_step[k];
            let b = (f64::from(self.high[k]) - origin[k]) * per_step[k];
            enter = greater(enter, lesser(a, b));
            exit = lesser(exit, greater(a, b));
        }
        if enter <= exit * SLACK { enter } else { f64::INFINITY }
    }
}

/// The lesser of two numbers of which none is NaN: one instruction, where `f64::min` takes a few.
#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers of which none is NaN.
#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// What the crate builds from: a box that is told its place.
struct Leaf {
    corners: Corners,
    node: usize,
}

impl Bounded<f64, 3> for Leaf {
    fn aabb(&self) -> Aabb<f64, 3> {
        let [low, high] = self.corners;
        Aabb::with_bounds(low.into(), high.into())
    }
}

impl BHShape<f64, 3> for Leaf {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Hierarchy {
    /// The tree over finite `boxes`, fewer than 2³⁰, and the order of its leaves: leaf k is box `order[k]`.
    /// Halves are built on all cores; the tree is the same on any number of them.
    pub(super) fn new(boxes: impl Iterator<Item = Corners>) -> (Self, Vec<u32>) {
        let mut leaves: Vec<Leaf> = boxes.map(|corners| Leaf { corners, node: 0 }).collect();
        let built = Bvh::build_with_executor(&mut leaves, split).nodes;
        compact(&built, |leaf| Bounds::around(&leaves[leaf].corners))
    }

    /// The nearest leaf that a ray meets: `meet` tells the distance to a leaf and what else is worth knowing.
    pub(super) fn nearest<T>(
        &self,
        origin: Vec3,
        direction: Vec3,
        mut meet: impl FnMut(usize) -> Option<(f64, T)>,
    ) -> Option<(f64, T)> {
        let per_step = direction.map(reciprocal);
        let mut found: Option<(f64, T)> = None;
        let mut far = f64::INFINITY;
        let mut waiting = Waiting::new();
        let mut next = self.root;
        while let Some(at) = next {
            next = None;
            if at & LEAF == 0 {
                let Node { bounds, children } = &self.nodes[at as usize];
                let [left, right] = bounds;
                let entered =
                    [left.entered(origin, per_step, far), right.entered(origin, per_step, far)];
                let near = usize::from(entered[1] < entered[0]);
                if entered[1 - near] < f64::INFINITY {
                    waiting.push((children[1 - near], entered[1 - near]));
                }
                if entered[near] < f64::INFINITY {
                    next = Some(children[near]);
                }
            } else if let Some((t, what)) = meet((at & !LEAF) as usize)
                && t < far
            {
                far = t;
                found = Some((t, what));
            }
            while next.is_none() {
                let Some((child, entered)) = waiting.pop() else { return found };
                next = (entered <= far).then_some(child);
            }
        }
        found
    }
}

/// 1/c, finite and of the sign of `c` even where c is 0: then a ray within a box's sides stays within.
fn reciprocal(c: f64) -> f64 {
    1.0 / c.abs().max(1e-300).copysign(c)
}

/// Builds both halves, large ones at once.
fn split(a: BvhNodeBuildArgs<'_, Leaf, f64, 3>, b: BvhNodeBuildArgs<'_, Leaf, f64, 3>) {
    const LARGE: usize = 1024;
    if a.node_count().min(b.node_count()) < LARGE {
        a.build_with_executor(split);
        b.build_with_executor(split);
    } else {
        rayon::join(|| a.build_with_executor(split), || b.build_with_executor(split));
    }
}

/// Nodes and leaves numbered in the order in which the crate holds them, parents before children.
fn compact(built: &[BvhNode<f64, 3>], around: impl Fn(usize) -> Bounds) -> (Hierarchy, Vec<u32>) {
    let mut order = Vec::new();
    let mut inner = 0;
    let number = |node: &BvhNode<f64, 3>| match *node {
        BvhNode::Leaf { shape_index, .. } => {
            order.push(shape_index as u32);
            (order.len() - 1) as u32 | LEAF
        }
        BvhNode::Node { .. } => {
            inner += 1;
            inner - 1
        }
    };
    let numbers: Vec<u32> = built.iter().map(number).collect();
    // From the last to the first, so that children's boxes are known before their parents'.
    let mut boxes: Vec<Bounds> = Vec::with_capacity(built.len());
    let mut nodes: Vec<Node> = Vec::with_capacity(inner as usize);
    for node in built.iter().rev() {
        boxes.push(match *node {
            BvhNode::Leaf { shape_index, .. } => around(shape_index),
            BvhNode::Node { child_l_index, child_r_index, .. } => {
                let children = [child_l_index, child_r_index];
                let bounds = children.map(|child| boxes[built.len() - 1 - child]);
                nodes.push(Node { bounds, children: children.map(|child| numbers[child]) });
                bounds[0].join(bounds[1])
            }
        });
    }
    nodes.reverse();
    (Hierarchy { nodes, root: numbers.first().copied() }, order)
}

/// A child put off, and the distance at which its box is entered.
type PutOff = (u32, f64);

/// Children put off, the last first. As many as trees usually are deep need no memory of their own.
struct Waiting {
    shallow: arrayvec::ArrayVec<PutOff, 48>,
    deep: Vec<PutOff>,
}

impl Waiting {
    fn new() -> Self {
        Self { shallow: arrayvec::ArrayVec::new(), deep: Vec::new() }
    }

    fn push(&mut self, child: PutOff) {
        if let Err(full) = self.shallow.try_push(child) {
            self.deep.push(full.element());
        }
    }

    fn pop(&mut self) -> Option<PutOff> {
        self.deep.pop().or_else(|| self.shallow.pop())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Boxes the size of their distance, nearer and nearer to a point: a tree deeper than any usual one.
    #[test]
    fn a_deep_tree_is_walked_to_its_end() {
        let scale = |k: usize| 0.5f64.powi(k as i32);
        let boxes = (0..120).map(|k| [Vec3::repeat(scale(k)), Vec3::repeat(1.5 * scale(k))]);
        let (tree, order) = Hierarchy::new(boxes);
        let mut seen = 0;
        let none = tree.nearest(Vec3::repeat(-1.0), Vec3::repeat(1.0), |_| -> Option<(f64, ())> {
            seen += 1;
            None
        });
        assert!(none.is_none() && seen == 120 && order.len() == 120);
        let last = |leaf: usize| Some((scale(order[leaf] as usize) + 1.0, order[leaf]));
        let (_, nearest) = tree.nearest(Vec3::repeat(-1.0), Vec3::repeat(1.0), last).unwrap();
        assert!(nearest > 45, "the boxes beyond 2⁻⁵² are one in double precision: {nearest}");
    }

    /// Where a ray enters a box in double precision, if it does.
    fn enters([low, high]: &Corners, origin: Vec3, direction: Vec3) -> Option<f64> {
        let (mut enter, mut exit) = (0.0f64, f64::INFINITY);
        for k in 0..3 {
            let per_step = reciprocal(direction[k]);
            let (a, b) = ((low[k] - origin[k]) * per_step, (high[k] - origin[k]) * per_step);
            (enter, exit) = (enter.max(a.min(b)), exit.min(a.max(b)));
        }
        (enter <= exit).then_some(enter)
    }

    proptest! {
        /// From near and afar, aslant and along an axis: what the tree finds is what looking at every box finds.
        #[test]
        fn no_box_is_passed_by(
            places in prop::collection::vec([-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0, 0.0f64..0.2], 1..60),
            aim in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
            way in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
            away in -1.0f64..6.0,
            straight in 0usize..7,
        ) {
            let boxes: Vec<Corners> = places
                .iter()
                .map(|[x, y, z, side]| [Vec3::new(*x, *y, *z), Vec3::new(x + side, y + 0.5 * side, z + side)])
                .collect();
            let mut way = Vec3::from(way);
            (0..3).filter(|k| straight & (1 << k) != 0).for_each(|k| way[k] = 0.0);
            prop_assume!(way.norm() > 1e-3);
            let origin = Vec3::from(aim) - way.normalize() * libm::pow(10.0, away);
            let (tree, order) = Hierarchy::new(boxes.iter().copied());
            let every = boxes.iter().filter_map(|b| enters(b, origin, way)).fold(f64::INFINITY, f64::min);
            let meet = |leaf: usize| Some((enters(&boxes[order[leaf] as usize], origin, way)?, ()));
            let found = tree.nearest(origin, way, meet).map_or(f64::INFINITY, |(t, ())| t);
            prop_assert_eq!(found, every);
        }
    }

    #[test]
    fn nothing_is_met_in_nothing_and_one_box_is_enough() {
        let (nothing, _) = Hierarchy::new(std::iter::empty());
        assert!(nothing.nearest(Vec3::zeros(), Vec3::z(), |_| Some((1.0, ()))).is_none());
        let (one, order) = Hierarchy::new(std::iter::once([Vec3::zeros(), Vec3::repeat(1.0)]));
        assert_eq!(one.nearest(-Vec3::z(), Vec3::z(), |leaf| Some((2.0, leaf))), Some((2.0, 0)));
        assert_eq!(order, [0]);
    }

    #[test]
    fn a_ray_in_the_side_of_a_box_meets_it() {
        let flat = |x: f64| [Vec3::new(x, -1.0, 0.0), Vec3::new(x + 1.0, 1.0, 0.0)];
        let (tree, _) = Hierarchy::new([flat(-1.0), flat(0.0)].into_iter());
        for (origin, direction) in [
            (Vec3::new(0.0, 0.0, 1.0), -Vec3::z()),
            (Vec3::new(0.0, -3.0, 0.0), Vec3::y()),
            (Vec3::new(0.0, 1.0, 2.0), Vec3::new(-0.0, 0.0, -1.0)),
        ] {
            let mut met = 0;
            tree.nearest(origin, direction, |_| -> Option<(f64, ())> {
                met += 1;
                None
            });
            assert_eq!(met, 2, "{origin} {direction}");
        }
    }
}
