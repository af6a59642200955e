//! Names that the documents and the docs of the source give exist: tests, keys, functions, and the files of a release.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const DOCUMENTS: [&str; 9] = [
    "README.md",
    "CONTRIBUTING.md",
    "docs/plan-keys.md",
    "docs/scripts.md",
    "docs/what-pass-means.md",
    "docs/exact-rules.md",
    "docs/model.md",
    "docs/studies/fit.md",
    "benches/RESULTS.md",
];

/// Files below `folder` that end in `ending`.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder is readable").flatten().map(|entry| entry.path());
    let inside = |path: PathBuf| match path.is_dir() {
        true => files(&path, ending),
        false => vec![path],
    };
    let all = entries.flat_map(inside);
    all.filter(|path| path.extension().is_some_and(|found| found == ending)).collect()
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(path).expect("the file is readable")
}

/// Lines that are comments, or that are not.
fn lines(text: &str, comments: bool) -> String {
    let wanted = |line: &&str| line.trim_start().starts_with("//") == comments;
    text.lines().filter(wanted).collect::<Vec<_>>().join("\n")
}

/// Backticked names in snake case, such as those of tests, and the filters of `cargo test`.
fn names(text: &str) -> Vec<&str> {
    let is_name = |name: &&str| {
        let snake = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        // `n_tires` is the length of an array.
        name.trim_matches('_').contains('_') && name.chars().all(snake) && !name.starts_with("n_")
    };
    let mut names: Vec<&str> =
        text.lines().flat_map(|line| line.split('`').skip(1).step_by(2)).filter(is_name).collect();
    let commands = ["cargo test --lib ", "cargo test --test suite "];
    let filters = commands.iter().flat_map(|command| text.split(command).skip(1));
    let ends = |c: char| !c.is_alphanumeric() && c != '_';
    names.extend(filters.filter_map(|rest| rest.split(ends).next()).filter(|name| !name.is_empty()));
    names
}

/// Names in small letters to which documentation links: the last part of [`each::path`].
fn links(comments: &str) -> Vec<&str> {
    let linked = comments.split("[`").skip(1).filter_map(|rest| rest.split_once("`]")).map(|(path, _)| path);
    let name = |path: &str| path.chars().all(|c| c.is_ascii_lowercase() || c == '_' || c == ':');
    linked.filter(|path| name(path)).filter_map(|path| path.rsplit("::").next()).collect()
}

/// rustdoc cannot tell units, written [m] and [s], from broken links.
#[test]
fn links_in_documentation_lead_to_modules_functions_or_fields() {
    let folders = ["src", "engine/src"].map(|folder| Path::new(ROOT).join(folder));
    let sources: Vec<String> = folders.iter().flat_map(|folder| files(folder, "rs")).map(read).collect();
    let code: Vec<String> = sources.iter().map(|text| lines(text, false)).collect();
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let declared = |keyword: &'static str| {
        let after = code.iter().flat_map(move |text| text.split(keyword).skip(1));
        after.filter_map(move |rest| rest.split(|c: char| !word(c)).next())
    };
    let known: BTreeSet<&str> =
        ["fn ", "mod ", "pub ", "use crate::"].into_iter().flat_map(declared).collect();
    let comments: Vec<String> = sources.iter().map(|text| lines(text, true)).collect();
    let linked: BTreeSet<&str> = comments.iter().flat_map(|text| links(text)).collect();
    assert!(linked.contains("step_error"), "links are found");
    let broken: Vec<&&str> =
        linked.iter().filter(|name| **name != "super" && !known.contains(*name)).collect();
    assert!(broken.is_empty(), "links to nothing: {broken:?}");
    // A link without a path leads to something that its own file declares or imports.
    for (code, comments) in code.iter().zip(&comments) {
        let words: BTreeSet<&str> = code.split(|c: char| !word(c)).collect();
        let linked = comments.split("[`").skip(1).filter_map(|rest| rest.split_once("`]"));
        let bare = linked.filter(|(_, rest)| !rest.starts_with('(')).map(|(name, _)| name);
        let bare = bare.filter(|name| *name != "super" && name.chars().all(word));
        let broken: Vec<&str> = bare.filter(|name| !words.contains(name)).collect();
        assert!(
            broken.is_empty(),
            "{}: links to nothing: {broken:?}",
            code.lines().next().unwrap_or_default()
        );
    }
}

