//! Figure 6 and *The calculation of the covariance matrix*: the ellipse of a footprint's perturbation vectors.

use std::f64::consts::TAU;

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use super::pyramids::{Cell, Level, bumps, direct, distance, principal, vectors};
use crate::parameter::Value;

/// The row.
pub const ROW: Row = Row {
    name: "schilling-f6",
    title: "The ellipse of a footprint's perturbation vectors, and the share of them inside",
    parts: &[],
    parameters: &[],
    secs: 0.2,
    make,
};

const SIDE: usize = 256;
/// Most vectors of a footprint that are drawn.
const DRAWN: usize = 700;

/// What the vectors of a footprint are, and how they are spread.
struct Footprint {
    name: &'static str,
    vectors: Vec<[f64; 2]>,
    whole: Cell,
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = ROW.exhibit();
    let normal =
        [("slope_variance_u", 0.09), ("slope_variance_v", 0.02), ("correlation_length", 3.0)];
    let normal = normal.map(|(name, value)| (name, Value::Number(value)));
    let mut all = vec![
        Footprint::of(
            "normal (the pattern gaussian)",
            mixed(vectors(&bumps("gaussian", SIDE, &normal, task.seed).normals)),
        ),
        Footprint::of("equal in a rectangle", rectangle()),
    ];
    for name in ["waves", "corrugated", "brushed", "bricks"] {
        task.go_on()?;
        all.push(Footprint::of(name, vectors(&bumps(name, SIDE, &[], task.seed).normals)));
    }
    let head = ["distribution", "share with xᵀK⁻¹x ≤ 1", "share with xᵀK⁻¹x ≤ 2", "σ₁", "σ₂"];
    let mut table =
        Table::new("shares", "Shares of a footprint's vectors inside two ellipses.", &head);
    for footprint in &all {
        let [most, least, _] = principal(footprint.whole.roughness);
        table.push(vec![
            footprint.name.into(),
            footprint.share(1.0).into(),
            footprint.share(2.0).into(),
            most.sqrt().into(),
            least.sqrt().into(),
        ]);
    }
    let closed = |q: f64| 1.0 - libm::exp(-0.5 * q);
    table.push(vec![
        "normal, in closed form".into(),
        closed(1.0).into(),
        closed(2.0).into(),
        "".into(),
        "".into(),
    ]);
    let axis = |variance: f64, edge: f64| 2.0 * variance.sqrt() / edge;
    let [long, short, _] = principal(all[1].whole.roughness);
    exhibit.claims = vec![
        Claim::near(
            "share of normally distributed vectors inside the ellipse xᵀK⁻¹x = 1",
            0.63,
            all[0].share(1.0),
            0.1,
        )
        .because("of a normal distribution in two dimensions 1 − e^(−1/2) = 39.3 % are inside; 63.2 % are inside \
                  xᵀK⁻¹x = 2: see the table"),
        Claim::near(
            "long main axis of the ellipse of vectors equally distributed in a rectangle, parts of its long edge",
            2.0 / 3f64.sqrt(),
            axis(long, EDGES[0]),
            0.01,
        )
        .because("the standard deviation is a/(2√3), so the ellipse is a/√3 long: the print's 2a/√3 belongs to \
                  edges of 2a"),
        Claim::near(
            "its short main axis, parts of the short edge",
            2.0 / 3f64.sqrt(),
            axis(short, EDGES[1]),
            0.01,
        )
        .because("as above"),
        farthest(&all[0]),
    ];
    exhibit.tables = vec![table];
    exhibit.figures = all[..3].iter().map(Footprint::drawn).collect();
    exhibit.remarks = vec![
        "The drawing of the reflected beam is not repeated; what it shows, the ellipse of a footprint's vectors, is \
         drawn from real ones."
            .into(),
    ];
    Ok(exhibit)
}

