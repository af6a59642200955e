//! Plans from the command line: loading with diagnostics on stderr, and opening one in the terminal.

use std::io::{self, IsTerminal};
use std::path::Path;

use super::{Compute, Look, Status};
use crate::plan::Plan;
use crate::study::Case;

/// Loads plans; prints every mistake of every plan and returns `None` when there is one.
pub fn cases<'a>(paths: impl IntoIterator<Item = &'a std::path::PathBuf>, look: &Look) -> Option<Vec<Case>> {
    let mut cases = Some(Vec::new());
    for path in paths {
        match Plan::load(path) {
            Ok(plan) => {
                if let Some(cases) = &mut cases {
                    cases.push(Case::new(plan));
                }
            }
            Err(diagnostics) => {
                eprint!("{}", diagnostics.render(look.colored(io::stderr().is_terminal())));
                cases = None;
            }
        }
    }
    cases
}

/// Opens a plan in the terminal; without one, says the same as `check`.
pub fn open(plan: &Path, compute: &Compute, look: &Look) -> io::Result<Status> {
    let Some(case) = cases(&[plan.to_path_buf()], look).and_then(|mut cases| cases.pop()) else {
        return Ok(Status::Wrong);
    };
    super::check::print(vec![case], compute, look, &super::check::Output::default())
}
