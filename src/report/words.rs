//! How it was measured, in words: formulas of shadings and metrics.

/// What a shading computes, in symbols.
pub fn shading_formula(shading: &str) -> &'static str {
    match shading {
        "ndf" => {
            "L = E · D(h): irradiance E = max(0, n·l) · (light) times the density D of the multiple surface at the half vector h"
        }
        "microfacet" => {
            "L = E · D(h) · G(l, v) / (4 (n·l) (n·v)): D at the half vector, with shadowing and masking G"
        }
        _ => "as described by the program that wrote the results",
    }
}

/// What a metric is, by its name in `metrics.csv`. A is the image, R the reference, mean over pixels.
pub fn metric_formula(metric: &str) -> Option<&'static str> {
    Some(match metric {
        "rmse" => "√ mean (A − R)²: root mean square error of linear radiance",
        "mae" => "mean |A − R|: mean absolute error of linear radiance",
        "relmse" => {
            "mean (A − R)² / (R² + ε): squared error relative to the reference, ε keeps dark pixels finite"
        }
        "ssim" => {
            "structural similarity of the tone-mapped images (Wang et al. 2004), 1 for equal images"
        }
        "bias" => "mean (A − R): whether the image is too bright (above 0) or too dark",
        "energy" => "Σ A / Σ R: the share of the reference's light that the image holds",
        "ndf_l1" => {
            "½ ∫ |D − D_true| cos θ dω: 0 for equal distributions of normals, 1 for disjoint ones"
        }
        _ => return None,
    })
}
