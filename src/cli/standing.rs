//! How a plan stands once a command has computed: what became of its file meanwhile, and what was seen of earlier shots.

use std::path::Path;

use crate::study::Case;
use crate::study::objection::Objection;
use crate::study::observed::Observed;
use crate::study::standing::Standing;
use crate::tui::recovery;

/// A plan, how its file is now, and how it stands, of which a command has found these `objections`.
pub fn standing_now(case: Case, objections: Vec<Objection>) -> (Case, Standing) {
    let case = case.with_file_now();
    let standing = Standing::of(&case, objections);
    (case, standing)
}

/// What was told of earlier shots of a plan in the terminal.
pub fn told_in_terminal(case: &Case) -> Observed {
    told_of(&case.source.path)
}

/// The same of a plan in this file.
pub fn told_of(path: &str) -> Observed {
    recovery::find_seen(Path::new(path))
}
