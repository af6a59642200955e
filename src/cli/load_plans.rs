//! Opens the plans named on the command line. Their mistakes go to standard error.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use super::arguments::LookArguments;
use super::tell;
use crate::plan::{HoleTiming, names};
use crate::study::Case;

/// Opens plans. Prints every mistake of every plan; `None` if there is a mistake.
pub fn open_all<'a>(paths: impl IntoIterator<Item = &'a PathBuf>, look: &LookArguments) -> Option<Vec<Case>> {
    // All plans are opened before the first mistake ends the command.
    let cases: Vec<Option<Case>> = paths.into_iter().map(|path| open(path, look)).collect();
    cases.into_iter().collect()
}

/// Opens a plan. Prints its mistakes; `None` if there is one.
pub fn open(path: &Path, look: &LookArguments) -> Option<Case> {
    let opened = Case::load(path);
    if let Err(mistakes) = &opened {
        tell::mistakes(mistakes, look.colored(io::stderr().is_terminal()));
    }
    opened.ok()
}

/// Opens a plan and finds the delay option of this name; without a name, the first option. Prints what is wrong; `None` if anything is.
pub fn open_option(plan: &Path, option: Option<&str>, look: &LookArguments) -> Option<(Case, usize)> {
    let case = open(plan, look)?;
    match find_option(&case, option) {
        Ok(option) => Some((case, option)),
        Err(message) => {
            tell!("error: {message}");
            None
        }
    }
}

/// Indices of the delay options of these names; all options if there are no names.
pub fn choose_options(case: &Case, names: &[String]) -> Result<Vec<usize>, String> {
    match names {
        [] => Ok((0..case.shots.len()).collect()),
        names => names.iter().map(|name| find_option(case, Some(name))).collect(),
    }
}

/// Timing of the holes of each row in a study that varies order or interval: the timing in the option of this name, or without a name the
/// timing that all options share.
pub fn holes_of(case: &Case, name: Option<&str>) -> Result<Option<HoleTiming>, String> {
    let option = find_option(case, name)?;
    Ok(case.plan.hole_timing_of(name.map(|_| option)))
}

/// Index of the delay option of this name; without a name, of the first option.
pub fn find_option(case: &Case, name: Option<&str>) -> Result<usize, String> {
    let names: Vec<&str> = case.plan.delays.iter().map(|delay| delay.name.as_str()).collect();
    let Some(name) = name else { return Ok(0) };
    names::find(names.iter().copied(), name).ok_or_else(|| {
        format!("no delay option '{name}' in {}; it has: {}", case.source.name(), names.join("; "))
    })
}
