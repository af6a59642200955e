//! Styles of the terminal by role, from the palette that all faces share. Colour never carries meaning alone: words and
//! signs say the same.

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;

use crate::report::ascii;
use crate::report::palette::Role;
use crate::verdict::VerdictWord;

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
            Theme::Dark => Style::new().fg(Color::Rgb(154, 162, 170)),
            Theme::Light => Style::new().fg(Color::Rgb(80, 80, 80)),
            Theme::Sunlight => self.base(),
        }
    }

    /// What may be missed: the mesh behind what is shown.
    pub fn faint(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Rgb(98, 106, 114)),
            Theme::Light => Style::new().fg(Color::Rgb(120, 120, 116)),
            Theme::Sunlight => self.base(),
        }
    }

    /// Cables of a drawing in which other things matter.
    pub fn mesh(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Rgb(66, 73, 81)),
            Theme::Light => Style::new().fg(Color::Rgb(186, 188, 182)),
            Theme::Sunlight => Style::new().fg(Color::Rgb(150, 150, 150)),
        }
    }

    /// The selected row.
    pub fn selected(self) -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }

    /// Behind the whole of the selected row, so that the eye keeps to it.
    pub fn row(self) -> Color {
        match self {
            Theme::Dark => Color::Rgb(38, 44, 52),
            Theme::Light => Color::Rgb(228, 232, 232),
            Theme::Sunlight => Color::Rgb(228, 228, 228),
        }
    }

    /// Behind the part of a line that is done.
    pub fn done(self) -> Style {
        let [red, green, blue] = match self {
            Theme::Dark => [40, 64, 84],
            Theme::Light => [196, 218, 234],
            Theme::Sunlight => [208; 3],
        };
        Style::new().bg(Color::Rgb(red, green, blue))
    }

    /// A verdict.
    pub fn verdict(self, verdict: impl Into<VerdictWord>) -> Style {
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

    /// Shots that are far from a limit: in the colour of no verdict.
    pub fn shots(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Rgb(112, 150, 172)),
            Theme::Light => Style::new().fg(Color::Rgb(70, 104, 130)),
            Theme::Sunlight => self.base(),
        }
    }

    /// How near a share of a limit is to it: up to half of it `calm`, from there ever nearer to the colour of a thin pass. The colour of a fail
    /// has what is past it alone.
    pub fn heat(self, calm: Style, share: f64) -> Style {
        let (from, to, part) = match share {
            _ if share <= CALM => return calm,
            _ if share <= 1.0 => {
                let (calm, warm) = (self.rgb(calm), self.rgb(self.caution()));
                match ((share - CALM) / (1.0 - CALM), self) {
                    (part, Theme::Light) if part <= 0.5 => (calm, BETWEEN_ON_LIGHT, 2.0 * part),
                    (part, Theme::Light) => (BETWEEN_ON_LIGHT, warm, 2.0 * part - 1.0),
                    (part, _) => (calm, warm, part),
                }
            }
            _ => return self.limit(),
        };
        calm.fg(mixed(from, to, part))
    }

    /// Red, green and blue of a style; of text without a colour of its own those that terminals usually give it.
    fn rgb(self, style: Style) -> [u8; 3] {
        match (style.fg, self) {
            (Some(Color::Rgb(red, green, blue)), _) => [red, green, blue],
            (_, Theme::Dark) => [190, 196, 204],
            (_, Theme::Light | Theme::Sunlight) => [30; 3],
        }
    }

    /// The line of a limit, and its value: what keeps it stands beside it in peace.
    pub fn limit_line(self) -> Style {
        self.base()
    }

    /// What is past a limit, or forbids to fire.
    pub fn limit(self) -> Style {
        self.role(Role::Fail)
    }

    /// What is near a limit, and a warning.
    pub fn caution(self) -> Style {
        self.role(Role::Thin)
    }
}

/// Share of a limit from which it is near.
const CALM: f64 = 0.5;

/// On a light ground the way from blue to a dark yellow leads through this grey: what lies between them unguided is greenish, as if it were good.
const BETWEEN_ON_LIGHT: [u8; 3] = [108, 108, 100];

