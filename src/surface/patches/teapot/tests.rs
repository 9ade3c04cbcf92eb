use super::*;
use crate::surface::Shape;

/// The published points again.
fn published(point: Vec3) -> Vec3 {
    point / SCALE + Vec3::z() * MIDDLE
}

/// Points of a fine grid of all patches, in published units.
fn points() -> impl Iterator<Item = Vec3> {
    let grid = (0..=40).flat_map(|i| (0..=40).map(move |j| [i, j].map(|k| f64::from(k) / 40.0)));
    let grid: Vec<[f64; 2]> = grid.collect();
    patches().into_iter().flat_map(move |Charted { patch, .. }| {
        grid.clone().into_iter().map(move |[u, v]| published(patch.at(u, v).point))
    })
}

#[test]
fn it_is_the_published_teapot() {
    let all = patches();
    assert_eq!(all.len(), 32);
    let (mut low, mut high) = (Vec3::zeros(), Vec3::zeros());
    for point in points() {
        (low, high) = (low.inf(&point), high.sup(&point));
    }
    // Its box: from the handle's furthest point, a patch's corner, to the spout's lip; the knob's top; the body.
    assert!((low - Vec3::new(-3.0, -2.0, 0.0)).amax() < 1e-9, "{low}");
    assert!((high - Vec3::new(3.434, 2.0, 3.15)).amax() < 2e-3, "{high}");
}

#[test]
fn it_is_symmetrical() {
    // Body, bottom and rim in x and y and both swapped; all of it in y.
    let all = &patches()[..24];
    for Charted { patch, .. } in all {
        for point in patch.points().iter().flatten() {
            let (x, y) = (point.x, point.y);
            let mirrored = |x: f64, y: f64| {
                let want = Vec3::new(x, y, point.z);
                let of = |p: &Vec3| (p - want).amax() < 1e-12;
                all.iter().any(|c| c.patch.points().iter().flatten().any(of))
            };
            assert!(mirrored(-x, y) && mirrored(x, -y) && mirrored(y, x));
        }
    }
}

#[test]
fn patches_meet_at_their_edges() {
    let all = patches();
    let joined = super::super::join::join(&all);
    for (k, (charted, joined)) in all.iter().zip(&joined).enumerate() {
        // Around, every patch has its neighbours.
        assert!(joined[0].is_some() && joined[1].is_some(), "patch {k}");
        for (edge, beyond) in joined.iter().enumerate() {
            let Some(beyond) = beyond else { continue };
            for along in [0.0, 0.2, 0.7, 1.0] {
                let end = (edge % 2) as f64;
                let [u, v] = if edge < 2 { [end, along] } else { [along, end] };
                let [s, t] = beyond.enter(0.0, along);
                let (here, there) = (charted.patch.at(u, v), all[beyond.patch].patch.at(s, t));
                assert!((here.point - there.point).norm() < 1e-12, "patch {k}, edge {edge}");
            }
        }
    }
    // Open edges: the rim's inside and the lid's edge; both ends of handle and spout; the poles.
    let open = joined.iter().flatten().filter(|beyond| beyond.is_none()).count();
    assert_eq!(open, 4 + 4 + 4 + 4 + 2 * 2 + 2 * 2);
}

#[test]
fn normals_point_out() {
    let all = patches();
    let normal = |patch: usize, u: f64, v: f64| all[patch].patch.tangents(u, v).normal;
    // The bottom's middle, the body's equator towards (1, −1), the rim, the knob's top.
    let aside = Vec3::new(1.0, -1.0, 0.0).normalize();
    for (patch, u, v, way) in [
        (0, 0.5, 0.0, -Vec3::z()),
        (8, 0.5, 0.0, aside),
        (12, 0.5, 0.5, Vec3::z()),
        (20, 0.5, 1.0, Vec3::z()),
        // The handle's outmost point, and the spout's lower side where it leaves the body.
        (24, 1.0, 1.0, -Vec3::x()),
        (28, 1.0, 0.0, -Vec3::z()),
    ] {
        assert!(normal(patch, u, v).dot(&way) > 0.9, "patch {patch}: {}", normal(patch, u, v));
    }
    // From there over every edge: nowhere is a patch inside out.
    for (k, joined) in super::super::join::join(&all).iter().enumerate() {
        for (edge, beyond) in joined.iter().enumerate() {
            let Some(beyond) = beyond else { continue };
            let end = (edge % 2) as f64;
            let [u, v] = if edge < 2 { [end, 0.4] } else { [0.4, end] };
            let [s, t] = beyond.enter(0.0, 0.4);
            let cosine = normal(k, u, v).dot(&normal(beyond.patch, s, t));
            assert!(cosine > 0.9, "patch {k}, edge {edge}: {cosine}");
        }
    }
}

