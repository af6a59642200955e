//! The one palette of text, page and terminal: colours by role.
//!
//! Blue and orange are told apart by the colour-blind, too. Meaning never rests on colour alone: words carry it as well.

use crate::verdict::VerdictWord;

/// What a colour stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What passes, and the course of a quantity.
    Pass,
    /// What is undecided, or a thin pass, and firings.
    Open,
    /// What fails, and limits.
    Fail,
}

impl Role {
    /// Role of a verdict: a pass that is thin has no colour of a pass, and one that does not stand that of a fail.
    pub fn of(word: impl Into<VerdictWord>) -> Self {
        match word.into() {
            VerdictWord::Pass => Role::Pass,
            VerdictWord::Thin | VerdictWord::Open => Role::Open,
            VerdictWord::Hold | VerdictWord::Fail => Role::Fail,
        }
    }

    /// Red, green and blue on a light ground.
    pub const fn on_light(self) -> [u8; 3] {
        match self {
            Role::Pass => [0, 70, 150],
            Role::Open => [130, 95, 0],
            Role::Fail => [190, 25, 0],
        }
    }

    /// Red, green and blue on a dark ground.
    pub const fn on_dark(self) -> [u8; 3] {
        match self {
            Role::Pass => [86, 180, 233],
            Role::Open => [240, 228, 66],
            Role::Fail => [255, 140, 60],
        }
    }

    /// Number of the foreground colour in an ANSI escape, for a ground that is not known.
    pub const fn ansi(self) -> u8 {
        match self {
            Role::Pass => 36,
            Role::Open => 33,
            Role::Fail => 31,
        }
    }
}
