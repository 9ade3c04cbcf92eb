//! Fournier's pyramids, whole maps: time and peak memory, in the paper's mode and the fast one.
//! `cargo bench --bench pyramid`
//!
//! Each is built in a process of its own (this program again), because a peak of memory never falls. The
//! memory is read from /proc: Linux only.

use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

use wrinkle::lobe::BaseLobe;
use wrinkle::method::fournier::{Fournier, Mode};
use wrinkle::method::{Method, Silent};
use wrinkle::parameter::Values;
use wrinkle::pattern;
use wrinkle::texture::NormalMap;

/// What is built: mode, side of the map, seconds it should stay under on two cores (if any).
const CASES: [(Mode, usize, Option<f64>); 4] = [
    (Mode::Paper, 128, None),
    (Mode::Paper, 256, Some(60.0)),
    (Mode::Fast, 256, None),
    (Mode::Fast, 1024, Some(60.0)),
];
const PATTERNS: [&str; 4] = ["waves", "gaussian", "bricks", "hemispheres"];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments.get(at).and_then(|a| a.parse::<usize>().ok());
    match arguments.iter().position(|a| a == "--only") {
        Some(at) => measure(number(at + 1).unwrap_or(0), number(at + 2).unwrap_or(0)),
        None => measure_all(),
    }
}

fn measure_all() {
    let program = std::env::current_exe().expect("this program");
    println!(
        "{:<24} {:>10} {:>10} {:>10}",
        "pyramid, exponent 60", "seconds", "of aim", "peak MiB"
    );
    for (case, &(mode, side, aim)) in CASES.iter().enumerate() {
        for (k, pattern) in PATTERNS.iter().enumerate() {
            let arguments = ["--only".to_owned(), case.to_string(), k.to_string()];
            let run = Command::new(&program).args(arguments).output().expect("it runs");
            let said = String::from_utf8_lossy(&run.stdout);
            let mut numbers = said.split_whitespace().map(|n| n.parse().unwrap_or(f64::NAN));
            let mut next = || numbers.next().unwrap_or(f64::NAN);
            let (secs, mib) = (next(), next());
            let of_aim = aim.map_or(String::new(), |aim| format!("{:.0}%", 100.0 * secs / aim));
            let name = format!("{mode:?} {side}² {pattern}").to_lowercase();
            println!("{name:<24} {secs:>10.2} {of_aim:>10} {mib:>10.0}");
        }
    }
}

fn measure(case: usize, pattern: usize) {
    let (mode, side, _) = CASES[case];
    let map = map(PATTERNS[pattern], side);
    let method = Fournier { mode, ..Fournier::default() };
    let start = Instant::now();
    let built = method.prefilter(&map, &BaseLobe::BlinnPhong { exponent: 60.0 }, &Silent);
    let secs = start.elapsed().as_secs_f64();
    std::hint::black_box(&built.expect("takes Blinn-Phong"));
    println!("{secs} {}", peak_mib());
}

fn map(name: &str, side: usize) -> Arc<NormalMap> {
    let entry = pattern::find(name).expect("a registered pattern");
    Arc::new((entry.build)(side, side, &Values::defaults(entry.parameters), 1).normals)
}

/// The process's largest resident size so far.
fn peak_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kib.map_or(f64::NAN, |kib| kib / 1024.0)
}
