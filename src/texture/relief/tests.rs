use super::*;
use crate::texture::{HorizonMap, Wrap};
use proptest::prelude::*;

fn relief(heights: HeightMap) -> Relief {
    Relief::new(Arc::new(heights))
}

/// The least slope from where a ray starts to its height above the surface, as steps find it, each longer than
/// the last by 0.002 of the way: surfaces with slopes up to 2 along each axis rise by less than 0.003 of the way
/// between two steps. The first 10⁻⁵ are left to rounding.
fn clearance(relief: &Relief, [x, y]: [f64; 2], d: [f64; 3]) -> f64 {
    let start = relief.height(x, y);
    let (mut least, mut t) = (f64::INFINITY, 1e-5);
    while t < 1e3 {
        let z = start + t * d[2];
        least = least.min((z - relief.height(x + t * d[0], y + t * d[1])) / t);
        if z > relief.range[1] {
            break;
        }
        t *= 1.002;
    }
    least
}

fn heights() -> impl Strategy<Value = Relief> {
    let wrap = prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp)];
    (1usize..=7, 1usize..=7, wrap).prop_flat_map(|(width, height, wrap)| {
        prop::collection::vec(-1.0f64..1.0, width * height)
            .prop_map(move |values| relief(HeightMap::new(width, height, wrap, values)))
    })
}

/// A horizontal unit vector, sometimes along an axis, with a slope.
fn direction() -> impl Strategy<Value = [f64; 3]> {
    let angle = prop_oneof![
        3 => 0.0f64..6.3,
        1 => prop::sample::select(vec![0.0, 0.5, 1.0, 1.5]).prop_map(|t| t * std::f64::consts::PI)
    ];
    (angle, 0.02f64..2.0).prop_map(|(angle, slope)| [angle.cos(), angle.sin(), slope])
}

proptest! {
    #[test]
    fn rays_see_what_fine_steps_see(
        relief in heights(), x in -3.0f64..9.0, y in -3.0f64..9.0, d in direction()
    ) {
        let clearance = clearance(&relief, [x, y], d);
        // Steps miss what lies between them: rays that all but touch decide nothing.
        if clearance.abs() > 0.02 {
            prop_assert_eq!(relief.sees([x, y], d), clearance > 0.0, "clearance {}", clearance);
        }
    }

    #[test]
    fn what_is_seen_is_on_the_ray_and_sees_the_eye(
        relief in heights(), x in 0.0f64..7.0, y in 0.0f64..7.0, d in direction()
    ) {
        let [hx, hy] = relief.seen_at([x, y], d);
        // On the ray through (x, y, 0), and on the surface.
        let t = (hx - x) * d[0] + (hy - y) * d[1];
        let off = [hx - x - t * d[0], hy - y - t * d[1]];
        prop_assert!(off[0].abs() + off[1].abs() < 1e-9);
        prop_assert!((relief.height(hx, hy) - t * d[2]).abs() < 1e-9, "{} {}", hx, hy);
        // Just above it nothing is in the way.
        let above = clearance_above(&relief, [hx, hy, t * d[2] + 1e-6], d);
        prop_assert!(above > 0.0, "{}", above);
    }

    #[test]
    fn a_slope_over_the_horizon_is_seen_and_one_under_it_is_not(
        values in prop::collection::vec(-1.0f64..1.0, 6 * 5), side in 0usize..4, at in 0usize..30
    ) {
        // From a texel's centre along an axis the surface is the line between entries that horizons
        // are of.
        let map = HeightMap::new(6, 5, Wrap::Repeat, values);
        let horizon = f64::from(HorizonMap::of(&map).slopes()[at][side]);
        let centre = [(at % 6) as f64 + 0.5, (at / 6) as f64 + 0.5];
        let [x, y] = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]][side];
        let relief = relief(map);
        prop_assert!(relief.sees(centre, [x, y, horizon + 1e-5]));
        prop_assert!(horizon == 0.0 || !relief.sees(centre, [x, y, horizon - 1e-5]));
    }
}

