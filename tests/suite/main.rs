//! All integration tests, in one binary so that they link once.
//!
//! | claim | where |
//! |---|---|
//! | a shelter as it is laid, a shot as it is fired | `as_laid` |
//! | a plan is read or its mistake is told | `plans`, `bad_plans`, `plan_keys`, `schema`, `import`, `shotplus`, `damaged_texts` |
//! | what is recommended is confirmed, and what a PASS stands on is told | `recommend`, `assumptions` |
//! | the motion is right | `closed_forms`, `anchors`, `reference`, `published`, `oracle`, `properties`, `mirrors`, `extremes`, `breaking`, `effects`, `damped_peaks`, `hole_by_hole` |
//! | its errors are right, and it takes no memory | `calibration`, `unknown_errors`, `allocation` |
//! | studies find what brute force finds | `risk`, `made_samples`, `studies`, `search`, `remedies`, `fit` |
//! | where a launch velocity comes from, and that no verdict passes on an estimate | `launch` |
//! | commands do what scripts expect | `check`, `json_documents`, `long_studies`, `saved`, `page`; the page in Russian: `language` |
//! | nothing is lost, whatever happens | `faults`, `saved`, `terminal` |
//! | screens and keys | `screens`, `keys`, `flight`, `terminal`, `two_plans`; what a person came for, in how many keys: `journeys` |
//! | the source keeps its own rules | `layers`, `documents` |
//! | the manual is short where a reader begins, and shows what the program prints | `manual` |
//! | what tests share | `support`: scenes, an app on a test terminal, the program on a pseudo-terminal |

mod allocation;
mod anchors;
mod as_laid;
mod assumptions;
mod bad_plans;
mod breaking;
mod calibration;
mod check;
mod closed_forms;
mod damaged_texts;
mod damped_peaks;
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
mod json_documents;
mod keys;
mod language;
mod launch;
mod layers;
mod long_studies;
mod made_samples;
mod manual;
mod mirrors;
mod oracle;
mod page;
mod plan_keys;
mod plans;
mod progress;
mod properties;
mod published;
mod recommend;
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
mod two_plans;
mod unknown_errors;
