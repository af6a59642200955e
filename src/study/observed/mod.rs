//! Observations of earlier shots, and which of them speak against a plan.
//!
//! | question | where |
//! |---|---|
//! | what did the user type or read in the terminal? | [`ObservationRecord`]; [`record_file`] is its file beside the plan |
//! | which observations speak against the plan? | [`Comparison`], made by [`objection`] |
//! | which values exceed a limit or leave their band, which times differ? | [`contradiction`], by the rules of `find_contradictions` |
//! | do several shots together show faster launches, or other launches than predicted? | `in_common` |
//! | which shots had another charge, stemming or mass of tires? | [`other_shot`] |
//!
//! [`crate::plan::observations`] reads files of observations. [`fit::observation_bands`](crate::study::fit::observation_bands) predicts the
//! observations of a plan.

mod comparison;
pub mod contradiction;
mod find_contradictions;
mod in_common;
pub mod objection;
pub mod other_shot;
mod record;
pub mod record_file;

pub use self::comparison::{AboveBand, Comparison, NotCompared, Objection};
pub use self::record::{ObservationRecord, Withdrawn, is_typed};
