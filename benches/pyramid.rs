//! Fournier's pyramids: time of a whole map. `cargo bench --bench pyramid`; benches/memory.rs has the memory.
#![allow(missing_docs)]

use std::sync::Arc;

use divan::Bencher;
use wrinkle::lobe::BaseLobe;
use wrinkle::method::{Method, Silent, fournier::Fournier};
use wrinkle::parameter::Values;
use wrinkle::pattern;
use wrinkle::texture::NormalMap;

const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 60.0 };
const PATTERNS: [&str; 3] = ["waves", "gaussian", "bricks"];

fn main() {
    divan::main();
}

fn map(name: &str, side: usize) -> Arc<NormalMap> {
    let entry = pattern::find(name).expect("a registered pattern");
    let bumps = (entry.build)(side, side, &Values::defaults(entry.parameters), 1);
    Arc::new(bumps.normals)
}

fn build(bencher: Bencher, method: &Fournier, map: &Arc<NormalMap>) {
    bencher.bench(|| method.prefilter(map, &BASE, &Silent).expect("takes Blinn-Phong").bytes());
}

#[divan::bench(args = PATTERNS, consts = [64, 128, 256], sample_count = 1, sample_size = 1)]
fn paper<const SIDE: usize>(bencher: Bencher, pattern: &str) {
    build(bencher, &Fournier::default(), &map(pattern, SIDE));
}
