//! The patterns against what is known of them in closed form.

use proptest::prelude::*;
use wrinkle::parameter::{Column, Domain, Value, Values};
use wrinkle::pattern::{Bumps, Entry, entries, find};
use wrinkle::texture::NormalMap;

/// A pattern's map with some parameters set.
fn make(name: &str, [width, height]: [usize; 2], set: &[(&str, Value)], seed: u64) -> Bumps {
    let entry = find(name).unwrap();
    (entry.build)(width, height, &values(&entry, set), seed)
}

fn values(entry: &Entry, set: &[(&str, Value)]) -> Values {
    let mut values = Values::defaults(entry.parameters);
    for (name, value) in set {
        let parameter = entry.parameters.iter().find(|p| p.name == *name).unwrap();
        values.set(parameter.name, value.clone());
    }
    values
}

fn number(x: f64) -> Value {
    Value::Number(x)
}

/// Weighted mean of `f(normal)`.
fn mean(map: &NormalMap, f: impl Fn([f64; 3]) -> f64) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for &[x, y, z, w] in map.texels() {
        sum += f64::from(w) * f([x, y, z].map(f64::from));
        total += f64::from(w);
    }
    sum / total
}

/// Mean over texels of `f(slope x, slope y)`.
fn slope_mean(map: &NormalMap, f: impl Fn(f64, f64) -> f64) -> f64 {
    mean(map, |[x, y, z]| f(-x / z, -y / z))
}

/// All settings of a pattern that differ from the defaults in one parameter, at its ends.
fn settings(entry: &Entry) -> Vec<Values> {
    let mut all = vec![values(entry, &[])];
    for parameter in entry.parameters {
        let ends: Vec<Value> = match parameter.domain {
            Domain::Real { min, max, .. } => vec![Value::Number(min), Value::Number(max)],
            Domain::Whole { min, max, .. } => {
                vec![Value::Number(min.into()), Value::Number(max.into())]
            }
            Domain::Choice { words } => words.iter().map(|w| Value::Word(w)).collect(),
            Domain::Text { .. } => ["i", "é\n§ 7", "Ω"].map(|t| Value::Text(t.into())).into(),
            Domain::Rows { columns, .. } => {
                let row = |end: fn(&Column) -> f64| columns.iter().map(end).collect();
                [row(|c| c.min), row(|c| c.max)].map(|row| Value::Rows(vec![row])).into()
            }
        };
        all.extend(ends.into_iter().map(|end| values(entry, &[(parameter.name, end)])));
    }
    all
}

#[test]
fn every_pattern_makes_sound_maps_of_every_size_and_setting() {
    for entry in entries() {
        for values in settings(&entry) {
            for [width, height] in [[1, 1], [2, 1], [1, 3], [2, 2], [5, 7], [32, 9]] {
                let bumps = (entry.build)(width, height, &values, 3);
                let what = format!("{} {width}x{height} {values:?}", entry.card.name);
                assert_eq!([bumps.normals.width(), bumps.normals.height()], [width, height]);
                for [x, y, z, w] in bumps.normals.texels() {
                    let length = (x * x + y * y + z * z).sqrt();
                    assert!((length - 1.0).abs() < 1e-6 && *z > 0.0, "{what}");
                    assert!(w.is_finite() && *w >= 0.0, "{what}");
                }
                if let Some(heights) = &bumps.heights {
                    assert_eq!([heights.width(), heights.height()], [width, height]);
                    assert!(heights.values().iter().all(|h| h.is_finite()), "{what}");
                }
            }
        }
    }
}

#[test]
fn names_are_unique_and_found() {
    let names: Vec<&str> = entries().iter().map(|e| e.card.name).collect();
    for name in &names {
        assert_eq!(names.iter().filter(|n| *n == name).count(), 1);
        assert!(find(name).is_some());
    }
    assert!(find("no such pattern").is_none());
}

#[test]
fn a_seed_makes_one_map_and_another_seed_another() {
    for name in ["waves", "gaussian", "brushed"] {
        let of = |seed| make(name, [32, 20], &[], seed).normals;
        assert_eq!(of(7), of(7));
        assert_ne!(of(7), of(8));
    }
}

