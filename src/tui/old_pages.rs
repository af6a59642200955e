//! Older pages beside the plan that permit an option which must no longer be fired, or that are of another text of the plan.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use super::app::App;
use crate::file::checksum;
use crate::report::html;
use crate::sorting::sort;
use crate::verdict::Verdict;

/// Bytes at the beginning of a page that say what it permits.
const HEAD: u64 = 4096;

impl App {
    /// Names of the options that must not be fired, as far as known.
    pub fn refused(&self) -> Vec<String> {
        let is_held = self.standing().against_passes().is_some();
        let refused = |option: &usize| {
            is_held || self.options[*option].is_decided() && self.word(*option).verdict() != Verdict::Pass
        };
        let options = (0..self.options.len()).filter(refused);
        options.map(|option| self.case.plan.delays[option].name.clone()).collect()
    }

    /// Warning about older pages that permit what must not be fired; `None` if there are no such pages.
    pub fn of_old_pages(&self) -> Option<String> {
        let (first, others) = self.old_pages.split_first()?;
        Some(match others.len() {
            0 => format!("{first} was written before: do not fire by it"),
            more => format!("{first} and {more} more were written before: do not fire by them"),
        })
    }
}

/// Sorted names of the pages in the folder of `plan` that permit a `refused` option, or an option of another text of the plan than `text`.
pub fn permitting_wrongly(plan: &Path, text: &str, refused: &[String]) -> Vec<String> {
    let Some(name) = plan.file_name() else { return Vec::new() };
    let (name, hash) = (name.to_string_lossy(), checksum(text));
    let folder = plan.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let files = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let pages = files.filter(|path| path.extension().is_some_and(|ending| ending == "html"));
    let permits = |path: &Path| {
        let mut head = Vec::new();
        File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head)).is_ok_and(|_| {
            let head = String::from_utf8_lossy(&head);
            html::is_page(&head) && html::permits_wrongly(&head, &name, &hash, refused)
        })
    };
    let found = pages.filter(|path| path.is_file() && permits(path));
    let mut names: Vec<String> =
        found.filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned())).collect();
    sort(&mut names);
    names
}
