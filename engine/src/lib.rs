//! How a shelter of tires and cables moves over a blast: contact dynamics, with an energy ledger.
//!
//! ```text
//! Scene, Shot ─▶ Model::run ─▶ Outcome: peaks of height, force and drift, energies, histories
//! ```
//!
//! The crate knows no plans, options, limits or screens: `blast-shelter` builds scenes from plans, and judges outcomes. It is a crate of
//! its own because it is the part that must be optimized as one piece; all else takes little time and builds in several.

pub mod choice;
pub mod outcome;
pub mod scene;
pub mod simulation;