#[test]
fn a_hemisphere_holds_all_directions_equally() {
    // The area of a hemisphere is uniform over directions. A midpoint rule meets its rim, where the
    // weight grows without bound, with an error of order side^(-1/2).
    let error = |side: usize| {
        let none = [("background", Value::Word("none"))];
        let map = make("hemispheres", [side, side], &none, 0).normals;
        type Moment = (fn([f64; 3]) -> f64, f64);
        let moments: [Moment; 6] = [
            (|n| n[0] * n[0], 1.0 / 3.0),
            (|n| n[1] * n[1], 1.0 / 3.0),
            (|n| n[2] * n[2], 1.0 / 3.0),
            (|n| n[2], 0.5),
            (|n| n[2] * n[2] * n[2] * n[2], 0.2),
            (|n| n[0] * n[0] * n[1] * n[1], 1.0 / 15.0),
        ];
        moments.iter().map(|(f, truth)| (mean(&map, f) - truth).abs()).fold(0.0, f64::max)
    };
    let errors = [64, 256, 1024].map(error);
    for (error, side) in errors.iter().zip([64.0f64, 256.0, 1024.0]) {
        assert!(*error < 0.1 / side.sqrt(), "side {side}: {errors:?}");
    }
}

#[test]
fn counted_equally_a_hemisphere_is_a_cosine_distribution() {
    // Without the weight a direction counts by its projected area: E[n_z] = 2/3, E[n_z²] = 1/2.
    let set = [("background", Value::Word("none")), ("weight", Value::Word("equal"))];
    let map = make("hemispheres", [512, 512], &set, 0).normals;
    assert!((mean(&map, |n| n[2]) - 2.0 / 3.0).abs() < 1e-3);
    assert!((mean(&map, |n| n[2] * n[2]) - 0.5).abs() < 1e-3);
}

#[test]
fn a_background_is_flat_or_nothing() {
    let beside = |word| make("hemispheres", [16, 16], &[("background", Value::Word(word))], 0);
    assert_eq!(beside("flat").normals.texel(0, 0), [0.0, 0.0, 1.0, 1.0]);
    assert_eq!(beside("none").normals.texel(0, 0), [0.0, 0.0, 1.0, 0.0]);
}

#[test]
fn a_cylinder_holds_a_half_circle_equally() {
    // Equal in angle: E[n_x²] = 1/2, E[n_z] = 2/π, E[n_x⁴] = 3/8. The weight grows as the root of the
    // distance to the rim, so a midpoint rule's error is as side^(-1/2).
    let moments: [fn(f64, f64) -> f64; 3] = [|x, _| x * x, |_, z| z, |x, _| x.powi(4)];
    for (axis, across, size) in [("v", 0, [2048, 2]), ("u", 1, [2, 2048])] {
        let map = make("cylinders", size, &[("axis", Value::Word(axis))], 0).normals;
        for (f, truth) in moments.iter().zip([0.5, std::f64::consts::FRAC_2_PI, 0.375]) {
            let error = (mean(&map, |n| f(n[across], n[2])) - truth).abs();
            assert!(error < 0.3 / 2048f64.sqrt(), "{error}");
        }
        assert_eq!(mean(&map, |n| n[1 - across].abs()), 0.0);
    }
}

#[test]
fn a_straight_twill_has_two_normals_a_texel_of_pitch() {
    for pitch in [4usize, 8, 10] {
        let set = [("pitch", number(pitch as f64))];
        let map = make("twill", [6 * pitch, 3 * pitch], &set, 0).normals;
        let mut distinct: Vec<[u32; 4]> =
            map.texels().iter().map(|t| t.map(f32::to_bits)).collect();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), 2 * pitch);
    }
}

