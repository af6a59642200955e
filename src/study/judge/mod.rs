//! Does an option pass, and may it be offered: everything that answers this, for every study, command and screen.
//!
//! | in this order | what | where |
//! |---|---|---|
//! | 1 | all options of one plan or of several: checked as planned, then sampled; it calls all that follows | [`batch`] |
//! | 2 | the samples that decide by height and by force, run once more for their courses | [`deciding_shot`] |
//! | 3 | any one hole left out; the next tire over a hole; tires that turn | [`one_dud`], [`next_tires`], `turned` |
//! | 4 | fresh draws that confirm what is offered | [`confirm`] |
//! | 5 | the safest first; the option that is recommended; the verdict on a plan | [`recommend`] |
//! | | all that becomes known of one option, and each [`Part`] as it does | [`Judgement`] |
//! | | what its verdict rests on, and the verdict | [`grounds`] |
//! | | why it does not pass | [`Reason`] |
//! | | the same of one of many shots, of which no samples are kept | [`brief_judgement`] |
//! | | which of many shots are judged, where there is no time for all | `nearest_limits` |
//!
//! A verdict comes from [`grounds::Grounds::verdict`] alone; whether a pass stands, and is leave to fire, says [`super::standing`].
//! The shot as planned and the samples have verdicts of their own, which are two of the grounds: `as_planned` and `samples` give
//! them with their reasons, and know nothing of this folder.

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
