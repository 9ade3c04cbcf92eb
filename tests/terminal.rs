//! The terminal is taken and given back, however a session ends. `examples/terminal.rs` is run on a terminal of ours.
#![cfg(unix)]

#[path = "common/pty.rs"]
mod pty;

use std::path::{Path, PathBuf};

use pty::{Pty, command};

/// The example's program: cargo builds examples with the tests, beside their folder.
fn example() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let target = test.parent().and_then(Path::parent).unwrap();
    let path = target.join("examples/terminal");
    assert!(path.exists(), "build it first: cargo build --example terminal");
    path
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A shell without prompt or echo of its own, so that the terminal's modes are ours to compare; it runs the example
/// and then says how it ended.
fn shell(argument: &str) -> Pty {
    let line = format!(
        "echo ready; read go; '{}' {argument}; echo \"ended: $?\"; read end",
        example().display()
    );
    let pty = Pty::start(command("sh", &["-c", &line], root()), [80, 24]);
    pty.wait_for("ready");
    pty
}

/// The example running on `pty`, with the terminal's modes of before and its process.
fn begin(pty: &Pty) -> (String, u32) {
    let before = pty.modes();
    pty.send("\n");
    pty.wait_for("last event: none");
    assert!(pty.screen().alternate_screen() && pty.screen().hide_cursor());
    assert_ne!(pty.modes(), before, "raw mode");
    (before, child_of(pty.process()))
}

fn child_of(process: u32) -> u32 {
    let path = format!("/proc/{process}/task/{process}/children");
    let told = std::fs::read_to_string(&path);
    let told = told.unwrap_or_else(|_| {
        let listed =
            std::process::Command::new("pgrep").args(["-P", &process.to_string()]).output();
        String::from_utf8(listed.unwrap().stdout).unwrap()
    });
    told.split_whitespace().next().expect("a child").parse().unwrap()
}

fn symbol(screen: &vt100::Screen, row: u16, column: u16) -> &str {
    screen.cell(row, column).map_or("", |cell| cell.contents())
}

fn assert_given_back(pty: &Pty, before: &str, ended: &str) {
    pty.wait_for(ended);
    let screen = pty.screen();
    assert!(!screen.alternate_screen() && !screen.hide_cursor());
    assert_eq!(screen.mouse_protocol_mode(), vt100::MouseProtocolMode::None);
    assert_eq!(pty.modes(), before);
}

#[test]
fn quitting_gives_the_terminal_back() {
    let pty = shell("half-blocks");
    let (before, _) = begin(&pty);
    pty.send("q");
    assert_given_back(&pty, &before, "ended: 0");
}

#[test]
fn a_panic_on_a_thread_gives_it_back_and_is_told() {
    let pty = shell("half-blocks");
    let (before, _) = begin(&pty);
    pty.send("x");
    assert_given_back(&pty, &before, "ended: 101");
    pty.wait_for("asked for");
}

#[test]
fn signals_end_it_with_their_codes() {
    for (signal, ended) in [("TERM", "ended: 143"), ("INT", "ended: 130"), ("HUP", "ended: 129")] {
        let pty = shell("half-blocks");
        let (before, process) = begin(&pty);
        pty::signal(process, signal);
        assert_given_back(&pty, &before, ended);
    }
}

#[test]
fn who_does_not_answer_a_signal_is_ended() {
    let pty = shell("half-blocks");
    let (before, process) = begin(&pty);
    pty.send("s");
    pty.wait_for("deaf");
    pty::signal(process, "TERM");
    assert_given_back(&pty, &before, "ended: 143");
}

#[test]
fn ctrl_z_gives_it_back_and_fg_takes_it_again() {
    // At home in a folder of its own: the shell writes its history there.
    let home = tempfile::tempdir().unwrap();
    let mut job = command("bash", &["--norc", "--noprofile", "-i"], home.path());
    job.env("PS1", "$ ");
    let pty = Pty::start(job, [100, 30]);
    pty.wait_for("$");
    pty.send(&format!("'{}' half-blocks\r", example().display()));
    pty.wait_for("last event: none");
    pty.send("\x1a");
    pty.wait_for("Stopped");
    assert!(!pty.screen().alternate_screen() && !pty.screen().hide_cursor());
    pty.send("fg\r");
    pty.wait_for("continued");
    assert!(pty.screen().alternate_screen());
    pty.wait("everything drawn again", |screen| symbol(screen, 20, 50) == "▀");
    pty.send("q");
    pty.wait("the shell again", |screen| !screen.alternate_screen());
    pty.send("exit\r");
}

#[test]
fn nobody_is_left_stopped_who_could_not_be_continued() {
    let mut pty = Pty::start(command(example(), &["half-blocks"], root()), [80, 24]);
    pty.wait_for("last event: none");
    pty.send("\x1a");
    pty.wait_for("suspended: false");
    pty.send("q");
    assert_eq!(pty.exit().exit_code(), 0);
}

#[test]
fn a_terminal_without_pictures_is_asked_and_gets_half_blocks() {
    let pty = Pty::start(command(example(), &[], root()), [80, 24]);
    pty.wait_for("HalfBlocks True");
    pty.wait("the picture", |screen| symbol(screen, 21, 70) == "▀");
    let screen = pty.screen();
    let (lit, dark) = (screen.cell(21, 70).unwrap(), screen.cell(5, 3).unwrap());
    let bright = |colour| matches!(colour, vt100::Color::Rgb(r, ..) if r > 200);
    assert!(bright(lit.fgcolor()) && !bright(dark.fgcolor()));
    pty.resize(60, 20);
    pty.wait("another size", |s| s.contents().contains("width: 60, height: 20"));
}

#[test]
fn without_colour_there_are_characters_and_no_colours() {
    let mut program = command(example(), &[], root());
    program.env("NO_COLOR", "1");
    let pty = Pty::start(program, [80, 24]);
    pty.wait_for("Characters None");
    let screen = pty.screen();
    let cells = (0..24).flat_map(|row| (0..80).map(move |column| (row, column)));
    for (row, column) in cells {
        let cell = screen.cell(row, column).unwrap();
        assert_eq!(cell.fgcolor(), vt100::Color::Default, "{row} {column}");
        assert_eq!(cell.bgcolor(), vt100::Color::Default, "{row} {column}");
    }
    assert!(screen.contents().contains('#') || screen.contents().contains('8'));
}

#[test]
fn a_chosen_protocol_is_written_and_kittys_pictures_are_deleted() {
    let mut pty = Pty::start(command(example(), &["kitty"], root()), [40, 12]);
    pty.wait("a picture's placeholders", |screen| screen.contents().contains('\u{10EEEE}'));
    pty.send("q");
    assert_eq!(pty.exit().exit_code(), 0);
    let written = String::from_utf8_lossy(&pty.bytes()).into_owned();
    // 40 by 10 cells of 10 by 20 pixels.
    assert!(written.contains("s=400,v=200,"), "at the screen's own pixels");
    assert!(written.contains("a=d,d=I"), "and taken away");
}

#[test]
fn without_a_terminal_one_sentence_tells() {
    let told =
        std::process::Command::new(example()).stdin(std::process::Stdio::null()).output().unwrap();
    assert_eq!(told.status.code(), Some(2));
    let told = String::from_utf8(told.stderr).unwrap();
    assert!(told.starts_with("error: standard input is not a terminal"), "{told}");
}
