//! Colours by role. Meaning never rests on colour alone: words and signs carry it too.

use ratatui::buffer::Buffer;
use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;

use crate::report::ascii::substitute;
use crate::report::palette::Role;
use crate::verdict::Verdict;

/// A set of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Theme {
    /// For dark rooms.
    #[default]
    Dark,
    /// For bright rooms.
    Light,
    /// Black on white, bold, for direct sun.
    Sunlight,
}

impl Theme {
    /// The next one.
    pub fn next(self) -> Self {
        match self {
            Theme::Dark => Theme::Light,
            Theme::Light => Theme::Sunlight,
            Theme::Sunlight => Theme::Dark,
        }
    }

    /// Plain text and background.
    pub fn base(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Reset).bg(Color::Reset),
            Theme::Light => Style::new().fg(Color::Rgb(30, 30, 30)).bg(Color::Rgb(250, 250, 246)),
            Theme::Sunlight => Style::new()
                .fg(Color::Rgb(0, 0, 0))
                .bg(Color::Rgb(255, 255, 255))
                .add_modifier(Modifier::BOLD),
        }
    }

    /// Titles.
    pub fn title(self) -> Style {
        self.base().add_modifier(Modifier::BOLD)
    }

    /// What may be overlooked.
    pub fn quiet(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Gray),
            Theme::Light => Style::new().fg(Color::Rgb(80, 80, 80)),
            Theme::Sunlight => self.base(),
        }
    }

    /// The selected row.
    pub fn selected(self) -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }

    /// A verdict; blue and orange, which the colour-blind tell apart.
    pub fn verdict(self, verdict: Verdict) -> Style {
        let role = Role::of(verdict);
        let [red, green, blue] = if self == Theme::Dark { role.on_dark() } else { role.on_light() };
        let color = Color::Rgb(red, green, blue);
        Style::new().fg(color).add_modifier(Modifier::BOLD)
    }

    /// The course of a quantity.
    pub fn curve(self) -> Style {
        self.verdict(Verdict::Pass)
    }

    /// A limit.
    pub fn limit(self) -> Style {
        self.verdict(Verdict::Fail)
    }

    /// A firing.
    pub fn firing(self) -> Style {
        self.verdict(Verdict::Undecided)
    }
}

/// Word and sign of a verdict.
pub fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓ PASS",
        Verdict::Undecided => "? OPEN",
        Verdict::Fail => "✗ FAIL",
    }
}

/// Takes all colour out of a drawn screen; bold and reverse stay.
pub fn without_color(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        cell.fg = Color::Reset;
        cell.bg = Color::Reset;
    }
}

/// Replaces every symbol of a drawn screen that is not ASCII. A substitute of two letters takes the blank after it.
pub fn to_ascii(buffer: &mut Buffer) {
    let cells = &mut buffer.content;
    for n in 0..cells.len() {
        let Some(letters) = cells[n].symbol().chars().next().and_then(substitute) else { continue };
        let (first, rest) = letters.split_at(letters.len().min(1));
        cells[n].set_symbol(first);
        if let Some(next) = cells.get_mut(n + 1).filter(|next| !rest.is_empty() && next.symbol() == " ") {
            next.set_symbol(rest);
        }
    }
}