#[test]
fn the_body_holds_what_it_holds() {
    // Its volume by the divergence theorem, ∮ P·n/3 over bottom and body and a flat lid at z = 2.4; against the
    // profile turned round, whose rings, cubics about the unit circle, have the area of a fine polygon.
    let steps = 200;
    let mut volume = 0.0;
    for Charted { patch, .. } in &patches()[..12] {
        for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
            let [u, v] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(steps));
            let at = patch.at(u, v);
            let area = at.along_u.cross(&at.along_v) / (SCALE * SCALE);
            volume += published(at.point).dot(&area) / 3.0 / f64::from(steps * steps);
        }
    }
    let ring: f64 = {
        let (n, k) = (20_000, 0.56);
        let p = |t: f64| {
            let s = 1.0 - t;
            let (b, c, d) = (3.0 * t * s * s, 3.0 * t * t * s, t * t * t);
            [s * s * s + b + k * c, k * b + c + d]
        };
        (0..n)
            .map(|i| {
                let (a, b) = (p(f64::from(i) / f64::from(n)), p(f64::from(i + 1) / f64::from(n)));
                2.0 * (a[0] * b[1] - a[1] * b[0])
            })
            .sum()
    };
    let lid = 2.4 / 3.0 * ring * 1.5 * 1.5;
    let profile: f64 = {
        let n = 4000;
        let patches = patches();
        [0, 4, 8]
            .iter()
            .flat_map(|&k| (0..n).map(move |i| (k, i)))
            .map(|(k, i)| {
                let at = |v: f64| published(patches[k].patch.at(0.0, v).point);
                let (a, b) = (at(f64::from(i) / f64::from(n)), at(f64::from(i + 1) / f64::from(n)));
                let radius = |p: Vec3| p.x.hypot(p.y);
                let middle = 0.5 * (radius(a) + radius(b));
                ring * middle * middle * (b.z - a.z)
            })
            .sum()
    };
    assert!((volume + lid - profile).abs() < 1e-3 * profile, "{volume} + {lid} {profile}");
}

#[test]
fn texture_coordinates_close_around_and_run_on_over_edges() {
    let all = patches();
    let joined = super::super::join::join(&all);
    let tiles = [2.3, 1.7];
    for (charted, joined) in all.iter().zip(&joined) {
        for (edge, beyond) in joined.iter().enumerate() {
            let Some(beyond) = beyond else { continue };
            let end = (edge % 2) as f64;
            let [u, v] = if edge < 2 { [end, 0.3] } else { [0.3, end] };
            let here = charted.chart.uv([u, v], tiles);
            let there = all[beyond.patch].chart.uv(beyond.enter(0.0, 0.3), tiles);
            let whole = here[0] - there[0];
            assert!((whole - whole.round()).abs() < 1e-9 && (here[1] - there[1]).abs() < 1e-9);
        }
    }
}

#[test]
fn as_a_mesh_it_has_about_as_many_triangles_as_kautz_tells_of() {
    let mesh = teapot_mesh(16);
    // 8 patches have a side that is a point: one triangle less in each of its cells.
    assert_eq!(mesh.triangles(), 32 * 2 * 16 * 16 - 8 * 16);
    let (patches, mesh) = (Shape::Patches(teapot()), Shape::Mesh(mesh));
    let mut seen = 0;
    for (i, j) in (0..30).flat_map(|i| (0..30).map(move |j| (i, j))) {
        let aim = Vec3::new(f64::from(i) / 15.0 - 1.0, 0.0, f64::from(j) / 20.0 - 0.75);
        let origin = Vec3::new(0.5, -4.0, 1.0);
        let (a, b) = (patches.trace(origin, aim - origin), mesh.trace(origin, aim - origin));
        assert_eq!(a.1, b.1);
        if a.1 {
            seen += 1;
            // The mesh is within its cells' chords of the patches; at a grazing ray t grows more.
            let grazing = (aim - origin).normalize().dot(&b.0.plane).abs();
            assert!((a.0.t - b.0.t).abs() < 1e-3 / grazing.max(0.02), "{} {}", a.0.t, b.0.t);
            assert!((a.0.uv[1] - b.0.uv[1]).abs() < 0.02 / grazing.max(0.05));
        }
    }
    assert!(seen > 150, "{seen}");
}
