//! Appendix A: the modified Blinn-Phong model.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::super::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Images, Panel, Row, Series, Table, Task,
};
use super::pyramids::{Covariance, distance, factor, principal};
use crate::experiment::results::SceneResult;
use crate::lobe::{Contour, Fall, PedalLobe, Spread};

/// The row.
pub const ROW: Row = Row {
    name: "schilling-a",
    title: "The modified Blinn-Phong model: isotropic and anisotropic, as printed and exactly elliptical",
    parts: &["highlights"],
    parameters: &[],
    secs: 0.5,
    make,
};

/// Exponent of the lobes whose contours are drawn.
const EXPONENT: f32 = 100.0;
/// Standard deviations 2 and 1, the long axis at 45°.
const CORRELATED: Covariance = [2.5, 1.5, 2.5];

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = ROW.exhibit();
    exhibit.claims = vec![simplified(), sides(), widest(Form::Deviation), widest(Form::Literal)];
    let (table, claim) = pedal();
    exhibit.claims.push(claim);
    exhibit.tables = vec![table];
    exhibit.figures = vec![contours()];
    let mut errors = Table::new(
        "errors",
        "Error of each form at one sample a pixel against the converged image.",
        &["scene", "form", "RMSE", "part of unfiltered's", "light kept", "SSIM"],
    );
    for scene in &task.part("highlights").results.scenes {
        task.go_on()?;
        one(scene, &mut errors, &mut exhibit);
    }
    exhibit.tables.push(errors);
    exhibit.remarks = vec![
        "With an exponent m the lobe's variance is that of K over m: K here is m times the slopes' covariance with the \
         base lobe's own, so that roughness has the same meaning for every m. K = 0 would give α′ = 90° everywhere."
            .into(),
        "The model is not normalised: a highlight is as bright at its middle however rough the surface. The forms \
         without “printed” put the same covariance into a lobe of unit integral."
            .into(),
    ];
    Ok(exhibit)
}

/// How q in cos²α′ = cos²α / (d⁴/q + cos²α) is read.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// q = |Dᵀ d|².
    Deviation,
    /// q = |D d|², as printed.
    Literal,
    /// q = d⁴/|D⁻¹ d|².
    Elliptical,
}

impl Form {
    const ALL: [Self; 3] = [Self::Deviation, Self::Literal, Self::Elliptical];

    fn name(self) -> &'static str {
        match self {
            Self::Deviation => "q = |Dᵀd|²",
            Self::Literal => "q = |Dd|², as printed",
            Self::Elliptical => "exactly elliptical",
        }
    }

    /// The lobe of a roughness in units where the identity changes nothing.
    fn lobe(self, k: Covariance) -> PedalLobe {
        let [d1, d2, d3] = factor(k);
        let (q, contour) = match self {
            Self::Deviation => (k, Contour::Pedal),
            Self::Literal => ([d1 * d1, d1 * d2, d2 * d2 + d3 * d3], Contour::Pedal),
            Self::Elliptical => (k, Contour::Ellipse),
        };
        let covariance = q.map(|entry| entry as f32 / EXPONENT);
        PedalLobe::new(
            [0.0, 0.0, 1.0],
            covariance,
            1.0,
            contour,
            Fall::Power { exponent: EXPONENT },
        )
    }

    /// Tangent of the angle at which the lobe has fallen to a half, in the direction `angle`.
    fn radius(self, k: Covariance, angle: f64) -> f64 {
        let (lobe, (sin, cos)) = (self.lobe(k), libm::sincos(angle));
        let bright = |r: f64| {
            let half = [r * cos, r * sin, 1.0];
            let length = (1.0 + r * r).sqrt();
            lobe.density(half.map(|c| (c / length) as f32)) > 0.5
        };
        let (mut near, mut far) = (0.0, 10.0);
        for _ in 0..40 {
            let middle = 0.5 * (near + far);
            if bright(middle) { near = middle } else { far = middle }
        }
        far
    }
}

/// Tangent of the angle at which a lobe with K the identity has fallen to a half: cosᵐ α = ½.
fn plain_radius() -> f64 {
    (libm::exp2(2.0 / f64::from(EXPONENT)) - 1.0).sqrt()
}

