//! The one palette of text, page and terminal: colours by role.
//!
//! Colour-blind readers can tell the colours apart, too. Meaning never rests on colour alone: words carry it as well.

use crate::verdict::VerdictWord;

/// Meaning of a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A pass.
    Pass,
    /// A thin pass, a value near its limit, warnings, and firing times in charts of the page.
    Thin,
    /// An undecided verdict.
    Open,
    /// A fail, a value above its limit, and the limits in charts of the page.
    Fail,
}

impl Role {
    /// All roles.
    pub const ALL: [Self; 4] = [Role::Pass, Role::Thin, Role::Open, Role::Fail];

    /// Role of a verdict. A thin pass has no colour of a pass. A pass that does not stand has the colour of a fail.
    pub fn of(word: impl Into<VerdictWord>) -> Self {
        match word.into() {
            VerdictWord::Pass => Role::Pass,
            VerdictWord::Thin => Role::Thin,
            VerdictWord::Open => Role::Open,
            VerdictWord::Hold | VerdictWord::Fail => Role::Fail,
        }
    }

    /// Name of the CSS class.
    pub const fn class(self) -> &'static str {
        match self {
            Role::Pass => "pass",
            Role::Thin => "thin",
            Role::Open => "undecided",
            Role::Fail => "fail",
        }
    }

    /// Red, green and blue on a light ground.
    pub const fn on_light(self) -> [u8; 3] {
        match self {
            Role::Pass => [0, 70, 150],
            Role::Thin => [130, 95, 0],
            Role::Open => [40, 40, 40],
            Role::Fail => [190, 25, 0],
        }
    }

    /// Red, green and blue on a dark ground.
    pub const fn on_dark(self) -> [u8; 3] {
        match self {
            Role::Pass => [86, 180, 233],
            Role::Thin => [240, 228, 66],
            Role::Open => [235, 235, 235],
            Role::Fail => [255, 140, 60],
        }
    }

    /// Number of the foreground colour in an ANSI escape, where the ground is not known.
    pub const fn ansi(self) -> u8 {
        match self {
            Role::Pass => 36,
            Role::Thin => 33,
            Role::Open => 39,
            Role::Fail => 31,
        }
    }
}
