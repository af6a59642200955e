//! The shots that are possible, as `[uncertainty]` describes them.
//!
//! | what | where |
//! |---|---|
//! | one drawn at random, and its run | [`random_shot`], [`sample`] |
//! | how many; which are run when | [`sample_count`], [`draw_until_sure`] |
//! | what they tell: the risk and its verdict | [`sampled_shot`]; of thousands of shots: [`risk_summary`] |
//! | how sure a count of failures is | [`failure_bounds`] |
//! | which input decides | [`influence`] |
//! | rows that may fire the wrong way round | [`swaps`] |

pub mod draw_until_sure;
pub mod failure_bounds;
pub mod influence;
pub mod random_shot;
pub mod risk_summary;
pub mod sample;
pub mod sample_count;
pub mod sampled_shot;
pub mod swaps;