/// cos²α′ = σ²cos²α / (1 − cos²α + σ²cos²α) against the general form with D = σ I.
fn simplified() -> Claim {
    let mut worst = 0.0f64;
    for sigma in [0.5, 1.0, 2.0, 5.0] {
        for step in 0..90 {
            let (sin, cos) = libm::sincos(f64::from(step).to_radians());
            let square = cos * cos;
            let primed = sigma * sigma * square / (1.0 - square + sigma * sigma * square);
            let want = libm::pow(primed, 0.5 * f64::from(EXPONENT));
            let lobe = Form::Deviation.lobe([sigma * sigma, 0.0, sigma * sigma]);
            let (s, c) = libm::sincos(0.7);
            let got = f64::from(lobe.density([sin * c, sin * s, cos].map(|x| x as f32)));
            worst = worst.max((got - want).abs());
        }
    }
    Claim::at_most(
        "largest difference of the simplified isotropic formula from the general one",
        "if only isotropic roughness information is used, the formula can be simplified",
        1e-4,
        worst,
    )
}

/// "We get α′ < α if the variance of n in the regarded direction is larger than 1, otherwise α′ ≥ α."
fn sides() -> Claim {
    let k = [2.0, 0.3, 0.5];
    let wrong = (0..360).filter(|degrees| {
        let angle = f64::from(*degrees).to_radians();
        let (sin, cos) = libm::sincos(angle);
        let variance = k[0] * cos * cos + 2.0 * k[1] * cos * sin + k[2] * sin * sin;
        let wider = Form::Deviation.radius(k, angle) > plain_radius();
        // Within the rounding of single precision the two sides cannot be told.
        (variance - 1.0).abs() > 1e-4 && wider != (variance > 1.0)
    });
    Claim::count(
        "directions of 360 in which α′ < α without a variance above 1, or the other way round",
        0,
        wrong.count(),
    )
}

/// The direction a form is widest in, held to the long axis of K.
fn widest(form: Form) -> Claim {
    let degrees = (0..1800).map(|tenth| f64::from(tenth) / 10.0);
    let along = degrees.map(|d| (form.radius(CORRELATED, d.to_radians()), d));
    let (_, angle) = along.fold((0.0, 0.0), |best, here| if here.0 > best.0 { here } else { best });
    let truth = principal(CORRELATED)[2].to_degrees();
    Claim::near(
        format!(
            "direction in which the lobe is widest, degrees, K = (2.5 1.5; 1.5 2.5), {}",
            form.name()
        ),
        truth,
        angle,
        0.02,
    )
    .because(
        "D Dᵀ = K, so |Dᵀd|² is the variance in direction d; |Dd|² belongs to another matrix, DᵀD",
    )
}

/// How much wider than the ellipse the contours are.
fn pedal() -> (Table, Claim) {
    let head =
        ["σ₁/σ₂", "q = |Dᵀd|²: widest over the ellipse", "(r + 1/r)/2", "exactly elliptical"];
    let caption =
        "Largest ratio, over all directions, of the lobe's half width to that of the ellipse of K.";
    let mut table = Table::new("pedal", caption, &head);
    let mut most = 0.0f64;
    for ratio in [1.0, 2.0, 4.0, 8.0] {
        let k = [ratio * ratio, 0.0, 1.0];
        let worst = |form: Form| {
            let over = |degrees: u32| {
                let angle = f64::from(degrees).to_radians();
                let (sin, cos) = libm::sincos(angle);
                form.radius(k, angle) / plain_radius() * distance(k, [cos, sin]).sqrt()
            };
            (0..180).map(over).fold(0.0, f64::max)
        };
        let found = worst(Form::Deviation);
        most = most.max(found);
        table.push(vec![
            ratio.into(),
            found.into(),
            (0.5 * (ratio + 1.0 / ratio)).into(),
            worst(Form::Elliptical).into(),
        ]);
    }
    let claim = Claim::shown(
        "width of the lobe over that of the ellipse of the roughness, at most, for σ₁/σ₂ up to 8",
        "an elliptical cone, characterized by three parameters",
        most,
        "at most 1.01",
        most <= 1.01,
    )
    .because("the deviations in all directions make a pedal curve, which meets its ellipse on the axes alone; the exactly \
              elliptical form does not differ");
    (table, claim)
}

