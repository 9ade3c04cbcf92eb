use super::boxes::reciprocal;
use super::*;
use proptest::prelude::*;

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
