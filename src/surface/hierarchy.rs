//! Boxes within boxes around many small things, and the first of them that a ray meets.

mod boxes;

use boxes::{Bounds, Nearby, Node, WIDE};
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::{Bvh, BvhNode, BvhNodeBuildArgs};

use crate::geometry::Vec3;

/// Corners of a box along the axes, world space: least and greatest coordinates.
pub(super) type Corners = [Vec3; 2];

/// A tree of boxes, up to four within one. It is built by the crate `bvh`; rays walk a compact copy, nearest box first,
/// that takes a tree of any depth and forgets what lies behind the nearest hit.
#[derive(Clone, Debug)]
pub(super) struct Hierarchy {
    /// The topmost first; empty if there is nothing at all.
    nodes: Vec<Node>,
    /// The box around everything.
    around: Corners,
}

/// Marks the index of a leaf.
const LEAF: u32 = 1 << 31;

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
        if self.nodes.is_empty() {
            return None;
        }
        let ray = Nearby::new(origin, direction, &self.around)?;
        let mut found: Option<(f64, T)> = None;
        let (mut far, mut reach) = (f64::INFINITY, f32::INFINITY);
        let mut waiting = Waiting::new();
        let mut next = Some(0);
        while let Some(at) = next {
            next = None;
            if at & LEAF == 0 {
                let node = &self.nodes[at as usize];
                // Those entered, the farthest first.
                let mut entered = arrayvec::ArrayVec::<PutOff, WIDE>::new();
                for (child, distance) in node.children.into_iter().zip(node.entered(&ray, reach)) {
                    if distance < f32::INFINITY {
                        let place = entered.iter().take_while(|(_, d)| *d > distance).count();
                        entered.insert(place, (child, distance));
                    }
                }
                next = entered.pop().map(|(child, _)| child);
                entered.into_iter().for_each(|later| waiting.push(later));
            } else if let Some((t, what)) = meet((at & !LEAF) as usize)
                && t < far
            {
                (far, reach) = (t, ray.reach(t));
                found = Some((t, what));
            }
            while next.is_none() {
                let Some((child, entered)) = waiting.pop() else { return found };
                next = (entered <= reach).then_some(child);
            }
        }
        found
    }
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

/// The crate's tree with every other floor left out, so that nodes have up to four children; and its leaves in order.
fn compact(built: &[BvhNode<f64, 3>], around: impl Fn(usize) -> Bounds) -> (Hierarchy, Vec<u32>) {
    // From the last to the first, so that children's boxes are known before their parents'.
    let mut boxes = vec![Bounds::around(&[Vec3::zeros(); 2]); built.len()];
    for (index, node) in built.iter().enumerate().rev() {
        boxes[index] = match *node {
            BvhNode::Leaf { shape_index, .. } => around(shape_index),
            BvhNode::Node { child_l_index, child_r_index, .. } => {
                boxes[child_l_index].join(boxes[child_r_index])
            }
        };
    }
    let mut tree = Hierarchy {
        nodes: Vec::new(),
        around: boxes.first().map_or([Vec3::zeros(); 2], Bounds::corners),
    };
    let mut order = Vec::new();
    if !built.is_empty() {
        tree.nodes.push(Node::EMPTY);
    }
    // Nodes whose children are still to be put: their places here, and in the crate's tree.
    let mut open: Vec<(usize, usize)> = tree.nodes.iter().map(|_| (0, 0)).collect();
    while let Some((place, index)) = open.pop() {
        for (lane, child) in adopted(built, &boxes, index).into_iter().enumerate() {
            let number = match built[child] {
                BvhNode::Leaf { shape_index, .. } => {
                    order.push(shape_index as u32);
                    (order.len() - 1) as u32 | LEAF
                }
                BvhNode::Node { .. } => {
                    tree.nodes.push(Node::EMPTY);
                    open.push((tree.nodes.len() - 1, child));
                    (tree.nodes.len() - 1) as u32
                }
            };
            tree.nodes[place].put(lane, &boxes[child], number);
        }
    }
    (tree, order)
}

/// What becomes a node's children: the leaf itself, or its two, of which the larger gives way to its own two while there
/// are fewer than four.
fn adopted(
    built: &[BvhNode<f64, 3>],
    boxes: &[Bounds],
    index: usize,
) -> arrayvec::ArrayVec<usize, WIDE> {
    let children = |index: usize| match built[index] {
        BvhNode::Leaf { .. } => None,
        BvhNode::Node { child_l_index, child_r_index, .. } => Some([child_l_index, child_r_index]),
    };
    let area = |index: usize| {
        let [x, y, z] = [0, 1, 2].map(|k| boxes[index].high[k] - boxes[index].low[k]);
        x * y + y * z + z * x
    };
    let mut adopted = arrayvec::ArrayVec::new();
    adopted.push(index);
    while adopted.len() < WIDE {
        let parents = adopted.iter().enumerate().filter(|(_, child)| children(**child).is_some());
        let larger = parents.max_by(|(_, a), (_, b)| area(**a).total_cmp(&area(**b)));
        let Some((lane, &parent)) = larger else { break };
        let [left, right] = children(parent).expect("it was found to have children");
        adopted[lane] = left;
        adopted.push(right);
    }
    adopted
}

/// A child put off, and the distance at which its box is entered.
type PutOff = (u32, f32);

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
mod tests;
