//! The sweep: which textures, methods, sample counts, scales and lobes are combined.

use super::catalogue::{Catalogue, unknown};
use super::item::Item;
use super::limits::Limits;
use super::material::{Material, read_lobe};
use super::method::{LOOKUPS, MethodSpec};
use super::motion::MotionSpec;
use super::reader::Reader;
use super::reference::ReferenceSpec;
use super::scene::{Shape, distance_limits, elevation_limits};
use super::texture::TextureSpec;
use crate::lobe::BaseLobe;
use crate::texture::Lookup;

/// What is combined with what.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepSpec {
    /// The textures, in the order of the spec; at least one.
    pub textures: Vec<TextureSpec>,
    /// The methods, in the order of the spec, each by one lookup after the other; at least one.
    pub methods: Vec<MethodSpec>,
    /// Samples a pixel of every method but `unfiltered`, rising powers of two.
    pub spp: Vec<u32>,
    /// Samples a pixel of the method `unfiltered`: the brute-force curve, rising powers of two.
    pub unfiltered_spp: Vec<u32>,
    /// How small the bumps are.
    pub scale: Scale,
    /// Degrees above the plane z = 0 that the camera stands at, in the order of the spec; at least one.
    pub elevations: Vec<f64>,
    /// The base lobes, in the order of the spec; at least one.
    pub lobes: Vec<BaseLobe>,
}

/// How small the bumps are in the image.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// The camera stays; the texture is tiled so that at the image's centre this many texels are
    /// across a pixel.
    TexelsPerPixel(Vec<f64>),
    /// The tiling stays; the camera moves.
    Distance {
        /// Distances from the origin, scene units.
        distances: Vec<f64>,
        /// Tiles of the texture along a scene unit.
        tiles: f64,
    },
}

