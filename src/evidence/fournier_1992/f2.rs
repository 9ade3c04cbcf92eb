//! Figure 2: two normals that mirror each other, and what averaging makes of them.

use std::sync::Arc;

use crate::geometry::Vec3;
use crate::lobe::{BaseLobe, MultipleSurface};
use crate::method::{self, Prefiltered, Silent};
use crate::parameter::{Domain, Parameter};
use crate::texture::{Footprint, NormalMap, Wrap};

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Row, Series, Table, Task,
};

/// The row.
pub const ROW: Row = Row {
    name: "fournier-f2",
    title: "Two mirrored normals: averaging puts the highlight where the surface has none",
    parts: &[],
    parameters: &[
        Parameter {
            name: "tilt",
            meaning: "tilt of the two normals to either side, degrees",
            domain: Domain::Real { default: 30.0, min: 5.0, max: 80.0 },
        },
        Parameter {
            name: "exponent",
            meaning: "exponent of the base lobe",
            domain: Domain::Real { default: 50.0, min: 10.0, max: 1000.0 },
        },
    ],
    secs: 0.1,
    make,
};

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let (tilt, exponent) = (task.values.number("tilt"), task.values.number("exponent"));
    let base = BaseLobe::BlinnPhong { exponent };
    let (sin, cos) = libm::sincos(tilt.to_radians());
    let map = Arc::new(NormalMap::from_fn(2, 1, Wrap::Repeat, |u, _| {
        [if u < 0.5 { -sin } else { sin }, 0.0, cos, 1.0]
    }));
    let truth = |h: [f32; 3]| -> f64 {
        let of = |side: f64| {
            let n = Vec3::new(side * sin, 0.0, cos);
            let axis = [n.x, n.y, n.z].map(|c| c as f32);
            f64::from(crate::lobe::Spread::density(&base.about(axis, 1.0), h))
        };
        0.5 * (of(-1.0) + of(1.0))
    };
    let whole = Footprint::whole();
    let under = |name: &str| -> MultipleSurface {
        let method = method::build(name).expect("a method of the program's own");
        let prefiltered: Box<dyn Prefiltered> =
            method.prefilter(&map, &base, &Silent).expect("a map of two texels, a Phong lobe");
        prefiltered.lobes_at(&whole)
    };
    let (averaged, multiple) = (under("averaged"), under("fournier"));
    let half = |degrees: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        [sin as f32, 0.0, cos as f32]
    };
    let angles: Vec<f64> = (-90..=90).map(f64::from).collect();
    let curve = |label: &str, density: &dyn Fn([f32; 3]) -> f64| Series {
        label: label.into(),
        points: angles.iter().map(|&a| [a, density(half(a))]).collect(),
        joined: true,
    };
    let of = |surface: &MultipleSurface, h| f64::from(surface.density(h));
    let curves = vec![
        curve("both normals (truth)", &truth),
        curve("averaged normal", &|h| of(&averaged, h)),
        curve("multiple surface", &|h| of(&multiple, h)),
    ];
    let (at_zero, at_tilt) = (half(0.0), half(tilt));
    let mut table = Table::new(
        "densities",
        "Density of normals a steradian, half vector in the plane of the two normals.",
        &["half vector", "truth", "averaged normal", "multiple surface"],
    );
    for (what, h) in [("between the normals", at_zero), ("at one of the normals", at_tilt)] {
        let values = [truth(h), of(&averaged, h), of(&multiple, h)];
        table.push(std::iter::once(what.into()).chain(values.map(Into::into)).collect());
    }
    let worst = angles.iter().map(|&a| (of(&multiple, half(a)) - truth(half(a))).abs());
    let worst = worst.fold(0.0, f64::max) / truth(at_tilt);
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![
        Claim::shown(
            "averaged density between the normals, over the truth's there",
            "a highlight where the surface has none",
            of(&averaged, at_zero) / truth(at_zero),
            "above 2",
            of(&averaged, at_zero) > 2.0 * truth(at_zero),
        ),
        Claim::shown(
            "averaged density at a normal, over the truth's there",
            "no highlight where the surface has one",
            of(&averaged, at_tilt) / truth(at_tilt),
            "below 0.5",
            of(&averaged, at_tilt) < 0.5 * truth(at_tilt),
        ),
        Claim::at_most(
            "largest difference of the multiple surface from the truth, of the truth's maximum",
            "two normals alone are enough (§2.1)",
            1e-4,
            worst,
        ),
    ];
    exhibit.tables = vec![table];
    let caption = format!(
        "Density of normals against the half vector's tilt in the plane of two normals tilted by ±{tilt}°."
    );
    let chart = Chart {
        x: Axis::linear("tilt of the half vector, degrees"),
        y: Axis::linear("density a steradian"),
        series: curves,
    };
    exhibit.figures = vec![Figure::new("densities", caption, Drawing::Chart(chart))];
    Ok(exhibit)
}
