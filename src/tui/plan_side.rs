//! Which of two plans side by side, and an option of such a plan.

/// Which of two plans, in the order of the command line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlanSide {
    /// The first, or the only one.
    #[default]
    A,
    /// The second.
    B,
}

impl PlanSide {
    /// The letter that marks text about this plan.
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
    /// The plan of the option.
    pub side: PlanSide,
    /// Index of the option in that plan.
    pub option: usize,
}
