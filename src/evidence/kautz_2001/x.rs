//! §7: bumps that are there already, as indices and back, with detail on top; their own NDF used to shade them.

use std::sync::Arc;

use super::common::{isotropic, maps, pictures, shot, view};
use crate::evidence::trials::{rmse, trials};
use crate::evidence::{Claim, Exhibit, FinishedPart, Halted, Panel, Row, Table, Task};
use crate::lobe::{BaseLobe, NdfImage};
use crate::method::{Silent, brute_force};
use crate::parameter::Values;
use crate::pattern;
use crate::render::{Camera, Film, direction};
use crate::surface::{Plane, Shape};
use crate::synthesis::{Bits, IndexTexture, Missed, Noise, Normals, Synthesis};
use crate::texture::NormalMap;

/// The row.
pub const ROW: Row = Row {
    name: "kautz-x",
    title: "The extensions: a map as indices and back, detail on top, and shading by the map's own distribution",
    parts: &["extension"],
    parameters: &[],
    secs: 4.0,
    make,
};

/// Texels a side of the map.
const SIDE: usize = 128;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let entry = pattern::find("waves").expect("a pattern of the program's own");
    let map = (entry.build)(SIDE, SIDE, &Values::defaults(entry.parameters), task.seed).normals;
    let own = NdfImage::of_normals(map.texels(), None, 256).expect("normals point up");
    let mut exhibit = ROW.exhibit();
    let (back, worst) = back(&map, &own);
    task.go_on()?;
    let (detail, shown) = detailed(&map, &own, task)?;
    let (measured, kautz) = compared(task.part(ROW.parts[0]));
    exhibit.claims = vec![
        Claim::at_most(
            "root mean square angle by which normals miss themselves, own NDF, indices unrounded, degrees",
            "so that the original normals will be looked up (§7)",
            1.0,
            worst[0],
        ),
        Claim::shown(
            "part of normals that miss themselves by over 2°, under an NDF narrower than the map, without and with a floor \
             of 2 %",
            "the original normals will be looked up (§7)",
            format!("{:.3}, {:.3}", worst[1], worst[2]),
            "a floor leaves at most half as many",
            worst[2] <= 0.5 * worst[1],
        ),
        Claim::shown(
            "root mean square tilt of the map, and with detail on top, degrees",
            "add more detail to a surface that already uses a bump map (§7)",
            format!("{:.1}, {:.1}", detail[0], detail[1]),
            "more with detail",
            detail[1] > detail[0],
        ),
    ];
    exhibit.claims.extend(kautz);
    exhibit.tables = vec![back, measured];
    exhibit.figures =
        vec![maps("ndf", "The map's own distribution.", &[("measured", &own)]), shown];
    Ok(exhibit)
}

/// Normals through indices and back; of interest: the rms angle by its own NDF, and the parts lost under a narrow one.
fn back(map: &NormalMap, own: &NdfImage) -> (Table, [f64; 3]) {
    let head = [
        "distribution",
        "indices",
        "RMS angle, degrees",
        "greatest, degrees",
        "part off by over 2°",
    ];
    let caption = "Normals of the map turned into indices and looked up again.";
    let mut table = Table::new("back", caption, &head);
    let narrow = isotropic(400.0);
    let floored = narrow.with_floor(0.02);
    let mut kept = [0.0; 3];
    for (k, (label, ndf)) in
        [("its own", own), ("narrower", &narrow), ("narrower, floor of 2 %", &floored)]
            .into_iter()
            .enumerate()
    {
        let normals = Normals::new(ndf, Noise::default().gain);
        for (bits, name) in
            [(Bits::Float, "unrounded"), (Bits::Sixteen, "16 bits"), (Bits::Eight, "8 bits")]
        {
            let indices = IndexTexture::of_map(&normals, map, bits);
            let back = indices.level(0).iter().map(|r| normals.at(r.map(f64::from)));
            let Missed { rms, most, far } = Missed::of(map.texels(), back);
            if bits == Bits::Float {
                kept[k] = if k == 0 { rms } else { far };
            }
            table.push(vec![label.into(), name.into(), rms.into(), most.into(), far.into()]);
        }
    }
    (table, kept)
}

/// The map and the map with detail, near by; and the root mean square tilt of both, degrees.
fn detailed(
    map: &NormalMap,
    own: &NdfImage,
    task: &Task,
) -> Result<([f64; 2], crate::evidence::Figure), Halted> {
    const FINER: usize = 4;
    let noise = Noise { cells: [48; 2], seed: task.seed, ..Noise::default() };
    let synthesis = Synthesis::new(own.with_floor(0.02), noise);
    let fine = synthesis.with_finer_detail(map, FINER, 0.5, 3.0);
    let tilts = [map, &fine].map(|map| Missed::upright(map.texels()).rms);
    let base = BaseLobe::BlinnPhong { exponent: 40.0 };
    let picture = |map: &NormalMap| -> Result<Film, Halted> {
        let camera = Camera::orbiting(1.2, 45.0, -90.0, 22.0, 224, 168);
        let plane = Shape::Plane(Plane::new()).tiled(1.0, 1.0);
        let bumps = brute_force().prefilter(&Arc::new(map.clone()), &base, &Silent);
        shot(
            &view(camera, plane, direction(45.0, 60.0)),
            bumps.map_err(|_| Halted)?.as_ref(),
            16,
            task,
        )
    };
    let panels = vec![
        Panel::new("map", "the map", Arc::new(picture(map)?)),
        Panel::new("detail", "with detail on top", Arc::new(picture(&fine)?)),
    ];
    Ok((
        tilts,
        pictures("detail", "A map of waves near by, and with synthesised detail on top.", panels),
    ))
}

/// The method `kautz` beside Fournier's, on the part's scenes.
fn compared(part: &FinishedPart) -> (Table, Vec<Claim>) {
    let head = ["texture", "texels a pixel", "kautz", "fournier-fast", "averaged", "unfiltered"];
    let mut table =
        Table::new("shaded", "RMSE of one sample a pixel against the reference.", &head);
    let (mut claims, mut worse, mut all) = (vec![], 0, 0);
    for scene in &part.results.scenes {
        let wanted = ["kautz", "fournier-fast", "averaged", "unfiltered"].map(|method| (method, 1));
        match trials(scene, wanted) {
            Ok(found) => {
                let errors = found.map(rmse);
                all += 1;
                worse += usize::from(errors[0] > errors[1]);
                let mut row =
                    vec![scene.key.texture.clone().into(), scene.key.texels_per_pixel.into()];
                row.extend(errors.map(Into::into));
                table.push(row);
            }
            Err(claim) => claims.push(*claim),
        }
    }
    claims.push(Claim::shown(
        "scenes in which shading by the map's own NDF has a greater error than Fournier's filter",
        "still not the same as correctly mipmapping a bump map as proposed by Fournier (§7)",
        format!("{worse} of {all}"),
        "more than half",
        2 * worse > all,
    ));
    (table, claims)
}
