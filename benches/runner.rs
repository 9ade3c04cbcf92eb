//! How long a key takes to the screen, while all cores render: `cargo bench --bench runner`.
//!
//! The real program on a pseudo-terminal: the lab is given a new scene, so that every core has work, and a key that
//! changes the picture is pressed at once. Measured is the time until the screen shows it, by half blocks in all
//! colours. It is to stay under 50 ms.

#[path = "../tests/common/pty.rs"]
mod pty;

use std::time::{Duration, Instant};

use pty::{Pty, command};

/// Keys pressed at each size.
const KEYS: usize = 40;

fn main() {
    for size in [[80, 24], [120, 40], [300, 80]] {
        let mut times = presses(size);
        times.sort();
        let ms = |time: Duration| 1e3 * time.as_secs_f64();
        let (median, last) = (times[times.len() / 2], times[times.len() - 1]);
        let [columns, rows] = size;
        println!(
            "{columns} × {rows}: median {:.1} ms, worst of {KEYS} {:.1} ms",
            ms(median),
            ms(last)
        );
    }
}

/// The times of keys from press to screen, on a terminal of this size.
fn presses(size: [u16; 2]) -> Vec<Duration> {
    let root = env!("CARGO_MANIFEST_DIR");
    let map = format!("{root}/data/denim.png");
    let program = command(env!("CARGO_BIN_EXE_wrinkle"), &["tui", &map], root.as_ref());
    let pty = Pty::start(program, size);
    pty.wait_for("reference:");
    let mut times = Vec::with_capacity(KEYS);
    for key in 0..KEYS {
        // Farther, and back: a scene that was not there.
        pty.send(if key % 8 < 4 { "d" } else { "D" });
        std::thread::sleep(Duration::from_millis(60));
        let start = Instant::now();
        pty.send(" ");
        let shown = if key % 2 == 0 { ": B " } else { ": A " };
        pty.wait_for(shown);
        times.push(start.elapsed());
    }
    pty.send("q");
    times
}
