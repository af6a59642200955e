//! All integration tests, in one binary so that they link once.

mod allocation;
mod bad_plans;
mod breaking;
mod calibration;
mod check;
mod closed_forms;
mod documents;
mod effects;
mod extremes;
mod faults;
mod fit;
mod flight;
mod hole_by_hole;
mod hostile;
mod import;
mod keys;
mod layers;
mod long_studies;
mod mirrors;
mod oracle;
mod page;
mod plan_keys;
mod plans;
mod properties;
mod reference;
mod remedies;
mod risk;
#[cfg(unix)]
mod saved;
mod scenes;
mod schema;
mod screens;
mod search;
#[cfg(feature = "shotplus")]
mod shotplus;
mod stage;
mod studies;
mod support;
#[cfg(unix)]
mod terminal;
mod walks;
mod watched;
