//! All integration tests, in one binary so that they link once.
//!
//! | claim | where |
//! |---|---|
//! | the motion is right | `closed_forms`, `reference`, `oracle`, `properties`, `mirrors`, `extremes`, `breaking`, `effects`, `hole_by_hole` |
//! | its errors are right, and it takes no memory | `calibration`, `allocation` |
//! | a plan is read or its mistake is told | `plans`, `bad_plans`, `plan_keys`, `schema`, `import`, `shotplus`, `damaged_texts` |
//! | studies find what brute force finds | `risk`, `studies`, `search`, `remedies`, `fit` |
//! | commands do what scripts expect | `check`, `long_studies`, `saved`, `page` |
//! | nothing is lost, whatever happens | `faults`, `saved`, `terminal` |
//! | screens and keys | `screens`, `keys`, `flight`, `terminal`; what a person came for, in how many keys: `journeys` |
//! | the source keeps its own rules | `layers`, `documents` |
//! | what tests share | `support`: scenes, an app on a test terminal, the program on a pseudo-terminal |

mod allocation;
mod bad_plans;
mod breaking;
mod calibration;
mod check;
mod closed_forms;
mod damaged_texts;
mod documents;
mod effects;
mod extremes;
mod faults;
mod fit;
mod flight;
mod hole_by_hole;
mod import;
#[cfg(unix)]
mod journeys;
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
mod saved;
mod schema;
mod screens;
mod search;
#[cfg(feature = "shotplus")]
mod shotplus;
mod studies;
mod support;
#[cfg(unix)]
mod terminal;
