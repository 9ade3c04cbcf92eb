use std::io::Write as _;

use proptest::prelude::*;

use super::*;
use crate::surface::{Hit, Surface};

/// A cube of side 2, each face a square of four triangles' worth of texture coordinates [0, 1]².
const CUBE: &str = "# a cube\nmtllib none.mtl\no cube\n\
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl none\ns off\n\
f 1/1 4/2 3/3 2/4\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\nf -8/1 -4/2 -1/3 -5/4\n";

fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::File::create(&path).unwrap().write_all(bytes).unwrap();
    (folder, path)
}

fn model(name: &str, bytes: &[u8]) -> Result<Model, String> {
    let (_folder, path) = file(name, bytes);
    read_model(&path, Up::Z).map_err(|error| error.to_string())
}

fn refused(name: &str, bytes: &[u8], parts: &[&str]) {
    let error = model(name, bytes).err().expect("an error");
    for part in [name].iter().chain(parts) {
        assert!(error.contains(part), "{error:?} does not tell of {part:?}");
    }
    assert!(!error.contains('\n') && error.contains("; "), "{error:?} says what to do");
}

/// A square of x and y in [−1, 1] at z = 0 as glTF: u along x, v (downwards there) against y.
struct Square {
    json: serde_json::Value,
    bytes: Vec<u8>,
}

impl Square {
    fn new() -> Self {
        let positions: [[f32; 3]; 4] =
            [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
        let uvs: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let indices: [u16; 6] = [0, 1, 2, 0, 2, 3];
        let mut bytes: Vec<u8> = Vec::new();
        positions.iter().flatten().for_each(|c| bytes.extend(c.to_le_bytes()));
        uvs.iter().flatten().for_each(|c| bytes.extend(c.to_le_bytes()));
        indices.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        let json = serde_json::json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2 }] }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0] },
                { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2" },
                { "bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR" },
            ],
            "bufferViews": [
                { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
                { "buffer": 0, "byteOffset": 48, "byteLength": 32 },
                { "buffer": 0, "byteOffset": 80, "byteLength": 12 },
            ],
            "buffers": [{ "byteLength": 92 }],
        });
        Self { json, bytes }
    }

    fn glb(&self) -> Vec<u8> {
        let json = serde_json::to_vec(&self.json).unwrap().into();
        let header = ::gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 };
        ::gltf::binary::Glb { header, json, bin: Some(self.bytes.clone().into()) }.to_vec().unwrap()
    }

    fn text(&self, uri: &str) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"][0]["uri"] = uri.into();
        serde_json::to_vec(&json).unwrap()
    }
}

/// What a ray along −z at (x, y) meets.
fn from_above(model: &Model, x: f64, y: f64) -> Hit {
    model.mesh.intersect(Vec3::new(x, y, 3.0), -Vec3::z()).expect("it is there")
}

#[test]
fn a_cube_is_centred_scaled_and_smooth() {
    let cube = model("cube.obj", CUBE.as_bytes()).unwrap();
    assert_eq!(cube.mesh.triangles(), 12);
    assert!(cube.notes.is_empty());
    let half = 1.0 / 3.0f64.sqrt();
    let hit = from_above(&cube, 0.0, 0.0);
    assert!((hit.point.z - half).abs() < 1e-6 && (hit.uv[0] - 0.5).abs() < 1e-6);
    assert!((hit.plane - Vec3::z()).norm() < 1e-12);
    // Towards a corner the smooth normal leans to it, by angle all three faces alike.
    let corner = from_above(&cube, half - 1e-7, half - 1e-7).frame.normal;
    assert!((corner - Vec3::repeat(half)).norm() < 1e-5, "{corner}");
    // Half a turn about x from y up to z up.
    let (_folder, path) = file("cube.obj", CUBE.replace("v -1 -1 -1\n", "v -1 -1 -2\n").as_bytes());
    let turned = read_model(&path, Up::Y).unwrap();
    let furthest = (0..8).map(|k| {
        let (x, y) = (f64::from(k % 2) - 0.5, f64::from(k / 2 % 2) - 0.5);
        turned
            .mesh
            .intersect(Vec3::new(x * 0.6, 3.0, y * 0.6), -Vec3::y())
            .map_or(0.0, |h| h.point.y)
    });
    assert!(furthest.fold(0.0, f64::max) > 0.6, "what was at −z is at +y");
}

