//! Figure 5: distributions by projection of a Gaussian, from the centre and from the opposite pole.

use super::super::{
    Axis, Chart, Claim, Disc, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};
use super::densities::{Density, over_sphere};
use crate::geometry::{HemisphereGrid, Vec3};
use crate::lobe::BaseLobe;
use crate::parameter::{Domain, Parameter};

/// Width of the Gaussians.
const SIGMA: Parameter = Parameter {
    name: "sigma",
    meaning: "standard deviation of the Gaussian about its mean, radians",
    domain: Domain::Real { default: 0.6, min: 0.05, max: 1.0 },
};

/// The row.
pub const ROW: Row = Row {
    name: "olano-f5",
    title: "Gaussians projected onto the hemisphere and onto the sphere",
    parts: &[],
    parameters: &[SIGMA],
    secs: 1.0,
    make,
};

/// A direction in the plane y = 0, degrees from the pole.
pub fn at(degrees: f64) -> Vec3 {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    Vec3::new(sin, 0.0, cos)
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let sigma = task.values.number("sigma");
    let grid = HemisphereGrid::new(720, 8);
    let mut exhibit = ROW.exhibit();
    let below = |density: Density| {
        density.normalised(at(100.0), sigma) / density.normalised(at(0.0), sigma)
    };
    let [planar, stereographic] = [Density::Planar, Density::Stereographic].map(below);
    exhibit.claims.push(Claim::shown(
        "projected from the centre: density 100° from the mean, of its peak",
        "probability distributions over a hemisphere (§4)",
        planar,
        "0",
        planar == 0.0,
    ));
    exhibit.claims.push(Claim::shown(
        "projected from the opposite pole: density 100° from the mean, of its peak",
        "a Gaussian-like distribution, defined over the whole Gauss map (§4)",
        stereographic,
        "above 0",
        stereographic > 0.0,
    ));
    exhibit.claims.push(slopes(sigma));
    let mut table = Table::new(
        "integrals",
        "Integrals over the sphere: of the value of the Gaussian as the print has it, over that of a steradian's \
         share of the plane; and of that share.",
        &["distribution", "as printed", "with the area of a steradian"],
    );
    for density in Density::ALL {
        let peak = density.factor(Vec3::z(), sigma);
        table.push(vec![
            density.name().into(),
            (peak * over_sphere(&grid, |h| density.printed(h, sigma))).into(),
            over_sphere(&grid, |h| density.normalised(h, sigma)).into(),
        ]);
    }
    exhibit.tables.push(table);
    let (claim, mixtures) = mixtures(sigma);
    exhibit.claims.push(claim);
    exhibit.tables.push(mixtures);
    exhibit.remarks.push(
        "The text takes “the value of the Gaussian density function on the plane” for the density on the sphere. \
         A density a steradian has the plane's area a steradian as a factor too: 1/z³ from the centre, 1/(1 + z)² \
         from the opposite pole. Both are shown."
            .into(),
    );
    exhibit.figures = figures(sigma);
    Ok(exhibit)
}

/// "The density function for a Gaussian distribution of microfacet slopes can also be created by projection."
fn slopes(sigma: f64) -> Claim {
    let base = BaseLobe::Beckmann { alpha: sigma * std::f64::consts::SQRT_2 };
    let worst = (0..90).map(|degrees| {
        let h = at(f64::from(degrees));
        // Beckmann's D is a density of area; of normals seen from above it is D cos θ.
        let want = base.density((h.x * h.x) / (h.z * h.z)) * h.z;
        (Density::Planar.normalised(h, sigma) - want).abs() / base.density(0.0)
    });
    let worst = worst.fold(0.0, f64::max);
    let words = "a Gaussian distribution of slopes is a projected Gaussian (§4)";
    let what = "largest difference of the projection from a Gaussian in slopes, of the peak";
    Claim::at_most(what, words, 1e-6, worst)
}

/// The halves of a mixture lean this far to either side, degrees.
const LEANS: [f64; 3] = [15.0, 30.0, 60.0];

