//! Pages written before, beside the plan, that permit what may no longer be fired, or what another text of the plan said.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use super::app::App;
use crate::file::checksum;
use crate::report::html;
use crate::sorting::sort;
use crate::verdict::Verdict;

/// Of a page its head says what it permits; so many bytes hold it.
const HEAD: u64 = 4096;

impl App {
    /// The names of the options that may not be fired, as far as that is known.
    pub fn refused(&self) -> Vec<String> {
        let is_held = self.standing().against_passes().is_some();
        let refused = |option: &usize| {
            is_held || self.options[*option].is_decided() && self.word(*option).verdict() != Verdict::Pass
        };
        let options = (0..self.options.len()).filter(refused);
        options.map(|option| self.case.plan.delays[option].name.clone()).collect()
    }

    /// What is said of pages written before that permit what may not be fired; `None` where there are none.
    pub fn of_old_pages(&self) -> Option<String> {
        let (first, others) = self.old_pages.split_first()?;
        Some(match others.len() {
            0 => format!("{first} was written before: do not fire by it"),
            more => format!("{first} and {more} more were written before: do not fire by them"),
        })
    }
}

/// The names of the pages in the folder of a plan with this `text` that permit an option which is `refused`, or one of another text of the
/// plan, in order.
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
