//! Specs that are right, and the manual. `tests/spec_errors.rs` has those that are wrong.

use std::collections::BTreeSet;
use std::path::Path;

use proptest::prelude::*;

use super::*;
use crate::lobe::BaseLobe;
use crate::parameter::{Domain, Parameter, Values};
use crate::pattern::baked::{Ground, NdfSource};
use crate::pattern::{self, Bumps};
use crate::surface::Perturbation;
use crate::texture::{Interpolation, NormalMap, Wrap};

/// A pattern `ribs` with one option of each kind, and the program's methods.
fn catalogue() -> Catalogue {
    const PARAMETERS: &[Parameter] = &[
        Parameter {
            name: "depth",
            meaning: "",
            domain: Domain::Real { default: 0.5, min: 0.0, max: 2.0 },
        },
        Parameter {
            name: "count",
            meaning: "",
            domain: Domain::Whole { default: 4, min: 1, max: 9 },
        },
        Parameter {
            name: "profile",
            meaning: "",
            domain: Domain::Choice { words: &["round", "square"] },
        },
    ];
    let card = pattern::Card { name: "ribs", source: "", summary: "" };
    let build = |width, height, _: &Values, _| Bumps {
        normals: NormalMap::from_fn(width, height, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]),
        heights: None,
        notes: Vec::new(),
    };
    let patterns = vec![pattern::Entry { card, parameters: PARAMETERS, build }];
    Catalogue { patterns, ..Catalogue::all() }
}

fn parse(text: &str) -> Result<Spec, SpecErrors> {
    let path = Path::new("experiments/ribbed.toml");
    Spec::parse_with(&catalogue(), &Log::new(path, text), text)
}

const SMALLEST: &str = "[sweep]\ntexture = [\"ribs\"]\nmethod = [\"averaged\"]\n";

#[test]
fn everything_but_textures_and_methods_has_a_default() {
    let spec = parse(SMALLEST).unwrap();
    assert_eq!((spec.name.as_str(), spec.title.as_str(), spec.seed), ("ribbed", "ribbed", 1));
    assert_eq!(spec.image, ImageSpec { width: 160, height: 120 });
    let (axes, perturbation) = (AxesSpec::Natural, Perturbation::Tangent);
    let plane = SurfaceSpec { shape: Shape::Plane, axes, perturbation, model: None };
    assert_eq!(spec.surface, plane);
    let target = [0.0; 3];
    let camera = CameraSpec { elevation: 40.0, azimuth: -90.0, fov: 25.0, distance: 4.0, target };
    assert_eq!(spec.camera, camera);
    let light = LightSpec::Directional { elevation: 40.0, azimuth: 90.0, irradiance: 1.0 };
    assert_eq!(spec.light, light);
    assert_eq!(spec.shading, Shading::Ndf);
    assert_eq!(
        spec.reference,
        ReferenceSpec { spp: 4096, replicates: 4, most: 16384, gap: 0.01, truth: Truth::Bumps }
    );
    assert_eq!(spec.sweep.spp, [1, 4, 16, 64]);
    assert_eq!(spec.sweep.unfiltered_spp, [1, 4, 16, 64, 256]);
    assert_eq!(spec.sweep.scale, Scale::TexelsPerPixel(vec![1.0, 4.0, 16.0, 64.0]));
    assert_eq!(spec.sweep.lobes, [BaseLobe::BlinnPhong { exponent: 60.0 }]);
    assert_eq!(spec.text, SMALLEST);
    let TextureSource::Pattern { name, width, height, values, seed } =
        &spec.sweep.textures[0].source
    else {
        panic!("a pattern")
    };
    assert_eq!((*name, *width, *height, *seed, values.whole("count")), ("ribs", 128, 128, 1, 4));
}

