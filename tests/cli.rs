//! The command line: exit codes, messages, what scripts read.

mod common;

use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use common::{output, repository, wrinkle};
use serde_json::Value;

/// A spec that runs in no time.
const TINY: &str = r#"
[image]
width = 8
height = 6
[reference]
spp = 4
replicates = 2
[sweep]
texture = ["t"]
method = ["averaged"]
spp = [1]
texels_per_pixel = [2.0]
[texture.t]
pattern = "waves"
width = 8
height = 8
"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("tiny.toml"), TINY).unwrap();
    folder
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Runs it, expects this exit code and nothing on standard output, and gives the message.
fn refused(folder: &Path, args: &[&str], code: i32) -> String {
    let output = output(folder, args);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {}", err(&output));
    assert_eq!(out(&output), "", "{args:?}");
    let message = err(&output);
    assert!(message.starts_with("error: "), "{message}");
    assert!(!message.contains("panicked"), "{message}");
    message
}

#[test]
fn help_is_the_manual() {
    let help = |args: &[&str]| out(&output(repository(), args));
    insta::assert_snapshot!("help", help(&["--help"]));
    for command in ["run", "merge", "verify", "list", "render", "lobes", "compare", "fit", "bake"] {
        let text = help(&[command, "--help"]);
        assert!(text.contains("Examples:"), "{command} has no example");
        insta::assert_snapshot!(format!("help_{command}"), text);
    }
}

#[test]
fn without_arguments_it_helps() {
    let output = output(repository(), &[]);
    assert_eq!(output.status.code(), Some(0));
    assert!(out(&output).contains("Usage: wrinkle"));
}

#[test]
fn a_run_tells_its_answer_or_its_json() {
    let folder = folder();
    let done = output(folder.path(), &["run", "tiny.toml"]);
    assert_eq!((done.status.code(), err(&done)), (Some(0), String::new()));
    let said = out(&done);
    assert!(said.starts_with("tiny: 1 trial of 1 scene in "), "{said}");
    assert!(said.ends_with("Report: reports/tiny/report.html\n"), "{said}");
    assert!(!said.contains('\u{1b}'), "no colour where nobody sees it");

    let done = output(folder.path(), &["run", "tiny.toml", "--json"]);
    let json: Value = serde_json::from_slice(&done.stdout).expect("JSON and nothing else");
    let experiment = &json["experiments"][0];
    assert_eq!(experiment["name"], "tiny");
    assert_eq!((&experiment["scenes"], &experiment["trials"]), (&1.into(), &1.into()));
    assert!(experiment["seconds"].is_f64());
    for file in experiment["files"].as_array().unwrap() {
        assert!(folder.path().join(file.as_str().unwrap()).is_file(), "{file}");
    }
}

#[test]
fn experiments_that_are_not_there_are_named_with_the_nearest() {
    let message = refused(repository(), &["run", "quik", "nosuch"], 2);
    assert!(message.contains("no experiment `quik`; did you mean `quick`? (known: "), "{message}");
    assert!(message.contains("no experiment `nosuch` (known: "), "{message}");
    let message = refused(repository(), &["run", "no/such.toml"], 2);
    assert_eq!(message, "error: there is no experiment file no/such.toml\n");
    let message = refused(folder().path(), &["run", "quick"], 2);
    assert!(message.contains("no folder experiments/"), "{message}");
    let message = refused(repository(), &["run", "quick", "experiments/quick.toml"], 2);
    assert!(message.contains("two experiments are named `quick`"), "{message}");
}

#[test]
fn every_error_of_a_spec_is_told_and_nothing_is_written() {
    let folder = folder();
    let wrong = TINY.replace("width = 8\nheight = 6", "widht = 8\nheight = -6");
    fs::write(folder.path().join("wrong.toml"), wrong).unwrap();
    let message = refused(folder.path(), &["run", "tiny.toml", "wrong.toml"], 2);
    assert!(message.starts_with("error: wrong.toml:3:1: unknown key `widht`"), "{message}");
    assert!(message.contains("wrong.toml:4:10: ") && message.contains("2 errors"), "{message}");
    assert!(!folder.path().join("reports").exists());
}

