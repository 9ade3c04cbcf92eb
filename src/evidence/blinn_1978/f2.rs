//! Figures 2 to 4: a bump function on a curve, the normal it perturbs, and the triangle that tells the angle.

use super::common::{arrow, line};
use crate::evidence::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Sketch, Stroke, Table, Task,
};
use crate::geometry::Vec3;
use crate::surface::Derivatives;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f2-f4",
    title: "A bump function on a surface, the normal it perturbs, and how far from the true one that is",
    parts: &[],
    parameters: &[],
    secs: 0.1,
    make,
};

fn make(_: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = ROW.exhibit();
    let [kept, shape, tilt] = orders();
    exhibit.claims = identities();
    exhibit.claims.extend([
        Claim::near(
            "order of the error of N′ in the height of the bumps, their slopes kept",
            1.0,
            kept,
            0.05,
        ),
        Claim::near(
            "order of that error, of the angle that N turns by, in the height of the bumps, their length kept",
            1.0,
            tilt,
            0.05,
        ),
        Claim::at_most(
            "error of N′ on a plane, where nothing is left out",
            "the value of F is left out with (N/|N|)_u, which is 0 there",
            1e-7,
            error(plane, 1e-2, 1e-2),
        ),
    ]);
    let mut table = Table::new(
        "orders",
        "How fast the unit normal of N + D comes near that of P + F N/|N| as bumps get lower, on a curved patch.",
        &["bumps", "order of the error"],
    );
    table.push(vec!["lower and as much shorter, as steep as they were".into(), kept.into()]);
    table.push(vec!["lower, as long as they were".into(), shape.into()]);
    table.push(vec!["the same, of the angle of the turn".into(), tilt.into()]);
    exhibit.tables = vec![table];
    exhibit.figures = vec![mapping(), turned(), chart()];
    exhibit.remarks = vec![
        "“Negligibly small” F is the paper's only approximation: what it leaves out is F times the curvature, beside \
         the slopes of F."
            .into(),
    ];
    Ok(exhibit)
}

/// The identities of §2 on many patches and slopes: the largest errors.
fn identities() -> Vec<Claim> {
    let (mut axis, mut angle, mut right) = (0.0f64, 0.0f64, 0.0f64);
    for k in 0..2000 {
        // A sequence that fills the cube evenly: multiples of irrational numbers.
        let number = |i: usize| {
            let x = f64::from(k + 1)
                * [0.754_877_7, 0.569_840_3, 0.819_172_5, 0.671_043_6][i % 4]
                * (1.0 + i as f64 * 0.37);
            2.0 * (x - x.floor()) - 1.0
        };
        let p = Derivatives {
            u: Vec3::new(1.0 + 0.5 * number(0), number(1), number(2)),
            v: Vec3::new(0.6 * number(3), 1.0 + 0.5 * number(4), number(5)),
        };
        let slopes = [2.0 * number(6), 2.0 * number(7)];
        let (n, d) = (p.normal(), p.displacement(slopes));
        let (length, bumped) = (n.norm(), n + d);
        let scale = length * bumped.norm();
        axis = axis.max((n.cross(&bumped) - p.axis(slopes) * length).norm() / scale);
        let tangent = n.cross(&bumped).norm() / n.dot(&bumped);
        angle = angle.max((tangent - d.norm() / length).abs() / (1.0 + tangent));
        right = right.max(d.dot(&n).abs() / scale);
    }
    let unit = Derivatives { u: Vec3::x(), v: Vec3::y() };
    let flat = unit.displacement([0.3, -0.7]) - Vec3::new(-0.3, 0.7, 0.0);
    let claim = |what: &str, paper: &str, here: f64| Claim::at_most(what, paper, 1e-12, here);
    vec![
        claim(
            "largest error of N × N′ = |N| (F_v P_u − F_u P_v), 2000 patches",
            "equal (§2)",
            axis,
        ),
        claim("largest error of tan θ = |D|/|N|", "equal (§2)", angle),
        claim("largest cosine between N and D", "N is perpendicular to D (§2)", right),
        claim("error of D on the flat unit patch", "D = (−F_u, −F_v, 0) (§4)", flat.norm()),
    ]
}

