//! All integration tests, in one binary so that they link once.

mod allocation;
mod bad_plans;
mod calibration;
mod check;
mod closed_forms;
mod extremes;
mod layers;
mod mirrors;
mod plans;
mod properties;
mod reference;
mod scenes;
mod screens;
#[cfg(unix)]
mod terminal;
