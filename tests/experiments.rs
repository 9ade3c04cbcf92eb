//! The experiments that come with the program are right.

use wrinkle::evidence;
use wrinkle::experiment::spec::Experiment;

#[test]
fn every_experiment_can_be_read() {
    let folder = std::path::Path::new("experiments");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let specs: Vec<_> =
        files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    assert!(specs.len() >= 2);
    for path in specs {
        let read = Experiment::load(&path, &evidence::keys());
        let experiment = read.unwrap_or_else(|error| panic!("{error}"));
        assert!(!experiment.question().is_empty(), "{} asks nothing", path.display());
    }
}
