//! How it was measured, in words and symbols.

use crate::metric;

/// What a shading computes, in symbols; radiance is for the multiple surface of density D.
pub fn shading_formula(shading: &str) -> &'static str {
    match shading {
        "ndf" => {
            "radiance Σ E · D(h), the sum over lobes; E the irradiance on a plane facing the light, h the half vector"
        }
        "microfacet" => {
            "radiance Σ E · D(h) · G₁(l) G₁(v) / (4 n·v), the sum over lobes; E the irradiance on a plane facing the light, \
             l, v and h the directions to light and eye and their half vector, n the lobe’s axis, G₁ Smith’s shadowing"
        }
        "phong" => {
            "radiance Σ E · D(h′), the sum over lobes; E the irradiance on a plane facing the light, h′ beside the lobe’s \
             axis at the angle whose cosine is (r·v)^¼, r the mirrored direction: of a base lobe of exponent s, (r·v)^(s/4)"
        }
        "torrance-sparrow" => {
            "radiance Σ E · D(h) · G F / (4 n·v), the sum over lobes; E the irradiance on a plane facing the light, l, v and \
             h the directions to light and eye and their half vector, n the lobe’s axis, G = min(1, 2 (n·h)(n·v)/(v·h), \
             2 (n·h)(n·l)/(v·h)) of V-shaped grooves, F Fresnel’s for the material’s index, or 1 (Blinn 1977)"
        }
        _ => "as its program computes it",
    }
}

/// How to read a figure of distributions of normals.
pub const DISTRIBUTIONS: &str = "A distribution of normals is shown on the hemisphere seen from above, x to the right, y \
    up. Colour is the square root of density, on the scale of the true distribution; what exceeds its greatest density \
    is yellow. Rings mark the axes of lobes. The distance is ½ ∫ |D − D_true| cos θ dω: 0 for equal distributions, 1 for \
    disjoint ones, more where energy is not kept.";

/// The same for distributions with no true one among them.
pub const DISTRIBUTIONS_ALONE: &str = "Distributions of normals on the hemisphere seen from above, x to the right, y up. \
    Colour is the square root of density; differences, which may be negative, are blue below 0 and orange above, in \
    proportion. Rings mark peaks; those below the horizon stand at the edge.";

/// What a metric of `metrics.csv` is: its meaning and formula, with its constants.
pub fn metric_formula(name: &str) -> Option<String> {
    if name == "ndf_l1" {
        return Some(
            "distance of distributions of normals, 0 for equal and 1 for disjoint ones: ½ ∫ |D − D_true| cos θ dω"
                .into(),
        );
    }
    if name == "ndf_kl" {
        return Some(
            "what is lost by a method's distribution of normals, nats, 0 for equal ones: ∫ p ln (p / q) of the normalised true \
             distribution p and the method's q, a millionth of which is spread evenly"
                .into(),
        );
    }
    if name == "ndf_wasserstein" {
        return Some(
            "how far a method's distribution of normals would have to be moved, in the disc of their x and y: the sliced \
             Wasserstein-1 distance times π/2, which is the shift of a shifted lobe"
                .into(),
        );
    }
    metric::find(name).map(|metric| format!("{}: {}", metric.meaning, metric.formula))
}

/// Whether a higher value is better.
pub fn better(name: &str) -> Option<&'static str> {
    use metric::Best;
    metric::find(name).map(|metric| match metric.best {
        Best::Lowest => "lower is better",
        Best::Highest => "higher is better",
        Best::One => "1 is best",
    })
}
