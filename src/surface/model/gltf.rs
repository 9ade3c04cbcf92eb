//! glTF 2.0, as text with its buffers beside it or within, and as GLB.

use std::path::{Path, PathBuf};

use gltf::accessor::Dimensions;
use gltf::buffer::Source;
use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, Semantic};
use nalgebra::Matrix4;

use super::accessor::{Buffers, Fault};
use super::{FURTHEST, MOST_TRIANGLES, ModelError, Point, Soup, read_file, too_many, wrong};
use crate::geometry::Vec3;

/// Whether bytes look like GLB or the JSON of glTF.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let first =
        bytes.iter().find(|byte| !byte.is_ascii_whitespace() && !b"\xEF\xBB\xBF".contains(byte));
    bytes.starts_with(b"glTF") || first == Some(&b'{')
}

const AGAIN: &str = "the file may be cut off or broken: export it again";
/// Deepest that nodes may be within nodes.
const DEEPEST: usize = 64;

/// Reads all triangles of the default scene (or the first, or if there is none all nodes) in the scene's space.
///
/// # Errors
/// What is wrong.
pub(super) fn read(path: &Path, bytes: &[u8]) -> Result<Soup, ModelError> {
    let (document, blob) = parse(path, bytes)?;
    let buffers = buffers(path, &document, blob)?;
    let mut scene = Scene { path, buffers, soup: Soup::default() };
    let roots: Vec<Node> = match document.default_scene().or_else(|| document.scenes().next()) {
        Some(scene) => scene.nodes().collect(),
        None => document.nodes().collect(),
    };
    for node in roots {
        scene.node(&node, Matrix4::identity(), 0)?;
    }
    if document.skins().next().is_some() || document.animations().next().is_some() {
        let note = "skins and animations are left out: the model is as it stands at rest";
        scene.soup.notes.push(format!("{}: {note}", path.display()));
    }
    if scene.soup.triangles.is_empty() {
        return Err(wrong(
            path,
            "",
            "its scene has no triangles",
            "export the model with its meshes",
        ));
    }
    Ok(scene.soup)
}

/// The checked JSON, and the binary part of a GLB.
fn parse(path: &Path, bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), ModelError> {
    if bytes.starts_with(b"glTF") {
        let told = bytes.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
        if told.is_none_or(|told| told < 20 || told > bytes.len()) {
            let what =
                format!("a GLB of {} bytes that tells of {}", bytes.len(), told.unwrap_or(0));
            return Err(wrong(path, "", what, AGAIN));
        }
    }
    let broken = |error: gltf::Error| wrong(path, "", format!("no glTF 2.0: {error}"), AGAIN);
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(broken)?;
    let mut json = document.into_json();
    // Extensions of how things look do not matter here; those of where they are do.
    let looks = |name: &String| {
        ["KHR_materials_", "KHR_lights_", "KHR_texture_", "EXT_texture_", "MSFT_texture_"]
            .iter()
            .any(|start| name.starts_with(start))
    };
    if let Some(name) = json.extensions_required.iter().find(|name| !looks(name)) {
        let what = format!("needs the extension {name}, which is not known here");
        return Err(wrong(path, "", what, "export the model without it, uncompressed"));
    }
    json.extensions_required.clear();
    let document = Document::from_json(json).map_err(broken)?;
    Ok((document, blob))
}

/// The bytes of all buffers: of the GLB, of data URIs, of files beside it.
fn buffers(
    path: &Path,
    document: &Document,
    mut blob: Option<Vec<u8>>,
) -> Result<Buffers, ModelError> {
    let mut bytes = Vec::new();
    for buffer in document.buffers() {
        let place = || format!(", buffer {}", buffer.index());
        let of_buffer = match buffer.source() {
            Source::Bin => {
                blob.take().ok_or_else(|| wrong(path, place(), "has no bytes", AGAIN))?
            }
            Source::Uri(uri) => match uri.strip_prefix("data:") {
                Some(data) => decoded(data).map_err(|what| wrong(path, place(), what, AGAIN))?,
                None => beside(path, uri, &place())?,
            },
        };
        let needed = buffer.length();
        if of_buffer.len() < needed {
            let what = format!("{} bytes of {needed}", of_buffer.len());
            return Err(wrong(path, place(), what, AGAIN));
        }
        bytes.push(of_buffer);
    }
    Ok(Buffers { bytes })
}

/// The files that hold buffers.
pub(super) fn files_beside(path: &Path, bytes: &[u8]) -> Vec<PathBuf> {
    let Ok((document, _)) = parse(path, bytes) else { return Vec::new() };
    let file = |buffer: gltf::Buffer| match buffer.source() {
        Source::Uri(uri) if !uri.starts_with("data:") => Some(folder(path).join(unescaped(uri))),
        _ => None,
    };
    document.buffers().filter_map(file).collect()
}

fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

fn decoded(data: &str) -> Result<Vec<u8>, Fault> {
    use base64::Engine;
    let (kind, text) = data.split_once(',').ok_or("a data URI without a comma")?;
    if !kind.ends_with(";base64") {
        return Err("a data URI that is not base64".to_owned());
    }
    let engine = base64::engine::general_purpose::STANDARD;
    engine.decode(text).map_err(|error| format!("a data URI that is no base64: {error}"))
}

/// A file in the model's folder or below it.
fn beside(path: &Path, uri: &str, place: &str) -> Result<Vec<u8>, ModelError> {
    let name = unescaped(uri);
    let plain = !name.is_empty() && !name.contains("://") && !Path::new(&name).is_absolute();
    if !plain {
        let what = format!("its bytes are at {uri}, which is no file beside it");
        return Err(wrong(path, place, what, "export the model as one .glb file"));
    }
    let file = folder(path).join(&name);
    if !file.is_file() {
        let what = format!("there is no file {}", file.display());
        return Err(wrong(path, place, what, "put it beside the model, or export one .glb file"));
    }
    read_file(&file)
}

/// `%20` and the like as the characters they stand for.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after.get(..2).and_then(|code| std::str::from_utf8(code).ok());
        let code = code.and_then(|code| u8::from_str_radix(code, 16).ok());
        match code.filter(|_| first == b'%') {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A scene on its way to triangles.
struct Scene<'a> {
    path: &'a Path,
    buffers: Buffers,
    soup: Soup,
}

impl Scene<'_> {
    fn node(&mut self, node: &Node, parent: Matrix4<f64>, depth: usize) -> Result<(), ModelError> {
        if depth > DEEPEST {
            let what = format!("more than {DEEPEST} nodes within one another, or a ring of them");
            return Err(wrong(
                self.path,
                format!(", node {}", node.index()),
                what,
                "correct the scene",
            ));
        }
        let own = Matrix4::from(node.transform().matrix().map(|column| column.map(f64::from)));
        let placed = parent * own;
        for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
            let mesh = node.mesh().map_or(0, |mesh| mesh.index());
            let place = format!(", mesh {mesh}, primitive {}", primitive.index());
            self.primitive(&primitive, &placed, &place)?;
        }
        for child in node.children() {
            self.node(&child, placed, depth + 1)?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        primitive: &Primitive,
        placed: &Matrix4<f64>,
        place: &str,
    ) -> Result<(), ModelError> {
        let path = self.path;
        let fault = |what: Fault| wrong(path, place, what, AGAIN);
        let Some(position) = primitive.get(&Semantic::Positions) else {
            return Err(wrong(path, place, "no POSITION", "export the model with its vertices"));
        };
        let Some(uv) = primitive.get(&Semantic::TexCoords(0)) else {
            let help = "unwrap the model and export it with texture coordinates";
            return Err(wrong(path, place, "no texture coordinates (TEXCOORD_0)", help));
        };
        // What it would take, before it is taken: a scene can show one mesh many times.
        let used = primitive.indices().map_or(position.count(), |indices| indices.count());
        let at_most = if primitive.mode() == Mode::Triangles { used / 3 } else { used };
        let most = 3 * MOST_TRIANGLES;
        if self.soup.triangles.len().saturating_add(at_most) > MOST_TRIANGLES
            || self.soup.points.len().saturating_add(position.count()) > most
        {
            return Err(too_many(path));
        }
        let positions = self.buffers.floats::<3>(&position, Dimensions::Vec3).map_err(fault)?;
        let uvs = self.buffers.floats::<2>(&uv, Dimensions::Vec2).map_err(fault)?;
        let normals = primitive.get(&Semantic::Normals);
        let normals = normals
            .map(|n| self.buffers.floats::<3>(&n, Dimensions::Vec3))
            .transpose()
            .map_err(fault)?;
        let tangents = primitive.get(&Semantic::Tangents).filter(|_| normals.is_some());
        let tangents = tangents
            .map(|t| self.buffers.floats::<4>(&t, Dimensions::Vec4))
            .transpose()
            .map_err(fault)?;
        let points = points(positions, uvs, normals, tangents).map_err(fault)?;
        let indices = match primitive.indices() {
            Some(indices) => self.buffers.indices(&indices).map_err(fault)?,
            None => (0..points.len() as u32).collect(),
        };
        if let Some(beyond) = indices.iter().find(|&&index| index as usize >= points.len()) {
            return Err(fault(format!("vertex {beyond} of {}", points.len())));
        }
        let help = "export the model as triangles";
        let triangles = triangles(primitive.mode(), &indices)
            .ok_or_else(|| wrong(path, place, format!("made of {:?}", primitive.mode()), help))?;
        self.add(points, triangles, placed).map_err(fault)
    }

    /// Points and triangles, moved to their place.
    fn add(
        &mut self,
        points: Vec<Point>,
        triangles: Vec<[u32; 3]>,
        placed: &Matrix4<f64>,
    ) -> Result<(), Fault> {
        let linear = placed.fixed_view::<3, 3>(0, 0).into_owned();
        let shift = Vec3::new(placed[(0, 3)], placed[(1, 3)], placed[(2, 3)]);
        // Normals go by the inverse transpose, which but for its length is the matrix of cofactors.
        let [x, y, z] = [0, 1, 2].map(|k| Vec3::from(linear.column(k)));
        let mirrored = x.dot(&y.cross(&z)) < 0.0;
        let turned = if mirrored { -1.0 } else { 1.0 };
        let first = self.soup.points.len() as u32;
        for (k, point) in points.into_iter().enumerate() {
            let wide = |c: [f32; 3]| Vec3::from(c.map(f64::from));
            let narrow = |v: Vec3| [v.x, v.y, v.z].map(|c| c as f32);
            let position = linear * wide(point.position) + shift;
            let within = position.iter().all(|c| c.abs() <= f64::from(FURTHEST));
            if !within {
                return Err(format!("vertex {k} is not finite, or beyond 10³⁰"));
            }
            let normal = point.normal.map(wide).map(|n| {
                let n = (y.cross(&z) * n.x + z.cross(&x) * n.y + x.cross(&y) * n.z) * turned;
                narrow(n.try_normalize(0.0).unwrap_or_default())
            });
            let tangent = point.tangent.map(|[x, y, z, sign]| {
                let t = (linear * wide([x, y, z])).try_normalize(0.0).unwrap_or_default();
                let [x, y, z] = narrow(t);
                [x, y, z, sign * turned as f32]
            });
            self.soup.points.push(Point { position: narrow(position), normal, tangent, ..point });
        }
        // Mirrored, triangles run the other way round.
        let moved = triangles.into_iter().map(|t| t.map(|corner| corner + first));
        self.soup
            .triangles
            .extend(moved.map(|[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] }));
        Ok(())
    }
}

