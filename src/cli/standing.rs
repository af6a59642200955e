//! How a plan stands once a command has computed: what became of its file meanwhile, and what was seen of earlier shots.

use std::path::Path;

use crate::kept;
use crate::study::observed::{Comparison, ObservationRecord};
use crate::study::standing::Standing;
use crate::study::{Case, FileState};

/// How a plan stands at this moment, of which a command has `compared` what was seen of earlier shots.
pub fn standing_now(case: &Case, compared: Comparison) -> Standing {
    Standing::of(case, FileState::now(&case.source), compared)
}

/// What was told of earlier shots of a plan in the terminal.
pub fn observation_record(case: &Case) -> ObservationRecord {
    record_of(&case.source.path)
}

/// The same of a plan in this file.
pub fn record_of(path: &Path) -> ObservationRecord {
    kept::find_record(path)
}
