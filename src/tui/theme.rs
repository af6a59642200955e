//! Styles of the terminal by role, from the palette that all faces share. Colour never carries meaning alone: words and
//! signs say the same.

use ratatui::buffer::Buffer;
use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;

use crate::report::ascii;
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
    /// The next theme; the first follows the last.
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

    /// Text of little importance.
    pub fn muted(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Gray),
            Theme::Light => Style::new().fg(Color::Rgb(80, 80, 80)),
            Theme::Sunlight => self.base(),
        }
    }

    /// What may be missed: the mesh behind what is shown.
    pub fn faint(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::DarkGray),
            Theme::Light => Style::new().fg(Color::Rgb(160, 160, 156)),
            Theme::Sunlight => self.base(),
        }
    }

    /// The selected row.
    pub fn selected(self) -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }

    /// A verdict.
    pub fn verdict(self, verdict: Verdict) -> Style {
        self.role(Role::of(verdict))
    }

    fn role(self, role: Role) -> Style {
        let [red, green, blue] = if self == Theme::Dark { role.on_dark() } else { role.on_light() };
        Style::new().fg(Color::Rgb(red, green, blue)).add_modifier(Modifier::BOLD)
    }

    /// The curve of a quantity: in the colour of no verdict.
    pub fn curve(self) -> Style {
        self.title()
    }

    /// A limit.
    pub fn limit(self) -> Style {
        self.role(Role::Fail)
    }

    /// A firing.
    pub fn firing(self) -> Style {
        self.role(Role::Open)
    }
}

/// Sign and word of a verdict.
pub fn label(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓ PASS",
        Verdict::Undecided => "? OPEN",
        Verdict::Fail => "✗ FAIL",
    }
}

/// Sign of a verdict.
pub fn mark(verdict: Verdict) -> &'static str {
    label(verdict).split(' ').next().unwrap_or_default()
}

/// Removes all colours from a drawn screen; bold and reverse stay.
pub fn without_color(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        cell.fg = Color::Reset;
        cell.bg = Color::Reset;
    }
}

/// Replaces every character of a drawn screen that poor fonts lack. A substitute of two letters takes the next cell as well
/// where that cell is blank.
pub fn to_ascii(buffer: &mut Buffer) {
    for n in 0..buffer.content.len() {
        let symbol = buffer.content[n].symbol().chars().next();
        let Some(letters) = symbol.and_then(ascii::substitute) else { continue };
        buffer.content[n].set_symbol(letters.get(..1).unwrap_or(" "));
        if let (Some(second), Some(next)) = (letters.get(1..2), buffer.content.get_mut(n + 1))
            && next.symbol() == " "
        {
            next.set_symbol(second);
        }
    }
}
