//! Pictures of the terminal runner's screens for docs/: `cargo build --release && cargo run --release --example screens`.
//!
//! Each screen is the real program's: it runs on a terminal of ours, gets keys, and what it draws there becomes a PNG.
//! Arguments are the names of the screens to make; all if there are none.

mod draw;
#[path = "../../tests/common/pty.rs"]
mod pty;

use std::path::Path;
use std::time::Duration;

use pty::{Pty, command};

/// What is done to come to a screen.
enum Step {
    /// Keys are typed.
    Type(&'static str),
    /// A text is waited for.
    For(&'static str),
}

use Step::{For, Type};

/// A screen: its name, columns and rows, arguments after `wrinkle tui`, and the way there.
struct Shot {
    name: &'static str,
    size: [u16; 2],
    args: &'static [&'static str],
    steps: &'static [Step],
}

const SHOTS: &[Shot] = &[
    Shot {
        name: "experiments",
        size: [120, 36],
        args: &["quick"],
        steps: &[For("RMSE"), For("fournier")],
    },
    Shot {
        name: "lab",
        size: [120, 36],
        args: &["data/denim.png"],
        steps: &[
            For("reference:"),
            For("olano-north"),
            Type("6s"),
            For("A olano-north │ B reference 1024 spp"),
            For("off 0."),
        ],
    },
    Shot {
        name: "lab-error",
        size: [120, 36],
        args: &["data/denim.png"],
        steps: &[
            For("reference:"),
            Type("6e"),
            For("A olano-north  |error|"),
            For("reference: 1024 spp"),
            For("off 0."),
        ],
    },
    Shot {
        name: "results",
        size: [120, 36],
        args: &[],
        steps: &[
            Type("R"),
            For("quick"),
            Type("\r"),
            For("small-twill"),
            For("A unfiltered 1 spp"),
            Type("3"),
            For("A fournier"),
            Type("\r"),
        ],
    },
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let own = std::env::current_exe()?;
    let program = own.parent().and_then(Path::parent).ok_or("no target folder")?.join("wrinkle");
    if !program.exists() {
        return Err("build the program first: cargo build, with the same profile".into());
    }
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for shot in SHOTS.iter().filter(|s| wanted.is_empty() || wanted.iter().any(|w| w == s.name)) {
        let mut args = vec!["tui", "--pictures", "half-blocks"];
        args.extend(shot.args);
        let pty = Pty::start(command(&program, &args, root), shot.size);
        pty.wait_for("wrinkle");
        for step in shot.steps {
            match step {
                Type(keys) => pty.send(keys),
                For(text) => pty.wait_for(text),
            }
        }
        pty.settle(Duration::from_millis(600));
        let path = root.join(format!("docs/images/tui-{}.png", shot.name));
        std::fs::write(&path, draw::draw(&pty.screen()).encode_png()?)?;
        println!("{}", path.display());
    }
    Ok(())
}