fn contours() -> Figure {
    let curve = |label: &str, radius: &dyn Fn(f64) -> f64| {
        let point = |i: u32| {
            let angle = TAU * f64::from(i) / 180.0;
            let (sin, cos) = libm::sincos(angle);
            [radius(angle) * cos, radius(angle) * sin]
        };
        Series { label: label.into(), points: (0..=180).map(point).collect(), joined: true }
    };
    let mut series = Vec::new();
    for form in Form::ALL {
        series.push(curve(form.name(), &|angle| form.radius(CORRELATED, angle)));
    }
    series.push(curve("without roughness (K = I)", &|_| plain_radius()));
    let chart = Chart {
        x: Axis::linear("slope of the half vector along u"),
        y: Axis::linear("slope along v"),
        series,
    };
    let caption = format!(
        "Contours at half brightness for K = (2.5 1.5; 1.5 2.5), exponent {EXPONENT}: standard deviations 2 along 45° and \
         1 across."
    );
    Figure::new("contours", caption, Drawing::Chart(chart))
}

/// The forms that are shown, by their labels in the sweep.
const SHOWN: [(&str, &str); 8] = [
    ("unfiltered", "no antialiasing"),
    ("isotropic-printed", "isotropic, as printed"),
    ("literal", "anisotropic, as printed: |Dd|²"),
    ("deviation", "anisotropic, |Dᵀd|²"),
    ("elliptical", "anisotropic, exactly elliptical"),
    ("gaussian", "elliptical, exp(−½ tan²α′)"),
    ("schilling-isotropic", "isotropic, normalised"),
    ("schilling-anisotropic", "anisotropic, normalised"),
];

fn one(scene: &SceneResult, table: &mut Table, exhibit: &mut Exhibit) {
    let at = format!("{} at {} texels a pixel", scene.key.texture, scene.key.texels_per_pixel);
    let name = format!("{}-converged", scene.slug);
    let converged = Panel::new(&name, "converged", Arc::clone(&scene.reference.film));
    let mut panels = vec![converged];
    let error = |method: &str| {
        let trial = scene.trials.iter().find(|t| t.method == method && t.spp == 1)?;
        trial.score("rmse")
    };
    let first = error(SHOWN[0].0).unwrap_or(f64::NAN);
    for (method, form) in SHOWN {
        let Some(trial) = scene.trials.iter().find(|t| t.method == method && t.spp == 1) else {
            continue;
        };
        let score = |name: &str| trial.score(name).unwrap_or(f64::NAN);
        let rmse = score("rmse");
        table.push(vec![
            at.clone().into(),
            form.into(),
            rmse.into(),
            (rmse / first).into(),
            score("energy").into(),
            score("ssim").into(),
        ]);
        let panel = Panel::new(&format!("{}-{method}", scene.slug), form, Arc::clone(&trial.film));
        panels.push(panel.remarked(format!("RMSE {rmse:.3}")));
    }
    let images = Images { panels, white: None, reference: Some(0), across: 3 };
    exhibit.figures.push(Figure::new(
        &scene.slug,
        format!("Highlights: {at}."),
        Drawing::Images(images),
    ));
    let [Some(isotropic), Some(printed), Some(normalised)] =
        ["isotropic-printed", "deviation", "schilling-anisotropic"].map(error)
    else {
        return;
    };
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE of the anisotropic model, of the isotropic one's, as printed, {at}"),
            "a cheap, isotropic and a more expensive anisotropic version",
            printed / isotropic,
            "below 1",
            printed < isotropic,
        )
        .because(
            "both are too bright where the surface is rough, the wider lobe over a larger area",
        ),
    );
    exhibit.claims.push(
        Claim::shown(
            format!("RMSE of the anisotropic model as printed, of the normalised one's, {at}"),
            "the size of the highlight is controlled entirely by the roughness",
            printed / normalised,
            "at most 1.1",
            printed <= 1.1 * normalised,
        )
        .because("the size is, but the brightness is not: the printed model is not normalised"),
    );
}