#[test]
fn all_ways_to_hold_bytes_give_the_same_square() {
    use base64::Engine;
    let square = Square::new();
    let data = base64::engine::general_purpose::STANDARD.encode(&square.bytes);
    let (folder, beside) = file("square.gltf", &square.text("a%20square.bin"));
    std::fs::write(folder.path().join("a square.bin"), &square.bytes).unwrap();
    assert_eq!(files_of(&beside), [beside.clone(), folder.path().join("a square.bin")]);
    let models = [
        model("square.glb", &square.glb()).unwrap(),
        model("square.gltf", &square.text(&format!("data:application/octet-stream;base64,{data}")))
            .unwrap(),
        read_model(&beside, Up::Z).unwrap(),
    ];
    let half = 1.0 / 2.0f64.sqrt();
    for model in models {
        assert_eq!(model.mesh.triangles(), 2);
        let hit = from_above(&model, 0.5 * half, 0.25 * half);
        // v grows upwards: a map lies on it as it is seen.
        assert!(
            (hit.uv[0] - 0.75).abs() < 1e-6 && (hit.uv[1] - 0.625).abs() < 1e-6,
            "{:?}",
            hit.uv
        );
        let frame = hit.frame;
        for (axis, want) in
            [(frame.tangent, Vec3::x()), (frame.bitangent, Vec3::y()), (frame.normal, Vec3::z())]
        {
            assert!((axis - want).norm() < 1e-6);
        }
    }
}

#[test]
fn nodes_place_turn_and_mirror() {
    let mut square = Square::new();
    // A quarter turn about z in the parent, then mirrored in x by the child.
    let half = 0.5f32.sqrt();
    square.json["nodes"] = serde_json::json!([
        { "children": [1], "rotation": [0, 0, half, half], "translation": [5, 0, 0] },
        { "mesh": 0, "scale": [-2, 1, 1] },
    ]);
    let model = model("turned.glb", &square.glb()).unwrap();
    let hit = from_above(&model, 0.1, 0.05);
    let frame = hit.frame;
    // x of the square runs along −x, then along −y; y along −x. It is seen from the front still.
    assert!((frame.tangent + Vec3::y()).norm() < 1e-6, "{frame:?}");
    assert!((frame.bitangent + Vec3::x()).norm() < 1e-6, "{frame:?}");
    assert!((frame.normal - Vec3::z()).norm() < 1e-6, "{frame:?}");
    assert!(hit.gradient[1].dot(&frame.bitangent) > 0.0, "left-handed, but v grows along it");
}

#[test]
fn mirrored_texture_coordinates_keep_bumps_bumps() {
    // Two squares side by side, one with u mirrored: as the halves of many faces.
    let text = "v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n\
                f 1/1 2/2 5/4 4/3\nf 2/2 3/1 6/3 5/4\n";
    let model = model("halves.obj", text.as_bytes()).unwrap();
    for (x, side) in [(-0.4, 1.0), (0.4, -1.0)] {
        let Hit { frame, gradient, .. } = from_above(&model, x, 0.1);
        assert!((frame.tangent - Vec3::x() * side).norm() < 1e-6);
        assert!((frame.bitangent - Vec3::y()).norm() < 1e-6);
        assert!(gradient[0].dot(&frame.tangent) > 0.0 && gradient[1].dot(&frame.bitangent) > 0.0);
        let turn = frame.tangent.cross(&frame.bitangent).dot(&frame.normal);
        assert!((turn - side).abs() < 1e-6);
    }
}

#[test]
fn tangents_of_the_file_are_taken() {
    let mut square = Square::new();
    for tangent in [[0.6f32, 0.8, 0.0, 1.0]; 4] {
        tangent.iter().for_each(|c| square.bytes.extend(c.to_le_bytes()));
    }
    for _ in 0..4 {
        [0.0f32, 0.0, 1.0].iter().for_each(|c| square.bytes.extend(c.to_le_bytes()));
    }
    square.json["buffers"][0]["byteLength"] = square.bytes.len().into();
    let views = square.json["bufferViews"].as_array_mut().unwrap();
    views.push(serde_json::json!({ "buffer": 0, "byteOffset": 92, "byteLength": 64 }));
    views.push(serde_json::json!({ "buffer": 0, "byteOffset": 156, "byteLength": 48 }));
    let accessors = square.json["accessors"].as_array_mut().unwrap();
    accessors.push(
        serde_json::json!({ "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC4" }),
    );
    accessors.push(
        serde_json::json!({ "bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC3" }),
    );
    let attributes = &mut square.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TANGENT"] = 3.into();
    attributes["NORMAL"] = 4.into();
    let frame = from_above(&model("square.glb", &square.glb()).unwrap(), 0.1, 0.2).frame;
    assert!((frame.tangent - Vec3::new(0.6, 0.8, 0.0)).norm() < 1e-6, "{frame:?}");
}