/// Vertices, in the file's own space; v turned to run upwards.
fn points(
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Option<Vec<[f32; 3]>>,
    tangents: Option<Vec<[f32; 4]>>,
) -> Result<Vec<Point>, Fault> {
    let count = positions.len();
    for (what, other) in [
        ("texture coordinates", Some(uvs.len())),
        ("normals", normals.as_ref().map(Vec::len)),
        ("tangents", tangents.as_ref().map(Vec::len)),
    ] {
        if let Some(other) = other.filter(|&other| other != count) {
            return Err(format!("{other} {what} for {count} vertices"));
        }
    }
    let finite = |numbers: &[f32]| numbers.iter().all(|c| c.abs() <= FURTHEST);
    let point = |k: usize| {
        let (normal, tangent) = (normals.as_ref().map(|n| n[k]), tangents.as_ref().map(|t| t[k]));
        let [u, v] = uvs[k];
        let all = [&positions[k][..], &uvs[k]].into_iter().all(finite)
            && normal.is_none_or(|n| finite(&n))
            && tangent.is_none_or(|t| finite(&t));
        let point = Point { position: positions[k], normal, uv: [u, 1.0 - v], tangent };
        all.then_some(point).ok_or_else(|| format!("vertex {k} is not finite, or beyond 10³⁰"))
    };
    (0..count).map(point).collect()
}

/// Triangles of a list, strip or fan of indices; `None` for points and lines.
fn triangles(mode: Mode, indices: &[u32]) -> Option<Vec<[u32; 3]>> {
    let three = |t: &[u32]| [t[0], t[1], t[2]];
    match mode {
        Mode::Triangles => Some(indices.chunks_exact(3).map(three).collect()),
        Mode::TriangleStrip => {
            let turned = |(k, t): (usize, &[u32])| {
                if k % 2 == 0 { three(t) } else { [t[1], t[0], t[2]] }
            };
            Some(indices.windows(3).enumerate().map(turned).collect())
        }
        Mode::TriangleFan => {
            let (first, rest) = indices.split_first()?;
            Some(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]).collect())
        }
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => None,
    }
}
