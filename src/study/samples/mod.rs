//! Sampled shots: random variants of a planned shot, as `[uncertainty]` describes them.
//!
//! | what | where |
//! |---|---|
//! | one sample: its draw and its run | [`random_shot`], [`run_sample`], [`sample`] |
//! | how many samples; which run when | [`sample_count`], [`sample_until_sure`] |
//! | the risk, its verdict and why it is no pass | [`sampled_shot`], [`risk_reason`]; of thousands of shots: [`risk_summary`] |
//! | how sure a count of failures is | [`failure_bounds`] |
//! | which input decides | [`influence`] |
//! | rows that may fire in reverse order | [`swaps`] |
//!
//! A verdict on samples is wrong with a probability of at most 5 % ([`failure_bounds`]), however often the samples are looked at. A
//! study that gives several verdicts and takes the best shares these 5 % among them. A study that chose by samples draws fresh
//! samples for the verdict:
//!
//! | study | share ([`ErrorShare`](failure_bounds::ErrorShare)) | fresh draws |
//! |---|---|---|
//! | `risk`: each option by itself | `Whole` | |
//! | `check`: each option by itself; each option that passes, if there are several | `Whole`; `Nth` | yes, for the choice |
//! | `remedies`: one change after the other, until one of a kind passes | `Nth` of the option, over all kinds | yes |
//! | `sweep`: one recommended interval after the other | `Nth` | yes |
//! | `orders`: the best order | `Nth` | yes |
//! | `search`: the schedules of the report, all at once | `Nth` | yes, for the choice |
//! | `size`: one combination after the other | `Nth` | yes, for the choice |

pub mod failure_bounds;
pub mod influence;
pub mod random_shot;
pub mod risk_reason;
pub mod risk_summary;
pub mod run_sample;
pub mod sample;
pub mod sample_count;
pub mod sample_until_sure;
pub mod sampled_shot;
pub mod swaps;