#[test]
fn triangles_that_the_texture_is_not_laid_on_are_told_of() {
    let text = format!("{CUBE}f 1/1 2/1 3/1\n");
    let cube = model("cube.obj", text.as_bytes()).unwrap();
    assert_eq!(cube.mesh.triangles(), 13);
    assert!(
        cube.notes[0].contains("1 of 13 triangles have no area in texture"),
        "{:?}",
        cube.notes
    );
}

#[test]
fn triangles_without_area_are_left_out_and_told_of() {
    let text = format!("{CUBE}f 1/1 1/2 2/3\nf 1/1 2/2 2/3\n");
    let cube = model("cube.obj", text.as_bytes()).unwrap();
    assert_eq!(cube.mesh.triangles(), 12);
    assert!(cube.notes[0].contains("2 of 14 triangles have no area"), "{:?}", cube.notes);
    refused("flat.obj", b"v 0 0 0\nv 1 1 1\nvt 0 0\nf 1/1 2/1 2/1\n", &["no triangle with area"]);
}

#[test]
fn what_is_wrong_with_an_obj_is_told_with_its_line() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
    let of = |rest: &str| format!("{triangle}{rest}").into_bytes();
    refused("a.obj", &of("f 1 2 3\n"), &[", line 5", "`1` has no texture coordinates"]);
    refused("a.obj", &of("f 1/1 2/1 4/1\n"), &[", line 5", "vertex 4 is not among the 3"]);
    refused("a.obj", &of("f 1/1 2/1 -4/1\n"), &["vertex -4"]);
    refused("a.obj", &of("f 1/2 2/1 3/1\n"), &["texture coordinate 2 is not among the 1"]);
    refused("a.obj", &of("f 1/1/1 2/1/1 3/1/1\n"), &["normal 1 is not among the 0"]);
    refused("a.obj", &of("f 1/1 2/1\n"), &["a face of 2 corners"]);
    refused("a.obj", &of("f 1/x 2/1 3/1\n"), &["`x` is no index"]);
    refused("a.obj", &of("f 9223372036854775807/1 2/1 -9223372036854775808/1\n"), &["not among"]);
    refused("a.obj", b"v 0 nan 0\n", &[", line 1", "not finite"]);
    refused("a.obj", b"v 0 1e39 0\n", &["not finite"]);
    refused("a.obj", b"v 0 0\n", &[", line 1", "2 numbers where 3"]);
    refused("a.obj", triangle.as_bytes(), &["no faces"]);
    refused("picture.png", b"\x89PNG\r\n\x1a\n\0\0", &["neither OBJ nor glTF"]);
    refused("empty", b"", &["neither OBJ nor glTF"]);
}

