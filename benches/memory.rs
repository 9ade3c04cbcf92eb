//! Peak memory of a prefiltered 4096² map, method by method: `cargo bench --bench memory`.
//!
//! Each method is measured in a process of its own (this program again, with the method's name),
//! because a peak never falls. Linux only: it reads /proc.

use std::process::Command;
use std::sync::Arc;

use wrinkle::lobe::BaseLobe;
use wrinkle::method::{self, Silent};
use wrinkle::texture::{NormalMap, Wrap};

/// Texels along a side.
const SIDE: usize = 4096;
/// The aim: a gibibyte for any one-lobe method.
const AIM_MIB: f64 = 1024.0;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().position(|a| a == "--only") {
        Some(at) => measure(arguments.get(at + 1).map_or("", String::as_str)),
        None => measure_all(),
    }
}

/// Every method that does not fit (a fit of 4096² texels takes minutes, and its memory says nothing of
/// one lobe).
fn measure_all() {
    let program = std::env::current_exe().expect("this program");
    println!("{:<32} {:>10} {:>10}", "method, 4096² map", "peak MiB", "of aim");
    for entry in method::entries() {
        let name = entry.card.name;
        if name == "fournier" {
            continue;
        }
        let run = Command::new(&program).args(["--only", name]).output().expect("it runs");
        let peak: f64 = String::from_utf8_lossy(&run.stdout).trim().parse().unwrap_or(f64::NAN);
        println!("{name:<32} {peak:>10.0} {:>9.0}%", 100.0 * peak / AIM_MIB);
    }
}

fn measure(name: &str) {
    let map = Arc::new(NormalMap::from_fn(SIDE, SIDE, Wrap::Repeat, |u, v| {
        [0.3 * libm::sin(300.0 * u), 0.3 * libm::sin(200.0 * v), 1.0, 1.0]
    }));
    let base = BaseLobe::BlinnPhong { exponent: 60.0 };
    let method = method::build(name).expect("a registered method");
    let prefiltered = method.prefilter(&map, &base, &Silent).expect("takes Blinn-Phong");
    std::hint::black_box(&prefiltered);
    println!("{}", peak_mib());
}

/// The process's largest resident size so far.
fn peak_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let kib = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kib.map_or(f64::NAN, |kib| kib / 1024.0)
}
