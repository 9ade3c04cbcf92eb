//! What holds on every surface.

use std::sync::LazyLock;

use super::*;
use proptest::prelude::*;

/// Those that are smooth but for the edges of their parts.
static SMOOTH: LazyLock<[Shape; 6]> = LazyLock::new(|| {
    [
        Shape::Plane(Plane::new()),
        Shape::Sphere(Sphere::new()),
        Shape::Cylinder(Cylinder::new()),
        Shape::Patches(bent_patch()),
        Shape::Patches(ribbon()),
        Shape::Patches(teapot()),
    ]
    .map(|s| s.tiled(1.7, 0.5))
});

static MESHES: LazyLock<[Shape; 3]> = LazyLock::new(|| {
    let ripples = crate::geometry::Ripples { count: 8, amplitude: 0.05 };
    [
        Shape::Mesh(drapery()),
        Shape::Mesh(teapot_mesh(4)),
        Shape::WavySphere(WavySphere::new(ripples, 5, WavyFrame::Vertex)),
    ]
    .map(|s| s.tiled(1.7, 0.5))
});

/// All of them.
fn every() -> impl Iterator<Item = &'static Shape> {
    SMOOTH.iter().chain(MESHES.iter())
}

fn unit(azimuth: f64, elevation: f64) -> Vec3 {
    crate::geometry::spherical_frame(azimuth, elevation).normal
}

/// All numbers of a hit, and of the footprint of a step.
fn numbers(hit: &Hit, direction: Vec3) -> Vec<f64> {
    let step = Vec3::new(0.01, -0.02, 0.005);
    let moved = displacement(direction, step, hit.t, hit.plane);
    let Frame { tangent, bitangent, normal } = hit.frame;
    let vectors =
        [hit.point, tangent, bitangent, normal, hit.plane, hit.gradient[0], hit.gradient[1], moved];
    vectors.iter().flat_map(|v| v.iter().copied()).chain([hit.t, hit.uv[0], hit.uv[1]]).collect()
}

/// Whether all around a hit, a hundredth of a unit of direction away, the same smooth part goes on.
fn surrounded(surface: &Shape, origin: Vec3, direction: Vec3, hit: &Hit) -> bool {
    let sides = Frame::about(direction.normalize());
    (0..8).all(|k| {
        let (s, c) = (std::f64::consts::FRAC_PI_4 * f64::from(k)).sin_cos();
        let aside =
            surface.intersect(origin, direction + (sides.tangent * c + sides.bitangent * s) * 0.01);
        aside.is_some_and(|aside| {
            aside.plane.dot(&hit.plane) > 0.95 && (aside.point - hit.point).norm() < 0.2
        })
    })
}

