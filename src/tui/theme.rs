//! Terminal styles by role, from the palette that all outputs share. Color never carries meaning alone: words and signs say the same.

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier, Style};
use serde::Deserialize;

use crate::report::ascii;
use crate::report::palette::Role;
use crate::verdict::VerdictWord;

/// A set of colors.
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

    /// Unimportant background, such as the mesh behind a drawing.
    pub fn faint(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Rgb(98, 106, 114)),
            Theme::Light => Style::new().fg(Color::Rgb(120, 120, 116)),
            Theme::Sunlight => self.base(),
        }
    }

    /// Cables in a drawing whose main content is something else.
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

    /// Background of the whole selected row. It guides the eye.
    pub fn row(self) -> Color {
        match self {
            Theme::Dark => Color::Rgb(38, 44, 52),
            Theme::Light => Color::Rgb(228, 232, 232),
            Theme::Sunlight => Color::Rgb(228, 228, 228),
        }
    }

    /// Background of the done part of a line.
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

    /// The curve of a quantity, in a color that no verdict has.
    pub fn curve(self) -> Style {
        self.title()
    }

    /// Shots that are far from a limit, in a color that no verdict has.
    pub fn shots(self) -> Style {
        match self {
            Theme::Dark => Style::new().fg(Color::Rgb(112, 150, 172)),
            Theme::Light => Style::new().fg(Color::Rgb(70, 104, 130)),
            Theme::Sunlight => self.base(),
        }
    }

    /// Style for a `share` of a limit. Up to half of the limit `calm`, from there gradually the color of a thin pass. Only a share that
    /// exceeds the limit has the color of a fail.
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

    /// Red, green and blue of a style. Text without a color of its own counts as the usual text color of terminals.
    fn rgb(self, style: Style) -> [u8; 3] {
        match (style.fg, self) {
            (Some(Color::Rgb(red, green, blue)), _) => [red, green, blue],
            (_, Theme::Dark) => [190, 196, 204],
            (_, Theme::Light | Theme::Sunlight) => [30; 3],
        }
    }

    /// The line of a limit and its value. Neutral, because values that keep the limit stand beside it.
    pub fn limit_line(self) -> Style {
        self.base()
    }

    /// A value that exceeds a limit, or a reason not to fire.
    pub fn limit(self) -> Style {
        self.role(Role::Fail)
    }

    /// A value near a limit, or a warning.
    pub fn caution(self) -> Style {
        self.role(Role::Thin)
    }
}

/// Share of a limit above which the color changes.
const CALM: f64 = 0.5;

/// On a light background the change from blue to dark yellow passes through this gray. A direct mix would be greenish and look good.
const BETWEEN_ON_LIGHT: [u8; 3] = [108, 108, 100];

/// The color at a `part`, 0 to 1, of the way between two colors.
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

/// Sign behind a pass with a proviso: no limit judges the slide, or the pass holds only if the tires do not turn. The badge that begins
/// with this sign states the proviso.
pub const PROVISO: &str = "*";

/// Sign and word of a verdict. A pass also has the sign of a proviso.
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

/// Removes all colors from a drawn screen. Bold and reverse stay.
pub fn without_color(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        cell.fg = Color::Reset;
        cell.bg = Color::Reset;
    }
}

/// Replaces every character of a drawn screen that poor fonts lack. A substitute of two letters also takes the next or the previous cell,
/// if that cell is blank. If neither is blank, `~` stands: half a substitute would be wrong, `+23` for `+-23`.
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
                // For letters, the first letter of the substitute is enough.
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

/// One ASCII letter for a Cyrillic letter that ASCII writes with several, so that `вариант К` and `вариант Х` stay two options. Never a
/// digit, because a digit would change a number in a name. If no Latin letter is left, a sign stands.
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

/// Replaces an ellipsis with two points. The second point takes a blank that is not the only blank between two words, or a letter of the
/// cut word. Before a digit, points would read as a decimal point; before a slash, as the name of another folder.
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
        // The sign of a state stands alone before its words.
        () if is_blank(before) && next == Some(' ') && !is_blank(after_next) => {
            row[n].set_symbol("~");
            return;
        }
        () if next == Some(' ') && is_blank(after_next) => n + 1,
        () if before == Some(' ') && is_blank(before_last) => n - 1,
        () if before.is_some_and(char::is_alphabetic) => n - 1,
        // A name was cut between two words.
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

    /// Cells keep their places, and no cell changes its meaning.
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

    /// A substitute of two cells never takes a cell of the next line.
    #[test]
    fn a_line_keeps_its_substitutes_for_itself() {
        let mut buffer = Buffer::with_lines(["more …", "  done"]);
        to_ascii(&mut buffer);
        let shown: String = buffer.content.iter().map(|cell| cell.symbol()).collect();
        assert_eq!(shown, "more :  done");
    }
}
