//! Which of two plans side by side, and an option of it.

/// Which of two plans: the first or the second of the command line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlanSide {
    /// The first, or the only one.
    #[default]
    A,
    /// The second.
    B,
}

impl PlanSide {
    /// The letter that stands before what belongs to the plan.
    pub fn letter(self) -> &'static str {
        match self {
            PlanSide::A => "A",
            PlanSide::B => "B",
        }
    }
}

/// A delay option of one of the plans shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanOption {
    /// Its plan.
    pub side: PlanSide,
    /// Its index in that plan.
    pub option: usize,
}
