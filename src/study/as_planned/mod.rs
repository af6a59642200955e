//! The check of one planned shot.
//!
//! | what | where |
//! |---|---|
//! | the check, refined until the verdict is sure | [`check`], `ladder`; one of thousands of shots: [`quick_check`]; many: [`check_many`] |
//! | greatest values of a run, with the error of its step | `peaks`, [`step_error`] |
//! | why a run does not pass | [`shot_reason`] |
//! | the cover over each hole as it fires, which no limit judges | [`cover`] |
//! | how much faster the tires may leave | [`margin`] |
//! | the numbers that a study keeps of a check | [`shot_summary`] |
//!
//! How far an error is trusted. The constants hold the factors, and their docs give the reasons:
//!
//! | factor | meaning |
//! |---|---|
//! | `step_error::MARGIN` | the reported error, over the largest estimate by neighboring steps |
//! | `step_error::FAR_ERROR_FACTOR` | how many errors nearby shots may differ before their difference becomes the error |
//! | `check::SURE_ERROR_FACTOR` | with how many errors a verdict of a check must still stand |
//! | `quick_check::ERROR_FACTOR` | the reported error of a quick check with its coarser runs, over the error that a check would report |
//! | `quick_check::SURE_PASS`, `SURE_FAIL` | with how many errors a verdict of a quick check must still stand |
//! | `sweep::windows::CALM_ERROR_FACTOR` | with how many errors two intervals must pass, so that the intervals between them pass |
//! | `orders::check_extremes::REACH_ERROR_FACTOR` | within how many errors an order may still be the worst or the best |
//! | `shot_reason::MOST_RESIDUAL` | which share of the energy may be missing in a run that counts at all |
//! | `samples::sampled_shot::BIAS_ALLOWANCE` | by how many differences of an audit all samples are moved; the verdict must still stand |

pub mod check;
pub mod check_many;
pub mod cover;
mod ladder;
pub mod margin;
mod peaks;
pub mod quick_check;
pub mod shot_reason;
pub mod shot_summary;
pub mod step_error;
