//! Standing of a plan after a command has computed: the state of its file now, and its comparison with observations of earlier shots.

use crate::kept;
use crate::study::observed::{Comparison, ObservationRecord};
use crate::study::standing::Standing;
use crate::study::{Case, FileState};

/// Standing of a plan at this moment. `compared` is its comparison with observations of earlier shots.
pub fn standing_now(case: &Case, compared: Comparison) -> Standing {
    Standing::of(case, FileState::now(&case.source), compared)
}

/// The record of a plan: observations typed or read in the terminal.
pub fn observation_record(case: &Case) -> ObservationRecord {
    kept::find_record(&case.source.path)
}
