//! The program that a report was written by: its version, and those of what it is built on.

use serde::Serialize;

/// A crate and its version.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Dependency {
    name: String,
    version: String,
}

/// What a report depends on beside its spec.
#[derive(Serialize)]
pub struct Program {
    version: &'static str,
    dependencies: Vec<Dependency>,
}

impl Program {
    /// This program, as its lock file has it.
    pub fn this() -> Self {
        let dependencies =
            direct(include_str!("../../Cargo.toml"), include_str!("../../Cargo.lock"));
        Self { version: env!("CARGO_PKG_VERSION"), dependencies }
    }

    /// One that stays the same, for snapshots.
    #[cfg(test)]
    pub fn fixed() -> Self {
        let dependency = Dependency { name: "libm".into(), version: "0.2".into() };
        Self { version: "0.0.0", dependencies: vec![dependency] }
    }
}

/// The crates that a manifest asks for on every platform, with the versions of the lock file, by name.
fn direct(manifest: &str, lock: &str) -> Vec<Dependency> {
    let read = |text: &str| text.parse::<toml::Table>().unwrap_or_default();
    let (manifest, lock) = (read(manifest), read(lock));
    let list = |table: &toml::Table, key: &str| -> Vec<toml::Value> {
        table.get(key).and_then(toml::Value::as_array).cloned().unwrap_or_default()
    };
    let packages = list(&lock, "package");
    let text = |value: &toml::Value, key: &str| Some(value.get(key)?.as_str()?.to_owned());
    let own = packages.iter().find(|p| text(p, "name").as_deref() == Some("wrinkle"));
    let asked =
        own.and_then(toml::Value::as_table).map_or_else(Vec::new, |p| list(p, "dependencies"));
    let wanted = |name: &str| manifest.get("dependencies").and_then(|d| d.get(name)).is_some();
    let of_line = |line: &str| {
        // `name`, or `name version` where the lock file has several.
        let (name, version) = line.split_once(' ').map_or((line, None), |(n, v)| (n, Some(v)));
        let alone = || packages.iter().find(|p| text(p, "name").as_deref() == Some(name));
        let version = version.map(str::to_owned).or_else(|| text(alone()?, "version"))?;
        wanted(name).then(|| Dependency { name: name.to_owned(), version })
    };
    asked.iter().filter_map(|line| of_line(line.as_str()?)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dependency_of_the_manifest_has_its_version() {
        let manifest: toml::Table = include_str!("../../Cargo.toml").parse().unwrap();
        let wanted = manifest["dependencies"].as_table().unwrap();
        let found = Program::this().dependencies;
        assert_eq!(found.len(), wanted.len());
        for dependency in found {
            let asked = match &wanted[&dependency.name] {
                toml::Value::String(version) => version.clone(),
                other => other["version"].as_str().unwrap().to_owned(),
            };
            assert!(dependency.version.starts_with(&asked), "{dependency:?}, {asked} asked for");
        }
    }

    #[test]
    fn a_crate_that_is_locked_twice_has_the_version_that_is_used() {
        let lock = "[[package]]\nname = \"wrinkle\"\nversion = \"1.0.0\"\ndependencies = [\"a\", \"b 2.0.0\", \"dev\"]\n\
                    [[package]]\nname = \"a\"\nversion = \"0.1.0\"\n[[package]]\nname = \"b\"\nversion = \"1.0.0\"\n\
                    [[package]]\nname = \"b\"\nversion = \"2.0.0\"\n[[package]]\nname = \"dev\"\nversion = \"1.0.0\"\n";
        let found = direct("[dependencies]\na = \"0.1\"\nb = \"2\"\n", lock);
        let found: Vec<_> = found.iter().map(|d| (d.name.as_str(), d.version.as_str())).collect();
        assert_eq!(found, [("a", "0.1.0"), ("b", "2.0.0")]);
        assert!(direct("nonsense [", "more").is_empty());
    }
}