/// `study/judge/batch.rs judge` in the drawings of CONTRIBUTING.md: the file is there and declares what is named behind it.
#[test]
fn the_way_of_a_check_leads_through_functions_that_exist() {
    let text = read(Path::new(ROOT).join("CONTRIBUTING.md"));
    let drawn: Vec<&str> = text.split("```").skip(1).step_by(2).filter(|block| block.contains('▶')).collect();
    let (mut count, mut folders) =
        (0, ["engine/src", "src"].map(|folder| Path::new(ROOT).join(folder)).to_vec());
    let words: Vec<&str> = drawn.iter().flat_map(|block| block.split_whitespace()).collect();
    for pair in words.windows(2) {
        let [file, name] = pair else { continue };
        let file = file.trim_start_matches('(').trim_end_matches(',');
        if !file.ends_with(".rs") || file.contains("NAME") {
            continue;
        }
        // A bare name is of a folder named before.
        let path = folders.iter().rev().map(|folder| folder.join(file)).find(|path| path.exists());
        let path = path.unwrap_or_else(|| panic!("{file}"));
        folders.extend(path.parent().map(Path::to_owned));
        let declared = name.rsplit("::").next().unwrap_or_default();
        if declared.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && !declared.is_empty() {
            let code = lines(&read(path), false);
            let is_there =
                ["fn ", "struct ", "enum "].iter().any(|word| code.contains(&format!("{word}{declared}")));
            assert!(is_there, "{file} has no {declared}");
            count += 1;
        }
    }
    assert!(count > 10, "{count}");
}

