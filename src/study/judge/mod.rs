//! Does an option pass, and may it be offered: everything that answers this, for every study, command and screen.
//!
//! | in this order | what | where |
//! |---|---|---|
//! | 1 | all options of one plan or of several: checked as planned, then sampled | [`options`] |
//! | 2 | the sample that decides, run once more for its course | [`deciding_shot`] |
//! | 3 | any one hole left out; the next tire over a hole | [`one_dud`], [`next_tires`] |
//! | 4 | the safest first, and the fresh draws that confirm what is offered | [`recommend`] |
//! | | all that becomes known of one option | [`Judgement`] |
//! | | what its verdict rests on, and the verdict | [`grounds`] |
//! | | why it does not pass | [`Reason`] |
//! | | the same of one of many shots, of which no samples are kept | [`brief_judgement`] |
//! | | which of many shots are judged, where there is no time for all | `nearest_limits` |
//!
//! A verdict comes from [`grounds::Grounds::verdict`] alone. The shot as planned and the samples have verdicts of their own, which are two of
//! the grounds: `as_planned` and `samples` give them with their reasons, and know nothing of this folder.

pub mod brief_judgement;
pub mod deciding_shot;
pub mod grounds;
mod judgement;
pub mod nearest_limits;
pub mod next_tires;
pub mod one_dud;
pub mod options;
mod reason;
pub mod recommend;

pub use judgement::Judgement;
pub use reason::Reason;