fn curved(u: f64, v: f64) -> Vec3 {
    let z = 0.4 * libm::sin(1.3 * u) * libm::cos(0.9 * v);
    Vec3::new(u + 0.1 * v * v, v - 0.2 * u * v, z)
}

fn plane(u: f64, v: f64) -> Vec3 {
    Vec3::new(u + 0.3 * v, 2.0 * v, 0.5 * u)
}

fn derivatives(p: impl Fn(f64, f64) -> Vec3, u: f64, v: f64, h: f64) -> Derivatives {
    let half = 0.5 / h;
    Derivatives { u: (p(u + h, v) - p(u - h, v)) * half, v: (p(u, v + h) - p(u, v - h)) * half }
}

/// Mean error of the unit normal on a patch under bumps `h` high and `length` long.
fn error(patch: fn(f64, f64) -> Vec3, h: f64, length: f64) -> f64 {
    let f = |u: f64, v: f64| h * libm::sin(u / length) * libm::cos(0.7 * v / length);
    let slopes = |u: f64, v: f64| {
        let ((s, c), (s2, c2)) = (libm::sincos(u / length), libm::sincos(0.7 * v / length));
        [h / length * c * c2, -0.7 * h / length * s * s2]
    };
    let of = |u: f64, v: f64| derivatives(patch, u, v, 1e-5);
    let moved = |u: f64, v: f64| patch(u, v) + of(u, v).normal().normalize() * f(u, v);
    const POINTS: usize = 3000;
    let off = |k: usize| {
        // The same points whatever the bumps: the golden ratio's relatives spread them evenly.
        let [u, v] = [0.754_877_666, 0.569_840_291].map(|a| a * (k + 1) as f64);
        let [u, v] = [u, v].map(|c| c - libm::floor(c));
        let p = of(u, v);
        let truth = derivatives(moved, u, v, 1e-4 * length).normal().normalize();
        ((p.normal() + p.displacement(slopes(u, v))).normalize() - truth).norm()
    };
    (0..POINTS).map(off).sum::<f64>() / POINTS as f64
}

/// Orders of the error: slopes kept, lengths kept, and that of the angle of the turn.
fn orders() -> [f64; 3] {
    let order = |error: &dyn Fn(f64) -> f64| libm::log10(error(1e-2) / error(1e-3));
    let kept = order(&|h| error(curved, h, h));
    let shape = order(&|h| error(curved, h, 0.1));
    // The angle is of the first power of the height.
    [kept, shape, shape - 1.0]
}

fn chart() -> Figure {
    let heights: Vec<f64> = (0..=8).map(|i| libm::exp10(-3.0 + 0.25 * f64::from(i))).collect();
    let series = |label: &str, of: &dyn Fn(f64) -> f64| Series {
        label: label.into(),
        points: heights.iter().map(|&h| [h, of(h)]).collect(),
        joined: true,
    };
    let chart = Chart {
        x: Axis::log("height of the bumps"),
        y: Axis::log("error of the unit normal"),
        series: vec![
            series("slopes kept", &|h| error(curved, h, h)),
            series("length kept", &|h| error(curved, h, 0.1)),
        ],
    };
    let caption =
        "N + D against the normal of the displaced surface P + F N/|N|, mean over a curved patch.";
    Figure::new("error", caption, Drawing::Chart(chart))
}

/// The curve of the diagrams, z(x) and its slope.
fn arch(x: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(1.1 * x);
    [0.45 * cos, -0.495 * sin]
}

/// The bump function of the diagrams and its derivative.
fn bump(x: f64) -> [f64; 2] {
    let ((s1, c1), (s2, c2)) = (libm::sincos(7.0 * x), libm::sincos(17.0 * x));
    [0.05 * s1 + 0.02 * c2, 0.35 * c1 - 0.34 * s2]
}

/// A section of the surface (x, y, z(x)) at x.
fn section(x: f64) -> Derivatives {
    Derivatives { u: Vec3::new(1.0, 0.0, arch(x)[1]), v: Vec3::y() }
}

