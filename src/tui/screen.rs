//! The screens and their order.

/// A screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Screen {
    /// The plan, to be edited.
    Plan,
    /// The delay options side by side.
    #[default]
    Compare,
    /// The selected option in motion.
    Flight,
    /// Studies: sweep, orders, risk, search, size, effects, fit.
    Studies,
    /// The cost of accuracy.
    Accuracy,
}

impl Screen {
    /// Every screen, in the order of the keys.
    pub const ALL: [Screen; 5] =
        [Screen::Plan, Screen::Compare, Screen::Flight, Screen::Studies, Screen::Accuracy];

    /// The screen `by` places further. The first follows the last.
    pub fn next_by(self, by: usize) -> Self {
        Self::ALL[(self as usize + by) % Self::ALL.len()]
    }

    /// The name on its tab.
    pub fn name(self) -> &'static str {
        match self {
            Screen::Plan => "Plan",
            Screen::Compare => "Compare",
            Screen::Flight => "Flight",
            Screen::Studies => "Studies",
            Screen::Accuracy => "Accuracy",
        }
    }
}
