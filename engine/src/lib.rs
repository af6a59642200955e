//! Motion of a shelter of tires and cables over a blast: contact dynamics with an energy ledger.
//!
//! ```text
//! Scene, Shot ─▶ Model::run ─▶ Outcome: peaks of height, force and drift, energies, histories
//! ```
//!
//! The crate knows no plans, options, limits or screens. `blast-shelter` builds the scenes from plans and judges the outcomes. The
//! engine is a crate of its own because the compiler must optimize it as one piece. The other code takes little time to run, and is
//! compiled in several pieces.

pub mod choice;
pub mod outcome;
pub mod scene;
pub mod simulation;
