//! The Snakemake workflow, with two workers: it is run where Snakemake is installed.
//!
//! Without Snakemake these tests say so and pass; with `WRINKLE_SNAKEMAKE=required` they fail.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use common::{assert_same, output, repository};

const EXPERIMENT: &str = r#"
seed = 3
[image]
width = 8
height = 6
[reference]
spp = 16
replicates = 2
[sweep]
texture = ["weave", "hills"]
method = ["unfiltered", "averaged"]
spp = [1]
unfiltered_spp = [1]
texels_per_pixel = [2.0, 5.0]
[texture.weave]
pattern = "twill"
width = 8
height = 8
[texture.hills]
pattern = "gaussian"
width = 8
height = 8
"#;

/// The program `snakemake`: that of target/workflow-venv, or the one on the PATH.
fn snakemake() -> Option<PathBuf> {
    let here = repository().join("target/workflow-venv/bin/snakemake");
    let works = |path: &PathBuf| {
        Command::new(path).arg("--version").output().is_ok_and(|told| told.status.success())
    };
    let found = [here, PathBuf::from("snakemake")].into_iter().find(works);
    if found.is_none() {
        let required = std::env::var("WRINKLE_SNAKEMAKE").is_ok_and(|value| value == "required");
        assert!(!required, "Snakemake is not installed; see workflow/README.md");
        eprintln!("NOT TESTED: Snakemake is not installed; see workflow/README.md");
    }
    found
}

/// A folder with the experiment and the workflow.
fn bench() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let workflow = folder.path().join("workflow");
    fs::create_dir(&workflow).unwrap();
    for file in ["Snakefile", "config.yaml"] {
        fs::copy(repository().join("workflow").join(file), workflow.join(file)).unwrap();
    }
    fs::write(folder.path().join("trial.toml"), EXPERIMENT).unwrap();
    folder
}

/// Runs the workflow with two workers and this program; what it said, and whether it succeeded.
fn run(snakemake: &Path, folder: &Path, program: &Path) -> (bool, String) {
    let set = format!("wrinkle={}", program.display());
    let done = Command::new(snakemake)
        .current_dir(folder)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .args(["--cores", "2", "--config", "experiment=trial.toml", "shards=3", &set])
        .output()
        .unwrap();
    (done.status.success(), String::from_utf8_lossy(&done.stderr).into_owned())
}

fn whole(folder: &Path) -> PathBuf {
    let done = output(folder, &["run", "trial.toml", "--out", "whole"]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    folder.join("whole/trial")
}

#[test]
fn two_workers_make_the_report_of_one_run() {
    let Some(snakemake) = snakemake() else { return };
    let bench = bench();
    let (done, said) = run(&snakemake, bench.path(), Path::new(env!("CARGO_BIN_EXE_wrinkle")));
    assert!(done, "{said}");
    assert_same(&whole(bench.path()), &bench.path().join("reports/trial"));
    let (done, said) = run(&snakemake, bench.path(), Path::new(env!("CARGO_BIN_EXE_wrinkle")));
    assert!(done && said.contains("Nothing to be done"), "{said}");
}

#[cfg(unix)]
#[test]
fn a_shard_that_dies_is_tried_again() {
    use std::os::unix::fs::PermissionsExt;

    let Some(snakemake) = snakemake() else { return };
    let bench = bench();
    let program = bench.path().join("mortal");
    let text = format!(
        "#!/bin/sh\n# Dies at once, the first time it is to do the second shard.\n\
         case \"$*\" in *2/3*) if mkdir died 2>/dev/null; then kill -9 $$; fi ;; esac\n\
         exec '{}' \"$@\"\n",
        env!("CARGO_BIN_EXE_wrinkle")
    );
    fs::write(&program, text).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let (done, said) = run(&snakemake, bench.path(), &program);
    assert!(done, "{said}");
    assert!(bench.path().join("died").is_dir(), "it died once");
    assert_same(&whole(bench.path()), &bench.path().join("reports/trial"));
}