#[test]
fn twill_cells_show_warp_and_weft_in_diagonal_steps() {
    for over in [1usize, 2, 3] {
        let (pitch, cells) = (6, 2 * (over + 1));
        for phase in 0..=over {
            let set = [
                ("over", number(over as f64)),
                ("pitch", number(pitch as f64)),
                ("phase", number(phase as f64)),
            ];
            let bumps = make("twill", [cells * pitch; 2], &set, 0);
            assert!(bumps.notes.is_empty(), "it meets itself: {:?}", bumps.notes);
            for (a, b) in (0..cells).flat_map(|a| (0..cells).map(move |b| (a, b))) {
                // The first texel of a cell leans across its thread.
                let [x, y, ..] = bumps.normals.texel(a * pitch, b * pitch);
                let weft = (b + over * a + phase) % (over + 1) == 0;
                assert_eq!(weft, x == 0.0 && y < 0.0, "cell {a},{b}");
                assert_eq!(!weft, y == 0.0 && x < 0.0, "cell {a},{b}");
            }
        }
    }
    assert_eq!(make("twill", [64, 64], &[], 0).notes.len(), 1, "64 is no multiple of 24");
}

#[test]
fn a_thread_is_a_cylinder_of_its_own_area() {
    // Both directions are cylinders, so E[n_z] = 2/π whatever the weave.
    for bend in [0.0, 1e-3] {
        let set = [("pitch", number(1024.0)), ("over", number(1.0)), ("bend", number(bend))];
        let map = make("twill", [2048, 2048], &set, 0).normals;
        assert!((mean(&map, |n| n[2]) - std::f64::consts::FRAC_2_PI).abs() < 0.015);
    }
}

#[test]
fn bent_threads_lean_outward_at_their_ends() {
    let set = [("pitch", number(16.0)), ("over", number(3.0)), ("bend", number(30.0))];
    let map = make("twill", [64, 64], &set, 0).normals;
    // Warp thread 0: weft over it in cell row 0, then a stretch over rows 1 to 3.
    let (start, end) = (map.texel(7, 16), map.texel(7, 63));
    assert!(start[1] < -0.4 && end[1] > 0.4, "{start:?} {end:?}");
    assert!((start[1] + end[1]).abs() < 1e-6);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn gaussian_variances_are_as_stated(
        (width, height) in (24usize..80, 24usize..80),
        (u, v) in (0.0f64..0.5, 0.0f64..0.5),
        length in 1.0f64..6.0,
        seed in any::<u64>(),
    ) {
        prop_assume!(u.max(v) > 1e-3);
        let set = [
            ("slope_variance_u", number(u)),
            ("slope_variance_v", number(v)),
            ("correlation_length", number(length)),
        ];
        let map = make("gaussian", [width, height], &set, seed).normals;
        // Normals are in single precision: that is the tolerance.
        let near = |got: f64, want: f64| (got - want).abs() < 3e-6 * u.max(v).max(1.0);
        let [xx, yy] = [slope_mean(&map, |x, _| x * x), slope_mean(&map, |_, y| y * y)];
        prop_assert!(near(xx, u) && near(yy, v), "{xx} for {u}, {yy} for {v}");
        prop_assert!(near(slope_mean(&map, |x, y| x * y), 0.0));
        prop_assert!(near(slope_mean(&map, |x, _| x), 0.0));
    }

    #[test]
    fn waves_have_the_slope_stated(
        (width, height) in (3usize..70, 1usize..70),
        slope in 0.0f64..2.0,
        wavelength in 2.0f64..100.0,
        seed in any::<u64>(),
    ) {
        let set = [("slope", number(slope)), ("wavelength", number(wavelength))];
        let map = make("waves", [width, height], &set, seed).normals;
        let square = slope_mean(&map, |x, y| x * x + y * y);
        prop_assert!((square - slope * slope).abs() < 1e-5 * slope.max(1.0));
    }
}

#[test]
fn gaussian_slopes_are_near_normal() {
    let set = [("slope_variance_u", number(0.09)), ("slope_variance_v", number(0.01))];
    let map = make("gaussian", [256, 256], &set, 5).normals;
    // A bump is some 2·6 texels wide along u and three times that along v: about 150 independent ones.
    // The standard errors are then √(6/150) = 0.2 for the skew and √(24/150) = 0.4 for the kurtosis at
    // worst; over six seeds 0.1 and 0.2 were seen.
    for (axis, deviation) in [(0, 0.3), (1, 0.1)] {
        let moment = |power| slope_mean(&map, |x, y| ([x, y][axis] / deviation).powi(power));
        assert!((moment(2) - 1.0).abs() < 1e-5);
        assert!(moment(3).abs() < 0.3, "skew {}", moment(3));
        assert!((moment(4) - 3.0).abs() < 0.4, "kurtosis {}", moment(4));
    }
}