#[test]
fn a_bad_texture_file_is_named_before_any_work() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let png = fs::read(repository().join("data/bricks.png")).unwrap();
    fs::write(at("cut.png"), &png[..2000]).unwrap();
    fs::write(at("empty.png"), b"").unwrap();
    fs::write(at("text.png"), b"not a picture").unwrap();
    for (file, why) in [("cut", "cut short"), ("empty", "is empty"), ("text", "not an image")] {
        let spec = TINY.replace("pattern = \"waves\"\nwidth = 8\nheight = 8", "");
        fs::write(at("bad.toml"), format!("{spec}\nfile = \"{file}.png\"\n")).unwrap();
        let message = refused(folder.path(), &["run", "bad.toml"], 2);
        assert!(message.contains(&format!("{file}.png: ")) && message.contains(why), "{message}");
        let name = format!("{file}.png");
        let message = refused(folder.path(), &["render", &name, "--out", "o.png"], 2);
        assert!(message.contains(why), "{message}");
        assert!(!at("o.png").exists());
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = folder();
    fs::write(folder.path().join("file"), b"").unwrap();
    let message = refused(folder.path(), &["run", "tiny.toml", "--out", "file"], 1);
    assert!(message.contains("cannot write file/tiny"), "{message}");
    assert!(message.contains("--out"), "{message}");
}

#[test]
fn two_runs_do_not_share_a_folder() {
    let folder = folder();
    let results = folder.path().join("reports/tiny");
    let held = wrinkle::experiment::lock::Lock::take(&results).unwrap();
    let message = refused(folder.path(), &["run", "tiny.toml"], 1);
    assert!(message.contains("another run is writing to reports/tiny"), "{message}");
    drop(held);
    assert!(output(folder.path(), &["run", "tiny.toml"]).status.success());
}

#[test]
fn numbers_out_of_range_are_refused() {
    let folder = folder();
    for args in [
        ["run", "tiny.toml", "--threads", "0"],
        ["run", "tiny.toml", "--threads", "abc"],
        ["render", "tiny.toml", "--out=o.png", "--spp=0"],
        ["render", "tiny.toml", "--out=o.png", "--size=8y6"],
        ["render", "tiny.toml", "--out=o.png", "--exposure=-1"],
        ["render", "tiny.toml", "--out=o.png", "--exposure=nan"],
        ["render", "tiny.toml", "--out=o.png", "--texels-per-pixel=-3"],
        ["render", "tiny.toml", "--out=o.png", "--texels-per-pixel=nan"],
        ["render", "tiny.toml", "--out=o.png", "--height-scale=nan"],
    ] {
        refused(folder.path(), &args, 2);
    }
}

