//! How a plan stands once a command has computed: what became of its file meanwhile, and what was seen of earlier shots.

use std::path::Path;

use crate::study::Case;
use crate::study::objection::{NotCompared, Objection};
use crate::study::standing::Standing;
use crate::tui::observed::Observed;
use crate::tui::recovery;

/// A plan, how its file is now, and how it stands, of which a command has found these `objections`.
pub fn standing_now(case: Case, objections: impl FnOnce(&Case) -> Vec<Objection>) -> (Case, Standing) {
    let case = case.with_file_now();
    let objections = objections(&case);
    let standing = standing_of_command(&case, objections);
    (case, standing)
}

/// How a plan stands, of which a command has found these `objections`. What was typed for it in the terminal is in no file: no command
/// knows whether it contradicts the verdicts.
pub fn standing_of_command(case: &Case, mut objections: Vec<Objection>) -> Standing {
    if seen_in_terminal(case).has_typed_beside(&case.plan) {
        objections.push(Objection::NotCompared(NotCompared::TypedInTerminal));
    }
    Standing::of(case, objections)
}

/// What was told of earlier shots in the terminal.
pub fn seen_in_terminal(case: &Case) -> Observed {
    recovery::find(Some(Path::new(&case.source.path))).map(|kept| kept.observed).unwrap_or_default()
}