const RICH: &str = r#"
seed = 7
[surface]
shape = "sphere"
tiles = 4
[light]
kind = "point"
position = [0, 3.5, 1]
[material]
lobe = "ggx"
shading = "microfacet"
[sweep]
texture = ["ribs", "fine", "cast"]
method = ["unfiltered", "smooth"]
spp = [16, 1]
unfiltered_spp = [1, 64]
distance = [2, 4.5]
alpha = [0.1, 0.3]
[texture.fine]
pattern = "ribs"
width = 64
depth = 1
profile = "square"
[texture.cast]
file = "../Cargo.toml"
kind = "height"
height_scale = -2
wrap = "clamp"
interpolation = "nearest"
[method.smooth]
use = "averaged"
"#;

#[test]
fn a_rich_spec_is_read_as_written() {
    let spec = parse(RICH).unwrap();
    assert_eq!(spec.light, LightSpec::Point { position: [0.0, 3.5, 1.0], intensity: 1.0 });
    let SweepSpec { textures, methods, spp, unfiltered_spp, scale, elevations, lobes } =
        &spec.sweep;
    assert_eq!(elevations, &[spec.camera.elevation]);
    assert_eq!(
        (spp.as_slice(), unfiltered_spp.as_slice()),
        ([1, 16].as_slice(), [1, 64].as_slice())
    );
    assert_eq!(*scale, Scale::Distance { distances: vec![2.0, 4.5], tiles: 4.0 });
    assert_eq!(*lobes, [0.1, 0.3].map(|alpha| BaseLobe::Ggx { alpha }));
    let TextureSource::Pattern { width, height, values, seed, .. } = &textures[1].source else {
        panic!("a pattern")
    };
    assert_eq!((*width, *height, *seed), (64, 128, 7));
    assert_eq!((values.number("depth"), values.word("profile")), (1.0, "square"));
    let TextureSource::File { path, written, reading } = &textures[2].source else {
        panic!("a file")
    };
    assert_eq!(
        (path.as_path(), written.as_str()),
        (Path::new("experiments/../Cargo.toml"), "../Cargo.toml")
    );
    assert_eq!(*reading, Reading::Height { scale: -2.0 });
    assert_eq!(textures[2].wrap, Wrap::Clamp);
    assert_eq!(textures[2].interpolation, Interpolation::Nearest);
    assert_eq!((methods[1].label.as_str(), methods[1].name), ("smooth", "averaged"));
    assert_eq!(spec.sweep.spp_of(&methods[0]), [1, 64]);
    assert_eq!(spec.sweep.spp_of(&methods[1]), [1, 16]);
}

#[test]
fn lobes_of_several_families_can_be_swept() {
    let text =
        format!("{SMALLEST}lobe = [{{ alpha = 0.3, lobe = \"ggx\" }}, {{ exponent = 9 }}]\n");
    let lobes = [BaseLobe::Ggx { alpha: 0.3 }, BaseLobe::BlinnPhong { exponent: 9.0 }];
    assert_eq!(parse(&text).unwrap().sweep.lobes, lobes);
}

#[test]
fn an_environment_is_a_map_or_a_file() {
    let light = |more: &str| {
        parse(&format!("{SMALLEST}[light]\nkind = \"environment\"\n{more}")).unwrap().light
    };
    let LightSpec::Environment { source, rotation, intensity, filter } =
        light("map = \"moon\"\nelevation = -5\nwidth = 33\nrotation = 30\nfilter = \"round\"\n")
    else {
        panic!("an environment")
    };
    assert_eq!((rotation, intensity, filter), (30.0, 1.0, crate::light::Filter::Round));
    let EnvironmentSource::Map { name, width, values } = source else { panic!("a map") };
    assert_eq!((name, width, values.number("elevation")), ("moon", 32, -5.0));
    let LightSpec::Environment { source, .. } = light("file = \"../Cargo.toml\"\n") else {
        panic!("an environment")
    };
    assert_eq!(source, EnvironmentSource::File { path: "experiments/../Cargo.toml".into() });
}