#[test]
fn render_writes_the_image_and_names_it() {
    let folder = folder();
    for name in ["o.png", "o.exr"] {
        let done = output(folder.path(), &["render", "tiny.toml", "--out", name]);
        assert_eq!((done.status.code(), out(&done)), (Some(0), format!("{name}\n")));
        assert!(folder.path().join(name).is_file());
    }
    // A map of the user's own, through the slowest filter.
    let map = repository().join("data/bricks.png");
    image::open(&map).unwrap().crop_imm(3, 5, 5, 3).save(folder.path().join("odd.png")).unwrap();
    let args = ["render", "odd.png", "--method", "fournier", "--size", "9x7", "--out", "o.png"];
    assert!(output(folder.path(), &args).status.success());
    let picture = image::open(folder.path().join("o.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (9, 7));
}

#[test]
fn render_puts_bumps_on_any_surface_and_lets_them_move() {
    let folder = folder();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    fs::write(folder.path().join("triangle.obj"), triangle).unwrap();
    let render = |args: &[&str]| {
        let done = output(folder.path(), &[&["render"], args].concat());
        assert_eq!(done.status.code(), Some(0), "{args:?}: {}", err(&done));
    };
    let film = |name: &str| {
        let stored = wrinkle::render::read_image(&folder.path().join(name)).unwrap();
        stored.channels[0].pixels().to_vec()
    };
    let lit = |name: &str| film(name).iter().filter(|radiance| **radiance > 0.0).count();
    for shape in ["teapot", "cylinder", "triangle.obj"] {
        render(&["tiny.toml", "--shape", shape, "--size", "40x30", "--out", "o.exr"]);
        assert!((1..1200).contains(&lit("o.exr")), "{shape}: {} pixels lit", lit("o.exr"));
    }
    // A setting changes what the experiment says, a pattern is a texture.
    render(&["tiny.toml", "--set", "light.irradiance=3", "--out", "bright.exr"]);
    render(&["tiny.toml", "--out", "as-it-is.exr"]);
    for (bright, usual) in film("bright.exr").iter().zip(&film("as-it-is.exr")) {
        assert!((bright - 3.0 * usual).abs() <= 1e-5 * bright, "{bright} {usual}");
    }
    let words = ["letters", "--set", "texture.letters.text=AB", "--size", "9x7", "--out", "o.png"];
    render(&words);

    let turning = ["--animate", "--set", "motion.frames=3", "--out", "turning.png"];
    render(&[&["tiny.toml", "--shape", "sphere"], &turning[..]].concat());
    let file = std::io::BufReader::new(fs::File::open(folder.path().join("turning.png")).unwrap());
    let frames = image::codecs::png::PngDecoder::new(file).unwrap().apng().unwrap();
    let frames = image::AnimationDecoder::into_frames(frames).collect_frames().unwrap();
    assert_eq!(frames.len(), 3);
    assert_ne!(frames[0].buffer(), frames[1].buffer());

    let wrong = |args: &[&str]| {
        refused(folder.path(), &[&["render", "tiny.toml", "--out", "o.png"], args].concat(), 2)
    };
    assert!(wrong(&["--shape", "teapto"]).contains("did you mean \"teapot\"?"));
    assert!(wrong(&["--shape", "gone.glb"]).contains("there is no file gone.glb"));
    let message = wrong(&["--set", "camera.elevatoin=3"]);
    assert!(message.contains("camera.elevatoin=3: unknown key"), "{message}");
    assert!(wrong(&["--set", "elevation"]).contains("KEY=VALUE"));
    assert!(wrong(&["--animate", "--set", "motion.frames=1"]).contains("motion.frames=1: "));
    let huge = ["--animate", "--set", "motion.frames=500", "--size", "4000x4000"];
    assert!(wrong(&huge).contains("lower --size"));
    let exr = ["render", "tiny.toml", "--animate", "--out", "o.exr"];
    assert!(refused(folder.path(), &exr, 2).contains("--animate writes PNG"));
}

#[test]
fn render_tells_what_there_is_instead() {
    let folder = folder();
    let render = |args: &[&str]| {
        let all = [&["render", "tiny.toml", "--out", "o.png"], args].concat();
        refused(folder.path(), &all, 2)
    };
    let message = render(&["--method", "fournir"]);
    assert!(message.contains("did you mean `fournier`? (known: unfiltered, "), "{message}");
    let message = render(&["--texture", "tt"]);
    assert!(message.contains("no texture `tt`; did you mean `t`? (known: t)"), "{message}");
    let wrong_out = |out: &str| refused(folder.path(), &["render", "tiny.toml", "--out", out], 2);
    assert!(wrong_out("o.jpg").contains("name it .png or .exr"));
    assert!(wrong_out("no/o.png").contains("there is no folder no"));
    let message = refused(folder.path(), &["render", "no.png", "--out", "o.png"], 2);
    assert_eq!(message, "error: there is no file no.png\n");
}

#[test]
fn compare_scores_and_holds_to_limits() {
    let folder = folder();
    for (method, name) in [("averaged", "a.exr"), ("unfiltered", "b.exr"), ("averaged", "a.png")] {
        let args = ["render", "tiny.toml", "--method", method, "--out", name];
        assert!(output(folder.path(), &args).status.success());
    }
    let compare = |args: &[&str]| output(folder.path(), &[&["compare"], args].concat());
    let same = compare(&["a.exr", "a.exr", "--json", "--fail-above", "rmse=0"]);
    assert_eq!(same.status.code(), Some(0));
    let scores: Value = serde_json::from_slice(&same.stdout).unwrap();
    assert_eq!((&scores["rmse"], &scores["energy"]), (&0.0.into(), &1.0.into()));
    let differ = compare(&["b.exr", "a.exr", "--fail-above", "rmse=0", "--fail-above", "ssim=2"]);
    assert_eq!(differ.status.code(), Some(1));
    assert!(err(&differ).starts_with("rmse is ") && err(&differ).contains(": above 0 by "));
    assert!(out(&differ).starts_with("rmse "));

    let wrong = |args: &[&str]| refused(folder.path(), &[&["compare"], args].concat(), 2);
    assert!(wrong(&["a.exr", "a.png"]).contains("compare like with like"));
    assert!(wrong(&["a.exr", "no.exr"]).contains("no.exr: cannot read"));
    assert!(wrong(&["a.exr", "tiny.toml"]).contains("tiny.toml: "));
    let message = wrong(&["a.exr", "a.exr", "--fail-above", "rms=1"]);
    assert!(message.contains("no metric `rms`; did you mean `rmse`?"), "{message}");
    let size = ["render", "tiny.toml", "--size", "9x7", "--out", "big.exr"];
    assert!(output(folder.path(), &size).status.success());
    assert!(wrong(&["a.exr", "big.exr"]).contains("8 × 6 pixels"));
}

#[test]
fn list_knows_everything_by_name() {
    let text = out(&output(repository(), &["list"]));
    let json: Value =
        serde_json::from_slice(&output(repository(), &["list", "--json"]).stdout).unwrap();
    for kind in ["methods", "patterns", "surfaces", "environments", "multiple_surfaces"] {
        for entry in json[kind].as_array().unwrap() {
            assert!(text.contains(entry["name"].as_str().unwrap()), "{entry}");
            assert!(!entry["summary"].as_str().unwrap().is_empty(), "{entry}");
        }
    }
    assert!(json["experiments"].as_array().unwrap().contains(&"quick".into()));
}

#[test]
fn colour_is_for_those_who_want_it() {
    let says = |variable: &str| {
        let mut list = wrinkle(repository(), &["list"]);
        out(&list.env(variable, "1").output().unwrap())
    };
    assert!(says("CLICOLOR_FORCE").contains('\u{1b}'));
    assert!(!says("NO_COLOR").contains('\u{1b}'));
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let mut list = wrinkle(repository(), &["list", "--json"]);
    let mut list = list.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(list.stdout.take());
    let done = list.wait_with_output().unwrap();
    assert_eq!((done.status.code(), err(&done)), (Some(0), String::new()));
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_a_failure() {
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    let done = wrinkle(repository(), &["list"]).stdout(full).output().unwrap();
    assert_eq!(done.status.code(), Some(1));
    assert!(err(&done).starts_with("error: cannot write to standard output"), "{}", err(&done));
}

#[test]
fn a_multiple_surface_is_drawn_and_its_json_is_a_surface_again() {
    let folder = folder();
    let json = out(&output(folder.path(), &["lobes", "silk", "--json", "--incidence=-20,75"]));
    let found: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(found["peaks"].as_array().unwrap().len(), 13);
    assert_eq!(found["plots"][1]["azimuth"], 90.0);
    assert_eq!(found["plots"][1]["reflections"][0]["incidence"], -20.0);
    assert_eq!(found["plots"][1]["reflections"][0]["exits"].as_array().unwrap().len(), 361);
    fs::write(folder.path().join("mine.json"), &json).unwrap();
    let again = out(&output(folder.path(), &["lobes", "mine.json", "--json", "--out", "l.png"]));
    let again: Value = serde_json::from_str(&again).unwrap();
    assert_eq!((&again["peaks"], &again["surface"]), (&found["peaks"], &"mine".into()));
    assert!(image::open(folder.path().join("l.png")).unwrap().width() > 1000);
    for (name, shape) in [("velvet", "sphere"), ("mine.json", "plane")] {
        let args = ["render", name, "--shape", shape, "--size", "9x7", "--out", "o.png"];
        assert_eq!(out(&output(folder.path(), &args)), "o.png\n");
        let image = image::open(folder.path().join("o.png")).unwrap();
        assert_eq!((image.width(), image.height()), (9, 7));
    }
}

#[test]
fn a_wrong_multiple_surface_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("bad.json"), "{\"peaks\": 7}").unwrap();
    for (args, says) in [
        (&["lobes", "velvt", "--json"][..], "did you mean `velvet`?"),
        (&["lobes", "bad.json", "--json"], "bad.json: invalid type"),
        (&["lobes", "no.json", "--json"], "cannot read no.json"),
        (&["lobes", "velvet", "--out", "o.exr"], "name it .png"),
        (&["lobes", "velvet", "--out", "no/o.png"], "there is no folder no"),
        (&["lobes", "velvet"], "--out <IMAGE>"),
        (&["lobes", "velvet", "--json", "--incidence=90"], "below 90"),
        (&["lobes", "velvet", "--json", "--incidence=1,2,3,4,5,6,7,8"], "at most 7"),
        (&["lobes", "velvet", "--json", "--azimuth=nan"], "from -360 to 360"),
        (&["render", "bad.json", "--out", "o.png"], "bad.json: invalid type"),
        (&["render", "silk", "--method", "lean", "--out", "o.png"], "leave out --method"),
        (&["render", "silk", "--shape", "teapot", "--out", "o.png"], "a sphere or a plane"),
        (&["render", "silk", "--set", "seed=3", "--out", "o.png"], "leave out --set"),
    ] {
        let message = refused(folder.path(), args, 2);
        assert!(message.contains(says), "{args:?}: {message}");
    }
    assert!(!folder.path().join("o.png").exists());
}

#[test]
fn a_baked_map_is_one_that_can_be_rendered_and_is_the_same_every_time() {
    let folder = folder();
    let bake = |name: &str| {
        let args = ["bake", "ggx:0.2,0.5,30", "--size", "48x32", "--cells", "4", "--out", name];
        output(folder.path(), &args)
    };
    let said = bake("a.png");
    assert_eq!(said.status.code(), Some(0), "{}", err(&said));
    assert!(out(&said).starts_with("a.png: 48x32, 3 octaves; "), "{}", out(&said));
    assert_eq!(bake("b.png").status.code(), Some(0));
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(bytes("a.png"), bytes("b.png"));
    let like =
        ["bake", "--like", "a.png", "--size", "16x16", "--cells", "2", "--out", "c.exr", "--json"];
    let said: Value = serde_json::from_str(&out(&output(folder.path(), &like))).unwrap();
    assert_eq!(said["width"], 16);
    let render = ["render", "c.exr", "--out", "look.png", "--size", "8x8"];
    assert_eq!(output(folder.path(), &render).status.code(), Some(0));
}

#[test]
fn detail_is_laid_onto_a_map_and_a_distribution_is_written_to_be_read_back() {
    let folder = folder();
    let bake = |args: &str| {
        let args: Vec<&str> = std::iter::once("bake").chain(args.split(' ')).collect();
        let said = output(folder.path(), &args);
        assert_eq!(said.status.code(), Some(0), "{}", err(&said));
        out(&said)
    };
    bake("ggx:0.3 --size 31x20 --cells 4 --green down --out map.png");
    let said = bake("--onto map.png --map-green down --green down --amount 0 --out same.png");
    assert!(
        said.starts_with("same.png: 31x20, 1 octave of amount 0 onto map.png (31x20)"),
        "{said}"
    );
    // What is lost is far less than a code of 16 bits, but may cross the middle between two.
    let codes = |name: &str| image::open(folder.path().join(name)).unwrap().into_rgb16().into_raw();
    let (map, same) = (codes("map.png"), codes("same.png"));
    assert!(map.iter().zip(&same).all(|(a, b)| a.abs_diff(*b) <= 1));
    let said = bake("ggx:0.1 --onto map.png --size 93x60 --out finer.exr --ndf-out ndf.exr --json");
    let said: Value = serde_json::from_str(&said).unwrap();
    assert_eq!((&said["width"], &said["onto"]["width"]), (&93.into(), &31.into()));
    let tilts =
        ["rms_tilt_degrees", "rms_tilt_with_detail_degrees"].map(|key| said["onto"][key].as_f64());
    assert!(tilts[0].unwrap() > 1.0 && tilts[1] > tilts[0], "{said}");
    assert!(said["onto"]["rms_missed_degrees"].as_f64().unwrap() < 1e-3);
    assert_eq!(bake("--like map.png --ndf-out alone.png"), "alone.png: the distribution\n");
    bake("alone.png --size 16x16 --cells 2 --out again.png");
    for (args, says) in [
        (
            &["bake", "--onto", "map.png", "--size", "30x20", "--out", "x.png"][..],
            "it has 31x20 texels",
        ),
        (&["bake", "--onto", "none.png", "--out", "x.png"], "none.png: there is no such file"),
        (&["bake", "ggx:0.3", "--kind", "height", "--out", "x.png"], "--like"),
        (&["bake", "ggx:0.3", "--amount", "1", "--out", "x.png"], "--onto"),
        (&["bake", "--onto", "map.png", "--amount", "nan", "--out", "x.png"], "from 0 to 8"),
        (&["bake", "ggx:0.3"], "--out"),
        (
            &["bake", "ggx:0.3", "--out", "x.png", "--ndf-out", "none/x.png"],
            "there is no folder none",
        ),
    ] {
        let message = refused(folder.path(), args, 2);
        assert!(message.contains(says), "{args:?}: {message}");
    }
    assert!(!folder.path().join("x.png").exists());
}

#[test]
fn what_is_no_distribution_is_told_with_its_place() {
    let folder = folder();
    let image = |name: &str, value: fn(u32, u32) -> u16| {
        let pixel = |x, y| image::Luma([value(x, y)]);
        image::ImageBuffer::from_fn(16, 16, pixel).save(folder.path().join(name)).unwrap();
    };
    image("black.png", |_, _| 0);
    image("white.png", |_, _| 900);
    let bake = |ndf: &str| refused(folder.path(), &["bake", ndf, "--out", "x.png"], 2);
    assert!(bake("black.png").contains("black.png: all of it is 0"));
    assert!(bake("white.png").contains("outside of the unit disc, first at pixel (0, 0)"));
    assert!(bake("tiny.toml").contains("tiny.toml"));
    assert!(bake("nothing.png").contains("there is no file nothing.png"));
    assert!(bake("beckmann:7").contains("a roughness α is from 0.02 to 2"));
    let huge = ["bake", "beckmann:0.3", "--size", "16384x16384", "--out", "x.png"];
    assert!(refused(folder.path(), &huge, 2).contains("texels are more than"));
    assert!(!folder.path().join("x.png").exists());
}