/// The colour at a `part` of the way from one to another.
fn mixed(from: [u8; 3], to: [u8; 3], part: f64) -> Color {
    let mix = |n: usize| (f64::from(from[n]) + part * (f64::from(to[n]) - f64::from(from[n]))).round() as u8;
    Color::Rgb(mix(0), mix(1), mix(2))
}

/// Sign and word of a verdict.
pub fn label(verdict: impl Into<VerdictWord>) -> &'static str {
    match verdict.into() {
        VerdictWord::Pass => "✓ PASS",
        VerdictWord::Thin => "△ THIN",
        VerdictWord::Hold => "! HOLD",
        VerdictWord::Open => "? OPEN",
        VerdictWord::Fail => "✗ FAIL",
    }
}

/// Behind a pass with a proviso: no limit judges the slide, or it passes only as long as tires do not turn. Badges that begin with this sign
/// say so.
pub const PROVISO: &str = "*";

/// Sign and word of a verdict, behind a pass the sign of a proviso.
pub fn starred(verdict: VerdictWord) -> &'static str {
    match verdict {
        VerdictWord::Pass => "✓ PASS*",
        VerdictWord::Thin => "△ THIN*",
        word => label(word),
    }
}

/// Sign of a verdict.
pub fn mark(verdict: impl Into<VerdictWord>) -> &'static str {
    label(verdict).split(' ').next().unwrap_or_default()
}

/// Removes all colours from a drawn screen; bold and reverse stay.
pub fn without_color(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        cell.fg = Color::Reset;
        cell.bg = Color::Reset;
    }
}

/// Replaces every character of a drawn screen that poor fonts lack. A substitute of two letters takes the next cell as well, or the one
/// before, where that is blank. Where neither is, half of it would say something else: of `+-23` the `+23`.
pub fn to_ascii(buffer: &mut Buffer) {
    let width = usize::from(buffer.area.width.max(1));
    for row in buffer.content.chunks_mut(width) {
        for n in 0..row.len() {
            let symbol = row[n].symbol();
            if symbol.is_ascii() {
                continue;
            }
            if symbol == "…" {
                put_ellipsis(row, n);
                continue;
            }
            if symbol == "°" {
                row[n].set_symbol("d");
                continue;
            }
            if let Some(letter) = one_letter(symbol) {
                row[n].set_symbol(&letter);
                continue;
            }
            let letters = ascii::to_ascii(symbol);
            let is_blank =
                |at: Option<usize>| at.and_then(|at| row.get(at)).is_some_and(|cell| cell.symbol() == " ");
            let [has_before, has_next] = [n.checked_sub(1), Some(n + 1)].map(is_blank);
            match (letters.get(..1), letters.get(1..2)) {
                // Of a letter the first one is enough.
                (Some(first), Some(_)) if letters.bytes().all(|letter| letter.is_ascii_alphabetic()) => {
                    row[n].set_symbol(first)
                }
                (None, _) => row[n].set_symbol(" "),
                (Some(first), None) => row[n].set_symbol(first),
                (Some(first), Some(second)) if has_next => {
                    row[n].set_symbol(first);
                    row[n + 1].set_symbol(second)
                }
                (Some(first), Some(second)) if has_before => {
                    row[n - 1].set_symbol(first);
                    row[n].set_symbol(second)
                }
                (Some(_), Some(_)) => row[n].set_symbol("~"),
            };
        }
    }
}

/// The letter of one cell for a Cyrillic one that ASCII writes with several: `вариант К` and `вариант Х` stay two options. None is a digit,
/// which would make another number of a name: where Latin has no letter left, a sign stands.
fn one_letter(symbol: &str) -> Option<String> {
    const LETTERS: [(&str, &str); 9] = [
        ("ж", "j"),
        ("х", "h"),
        ("ц", "c"),
        ("ч", "x"),
        ("ш", "w"),
        ("щ", "q"),
        ("э", "}"),
        ("ю", "@"),
        ("я", "&"),
    ];
    let small = symbol.to_lowercase();
    let (_, letter) = LETTERS.into_iter().find(|(letter, _)| *letter == small)?;
    Some(if small == symbol { letter.to_owned() } else { letter.to_uppercase() })
}