/// What the sweep's keys are checked against.
pub(super) struct Context<'a> {
    pub catalogue: &'a Catalogue,
    /// The tables under `[texture]`; `None` for one that is wrong.
    pub textures: Vec<(&'a str, Option<TextureSpec>)>,
    /// The tables under `[method]`; `None` for one that is wrong.
    pub methods: Vec<(&'a str, Option<MethodSpec>)>,
    pub shape: Shape,
    /// The camera's own elevation.
    pub elevation: f64,
    /// The key `tiles` of `[surface]` and its value.
    pub tiles: Option<(Item<'a>, f64)>,
    pub material: Material,
    pub reference: ReferenceSpec,
    pub motion: Option<MotionSpec>,
    pub seed: u64,
}

/// The method that is brute force: no filter, more samples.
const UNFILTERED: &str = "unfiltered";
/// Most samples a pixel that a trial may take.
const MAX_SPP: u32 = 65536;

impl SweepSpec {
    pub(super) fn read(reader: &Reader, context: &Context) -> Self {
        let spp = read_spp(reader.item("spp"), context).unwrap_or_else(|| vec![1, 4, 16, 64]);
        let own = reader.item("unfiltered_spp");
        let unfiltered_spp = read_spp(own.clone(), context)
            .unwrap_or_else(|| continued(&spp, context.reference.spp / 16));
        let textures = read_textures(reader, context);
        let methods = by_lookups(reader, read_methods(reader, context));
        if let (Some(own), false) = (own, methods.iter().any(|m| m.name == UNFILTERED)) {
            let message = "`unfiltered_spp` has no effect: no method of the sweep is `unfiltered`";
            own.error(message.to_owned(), None);
        }
        Self {
            textures,
            methods,
            scale: read_scale(reader, context),
            elevations: read_elevations(reader, context),
            lobes: read_lobes(reader, &context.material),
            spp,
            unfiltered_spp,
        }
    }

    /// The sample counts of a method.
    pub fn spp_of(&self, method: &MethodSpec) -> &[u32] {
        if method.name == UNFILTERED { &self.unfiltered_spp } else { &self.spp }
    }
}

fn read_textures(reader: &Reader, context: &Context) -> Vec<TextureSpec> {
    let expected = "a list of names of patterns or of [texture.NAME] tables";
    let list = reader.required("texture", expected);
    let built_in = context.catalogue.pattern_names();
    let plain = |name: &str| TextureSpec::plain(context.catalogue, name, context.seed);
    list.map_or_else(Vec::new, |list| named("texture", &list, &context.textures, &built_in, plain))
}

fn read_methods(reader: &Reader, context: &Context) -> Vec<MethodSpec> {
    let expected = "a list of names of methods or of [method.LABEL] tables";
    let list = reader.required("method", expected);
    let built_in = context.catalogue.method_names();
    let plain = |name: &str| MethodSpec::plain(context.catalogue, name);
    list.map_or_else(Vec::new, |list| named("method", &list, &context.methods, &built_in, plain))
}

/// The methods by each lookup of the list, or as they are if there is none.
fn by_lookups(reader: &Reader, methods: Vec<MethodSpec>) -> Vec<MethodSpec> {
    let Some(item) = reader.item("lookup") else { return methods };
    let lookups = item.list("lookups", |item| item.choice(&LOOKUPS));
    let mut all: Vec<MethodSpec> = Vec::new();
    for method in methods {
        // One that has a lookup of its own keeps it; one that has none stays as it is.
        let fixed = method.lookup != Lookup::default();
        let by = |lookup: &Lookup| method.by(*lookup, &item);
        let each: Vec<MethodSpec> =
            if fixed { Vec::new() } else { lookups.iter().filter_map(by).collect() };
        all.extend(if each.is_empty() { vec![method] } else { each });
    }
    for (k, method) in all.iter().enumerate() {
        if all[..k].iter().any(|other| other.label == method.label) {
            let help = "give the table under [method] another name".to_owned();
            item.error(format!("two methods would be called `{}`", method.label), Some(help));
        }
    }
    all
}

/// What a list of names stands for: each is a table of the spec, or else built in.
fn named<T: Clone>(
    what: &str,
    list: &Item,
    tables: &[(&str, Option<T>)],
    built_in: &[&str],
    plain: impl Fn(&str) -> Option<T>,
) -> Vec<T> {
    let names: Vec<&str> =
        tables.iter().map(|(name, _)| *name).chain(built_in.iter().copied()).collect();
    let chosen = list.list("names", |item| {
        let name = item.text()?;
        if names.contains(&name) { Some(name) } else { unknown(what, name, item, &names) }
    });
    let find = |name: &str| match tables.iter().find(|(table, _)| *table == name) {
        Some((_, value)) => value.clone(),
        None => plain(name),
    };
    chosen.into_iter().filter_map(find).collect()
}

/// A list of sample counts, made to rise. `None` if there is no list.
fn read_spp(item: Option<Item>, context: &Context) -> Option<Vec<u32>> {
    let most = MAX_SPP.min(context.reference.spp);
    let mut list = item?.list("sample counts", |item| {
        let spp = item.power_of_two(1, MAX_SPP)?;
        if spp > most {
            let message = format!("{spp} samples a pixel are more than the reference's {most}");
            item.error(message, Some("raise `spp` in [reference]".to_owned()));
        }
        Some(spp)
    });
    list.sort_unstable();
    Some(list)
}

/// `spp`, then four times its last again and again while at most `most`.
fn continued(spp: &[u32], most: u32) -> Vec<u32> {
    let mut counts = spp.to_vec();
    while let Some(next) = counts.last().and_then(|last| last.checked_mul(4)) {
        if next > most.min(MAX_SPP) {
            break;
        }
        counts.push(next);
    }
    counts
}

/// The elevations of the sweep, or the camera's one.
fn read_elevations(reader: &Reader, context: &Context) -> Vec<f64> {
    let limits = elevation_limits(context.shape);
    let list = reader.item("elevation");
    let list = list.map(|list| list.list("elevations", |item| item.real(limits)));
    list.unwrap_or_else(|| vec![context.elevation])
}

fn read_scale(reader: &Reader, context: &Context) -> Scale {
    let texels = reader.item("texels_per_pixel");
    let distances = reader.item("distance");
    match (texels, distances) {
        (Some(_), Some(distance)) => {
            let help =
                "keep one: `distance` moves the camera, `texels_per_pixel` tiles the texture";
            let message = "[sweep] has both `texels_per_pixel` and `distance`";
            distance.error(message.to_owned(), Some(help.to_owned()));
            Scale::TexelsPerPixel(Vec::new())
        }
        (None, Some(distance)) => {
            if context.motion.is_some_and(|motion| motion.kind.changes_distance()) {
                let help = "keep one: sweep over `texels_per_pixel`, those of the first frame";
                let message = "`distance` has no effect: [motion] moves the camera".to_owned();
                distance.error(message, Some(help.to_owned()));
            }
            let limits = distance_limits(context.shape);
            let distances = distance.list("distances", |item| item.real(limits));
            if context.tiles.is_none() {
                let help =
                    "add `tiles = 4.0` to [surface]: tiles of the texture along a scene unit";
                let message = "a sweep over `distance` needs the key `tiles` in [surface]";
                distance.error(message.to_owned(), Some(help.to_owned()));
            }
            Scale::Distance { distances, tiles: context.tiles.as_ref().map_or(1.0, |(_, t)| *t) }
        }
        (texels, None) => {
            if let Some((item, _)) = &context.tiles {
                let help = "sweep over `distance` instead of `texels_per_pixel`, or remove it";
                let message = "`tiles` has no effect: the sweep chooses the tiling";
                item.error(message.to_owned(), Some(help.to_owned()));
            }
            let limits = Limits::above(0.0, 65536.0);
            let list = texels.map(|list| list.list("texel counts", |item| item.real(limits)));
            Scale::TexelsPerPixel(list.unwrap_or_else(|| vec![1.0, 4.0, 16.0, 64.0]))
        }
    }
}

/// The lobes of whichever key has them, or the material's one.
fn read_lobes(reader: &Reader, material: &Material) -> Vec<BaseLobe> {
    let family = material.family;
    let parameters = reader.item(family.key());
    let lobes = reader.item("lobe");
    if let (Some(_), Some(lobes)) = (&parameters, &lobes) {
        let message = format!("[sweep] has both `{}` and `lobe`", family.key());
        lobes.error(message, Some("keep one of them".to_owned()));
    }
    if let Some(lobes) = lobes {
        lobes.list("tables such as { lobe = \"ggx\", alpha = 0.2 }", |item| {
            let table = item.table()?;
            let title = ("the lobe".to_owned(), "[material]");
            let (_, lobe) = Reader::read(reader.log(), title, item.span(), Some(table), read_lobe);
            Some(lobe)
        })
    } else if let Some(parameters) = parameters {
        let widths = parameters.list("numbers", |item| family.parameter(item));
        widths.into_iter().map(|width| family.lobe(width)).collect()
    } else {
        vec![material.lobe]
    }
}