/// Two clusters mixed into one, by their moments on the stereographic plane and in space: the total
/// variation that is left, ½ ∫ |p − p′| dω over the sphere.
fn mixtures(sigma: f64) -> (Claim, Table) {
    let mut table = Table::new(
        "mixtures",
        "Two equal clusters to either side, each a restricted Gaussian, and the one distribution of the same \
         moments: ½ ∫ |p − p′| dω.",
        &[
            "lean to either side, degrees",
            "projected from the opposite pole",
            "3D Gaussian, restricted",
        ],
    );
    let mut worse = 0;
    for lean in LEANS {
        let [plane, space] = one_for_two(sigma, lean);
        worse += usize::from(plane > space);
        table.push(vec![lean.into(), plane.into(), space.into()]);
    }
    let claim = Claim::shown(
        format!("leans of {} at which one stereographic Gaussian is further from two than one in space", LEANS.len()),
        "combining two stereographic Gaussians gives no good approximation (§4)",
        worse,
        "all of them",
        worse == LEANS.len(),
    )
    .because(
        "the sphere's map from the opposite pole keeps angles, so a cluster stays nearly round on its plane wherever \
         it is, and moments taken there describe two clusters about as well as moments in space; what speaks against \
         them is that a cluster's own covariance there depends on where it is, and that they have no bound near \
         the opposite pole",
    );
    (claim, table)
}

fn one_for_two(sigma: f64, lean: f64) -> [f64; 2] {
    let grid = HemisphereGrid::new(180, 360);
    let v = sigma * sigma;
    let means = [at(lean), at(-lean)];
    let peak = Density::Restricted.factor(Vec3::z(), sigma);
    let two =
        |h: Vec3| means.iter().map(|m| 0.5 * peak * libm::exp((h.dot(m) - 1.0) / v)).sum::<f64>();
    let plane = |h: Vec3| [h.x / (1.0 + h.z), h.y / (1.0 + h.z)];
    let mean_of = |f: &dyn Fn(Vec3) -> f64| over_sphere(&grid, |h| two(h) * f(h));
    // By symmetry the mean on the plane is 0 and its axes are x and y. The far pole's neighbourhood is left out:
    // its moments on the plane do not exist.
    let seen = |h: Vec3| h.z > -0.9;
    let [xx, yy] =
        [0, 1].map(|c| mean_of(&|h| if seen(h) { plane(h)[c] * plane(h)[c] } else { 0.0 }));
    let flat = |h: Vec3| {
        let [x, y] = plane(h);
        let gauss = libm::exp(-0.5 * (x * x / xx + y * y / yy));
        gauss / (std::f64::consts::TAU * (xx * yy).sqrt() * (1.0 + h.z) * (1.0 + h.z))
    };
    // In space: mean of the clusters' 3D Gaussians and their second moments, as the paper mixes them.
    let (sin, cos) = libm::sincos(lean.to_radians());
    let restricted = |h: Vec3| {
        let q = h.x * h.x / (v + sin * sin) + h.y * h.y / v + (h.z - cos) * (h.z - cos) / v;
        libm::exp(-0.5 * q)
    };
    let whole = over_sphere(&grid, restricted);
    let apart = |p: &dyn Fn(Vec3) -> f64| 0.5 * over_sphere(&grid, |h| (two(h) - p(h)).abs());
    [apart(&|h| if h.z > -1.0 + 1e-9 { flat(h) } else { 0.0 }), apart(&|h| restricted(h) / whole)]
}

fn figures(sigma: f64) -> Vec<Figure> {
    let profile = |density: Density| Series {
        label: density.name().into(),
        points: (-180..=180)
            .step_by(2)
            .map(|a| [f64::from(a), density.normalised(at(f64::from(a)), sigma)])
            .collect(),
        joined: true,
    };
    let chart = Chart {
        x: Axis::linear("angle from the mean, degrees"),
        y: Axis::linear("density a steradian"),
        series: Density::ALL.map(profile).into(),
    };
    let fournier = HemisphereGrid::fournier();
    let disc = |density: Density| Disc {
        label: density.name().into(),
        remark: String::new(),
        density: fournier
            .samples()
            .iter()
            .map(|s| density.normalised(s.direction, sigma))
            .collect(),
        peaks: vec![],
        own_scale: false,
    };
    let caption = format!("Three round distributions of normals of width {sigma} about one mean.");
    vec![
        Figure::new("profiles", caption, Drawing::Chart(chart)),
        Figure::new(
            "hemispheres",
            "The same on the upper hemisphere, seen from above.",
            Drawing::Discs(Density::ALL.map(disc).into()),
        ),
    ]
}
