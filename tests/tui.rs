//! The runner from its start to its end, on a real pseudo-terminal: runs, flips, sizes, signals.
#![cfg(unix)]

mod common;
#[path = "common/pty.rs"]
mod pty;

use std::path::Path;

use pty::{Pty, command};

/// An experiment of a few seconds a scene, even without optimisation; each scale is a scene.
fn spec(width: u32, spp: u32, scales: &str) -> String {
    format!(
        r#"
title = "Tiny"
question = "Does it run?"
seed = 5
[image]
width = {width}
height = 24
[reference]
spp = {spp}
replicates = 2
[sweep]
texture = ["gaussian"]
method = ["unfiltered", "averaged", "toksvig"]
spp = [1]
unfiltered_spp = [1, 4]
texels_per_pixel = [{scales}]
[texture.gaussian]
pattern = "gaussian"
width = 32
height = 32
"#
    )
}

/// A folder with `experiments/tiny.toml`.
fn folder(spec: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("experiments")).unwrap();
    std::fs::write(folder.path().join("experiments/tiny.toml"), spec).unwrap();
    folder
}

fn fast() -> tempfile::TempDir {
    folder(&spec(32, 32, "2.0, 4.0"))
}

/// Long enough to be interrupted, its first pieces done soon.
fn slow() -> tempfile::TempDir {
    folder(&spec(64, 256, "2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 12.0, 16.0"))
}

const PROGRAM: &str = env!("CARGO_BIN_EXE_wrinkle");

/// The runner in a folder, on a terminal of this size.
fn start(folder: &Path, size: [u16; 2]) -> Pty {
    let args = ["tui", "tiny", "--pictures", "half-blocks", "--threads", "1"];
    let pty = Pty::start(command(PROGRAM, &args, folder), size);
    pty.wait_for("Tiny");
    pty
}

/// The same below a shell, which tells how it ended; what is compared afterwards is the terminal's modes of before.
fn below_a_shell(folder: &Path) -> (Pty, String) {
    let line = format!(
        "echo ready; read go; '{PROGRAM}' tui tiny --pictures half-blocks --threads 1; echo \"ended: $?\"; read end"
    );
    let pty = Pty::start(command("sh", &["-c", &line], folder), [100, 30]);
    pty.wait_for("ready");
    let modes = pty.modes();
    pty.send("\n");
    pty.wait_for("Tiny");
    assert_ne!(pty.modes(), modes, "raw mode");
    (pty, modes)
}

fn assert_given_back(pty: &Pty, modes: &str, ended: &str) {
    pty.wait_for(ended);
    assert!(!pty.screen().alternate_screen() && !pty.screen().hide_cursor());
    assert_eq!(pty.screen().mouse_protocol_mode(), vt100::MouseProtocolMode::None);
    assert_eq!(pty.modes(), modes);
}

/// The runner's process below a shell.
fn runner(pty: &Pty) -> u32 {
    let shell = pty.process();
    let told = std::process::Command::new("ps")
        .args(["-o", "pid=", "--ppid", &shell.to_string()])
        .output();
    let children = format!("/proc/{shell}/task/{shell}/children");
    let told = std::fs::read_to_string(children)
        .unwrap_or_else(|_| String::from_utf8_lossy(&told.unwrap().stdout).into_owned());
    told.split_whitespace().next().expect("the shell's child").parse().unwrap()
}

