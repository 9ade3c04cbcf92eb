//! The image files of a report.

use std::path::{Path, PathBuf};

use super::text::clean;

/// A scene with its image files, as far as they are there.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneImages {
    /// The scene's slug.
    pub slug: String,
    /// The reference.
    pub reference: Option<PathBuf>,
    /// The methods' images, in the order of the spec.
    pub images: Vec<ImageFile>,
}

/// A method's image.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageFile {
    /// The method's label.
    pub method: String,
    /// Samples a pixel.
    pub spp: u32,
    /// The file.
    pub path: PathBuf,
}

/// Whether a name from a file leads to one place in a folder, not out of it.
fn is_plain(name: &str) -> bool {
    !name.is_empty() && name != "." && name != ".." && !name.contains(['/', '\\', '\0'])
}

/// The images of a scene that has these trials; the number of those that are not there is added to `missing`.
pub(super) fn of_scene(
    folder: &Path,
    slug: &str,
    trials: impl Iterator<Item = (String, u32)>,
    missing: &mut usize,
) -> SceneImages {
    let mut there = |name: String| {
        let path = folder.join("images").join(slug).join(name);
        let found = is_plain(slug) && path.is_file();
        *missing += usize::from(!found);
        found.then_some(path)
    };
    let reference = there("reference.exr".to_owned());
    let image = |(method, spp): (String, u32)| {
        let name = format!("{method}-{spp}spp.exr");
        let path = if is_plain(&name) { there(name) } else { None }?;
        Some(ImageFile { method, spp, path })
    };
    SceneImages { slug: slug.to_owned(), reference, images: trials.filter_map(image).collect() }
}

/// The images in a folder whose figures are lost: every scene in it, in alphabetical order.
pub(super) fn found_in(folder: &Path) -> Vec<SceneImages> {
    let scene = |(slug, path): (String, PathBuf)| {
        let files = exr_files(&path);
        let reference = files.iter().find(|(stem, _)| stem == "reference");
        let image = |(stem, path): &(String, PathBuf)| {
            let (method, spp) = stem.strip_suffix("spp")?.rsplit_once('-')?;
            Some(ImageFile { method: method.into(), spp: spp.parse().ok()?, path: path.clone() })
        };
        let images: Vec<_> = files.iter().filter_map(image).collect();
        let reference = reference.map(|(_, path)| path.clone());
        let any = reference.is_some() || !images.is_empty();
        any.then_some(SceneImages { slug, reference, images })
    };
    entries(&folder.join("images"), |path| path.is_dir()).into_iter().filter_map(scene).collect()
}

/// The EXR files in a folder by stem, in alphabetical order; none if it cannot be read.
pub(super) fn exr_files(folder: &Path) -> Vec<(String, PathBuf)> {
    files(folder, "exr")
}

/// The files of this ending in a folder by stem, in alphabetical order; none if it cannot be read.
pub(super) fn files(folder: &Path, ending: &str) -> Vec<(String, PathBuf)> {
    entries(folder, |path| path.is_file() && path.extension().is_some_and(|e| e == ending))
        .into_iter()
        .map(|(_, path)| (clean(&path.file_stem().unwrap_or_default().to_string_lossy()), path))
        .collect()
}

/// What is in a folder by name, hidden things aside, in alphabetical order.
pub(super) fn entries(folder: &Path, wanted: impl Fn(&Path) -> bool) -> Vec<(String, PathBuf)> {
    let all = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let named = all.map(|entry| (clean(&entry.file_name().to_string_lossy()), entry.path()));
    let shown = named.filter(|(name, path)| !name.starts_with('.') && wanted(path));
    let mut shown: Vec<_> = shown.collect();
    shown.sort();
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_files_do_not_lead_out_of_the_folder() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(root.path().join("report/images")).unwrap();
        std::fs::write(root.path().join("report/reference.exr"), "").unwrap();
        std::fs::write(root.path().join("report/images/up-1spp.exr"), "").unwrap();
        let mut missing = 0;
        let trials = [("../up".to_owned(), 1)].into_iter();
        let scene = of_scene(&root.path().join("report"), "..", trials, &mut missing);
        assert_eq!((scene.reference, scene.images), (None, vec![]));
    }
}