#[test]
fn bricks_and_grid_are_flat_on_top_and_in_the_grooves() {
    for name in ["grid", "bricks"] {
        let bumps = make(name, [128, 96], &[], 0);
        let heights = bumps.heights.unwrap();
        let (low, high) =
            heights.values().iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
        assert_eq!((low, high), (0.0, 2.0), "{name}");
        // Between grooves and in one: the middle of a plate or brick, and a corner where joints meet.
        let [i, j] = if name == "grid" { [16, 12] } else { [21, 8] };
        assert_eq!((bumps.normals.texel(i, j)[2], heights.at(i as isize, j as isize)), (1.0, 2.0));
        assert_eq!((bumps.normals.texel(0, 0)[2], heights.at(0, 0)), (1.0, 0.0));
        // A closed surface that repeats: slopes cancel.
        assert!(slope_mean(&bumps.normals, |x, _| x).abs() < 1e-6);
        assert!(slope_mean(&bumps.normals, |_, y| y).abs() < 1e-6);
    }
}

#[test]
fn courses_of_bricks_are_shifted_by_half_a_brick() {
    let set = [("columns", number(2.0)), ("courses", number(2.0))];
    let heights = make("bricks", [64, 64], &set, 0).heights.unwrap();
    for j in 0..32 {
        for i in 0..64 {
            assert_eq!(heights.at(i, j), heights.at(i + 16, j + 32), "{i},{j}");
        }
    }
}