fn mapping() -> Figure {
    let xs: Vec<f64> = (0..=240).map(|k| -1.2 + 0.01 * f64::from(k)).collect();
    let of = |f: &dyn Fn(f64) -> [f64; 2]| xs.iter().map(|&x| f(x)).collect();
    let ground = -0.45;
    let surface = |x: f64| [x, arch(x)[0]];
    let mapped = |x: f64| {
        let n = section(x).normal().normalize();
        [x + bump(x)[0] * n.x, arch(x)[0] + bump(x)[0] * n.z]
    };
    let mut strokes = vec![
        line(vec![[-1.2, ground], [1.2, ground]], 0),
        line(of(&|x| [x, ground + bump(x)[0]]), 2),
        line(of(&surface), 0),
        line(of(&mapped), 1),
    ];
    for (k, name) in [(0, "P"), (1, "P′ = P + F N/|N|"), (2, "F(u)")] {
        let end = [surface(1.2), mapped(1.2), [1.2, ground + bump(1.2)[0]]][k];
        let ink = [0, 1, 2][k];
        let label = named([end[0], end[1] + [-0.07, 0.07, 0.0][k]], name, ink);
        strokes.push(label);
    }
    // Room for the names.
    strokes.push(line(vec![[2.1, ground]], 0));
    let sketch = Sketch { label: "Figure 2: mapping a bump function".into(), strokes };
    let caption = "A bump function, and a section of a surface with it on, computed.";
    Figure::new("mapping", caption, Drawing::Sketches(vec![sketch]))
}

fn turned() -> Figure {
    let at = 0.42;
    let (p, [f, f_u]) = (section(at), bump(at));
    let flat = |v: Vec3| [v.x, v.z];
    let (n, d) = (p.normal(), p.displacement([f_u, 0.0]));
    let foot = [at, arch(at)[0]];
    let curve = |offset: f64| {
        (0..=60)
            .map(|k| 0.01 * f64::from(k) + at - 0.3)
            .map(move |x| [x, arch(x)[0] + offset])
            .collect()
    };
    let wrinkled = (0..=60).map(|k| 0.01 * f64::from(k) + at - 0.3).map(|x| {
        let n = section(x).normal().normalize();
        [x + (bump(x)[0] - f) * n.x, arch(x)[0] + (bump(x)[0] - f) * n.z]
    });
    let tip = [foot[0] + n.x, foot[1] + n.z];
    let perturbed = Sketch {
        label: "Figure 3: the perturbed normal".into(),
        strokes: vec![
            line(curve(0.0), 0),
            line(wrinkled.collect(), 1),
            arrow(foot, flat(n), "N", 0),
            arrow(foot, flat(d), "D", 2),
            arrow(foot, flat(n + d), "N′", 1),
        ],
    };
    let rotated = Sketch {
        label: "Figure 4: the rotated normal".into(),
        strokes: vec![
            arrow(foot, flat(n), "N", 0),
            arrow(tip, flat(d), "", 2),
            named([tip[0] + 0.4 * d.x, tip[1] + 0.4 * d.z + 0.04], "D", 2),
            arrow(foot, flat(n + d), "N′", 1),
            angle(foot, n, n + d),
        ],
    };
    let degrees = libm::atan2(d.norm(), n.norm()).to_degrees();
    let caption = format!(
        "N, D and N′ at a point of that section, and the right triangle they form: F_u = {f_u:.3}, tan θ = |D|/|N| = \
         {:.3}, θ = {degrees:.1}°.",
        d.norm() / n.norm()
    );
    Figure::new("normals", caption, Drawing::Sketches(vec![perturbed, rotated]))
}

/// A name alone: a stroke of one point.
fn named(at: [f64; 2], name: &str, ink: usize) -> Stroke {
    Stroke { name: name.into(), ..line(vec![at], ink) }
}

/// The arc between two directions, with its name.
fn angle(foot: [f64; 2], from: Vec3, to: Vec3) -> Stroke {
    let [a, b] = [from, to].map(|v| libm::atan2(v.z, v.x));
    let at = |k: i32| {
        let (sin, cos) = libm::sincos(a + (b - a) * f64::from(k) / 20.0);
        [foot[0] + 0.3 * cos, foot[1] + 0.3 * sin]
    };
    let mut arc = line((0..=20).map(at).collect(), 3);
    arc.name = "θ".into();
    arc
}