/// Runs the experiment to its end without a terminal.
fn finish(folder: &Path) {
    let output = common::output(folder, &["run", "tiny", "--threads", "1"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn a_run_a_look_and_the_end() {
    let folder = fast();
    let (pty, modes) = below_a_shell(folder.path());
    pty.send("r");
    pty.wait_for("tiny is done");
    assert!(folder.path().join("reports/tiny/report.md").is_file());

    // The results: its scene, an image, another, an error map, pixels as numbers.
    pty.send("R");
    pty.wait_for("a sweep, written");
    pty.send("\r");
    pty.wait_for("A unfiltered 1 spp");
    pty.send("2");
    pty.wait_for("A averaged 1 spp");
    pty.send(" ");
    pty.wait_for("B reference");
    pty.send(" e");
    pty.wait_for("|error|");
    pty.send("ev");
    pty.wait_for("signed error");

    // The lab: the same experiment, live.
    pty.send("Ev");
    pty.wait_for("tiny is open");
    pty.send("2");
    pty.wait_for("A averaged");
    pty.send(" ");
    pty.wait_for("B reference");

    // Another size, one that is too small, and back.
    pty.resize(140, 40);
    pty.wait("a wider frame", |screen| {
        (90..140).any(|column| screen.cell(5, column).is_some_and(|cell| cell.has_contents()))
    });
    pty.resize(40, 10);
    pty.wait_for("The terminal is 40 × 10");
    pty.resize(100, 30);
    pty.wait_for("Methods");
    pty.send("q");
    assert_given_back(&pty, &modes, "ended: 0");
}

#[test]
fn what_the_runner_writes_is_what_the_command_writes() {
    let (one, other) = (fast(), fast());
    let mut pty = start(one.path(), [80, 24]);
    pty.send("r");
    pty.wait_for("tiny is done");
    pty.send("q");
    assert_eq!(pty.exit().exit_code(), 0);
    finish(other.path());
    common::assert_same(&one.path().join("reports/tiny"), &other.path().join("reports/tiny"));
}

/// Waits until a run has kept its first piece.
fn wait_for_a_piece(folder: &Path) {
    let state = folder.join("reports/tiny/.state");
    let end = std::time::Instant::now() + std::time::Duration::from_secs(60);
    let kept = || walk(&state).iter().any(|path| path.extension().is_some_and(|e| e == "json"));
    while !kept() {
        assert!(std::time::Instant::now() < end, "no piece is kept: {:?}", walk(&state));
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
}

/// All files below a folder.
fn walk(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    entries.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
}

#[test]
fn signals_in_mid_run_end_it_in_order_and_the_next_run_goes_on() {
    for (signal, ended) in [("TERM", "ended: 143"), ("HUP", "ended: 129")] {
        let folder = slow();
        let (pty, modes) = below_a_shell(folder.path());
        pty.send("r");
        wait_for_a_piece(folder.path());
        pty::signal(runner(&pty), signal);
        assert_given_back(&pty, &modes, ended);
        // The folder is let go of: a run may begin at once, and takes up what is there.
        assert_goes_on(folder.path());
    }
}

/// Begins the run again and holds that it takes up what was kept.
fn assert_goes_on(folder: &Path) {
    let kept = walk(&folder.join("reports/tiny/.state"));
    let before: Vec<_> = kept.iter().map(|path| (path.clone(), std::fs::read(path).ok())).collect();
    let pty = start(folder, [100, 30]);
    pty.send("r");
    pty.wait_for("▶ tiny");
    pty.send("x");
    pty.wait_for("tiny was halted");
    for (path, bytes) in
        before.iter().filter(|(path, _)| path.extension().is_some_and(|e| e == "json"))
    {
        assert_eq!(std::fs::read(path).ok(), *bytes, "{} was done again", path.display());
    }
}

#[test]
fn a_killed_run_leaves_results_that_the_next_takes_up() {
    let (folder, whole) = (fast(), fast());
    let mut pty = start(folder.path(), [80, 24]);
    pty.send("r");
    wait_for_a_piece(folder.path());
    pty.signal("KILL");
    pty.exit();
    finish(folder.path());
    finish(whole.path());
    common::assert_same(&folder.path().join("reports/tiny"), &whole.path().join("reports/tiny"));
}

#[test]
fn quitting_in_mid_run_asks_first() {
    let folder = slow();
    let mut pty = start(folder.path(), [80, 24]);
    pty.send("r");
    wait_for_a_piece(folder.path());
    pty.send("q");
    pty.wait_for("Quit");
    pty.send("n");
    pty.wait_without("Quit");
    pty.send("qy");
    assert_eq!(pty.exit().exit_code(), 0);
}

#[test]
fn ctrl_z_and_fg() {
    let folder = fast();
    let mut shell = command("bash", &["--norc", "--noprofile", "-i"], folder.path());
    shell.env("PS1", "$ ");
    let pty = Pty::start(shell, [100, 30]);
    pty.wait_for("$");
    pty.send(&format!("'{PROGRAM}' tui tiny --pictures half-blocks\r"));
    pty.wait_for("Tiny");
    pty.send("\x1a");
    pty.wait_for("Stopped");
    assert!(!pty.screen().alternate_screen() && !pty.screen().hide_cursor());
    pty.send("fg\r");
    pty.wait("everything drawn again", |screen| {
        screen.alternate_screen() && screen.contents().contains("Tiny")
    });
    pty.send("q");
    pty.wait("the shell again", |screen| !screen.alternate_screen());
}

/// The first image of the report.
fn look_at_an_image(pty: &Pty) {
    pty.wait_for("Tiny");
    pty.send("R");
    pty.wait_for("a sweep, written");
    pty.send("\r");
    // Its value under the cursor: the image is read.
    pty.wait("an image", |screen| {
        screen.contents().contains(" A 0.") || screen.contents().contains(" A 1.")
    });
}

#[test]
fn without_colour_nothing_is_coloured() {
    let folder = fast();
    finish(folder.path());
    let mut program = command(PROGRAM, &["tui", "tiny"], folder.path());
    program.env("NO_COLOR", "1");
    let pty = Pty::start(program, [80, 24]);
    look_at_an_image(&pty);
    let screen = pty.screen();
    for (row, column) in (0..24).flat_map(|row| (0..80).map(move |column| (row, column))) {
        let cell = screen.cell(row, column).unwrap();
        let colours = (cell.fgcolor(), cell.bgcolor());
        assert_eq!(colours, (vt100::Color::Default, vt100::Color::Default), "{row} {column}");
    }
    assert!(!screen.contents().contains('▀'), "half blocks without colour say nothing");
}

#[test]
fn a_terminal_without_colours_of_its_own_gets_256() {
    let folder = fast();
    finish(folder.path());
    let mut program = command(PROGRAM, &["tui", "tiny"], folder.path());
    program.env_remove("COLORTERM");
    let pty = Pty::start(program, [80, 24]);
    look_at_an_image(&pty);
    let screen = pty.screen();
    let cells = (0..24).flat_map(|row| (0..80).map(move |column| (row, column)));
    let mut coloured = 0;
    for (row, column) in cells {
        let cell = screen.cell(row, column).unwrap();
        assert!(!matches!(cell.fgcolor(), vt100::Color::Rgb(..)), "{row} {column}");
        coloured += u32::from(matches!(cell.fgcolor(), vt100::Color::Idx(16..)));
    }
    assert!(coloured > 50, "{coloured}");
}

#[test]
fn without_a_terminal_one_sentence_tells() {
    let output = common::output(common::repository(), &["tui"]);
    assert!(!output.status.success());
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("is not a terminal"), "{told}");
    assert_eq!(told.trim_end().lines().count(), 1, "{told}");
}
