//! The shots that are possible, as `[uncertainty]` describes them.
//!
//! | what | where |
//! |---|---|
//! | one drawn at random, and its run | [`draw`], [`sample`] |
//! | how many; which are run when | [`sampling`], [`rounds`] |
//! | what they tell: the risk and its verdict | [`sampled_shot`]; of thousands of shots: [`risk_summary`] |
//! | how sure a count of failures is | [`failure_bounds`] |
//! | which input decides | [`influence`] |
//! | rows that may fire the wrong way round | [`swaps`] |

pub mod draw;
pub mod failure_bounds;
pub mod influence;
pub mod risk_summary;
pub mod rounds;
pub mod sample;
pub mod sampled_shot;
pub mod sampling;
pub mod swaps;