/// Puts two points in place of an ellipsis: the second into a blank that is not the last one between two words, else over a letter of the
/// word that is cut. Points before a digit would be those of a decimal, before a slash the name of another folder.
fn put_ellipsis(row: &mut [Cell], n: usize) {
    let at = |n: Option<usize>| n.and_then(|n| row.get(n)).and_then(|cell| cell.symbol().chars().next());
    let [before_last, before] = [2, 1].map(|back| at(n.checked_sub(back)));
    let [next, after_next] = [1, 2].map(|on| at(Some(n + on)));
    let is_blank = |letter: Option<char>| letter.is_none_or(|letter| letter == ' ');
    let second = match () {
        () if matches!(next, Some('/' | '\\')) => {
            row[n].set_symbol("*");
            return;
        }
        // The sign of a state, which stands alone before its words.
        () if is_blank(before) && next == Some(' ') && !is_blank(after_next) => {
            row[n].set_symbol("~");
            return;
        }
        () if next == Some(' ') && is_blank(after_next) => n + 1,
        () if before == Some(' ') && is_blank(before_last) => n - 1,
        () if before.is_some_and(char::is_alphabetic) => n - 1,
        // A name that was cut between two words.
        () if before == Some(' ') && next.is_some_and(char::is_alphabetic) => n - 1,
        () if next == Some(' ') && !after_next.is_some_and(|letter| letter.is_ascii_digit()) => n + 1,
        () => {
            row[n].set_symbol(":");
            return;
        }
    };
    row[n].set_symbol(".");
    row[second].set_symbol(".");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_of_two_letters_is_never_halved() {
        let mut buffer = Buffer::with_lines(["to ±23 %", "1.5 ± 0.1", "by(±2 %)"]);
        to_ascii(&mut buffer);
        let shown: String = buffer.content.iter().map(|cell| cell.symbol()).collect();
        assert_eq!(shown, "to+-23 % 1.5 +-0.1by(~2 %) ");
    }

    /// Cells stay where they are, and none says anything else than before.
    #[test]
    fn substitutes_change_no_meaning() {
        let ascii = |line: &str| {
            let mut buffer = Buffer::with_lines([line]);
            to_ascii(&mut buffer);
            buffer.content.iter().map(|cell| cell.symbol()).collect::<String>()
        };
        for (shown, in_ascii) in [
            ("25 ms, midd…irst ✗", "25 ms, mid..irst X"),
            ("25 ms, …rst ✗", "25 ms,..rst X"),
            ("as listed (defau…  2", "as listed (defau.. 2"),
            ("109 ms     … wait", "109 ms     ~ wait"),
            (" 109 ms … wait", " 109 ms ~ wait"),
            ("… 109 ms passes", "~ 109 ms passes"),
            ("in …/plans/a.toml", "in */plans/a.toml"),
            ("Computing… ", "Computing.."),
            ("2.6° (assumed 1°)", "2.6d (assumed 1d)"),
            ("e\u{301}té ±", "ete+-"),
            ("схема К, Х, Ц, Ш, Щ", "shema K, H, C, W, Q"),
            ("1-ч, 1-э, 1-Ю, 1-я", "1-x, 1-}, 1-@, 1-&"),
            ("▁▂▃▄▅▆▇█ 1 %", "_,:=+*&# 1 %"),
        ] {
            assert_eq!(ascii(shown), in_ascii, "{shown}");
        }
    }

    /// What needs two cells takes none of the next line.
    #[test]
    fn a_line_keeps_its_substitutes_for_itself() {
        let mut buffer = Buffer::with_lines(["more …", "  done"]);
        to_ascii(&mut buffer);
        let shown: String = buffer.content.iter().map(|cell| cell.symbol()).collect();
        assert_eq!(shown, "more :  done");
    }
}