#[test]
fn names_in_documents_and_comments_exist() {
    let folders =
        ["src", "engine/src", "tests", "benches", "examples"].map(|folder| Path::new(ROOT).join(folder));
    let sources: Vec<String> = folders.iter().flat_map(|folder| files(folder, "rs")).map(read).collect();
    let code: Vec<String> = sources.iter().map(|text| lines(text, false)).collect();
    let known: BTreeSet<&str> =
        code.iter().flat_map(|text| text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')).collect();
    let documents = DOCUMENTS.map(|name| read(Path::new(ROOT).join(name)));
    let comments = sources.iter().map(|text| lines(text, true));
    let texts: Vec<String> = documents.into_iter().chain(comments).collect();
    let named: Vec<&str> = texts.iter().flat_map(|text| names(text)).collect();
    assert!(named.contains(&"tires_asleep_would_not_have_moved"), "names of tests are found");
    let unknown: BTreeSet<&str> = named.into_iter().filter(|name| !known.contains(name)).collect();
    assert!(unknown.is_empty(), "no code has these names: {unknown:?}");
}

/// Words with a capital inside that are no names of the source.
const PROPER_NAMES: [&str; 5] = ["PowerShell", "BackTab", "McNemar", "SplitMix64", "McKenzie"];

/// Whether a word is written as a type is: `ShotSummary`.
fn is_type_name(word: &str) -> bool {
    let letters: Vec<char> = word.chars().collect();
    let turns = letters.windows(3).any(|three| {
        three[0].is_ascii_lowercase() && three[1].is_ascii_uppercase() && three[2].is_ascii_lowercase()
    });
    turns && letters[0].is_ascii_uppercase() && letters.iter().all(char::is_ascii_alphanumeric)
}

/// A type that stands in a sentence without backticks is the trace of a rename that went through words.
#[test]
fn no_comment_has_the_name_of_a_type_for_a_word() {
    let sources = ["src", "engine/src", "tests", "benches"]
        .into_iter()
        .flat_map(|folder| files(&Path::new(ROOT).join(folder), "rs"));
    for path in sources {
        let mut in_example = false;
        for line in read(&path).lines().map(str::trim_start).filter(|line| line.starts_with("//")) {
            in_example ^= line.contains("```");
            let sentence: String = line.split('`').step_by(2).collect();
            let is_target = sentence.contains("]: ") || sentence.contains("](");
            let words = sentence.split(|c: char| !c.is_alphanumeric());
            let odd =
                words.filter(|word| is_type_name(word) && !PROPER_NAMES.contains(word)).collect::<Vec<_>>();
            assert!(in_example || is_target || odd.is_empty(), "{}: {odd:?} in “{line}”", path.display());
        }
    }
}

/// Cargo.toml as a table.
fn manifest() -> toml::Table {
    read(Path::new(ROOT).join("Cargo.toml")).parse().expect("TOML")
}

/// Whether a package leaves a file out: patterns that name it, a folder above it, or a folder and an ending.
fn is_excluded(path: &str) -> bool {
    let patterns = manifest()["package"]["exclude"].clone().try_into::<Vec<String>>().expect("texts");
    patterns.iter().any(|pattern| match pattern.split_once('*') {
        Some((folder, ending)) => path.strip_prefix(folder).is_some_and(|rest| rest.ends_with(ending)),
        None => path == pattern || path.starts_with(&format!("{pattern}/")),
    })
}

/// What the README shows and links to is there, and in the package, too.
#[test]
fn links_of_the_readme_lead_to_files_of_the_package() {
    let readme = read(Path::new(ROOT).join("README.md"));
    let between = |begin: &str, end: char| {
        readme.split(begin).skip(1).filter_map(|rest| Some(rest.split_once(end)?.0)).collect::<Vec<_>>()
    };
    let linked = [between("](", ')'), between("src=\"", '"'), between("srcset=\"", '"')].concat().into_iter();
    let files: Vec<&str> = linked.filter(|link| !link.starts_with("https://")).collect();
    assert!(files.contains(&"docs/pictures/compare-light.svg"), "links are found");
    for file in files {
        assert!(Path::new(ROOT).join(file).exists(), "{file}");
        assert!(!is_excluded(file), "{file} is not in the package");
    }
    assert!(is_excluded("examples/record/walk.cast") && is_excluded("tests/suite/main.rs"));
}

/// `cargo binstall` asks for the archives that a release has, and for the program where it lies in them.
#[test]
fn binstall_asks_for_the_archives_of_a_release() {
    let script = read(Path::new(ROOT).join(".ci/release"));
    for line in [
        "name=shelter-$version-$target",
        "*windows*) archive=$name.zip && ",
        "*) archive=$name.tar.gz && ",
        "into=$archives/$name",
        "cp \"$built\" README.md",
    ] {
        assert!(script.contains(line), "an archive has another name: {line}");
    }
    let workflow = read(Path::new(ROOT).join(".github/workflows/release.yml"));
    let targets: Vec<&str> = workflow
        .split("target: ")
        .skip(1)
        .filter_map(|rest| rest.split_once(" }"))
        .map(|(target, _)| target)
        .filter(|target| !target.contains('$'))
        .collect();
    assert_eq!(targets.len(), 4, "{targets:?}");
    let package = &manifest()["package"];
    let binstall = &package["metadata"]["binstall"];
    // Until there is an address, any stands for it.
    let repo =
        package.get("repository").map_or("https://example.org/shelter", |it| it.as_str().expect("a text"));
    for target in targets {
        let own = binstall["overrides"].get(target);
        let key = |name: &str| {
            let text = own.and_then(|own| own.get(name)).unwrap_or_else(|| &binstall[name]);
            let text = text.as_str().expect("a text").replace("{ target }", target);
            text.replace("{ version }", "1.2.3").replace("{ repo }", repo)
        };
        let (format, ending) = if target.contains("windows") { ("zip", "zip") } else { ("tgz", "tar.gz") };
        let folder = format!("shelter-1.2.3-{target}");
        assert_eq!(key("pkg-url"), format!("{repo}/releases/download/v1.2.3/{folder}.{ending}"));
        assert_eq!(key("pkg-fmt"), format);
        assert_eq!(key("bin-dir"), format!("{folder}/{{ bin }}{{ binary-ext }}"));
    }
}

/// Every bench runs in the CI for seconds.
#[test]
fn every_bench_has_a_short_run() {
    let script = read(Path::new(ROOT).join(".ci/benches"));
    let benches = manifest()["bench"].clone().try_into::<Vec<toml::Table>>().expect("benches");
    assert!(benches.len() > 4);
    for bench in benches {
        let name = bench["name"].as_str().expect("a name");
        assert!(script.contains(&format!("\nbench {name}")), "{name}");
    }
    assert!(script.contains("benches/peers/run.py"));
}
