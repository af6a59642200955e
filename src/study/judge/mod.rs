//! Whether an option passes, and whether it may be offered. Every study, command and screen asks here.
//!
//! | in this order | what | where |
//! |---|---|---|
//! | 1 | checks all options of one or several plans as planned, samples them, and calls the steps below | [`batch`] |
//! | 2 | runs the samples that decide by height and by force once more, for their curves over time | [`deciding_shot`] |
//! | 3 | tries any one hole left out, the next tire over a hole, and tires that turn | [`one_dud`], [`next_tires`], `turned` |
//! | 4 | confirms an offered option by fresh draws | [`confirm`] |
//! | 5 | ranks options by safety, recommends one, gives the verdict on a plan | [`recommend`] |
//! | | holds everything known of one option, and takes each [`Part`] as it becomes known | [`Judgement`] |
//! | | lists the grounds of a verdict and gives the verdict | [`grounds`] |
//! | | says why an option does not pass | [`Reason`] |
//! | | judges one of many shots without keeping samples | [`brief_judgement`] |
//! | | chooses the shots to judge if there is no time for all | `nearest_limits` |
//!
//! Only [`grounds::Grounds::verdict`] gives a verdict. [`super::standing`] says whether a pass stands and permits firing. The planned shot
//! and the samples have verdicts of their own, which are two of the grounds. `as_planned` and `samples` give these with their reasons, and
//! do not depend on this folder.

pub mod batch;
pub mod brief_judgement;
pub mod confirm;
pub mod deciding_shot;
pub mod grounds;
mod judgement;
pub mod nearest_limits;
pub mod next_tires;
pub mod one_dud;
mod reason;
pub mod recommend;
mod turned;

pub use judgement::{Judgement, OptionResults, Part, verdict_of};
pub use reason::Reason;