/// The least height above the surface of a ray from a point above it.
fn clearance_above(relief: &Relief, [x, y, z]: [f64; 3], d: [f64; 3]) -> f64 {
    (0..20_000)
        .map(|k| f64::from(k) / 512.0)
        .take_while(|t| z + t * d[2] < relief.range[1])
        .map(|t| z + t * d[2] - relief.height(x + t * d[0], y + t * d[1]))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn over_flat_ground_everything_is_seen() {
    let flat = relief(HeightMap::from_fn(4, 3, Wrap::Repeat, |_, _| 0.7));
    for d in [[1.0, 0.0, 0.0], [0.3, -0.4, 1e-9], [0.0, 0.0, 1.0], [-0.6, 0.8, 2.0]] {
        assert!(flat.sees([0.9, 2.2], d), "{d:?}");
    }
    assert!(!flat.sees([0.9, 2.2], [0.0, 1.0, -0.1]));
    // The plane at height 0.7 shows the point that the eye's ray passes there, not the one below.
    let [x, y] = flat.seen_at([1.0, 1.0], [1.0, 0.0, 2.0]);
    assert!((x - 1.35).abs() < 1e-12 && y == 1.0);
    assert_eq!(flat.seen_at([1.0, 1.0], [0.0, 0.0, 1.0]), [1.0, 1.0]);
    assert_eq!(flat.seen_at([1.0, 1.0], [1.0, 0.0, 0.0]), [1.0, 1.0]);
}

#[test]
fn extremes_end() {
    let steep = relief(HeightMap::new(2, 2, Wrap::Repeat, vec![1e300, -1e300, 0.0, 5.0]));
    let one = relief(HeightMap::new(1, 1, Wrap::Clamp, vec![3.0]));
    for relief in [steep, one] {
        for d in [[1.0, 0.0, 0.0], [0.0, 1.0, 1e-30], [1e-30, 1e-30, 1.0], [0.7, 0.7, 1e-3]] {
            relief.sees([0.3, 0.4], d);
            relief.seen_at([0.3, 0.4], d);
            relief.sees([f64::NAN, 0.4], d);
            relief.seen_at([f64::INFINITY, 0.4], d);
        }
    }
}

#[test]
fn the_visible_part_of_touching_cylinders_has_a_closed_form() {
    // Half circles of radius 1 at distance 2, seen across from elevation e. The point at angle a from the
    // vertical, towards the eye, lies cos(a + e) above the ray through its circle's centre. It faces the
    // eye from a = −e on. The next circle hides what is below its own top, 1 − 2 sin e above that ray,
    // so a goes up to arccos(1 − 2 sin e) − e, or to the foot of the flank. It stands at sin a.
    let (side, radius) = (512usize, 128.0);
    let circle = |u: f64, _| {
        let x = (2.0 * u).fract() * 2.0 - 1.0;
        radius * (1.0 - x * x).sqrt()
    };
    let map = relief(HeightMap::from_fn(side, 1, Wrap::Repeat, circle));
    for degrees in [10.0f64, 25.0, 45.0, 70.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let last = (1.0 - 2.0 * sin).acos() - degrees.to_radians();
        let last = last.min(std::f64::consts::FRAC_PI_2);
        let share = (last.sin() - (-degrees.to_radians()).sin()) / 2.0;
        let places = 4096;
        let seen = (0..places)
            .filter(|k| {
                let x = (f64::from(*k) + 0.5) / f64::from(places) * 256.0;
                map.sees([x, 0.5], [cos, 0.0, sin])
            })
            .count();
        let got = seen as f64 / f64::from(places);
        // Chords a texel wide turn the place where a flank turns away by up to half a texel.
        assert!((got - share).abs() < 1.5 / 256.0, "{degrees}°: {got} {share}");
    }
}
