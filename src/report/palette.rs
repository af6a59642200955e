//! The one palette of text, page and terminal: colours by role.
//!
//! Blue and orange are told apart by the colour-blind, too. Meaning never rests on colour alone: words carry it as well.

use crate::verdict::Verdict;

/// What a colour stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What passes, and the course of a quantity.
    Pass,
    /// What is undecided, and firings.
    Open,
    /// What fails, and limits.
    Fail,
}

impl Role {
    /// Role of a verdict.
    pub fn of(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Pass => Role::Pass,
            Verdict::Undecided => Role::Open,
            Verdict::Fail => Role::Fail,
        }
    }

    /// Red, green and blue on a light ground.
    pub const fn on_light(self) -> [u8; 3] {
        match self {
            Role::Pass => [0, 70, 150],
            Role::Open => [110, 80, 0],
            Role::Fail => [170, 50, 0],
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