#[test]
fn nothing_moves_unless_it_is_told_to() {
    assert_eq!(parse(SMALLEST).unwrap().motion, None);
    let motion =
        |more: &str| parse(&format!("{SMALLEST}[motion]\n{more}")).unwrap().motion.unwrap();
    let turn = MotionKind::Rotate { degrees: 60.0 };
    assert_eq!(motion(""), MotionSpec { kind: turn, frames: 24, fps: 12 });
    let away = motion("kind = \"recede\"\nto = 32\nframes = 4\nfps = 3\n");
    let kind = MotionKind::Distance { from: 4.0, to: 32.0 };
    assert_eq!(away, MotionSpec { kind, frames: 4, fps: 3 });
}

#[test]
fn facets_mirror_all_light_unless_they_have_an_index() {
    use crate::lobe::intensity::Fresnel;
    let shading = |more: &str| {
        let text = format!("{SMALLEST}[material]\nshading = \"torrance-sparrow\"\n{more}");
        parse(&text).unwrap().shading
    };
    assert_eq!(shading(""), Shading::TorranceSparrow(Fresnel::Mirror));
    assert_eq!(shading("index = 1.5\n"), Shading::TorranceSparrow(Fresnel::Index(1.5)));
}

#[test]
fn what_contradicts_itself_is_an_error() {
    for (more, message) in [
        ("distance = [1]\n", "a sweep over `distance` needs the key `tiles` in [surface]"),
        ("[surface]\ntiles = 3\n", "`tiles` has no effect: the sweep chooses the tiling"),
        ("exponent = [3]\nlobe = [{}]\n", "[sweep] has both `exponent` and `lobe`"),
        ("alpha = [0.2]\n", "unknown key `alpha` in [sweep]"),
        (
            "unfiltered_spp = [1]\n",
            "`unfiltered_spp` has no effect: no method of the sweep is `unfiltered`",
        ),
        ("spp = [8192]\n", "8192 samples a pixel are more than the reference's 4096"),
        (
            "[surface]\nshape = \"sphere\"\n[light]\nkind = \"point\"\nposition = [0, 0, 1]\n",
            "`position` is inside the sphere of radius 1",
        ),
        (
            "[light]\nkind = \"point\"\nposition = [0, 0, -1]\n",
            "`position` is not above the plane: z is -1",
        ),
        (
            "[light]\nkind = \"point\"\nposition = [0, 0]\n",
            "`position` must be three numbers, [x, y, z], not a list",
        ),
        (
            "[texture.x]\npattern = \"ribs\"\ncount = 10\n",
            "`count` must be a whole number from 1 to 9, not 10",
        ),
        (
            "[texture.x]\npattern = \"ribs\"\nprofile = \"flat\"\n",
            "`profile` must be \"round\" or \"square\", not \"flat\"",
        ),
        ("[light]\nkind = \"environment\"\nmap = \"mon\"\n", "unknown environment \"mon\""),
        (
            "[light]\nkind = \"environment\"\nmap = \"moon\"\nfile = \"../Cargo.toml\"\n",
            "[light] has both `map` and `file`",
        ),
        (
            "[light]\nkind = \"environment\"\nfile = \"none.exr\"\n",
            "there is no file experiments/none.exr",
        ),
        ("[light]\nkind = \"environment\"\nrun = \"level\"\n", "unknown key `run` in [light]"),
        (
            "[light]\nkind = \"environment\"\n[material]\nshading = \"microfacet\"\n",
            "facets mirror an environment with shading \"ndf\" only",
        ),
        (
            "[light]\nkind = \"environment\"\n[reference]\ntruth = \"relief\"\n",
            "under an environment the truth is \"bumps\" only: what heights hide of it is not known",
        ),
        (
            "[light]\nkind = \"environment\"\n[method.dark]\nuse = \"unfiltered\"\nshadowing = \"printed\"\n",
            "[method.dark] looks for shadows, which an environment does not cast",
        ),
        (
            "[motion]\nkind = \"approach\"\n",
            "[motion] needs the key `to`: the camera's distance in the last frame",
        ),
        (
            "[motion]\nkind = \"approach\"\nto = 4\n",
            "to approach from 4, `to` must be less than that, not 4",
        ),
        (
            "[motion]\nkind = \"recede\"\nfrom = 3\nto = 2\n",
            "to recede from 3, `to` must be more than that, not 2",
        ),
        (
            "[material]\nlobe = \"ggx\"\nshading = \"phong\"\n",
            "Phong's highlight has an exponent, and this lobe has none",
        ),
        ("[material]\nindex = 1.5\n", "unknown key `index` in [material]"),
        ("[motion]\nframes = 1\n", "`frames` must be a whole number from 2 to 500, not 1"),
        ("[motion]\nto = 2\n", "unknown key `to` in [motion]"),
        (
            "distance = [3]\n[surface]\ntiles = 3\n[motion]\nkind = \"recede\"\nto = 8\n",
            "`distance` has no effect: [motion] moves the camera",
        ),
        ("[texture.x]\npattern = \"ribs\"\ngreen = \"up\"\n", "unknown key `green` in [texture.x]"),
        ("[texture.x]\npattern = \"rib\"\ncount = 3\n", "unknown pattern \"rib\""),
    ] {
        let error = parse(&format!("{SMALLEST}{more}")).expect_err(message);
        let messages: Vec<&str> = error.errors().iter().map(|e| e.message.as_str()).collect();
        assert_eq!(messages, [message], "{more}");
    }
}