/// Whether a hit's frame is orthonormal, turns as `handed` says, and follows u and v.
fn framed(hit: &Hit, handed: f64) -> bool {
    let Frame { tangent, bitangent, normal } = hit.frame;
    (tangent.cross(&bitangent) * handed - normal).norm() < 1e-9
        && (normal.norm() - 1.0).abs() < 1e-9
        && hit.gradient[0].dot(&tangent) * handed >= 0.0
        && hit.gradient[1].dot(&bitangent) * handed >= 0.0
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn differentials_match_finite_differences(
        azimuth in 0.0f64..6.2, elevation in 0.05f64..1.5, aim in [-0.9f64..0.9, -0.9f64..0.9, -0.4f64..0.4]
    ) {
        let origin = unit(azimuth, elevation) * 4.0;
        let step = Vec3::new(0.3, -0.2, 0.1);
        for surface in SMOOTH.iter() {
            let aim = if matches!(surface, Shape::Plane(_)) { Vec3::new(aim[0], aim[1], 0.0) } else { aim.into() };
            let direction = aim - origin;
            let h = 1e-6;
            let both = surface.intersect(origin, direction).zip(surface.intersect(origin, direction + step * h));
            let Some((hit, near)) = both else { continue };
            let cosine = direction.normalize().dot(&hit.plane).abs();
            let moved = displacement(direction, step, hit.t, hit.plane);
            let exact = (near.point - hit.point) / h;
            // Within a chord of an open edge the mesh stands in; and a step may lead over to another part.
            if cosine < 0.1 || !surrounded(surface, origin, direction, &hit) {
                continue;
            }
            // The second order grows as curvature over the cube of the cosine.
            prop_assert!((moved - exact).norm() < 1e-3 * exact.norm().max(1.0), "{moved} {exact}");
            for c in 0..2 {
                let d = (near.uv[c] - hit.uv[c]) / h;
                // The seam of a closed surface is a jump of whole tiles, a pole one of its own.
                if d.abs() < 1e3 {
                    let linear = hit.gradient[c].dot(&moved);
                    prop_assert!((linear - d).abs() < 2e-3 * d.abs().max(1.0), "{c}: {linear} {d}");
                }
            }
        }
    }

    #[test]
    fn points_lie_on_their_rays(azimuth in 0.0f64..6.2, elevation in -1.5f64..1.5, aim in [-0.9f64..0.9, -0.9f64..0.9, -0.5f64..0.5]) {
        let origin = unit(azimuth, elevation) * 5.0;
        let direction = Vec3::from(aim) - origin;
        for surface in every() {
            if let Some(hit) = surface.intersect(origin, direction) {
                prop_assert!((origin + direction * hit.t - hit.point).norm() < 1e-9);
            }
        }
    }

    #[test]
    fn all_is_finite_and_framed_from_anywhere(azimuth in 0.0f64..6.2, elevation in -1.57f64..1.57, aim in [-1.1f64..1.1, -1.1f64..1.1, -1.1f64..1.1]) {
        let origin = unit(azimuth, elevation) * 3.0;
        for (k, surface) in every().enumerate() {
            // At it, past it, along an axis, and through the poles.
            let aims = [Vec3::from(aim), Vec3::new(0.0, 0.0, aim[2]), Vec3::zeros()];
            for direction in aims.map(|aim| aim - origin) {
                check(k, surface, origin, direction)?;
            }
            for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
                check(k, surface, axis * 3.0, -axis)?;
                check(k, surface, Vec3::from(aim) + axis * 3.0, -axis)?;
            }
        }
    }
}

fn check(k: usize, surface: &Shape, origin: Vec3, direction: Vec3) -> Result<(), TestCaseError> {
    let (hit, hits) = surface.trace(origin, direction);
    let all = numbers(&hit, direction);
    prop_assert!(all.iter().all(|x| x.is_finite()), "surface {k}: {hit:?} of {origin} {direction}");
    if hits {
        // Seen from behind, all three turn about.
        let front = framed(&hit, 1.0);
        let open = matches!(surface, Shape::Cylinder(_) | Shape::Patches(_));
        prop_assert!(
            front || open && framed(&hit, -1.0),
            "surface {k}: {hit:?} of {origin} {direction}"
        );
    }
    Ok(())
}

/// Silhouettes: rays nearer and nearer to passing by, found by halving.
#[test]
fn silhouettes_are_finite() {
    for (k, surface) in every().enumerate() {
        for turn in 0..24 {
            let origin = unit(0.26 * f64::from(turn), 0.4 * f64::from(turn % 5 - 2)) * 4.0;
            let side = origin.cross(&Vec3::z()).normalize();
            let at = |x: f64| side * x + Vec3::z() * 0.1 - origin;
            let (mut inside, mut outside) = (0.0, 2.0);
            for _ in 0..60 {
                let middle = 0.5 * (inside + outside);
                let (hit, hits) = surface.trace(origin, at(middle));
                assert!(numbers(&hit, at(middle)).iter().all(|x| x.is_finite()), "{k}: {hit:?}");
                if hits { inside = middle } else { outside = middle }
            }
        }
    }
}
