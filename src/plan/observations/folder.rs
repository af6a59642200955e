//! Finds the files of observations in a folder. None may be missed: a film that nobody reads contradicts no plan.

use std::io::Read;
use std::path::{Path, PathBuf};

use super::name_of;
use crate::choice::ObservedQuantity;
use crate::plan::Diagnostics;
use crate::sorting::sort;

/// The files at these paths. A folder stands for all its files that end in `.csv`, in the order of their names. Any other file in the
/// folder that may be a table, or hold one, is a mistake: a film that nobody reads contradicts no plan.
pub fn files_of(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Diagnostics> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let unreadable = |message: String| {
            Diagnostics::unreadable(
                &name_of(path),
                message,
                "give the folder in which the files of observations lie",
            )
        };
        let entries = std::fs::read_dir(path).map_err(|error| unreadable(error.to_string()))?;
        let found: Result<Vec<PathBuf>, _> = entries.map(|entry| entry.map(|entry| entry.path())).collect();
        let mut found = found.map_err(|error| unreadable(error.to_string()))?;
        sort(&mut found);
        if let Some(other) = found.iter().find(|path| is_no_csv_but_may_be_table(path)) {
            return Err(Diagnostics::unreadable(
                &name_of(other),
                "in this folder only files that end in .csv are read".to_owned(),
                "name it by itself, save it as .csv, or take it out of the folder",
            ));
        }
        found.retain(|path| has_ending(path, &["csv"]));
        if found.is_empty() {
            return Err(unreadable("the folder has no file that ends in .csv".to_owned()));
        }
        files.extend(found);
    }
    Ok(files)
}

/// Names of the films that lie beside a plan, or in a folder beside it, and are not among the files `given`. Folders of other plans' shots do
/// not count; the folder of `rows.toml` is `rows.shots`.
pub fn names_of_films_not_given(plan: &Path, given: &[PathBuf]) -> Vec<String> {
    let (own, beside) = (plan.with_extension("shots"), plan.parent().unwrap_or(Path::new("")));
    let beside = if beside.as_os_str().is_empty() { Path::new(".") } else { beside };
    let is_others = |path: &PathBuf| *path != own && has_ending(path, &["shots"]);
    let folders = entries_of(beside).filter(|path| path.is_dir() && !is_others(path));
    let within = folders.flat_map(|folder| entries_of(&folder));
    let same = |a: &Path, b: &Path| a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b));
    let tables = within.chain(entries_of(beside)).filter(|path| has_ending(path, &["csv"]) && path.is_file());
    let not_given = tables.filter(|film| given.iter().all(|one| !same(one, film)));
    let mut films: Vec<PathBuf> =
        not_given.filter(|path| path.starts_with(&own) || names_quantities(path)).collect();
    sort(&mut films);
    films.iter().map(|film| name_of(film.strip_prefix(beside).unwrap_or(film))).collect()
}

/// The entries of a folder; none if it cannot be read.
fn entries_of(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

/// Whether an entry of a folder may hold observations that nobody reads: a folder, a table of another kind, a copy with another ending, or
/// a file that looks like a table.
fn is_no_csv_but_may_be_table(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let is_csv = has_ending(path, &["csv"]);
    path.is_dir() || !is_csv && (name.contains(".csv") || has_ending(path, &TABLES) || names_quantities(path))
}

/// Whether a file with any ending holds the name of a quantity in its first megabyte, as every table of observations does. Plans and their
/// pages do not count. Nor does the record beside a plan, because the program compares the plan with it anyway.
fn names_quantities(path: &Path) -> bool {
    let name = path.to_string_lossy();
    let is_reported_of_plan =
        name.strip_suffix(".seen.json").is_some_and(|plan| Path::new(&format!("{plan}.toml")).exists());
    if is_reported_of_plan || has_ending(path, &["toml", "html"]) {
        return false;
    }
    if !path.is_file() {
        return true;
    }
    let mut start = Vec::new();
    let read = std::fs::File::open(path).map(|file| file.take(1 << 20).read_to_end(&mut start));
    // Without zero bytes, text with two bytes a letter is readable, too.
    start.retain(|byte| *byte != 0);
    let text = String::from_utf8_lossy(&start).to_lowercase();
    // A file that cannot be read may be a table.
    !matches!(read, Ok(Ok(_))) || ObservedQuantity::NAMES.iter().any(|name| text.contains(name))
}

/// Endings of tables that are not read.
const TABLES: [&str; 9] = ["txt", "tsv", "tab", "dat", "xls", "xlsx", "xlsm", "ods", "numbers"];

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().unwrap_or_default();
    endings.iter().any(|known| ending.eq_ignore_ascii_case(known))
}