#[test]
fn the_manual_names_every_key_under_its_heading() {
    let mut keys = BTreeSet::new();
    let normal_file = "[texture.x]\nfile = \"../Cargo.toml\"\nkind = \"normal\"\n";
    let around = "[light]\nkind = \"environment\"\n";
    let turning = "[motion]\nkind = \"drift\"\n";
    let coming = "[motion]\nkind = \"approach\"\nto = 2\n";
    let grooves = "[material]\nshading = \"torrance-sparrow\"\n";
    let of_words = "[texture.x]\nndf = \"ggx:0.2\"\n";
    let onto = "[texture.x]\nonto = \"../Cargo.toml\"\n";
    for more in ["", normal_file, around, turning, coming, grooves, of_words, onto] {
        let text = format!("{SMALLEST}{more}");
        let log = Log::new(Path::new("experiments/ribbed.toml"), &text);
        Spec::parse_with(&catalogue(), &log, &text).unwrap();
        keys.extend(log.keys());
    }
    let log = Log::new(Path::new("experiments/ribbed.toml"), RICH);
    Spec::parse_with(&catalogue(), &log, RICH).unwrap();
    keys.extend(log.keys());
    assert!(keys.len() > 40, "the readers were asked: {keys:?}");
    let manual = include_str!("../../../docs/experiments.md");
    for (heading, key) in keys {
        let section = manual.split("\n## ").find(|section| section.starts_with(heading));
        let section = section.unwrap_or_else(|| panic!("the manual has no section {heading}"));
        let rows = section.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
        let found = rows.into_iter().any(|keys| keys.contains(&format!("`{key}`")));
        assert!(found, "the manual has no row for `{key}` under {heading}");
    }
}

