//! Dependencies follow the table in `src/lib.rs`: imports point one way, no files inside a module use each other in a circle.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const SRC: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src");
/// The crate of what is integrated, a part of the same table.
const ENGINE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/engine/src");

/// A row of the table in `src/lib.rs`, the one place where the order of layers stands.
struct Layer {
    module: String,
    /// Modules named in the last column; the modules above are the others that it may use.
    must_not_know: Vec<String>,
    /// Whether the last column forbids every other module.
    knows_none: bool,
}

/// Layers from the lowest to the highest.
fn layers() -> Vec<Layer> {
    let text = fs::read_to_string(Path::new(SRC).join("lib.rs")).expect("lib.rs is readable");
    let links = |cell: &str| -> Vec<String> {
        cell.split("[`").skip(1).filter_map(|link| Some(link.split_once("`]")?.0.to_owned())).collect()
    };
    let rows = text.lines().filter_map(|line| line.strip_prefix("//! | [`"));
    rows.map(|row| {
        let (module, rest) = row.split_once("`]").expect("a link to the module");
        let last = rest.trim_end_matches(['|', ' ']).rsplit('|').next().unwrap_or_default();
        let knows_none = last.contains("any other module");
        Layer { module: module.to_owned(), must_not_know: links(last), knows_none }
    })
    .collect()
}

#[test]
fn imports_point_one_way() {
    let layers = layers();
    let modules: Vec<&str> = layers.iter().map(|layer| layer.module.as_str()).collect();
    let rank = |module: &str| {
        let found = modules.iter().position(|name| *name == module);
        found.unwrap_or_else(|| panic!("module {module} is not in the table of src/lib.rs"))
    };
    for file in files() {
        let Some(own) = module_path(&file).into_iter().next() else { continue };
        let layer = &layers[rank(&own)];
        let text = fs::read_to_string(&file).expect("source is readable");
        for name in paths_from(&["crate::"], &text).into_iter().filter_map(|path| path.into_iter().nth(1)) {
            let may = name == own
                || rank(&name) < rank(&own) && !layer.knows_none && !layer.must_not_know.contains(&name);
            assert!(may, "{} uses {name}, which {own} must not know", file.display());
        }
    }
}

/// In every folder inside a module: no file (or folder) leads back to itself through those it uses. A `mod.rs` is left out:
/// its items are those that its files share.
#[test]
fn files_of_a_module_use_each_other_in_no_circle() {
    let modules: BTreeSet<Vec<String>> = files().iter().map(|file| module_path(file)).collect();
    let mut uses = BTreeMap::<Vec<String>, BTreeSet<Vec<String>>>::new();
    for file in files() {
        let own = module_path(&file);
        let text = fs::read_to_string(&file).expect("source is readable");
        for used in used_paths(&text, &own) {
            let shared = own.iter().zip(&used).take_while(|(a, b)| a == b).count();
            let known = used.get(..=shared).is_some_and(|path| modules.contains(path));
            if shared > 0 && shared < own.len() && known {
                uses.entry(own[..=shared].to_vec()).or_default().insert(used[..=shared].to_vec());
            }
        }
    }
    // What leads nowhere is in no circle, nor is what leads only there.
    loop {
        let left: BTreeSet<_> = uses.keys().cloned().collect();
        uses.values_mut().for_each(|used| used.retain(|path| left.contains(path)));
        uses.retain(|_, used| !used.is_empty());
        if uses.len() == left.len() {
            break;
        }
    }
    assert!(uses.is_empty(), "circles: {uses:#?}");
}

/// Absolute paths that a file of module `own` names by `crate`, `self` or `super`, outside of comments and tests.
fn used_paths(text: &str, own: &[String]) -> Vec<Vec<String>> {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let code: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let found = paths_from(&["crate::", "self::", "super::"], &code.join("\n"));
    found.into_iter().map(|path| absolute(path, own)).collect()
}

/// Every path in `text` that begins with one of `roots`, a path for each leaf of a `use` tree.
fn paths_from(roots: &[&str], text: &str) -> Vec<Vec<String>> {
    let continues = |before: &str| before.ends_with(|c: char| c.is_alphanumeric() || "_:".contains(c));
    let starts = roots.iter().flat_map(|root| text.match_indices(root));
    let mut found = Vec::new();
    for (at, _) in starts.filter(|(at, _)| !continues(&text[..*at])) {
        read_tree(&text[at..], &[], &mut found);
    }
    found
}

/// Reads one path of a `use` tree into `found`; returns the text after it.
fn read_tree<'t>(text: &'t str, before: &[String], found: &mut Vec<Vec<String>>) -> &'t str {
    if let Some(mut rest) = text.strip_prefix('{') {
        while !rest.is_empty() && !rest.starts_with('}') {
            rest = read_tree(rest.trim_start_matches([',', ' ', '\n']), before, found);
            rest = rest.trim_start_matches(|c| !",}".contains(c));
            rest = rest.trim_start_matches([',', ' ', '\n']);
        }
        return rest.strip_prefix('}').unwrap_or(rest);
    }
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let path = [before, &[text[..end].to_owned()]].concat();
    match text[end..].strip_prefix("::") {
        Some(rest) => read_tree(rest, &path, found),
        None => {
            found.push(path);
            &text[end..]
        }
    }
}

fn absolute(path: Vec<String>, own: &[String]) -> Vec<String> {
    let mut from = own.to_vec();
    let mut rest = path.as_slice();
    while let [root, next @ ..] = rest {
        match root.as_str() {
            "crate" => from.clear(),
            "self" => {}
            "super" => drop(from.pop()),
            _ => break,
        }
        rest = next;
    }
    from.extend_from_slice(rest);
    from
}

#[test]
fn used_paths_are_read_from_trees() {
    let own = ["a".to_owned(), "b".to_owned()];
    let text =
        "use super::{c::{D, e as f}, g};\n// super::not\nlet x = crate::h::i::<T>();\n#[cfg(test)] super::no";
    let read: Vec<String> = used_paths(text, &own).iter().map(|path| path.join(".")).collect();
    assert_eq!(read, ["h.i.", "a.c.D", "a.c.e", "a.g"]);
}

/// A clock that is set while a study runs must change nothing: only the date of a report and the times of files are of the
/// wall clock.
#[test]
fn durations_are_of_the_monotonic_clock() {
    let files = files();
    let reads =
        |text: &str| ["SystemTime::now", "Local::now", "Utc::now"].iter().any(|name| text.contains(name));
    let product = |text: String| text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default().to_owned();
    let found: Vec<_> = files
        .iter()
        .filter(|file| reads(&product(fs::read_to_string(file).expect("source is readable"))))
        .collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].ends_with("report/html/mod.rs"), "{found:?}");
}

/// Path of the module in a file, from the crate's root; empty for lib.rs and main.rs.
fn module_path(file: &Path) -> Vec<String> {
    let inside = file.strip_prefix(SRC).or_else(|_| file.strip_prefix(ENGINE));
    let inside = inside.expect("inside one of both").with_extension("");
    let path = inside.iter().map(|part| part.to_string_lossy().into_owned());
    path.filter(|name| !matches!(name.as_str(), "lib" | "main" | "mod")).collect()
}

/// All source files.
fn files() -> Vec<PathBuf> {
    let mut files = Vec::new();
    for source in [SRC, ENGINE] {
        let known = files.len();
        collect(Path::new(source), &mut files);
        assert!(files.len() > known + 20);
    }
    files
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
