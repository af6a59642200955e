//! The shots that are possible, as `[uncertainty]` describes them.
//!
//! | what | where |
//! |---|---|
//! | one drawn at random, and its run | [`random_shot`], [`run_sample`], [`sample`] |
//! | how many; which are run when | [`sample_count`], [`sample_until_sure`] |
//! | what they tell: the risk, its verdict and why that is no pass | [`sampled_shot`], [`risk_reason`]; of thousands of shots: [`risk_summary`] |
//! | how sure a count of failures is | [`failure_bounds`] |
//! | which input decides | [`influence`] |
//! | rows that may fire the wrong way round | [`swaps`] |
//!
//! A verdict on samples is wrong with a probability of at most 5 % ([`failure_bounds`]), however often they are looked at. Who
//! gives several verdicts and takes the best shares these 5 % between them, and who chose by samples draws fresh ones for the
//! verdict:
//!
//! | who | share ([`ErrorShare`](failure_bounds::ErrorShare)) | fresh draws |
//! |---|---|---|
//! | `risk`: each option by itself | `Whole` | |
//! | `check`: each option by itself; what it recommends | `Whole`; `Nth` | yes, for the choice |
//! | `remedies`: one change of a kind after the other, until one passes | `Nth` of the kind | yes |
//! | `sweep`: one recommended interval after the other | `Nth` | yes |
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