#[test]
fn heights_belong_to_the_normals() {
    // Central differences of the stored heights come near the stored slopes where waves are long.
    for (name, set) in [
        ("waves", vec![]),
        ("gaussian", vec![]),
        ("corrugated", vec![]),
        ("corrugated", vec![("profile", Value::Word("arcs")), ("axis", Value::Word("u"))]),
        ("brushed", vec![("breadth", number(3.0))]),
    ] {
        let bumps = make(name, [96, 64], &set, 2);
        let by_difference = NormalMap::from_heights(&bumps.heights.unwrap(), 1.0);
        let worst = by_difference
            .texels()
            .iter()
            .zip(bumps.normals.texels())
            .map(|(a, b)| a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
            .fold(1.0, f32::min);
        assert!(worst > 0.98, "{name}: {worst}");
    }
}

#[test]
fn heights_seen_from_above_are_those_of_the_geometry() {
    let top = |name, set: &[_]| make(name, [64, 64], set, 0).heights.unwrap();
    // A sphere and two cylinders: F² and the squared distance from the axis add up to the radius'.
    let sphere = top("hemispheres", &[]);
    let cylinders = top("cylinders", &[("count", Value::Number(2.0))]);
    for j in 0..64 {
        for i in 0..64 {
            let (x, y) = (i as f64 + 0.5 - 32.0, j as f64 + 0.5 - 32.0);
            let square = 32.0f64.powi(2) - x * x - y * y;
            assert!((sphere.at(i, j) - square.max(0.0).sqrt()).abs() < 1e-9, "{i}, {j}");
            let across = (i as f64 + 0.5).rem_euclid(32.0) - 16.0;
            let want = (16.0f64.powi(2) - across * across).sqrt();
            assert!((cylinders.at(i, j) - want).abs() < 1e-9, "{i}, {j}");
        }
    }
    let threads = top("twill", &[]);
    let crest = (16.0 - 0.25f64).sqrt();
    assert!(
        (threads.range()[1] - crest).abs() < 1e-9,
        "half a pitch of 8, half a texel off the axis"
    );
}

#[test]
fn normals_seen_from_above_are_those_of_the_heights() {
    // Inside a thread, away from its rims, central differences come near the normal's own slope.
    let bent = [("pitch", Value::Number(64.0)), ("bend", Value::Number(20.0))];
    let bumps = make("twill", [192, 192], &bent, 0);
    let heights = bumps.heights.unwrap();
    let mut seen = 0;
    for (j, i) in (0..192).flat_map(|j| (0..192).map(move |i| (j, i))) {
        let inside = |k: usize| (16..48).contains(&(k % 64));
        let [x, y, z, _] = bumps.normals.texel(i, j).map(f64::from);
        if inside(i) && inside(j) {
            let [fx, fy] = heights.gradient(i as isize, j as isize);
            // The thread is taken for straight: the bend of its line is left out of the slope along it.
            assert!((fx + x / z).abs() < 0.08 && (fy + y / z).abs() < 0.25, "{i}, {j}: {fx} {fy}");
            seen += 1;
        }
    }
    assert_eq!(seen, 9 * 32 * 32);
}

#[test]
fn corrugated_sheet_has_the_slopes_of_its_profile() {
    // A cosine of depth d a pitch has slopes of mean square (π d)²/2; texels of whole pitches meet it exactly.
    // Arcs of radius R = (1/16 + s²)/2s, s = d/2, over chords of half a pitch: the mean of x²/(R² − x²) over
    // |x| < ¼, which is R/¼ artanh(¼/R) − 1. Texels 1/128 apart are its midpoint rule, short by
    // (1/128)²/24 · 4 f′(¼) = 0.0013, as f′(¼) = R²/2(R² − 1/16)² = 127.
    let depth = 0.3;
    let radius: f64 = (0.0625 + depth * depth / 4.0) / depth;
    let arcs = 4.0 * radius * (0.25 / radius).atanh() - 1.0;
    let sine = (std::f64::consts::PI * depth).powi(2) / 2.0;
    for (profile, want, within) in [("sine", sine, 1e-5), ("arcs", arcs, 2e-3)] {
        for (axis, along) in [("v", 1), ("u", 0)] {
            let set = [
                ("depth", number(depth)),
                ("profile", Value::Word(profile)),
                ("axis", Value::Word(axis)),
                ("count", number(2.0)),
            ];
            let bumps = make("corrugated", [256, 256], &set, 0);
            let square = |axis: usize| slope_mean(&bumps.normals, |x, y| [x, y][axis].powi(2));
            assert!((square(1 - along) - want).abs() < within, "{profile} {axis} {want}");
            assert_eq!(square(along), 0.0);
            let [low, high] = bumps.heights.unwrap().range();
            assert!((high - low - depth * 128.0).abs() < 0.05, "{low} {high}");
        }
    }
}

#[test]
fn brushed_metal_is_rough_across_its_scratches_alone() {
    for seed in 0..3 {
        let map = make("brushed", [256, 128], &[("slope", number(0.3))], seed).normals;
        let across = slope_mean(&map, |_, y| y * y);
        assert!((across - 0.09).abs() < 1e-6, "{across}");
        // A groove of deviation w and length ℓ slopes along itself by π/ℓ · w of what it does across, and
        // shorter ones more: below a tenth.
        let along = slope_mean(&map, |x, _| x * x);
        assert!(along > 0.0 && along < 0.01 * across, "{along}");
        assert!(slope_mean(&map, |x, _| x).abs() < 1e-6 && slope_mean(&map, |_, y| y).abs() < 1e-6);
    }
}

#[test]
fn a_wavy_sphere_is_steepest_where_its_ripples_are() {
    // Rings about the x axis: on the equator at longitude α the slope along u is −h k sin(k α)/r towards +x.
    let set = [("ripples", number(6.0)), ("amplitude", number(0.1))];
    let map = make("wavy-sphere", [240, 121], &set, 0).normals;
    for i in 0..240 {
        let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / 240.0;
        let (sin, cos) = libm::sincos(6.0 * angle);
        let slope = -0.1 * 6.0 * sin / (1.0 + 0.1 * cos);
        let [x, y, z, _] = map.texel(i as usize, 60).map(f64::from);
        assert!((-x / z - slope).abs() < 1e-5 && y.abs() < 1e-6, "{i}: {} {slope}", -x / z);
    }
}
