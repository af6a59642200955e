//! What was seen of earlier shots, and what of it speaks against a plan.
//!
//! | question | where |
//! |---|---|
//! | what was told in the terminal, as text | [`ObservationRecord`], and [`record_file`], the file beside the plan that holds it |
//! | what of all that was seen speaks against the plan | [`Comparison`], which [`objection`] makes |
//! | values outside what the plan predicts, over a limit, or fired otherwise | [`contradiction`], by the rules of `find_contradictions` |
//! | shots that say together that launches are faster, or other than predicted | `in_common` |
//! | shots with another charge, stemming or mass of tires | [`other_shot`] |
//!
//! Files of observations are read by [`crate::plan::observations`]; what a plan predicts of them is computed by
//! [`fit::observation_bands`](crate::study::fit::observation_bands).

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