#[test]
fn what_is_wrong_with_a_gltf_is_told_with_its_place() {
    let broken = |change: &dyn Fn(&mut Square)| {
        let mut square = Square::new();
        change(&mut square);
        square.glb()
    };
    let set = |pointer: &'static str, value: serde_json::Value| {
        broken(&move |s| *s.json.pointer_mut(pointer).unwrap() = value.clone())
    };
    let place = ", mesh 0, primitive 0";
    let attributes = "/meshes/0/primitives/0/attributes";
    refused(
        "a.glb",
        &set(attributes, serde_json::json!({ "POSITION": 0 })),
        &[place, "TEXCOORD_0"],
    );
    refused(
        "a.glb",
        &set("/accessors/2/count", 7.into()),
        &[place, "7 elements of which its buffer has 6"],
    );
    refused(
        "a.glb",
        &set("/accessors/0/count", 4_000_000_000u64.into()),
        &["more than 2000000 triangles"],
    );
    refused("a.glb", &set("/accessors/1/type", "VEC3".into()), &[place, "Vec3 where Vec2"]);
    let lines = broken(&|s| s.json["meshes"][0]["primitives"][0]["mode"] = 1.into());
    refused("a.glb", &lines, &[place, "made of Lines"]);
    let packed = broken(&|s| {
        s.json["extensionsRequired"] = serde_json::json!(["KHR_draco_mesh_compression"]);
        s.json["extensionsUsed"] = serde_json::json!(["KHR_draco_mesh_compression"]);
    });
    refused("a.glb", &packed, &["KHR_draco_mesh_compression"]);
    refused(
        "a.glb",
        &set("/meshes/0/primitives/0/attributes/POSITION", 9.into()),
        &[", mesh 0", "accessor 9 of 3"],
    );
    refused("a.glb", &broken(&|s| s.bytes[80] = 9), &[place, "vertex 9 of 4"]);
    refused(
        "a.glb",
        &broken(&|s| s.bytes[0..4].copy_from_slice(&f32::NAN.to_le_bytes())),
        &[place, "vertex 0"],
    );
    refused("a.glb", &broken(&|s| s.bytes.truncate(60)), &[", buffer 0", "60 bytes of 92"]);
    let ring = set("/nodes", serde_json::json!([{ "mesh": 0, "children": [0] }]));
    refused("a.glb", &ring, &[", node 0", "a ring of them"]);
    refused(
        "a.gltf",
        &Square::new().text("gone.bin"),
        &[", buffer 0", "there is no file", "gone.bin"],
    );
    refused(
        "a.gltf",
        &Square::new().text("https://example.org/a.bin"),
        &[", buffer 0", "no file beside it"],
    );
    refused("a.gltf", &Square::new().text("data:;base64,%%%"), &[", buffer 0", "base64"]);
    refused("a.glb", &Square::new().glb()[..60], &["a GLB of 60 bytes"]);
    refused("a.gltf", b"{ \"asset\": 1", &["no glTF 2.0"]);
    refused("a.gltf", b"{}", &["no glTF 2.0"]);
}

#[test]
fn a_scene_that_shows_a_mesh_too_often_is_refused_before_it_is_made() {
    let mut square = Square::new();
    let children: Vec<usize> = (1..=64).collect();
    let mut nodes = vec![serde_json::json!({ "children": children })];
    // A million vertices that are all the same one, in 64 places.
    square.json["accessors"][2]["count"] = 6.into();
    nodes.extend((0..64).map(|_| serde_json::json!({ "mesh": 0 })));
    square.json["nodes"] = nodes.into();
    assert_eq!(model("many.glb", &square.glb()).unwrap().mesh.triangles(), 128);
    square.json["accessors"][2] =
        serde_json::json!({ "componentType": 5125, "count": 300_000, "type": "SCALAR" });
    let error = model("many.glb", &square.glb()).err().unwrap();
    assert!(error.contains("more than 2000000") || error.contains("no glTF"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    /// Whatever bytes: a model whose hits are finite, or a message.
    #[test]
    fn broken_files_are_refused_or_read(
        which in 0usize..3, cut in prop::option::of(0.0f64..1.0),
        flips in prop::collection::vec((0.0f64..1.0, any::<u8>()), 0..6)
    ) {
        use base64::Engine;
        let square = Square::new();
        let data = base64::engine::general_purpose::STANDARD.encode(&square.bytes);
        let (name, mut bytes) = match which {
            0 => ("a.obj", CUBE.as_bytes().to_vec()),
            1 => ("a.glb", square.glb()),
            _ => ("a.gltf", square.text(&format!("data:;base64,{data}"))),
        };
        for (at, byte) in flips {
            let at = (at * bytes.len() as f64) as usize;
            bytes[at] = byte;
        }
        bytes.truncate(cut.map_or(bytes.len(), |cut| (cut * bytes.len() as f64) as usize));
        match model(name, &bytes) {
            Err(message) => prop_assert!(message.contains(name) && message.len() < 2000, "{message}"),
            Ok(model) => {
                for k in 0..20 {
                    let direction = Vec3::new((f64::from(k) * 0.7).sin(), (f64::from(k) * 1.1).cos(), -2.0) ;
                    let (hit, _) = model.mesh.trace(Vec3::new(0.1, 0.2, 2.0), direction);
                    let numbers = [hit.point, hit.frame.tangent, hit.frame.bitangent, hit.frame.normal, hit.gradient[0]];
                    prop_assert!(numbers.iter().all(|v| v.iter().all(|c| c.is_finite())), "{hit:?}");
                }
            }
        }
    }
}
