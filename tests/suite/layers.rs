//! Imports point one way: a file may use only layers below its own, or its own.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules from the lowest layer to the highest; those on a line do not know each other.
const LAYERS: &[&[&str]] = &[
    &["units", "file", "choice", "ropes"],
    &["plan"],
    &["scene"],
    &["outcome"],
    &["simulation"],
    &["verdict"],
    &["study"],
    &["report", "worker"],
    &["tui"],
    &["cli"],
];

#[test]
fn imports_point_one_way() {
    let mut files = Vec::new();
    collect(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &mut files);
    assert!(files.len() > 20);
    for file in files {
        let Some(own) = module(&file) else { continue };
        let text = fs::read_to_string(&file).expect("source is readable");
        for used in text.split("crate::").skip(1) {
            let name: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            let (own_layer, layer) = (layer(&own), layer(&name));
            assert!(
                name == own || layer < own_layer,
                "{} uses {name}, which is not below {own}",
                file.display()
            );
        }
    }
}

/// A clock that is set while a study runs must change nothing: only the date of a report and the times of files are of the
/// wall clock.
#[test]
fn durations_are_of_the_monotonic_clock() {
    let mut files = Vec::new();
    collect(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &mut files);
    let reads = |text: &str| {
        ["SystemTime::now", "Zoned::now", "Timestamp::now"].iter().any(|name| text.contains(name))
    };
    let product = |text: String| text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default().to_owned();
    let found: Vec<_> = files
        .iter()
        .filter(|file| reads(&product(fs::read_to_string(file).expect("source is readable"))))
        .collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].ends_with("report/html/mod.rs"), "{found:?}");
}

fn layer(module: &str) -> usize {
    let found = LAYERS.iter().position(|layer| layer.contains(&module));
    found.unwrap_or_else(|| panic!("module {module} has no layer"))
}

/// The top module a file belongs to; none for lib.rs and main.rs.
fn module(file: &Path) -> Option<String> {
    let inside = file.strip_prefix(concat!(env!("CARGO_MANIFEST_DIR"), "/src")).expect("inside src");
    let first = inside.components().next()?.as_os_str().to_str()?;
    let name = first.trim_end_matches(".rs");
    (!matches!(name, "lib" | "main")).then(|| name.to_owned())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("src is readable") {
        let path = entry.expect("entry is readable").path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
}