#[test]
fn bumps_are_baked_from_words_from_files_and_onto_maps() {
    let of = |keys: &str| -> Result<TextureSource, SpecErrors> {
        let spec =
            format!("[sweep]\ntexture = [\"x\"]\nmethod = [\"averaged\"]\n[texture.x]\n{keys}");
        parse(&spec).map(|spec| spec.sweep.textures[0].source.clone())
    };
    let recipe = |keys: &str| match of(keys) {
        Ok(TextureSource::Baked { recipe, written }) => (recipe, written),
        other => panic!("{keys}: {other:?}"),
    };
    let (words, written) = recipe("ndf = \"2*ggx:0.1 + ggx:0.3@20,0\"\nwidth = 64\ncells = 4");
    let Ground::Bare { ndf: NdfSource::Lobes(lobes), size: [64, 128] } = &words.ground else {
        panic!("{words:?}");
    };
    assert_eq!((lobes.len(), words.cells, words.octaves, words.seed), (2, Some(4), None, 1));
    assert!(written.starts_with("baked (ndf = \"2*ggx:0.1"), "{written}");
    let (like, _) = recipe("like = \"../data/denim.png\"\ngreen = \"down\"\noctaves = 2");
    assert_eq!(like.files(), [Path::new("experiments/../data/denim.png")]);
    assert_eq!(like.octaves, Some(2));
    let (onto, written) =
        recipe("onto = \"../data/denim.png\"\nndf = \"velvet\"\namount = 0.25\nseed = 9");
    assert!(written.contains("onto = \"../data/denim.png\""), "{written}");
    let Ground::Onto { ndf: Some(NdfSource::Named("velvet")), amount, size: None, .. } =
        onto.ground
    else {
        panic!("{onto:?}");
    };
    assert_eq!((amount, onto.seed), (0.25, 9));
    for (keys, message) in [
        ("ndf = \"ggx:7\"", "`ndf`: ggx:7: a roughness α is from 0.02 to 2"),
        ("like = \"none.png\"\ngain = 0.6", "there is no file experiments/none.png"),
        ("onto = \"../data/denim.png\"\nwidth = 2048", "`width` and `height` go together"),
        ("ndf = \"silk\"\nlike = \"../data/denim.png\"", "[texture.x] has both `ndf` and `like`"),
        (
            "ndf = \"silk\"\npattern = \"ribs\"",
            "[texture.x] has both bumps and what to bake them from",
        ),
        ("ndf = \"silk\"\namount = 0.5", "unknown key `amount` in [texture.x]"),
        (
            "onto = \"../data/denim.png\"\namount = -1",
            "`amount` must be a number from 0 to 8, not -1",
        ),
    ] {
        let error = of(keys).expect_err(message);
        let messages: Vec<&str> = error.errors().iter().map(|e| e.message.as_str()).collect();
        assert_eq!(messages, [message], "{keys}");
    }
}

#[test]
fn no_option_hides_behind_a_key_of_its_table() {
    let known = Catalogue::all();
    for parameter in crate::light::environment::maps::entries().iter().flat_map(|e| e.parameters) {
        let taken = ["kind", "map", "file", "width", "rotation", "intensity", "filter"];
        assert!(!taken.contains(&parameter.name), "{}", parameter.name);
    }
    for parameter in known.patterns.iter().flat_map(|entry| entry.parameters) {
        let taken = [
            "pattern",
            "file",
            "ndf",
            "like",
            "onto",
            "width",
            "height",
            "seed",
            "wrap",
            "interpolation",
            "repeat",
        ];
        assert!(!taken.contains(&parameter.name), "{}", parameter.name);
    }
    for parameter in known.methods.iter().flat_map(|entry| entry.parameters) {
        assert_ne!(parameter.name, "use");
    }
}

proptest! {
    #[test]
    fn nothing_panics(text in "(\\[(sweep|image|light|texture\\.a|method\\.b)\\]\n|[a-z_]{1,9}|=|\\[|\\]|,| |\n|\"|3|1e9|-1|\\{|\\}|spp|distance|lobe|position){0,60}") {
        let _ = parse(&text);
    }

    #[test]
    fn any_value_under_any_key_is_read_or_refused(
        key in "(title|seed|image|sweep|light|method|texture|texture\\.a|sweep\\.spp|sweep\\.lobe|sweep\\.texture|light\\.position|light\\.kind|motion|motion\\.frames|image\\.width|material\\.lobe|texture\\.a\\.file|texture\\.a\\.ndf|texture\\.a\\.onto|method\\.a\\.use)",
        value in "(3|-3|0x10|9999999999|1.5|inf|nan|true|\"\"|\"x\"|\"ribs\"|\\[\\]|\\[1, 1\\]|\\[\"ribs\"\\]|\\[\\[1\\]\\]|\\{\\}|\\{ a = 1 \\}|\\[\\{\\}, \\{\\}\\]|2020-01-01)",
    ) {
        if let Err(error) = parse(&format!("{key} = {value}\n")) {
            prop_assert!(!error.errors().is_empty());
        }
    }
}