/// "The distance of a point x on the ellipse to the average vector x̄ represents the standard deviation in the
/// direction (x − x̄)": how far from true that is.
fn farthest(normal: &Footprint) -> Claim {
    let k = normal.whole.roughness;
    let ratio = |i: u32| {
        let (sin, cos) = libm::sincos(TAU * f64::from(i) / 360.0);
        let on_ellipse = 1.0 / distance(k, [cos, sin]).sqrt();
        let deviation = (k[0] * cos * cos + 2.0 * k[1] * cos * sin + k[2] * sin * sin).sqrt();
        deviation / on_ellipse
    };
    let most = (0..360).map(ratio).fold(0.0, f64::max);
    Claim::shown(
        "standard deviation in a direction over the ellipse's radius there, at most",
        "the distance of a point on the ellipse to the average vector represents the standard deviation in its \
         direction",
        most,
        "below 1.01",
        most < 1.01,
    )
    .because("it does along the axes alone; between them the deviations make a pedal curve, which is wider than the \
              ellipse")
}

/// Edges of the rectangle.
const EDGES: [f64; 2] = [0.6, 0.2];

/// Vectors equally distributed in a rectangle, in the middles of equal cells.
fn rectangle() -> Level {
    let place = |i: usize, edge: f64| ((i as f64 + 0.5) / SIDE as f64 - 0.5) * edge;
    let cell = |at: usize| Cell {
        mean: [place(at % SIDE, EDGES[0]), place(at / SIDE, EDGES[1])],
        ..Cell::default()
    };
    Level { side: SIDE, cells: (0..SIDE * SIDE).map(cell).collect() }
}

/// The vectors turned by 30°, so that f_u and f_v are correlated.
fn mixed(mut level: Level) -> Level {
    let (sin, cos) = libm::sincos(std::f64::consts::FRAC_PI_6);
    for cell in &mut level.cells {
        let [x, y] = cell.mean;
        cell.mean = [cos * x - sin * y, sin * x + cos * y];
    }
    level
}

impl Footprint {
    fn of(name: &'static str, bottom: Level) -> Self {
        let whole = direct(&bottom, bottom.side.ilog2() as usize).cells[0];
        Self { name, vectors: bottom.cells.iter().map(|cell| cell.mean).collect(), whole }
    }

    /// The share of vectors with xᵀK⁻¹x ≤ `q`.
    fn share(&self, q: f64) -> f64 {
        let Cell { mean: [x, y], roughness } = self.whole;
        let inside = |v: &&[f64; 2]| distance(roughness, [v[0] - x, v[1] - y]) <= q;
        self.vectors.iter().filter(inside).count() as f64 / self.vectors.len() as f64
    }

    fn drawn(&self) -> Figure {
        // Multiples of the golden ratio, folded: spread over the rows and columns of any map.
        let pick = |i: usize| {
            let share = i as f64 * 0.618_033_988_749_894_9;
            self.vectors[((share - share.floor()) * self.vectors.len() as f64) as usize]
        };
        let cloud = (0..DRAWN.min(self.vectors.len())).map(pick).collect();
        let series = vec![
            Series { label: "perturbation vectors".into(), points: cloud, joined: false },
            self.ellipse("ellipse of K", 1.0),
            self.ellipse("√2 times as wide", 2.0),
        ];
        let chart = Chart { x: Axis::linear("f_u"), y: Axis::linear("f_v"), series };
        let caption = format!(
            "Perturbation vectors of a footprint, {}, and the ellipses xᵀK⁻¹x = 1 and 2 of their covariance: {:.1} % \
             and {:.1} % are inside.",
            self.name,
            100.0 * self.share(1.0),
            100.0 * self.share(2.0),
        );
        let name: String = self.name.chars().take_while(|c| c.is_ascii_alphabetic()).collect();
        Figure::new(&name, caption, Drawing::Chart(chart))
    }

    fn ellipse(&self, label: &str, q: f64) -> Series {
        let Cell { mean, roughness } = self.whole;
        let [most, least, angle] = principal(roughness);
        let (sin, cos) = libm::sincos(angle);
        let point = |i: u32| {
            let (s, c) = libm::sincos(TAU * f64::from(i) / 120.0);
            let [x, y] = [(q * most).sqrt() * c, (q * least).sqrt() * s];
            [mean[0] + cos * x - sin * y, mean[1] + sin * x + cos * y]
        };
        Series { label: label.into(), points: (0..=120).map(point).collect(), joined: true }
    }
}
