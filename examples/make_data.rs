//! Writes the maps in `data/` again, byte for byte: `cargo run --release --example make_data`.

use std::path::Path;

use wrinkle::parameter::{Value, Values};
use wrinkle::pattern::{Bumps, find};
use wrinkle::texture::image_file::write_normal_map_png16;

/// A map of `data/`: its file, its pattern, size, seed, and the parameters that are not the defaults.
struct Item {
    file: &'static str,
    pattern: &'static str,
    size: [usize; 2],
    seed: u64,
    set: &'static [(&'static str, Value)],
}

const ITEMS: [Item; 3] = [
    Item {
        file: "denim.png",
        pattern: "twill",
        size: [128, 128],
        seed: 0,
        set: &[
            ("over", Value::Number(3.0)),
            ("pitch", Value::Number(8.0)),
            ("bend", Value::Number(20.0)),
        ],
    },
    Item { file: "bricks.png", pattern: "bricks", size: [128, 128], seed: 0, set: &[] },
    Item {
        file: "brushed.png",
        pattern: "gaussian",
        size: [128, 128],
        seed: 1,
        set: &[
            ("slope_variance_u", Value::Number(0.04)),
            ("slope_variance_v", Value::Number(0.0025)),
            ("correlation_length", Value::Number(3.0)),
        ],
    },
];

fn bumps(item: &Item) -> Option<Bumps> {
    let entry = find(item.pattern)?;
    let values = Values::defaults(entry.parameters).with(item.set);
    let [width, height] = item.size;
    Some((entry.build)(width, height, &values, item.seed))
}

/// Writes every map into `folder`; the names of the files.
pub fn write_all(folder: &Path) -> Result<Vec<&'static str>, Box<dyn std::error::Error>> {
    for item in &ITEMS {
        let bumps = bumps(item).ok_or("no such pattern")?;
        write_normal_map_png16(folder.join(item.file), &bumps.normals)?;
    }
    Ok(ITEMS.map(|item| item.file).to_vec())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    for file in write_all(&folder)? {
        println!("{}", folder.join(file).display());
    }
    Ok(())
}
