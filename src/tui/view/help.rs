//! The help: the meaning of the words on the screens, and the keys of the current screen.

use ratatui::Frame;
use ratatui::layout::{Constraint, Flex, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Padding, Paragraph};

use super::report::wrapped;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::{Action, BINDINGS, Binding};

const WORDS: &[(&str, &str)] = &[
    ("✓ PASS", "if inputs hold, few enough shots fail (95 % sure)"),
    ("△ THIN", "a pass that little more than the plan states ends"),
    ("! HOLD", "observations or the plan's file speak against every pass"),
    ("✗ FAIL", "fails as planned, or too many shots surely fail"),
    ("? OPEN", "neither: more samples come, or a reason stands below"),
    ("shots that fail", "where their share lies, 95 % sure; ┊ is the share accepted"),
    ("1 in 100 above", "of 100 shots one lies above it (100: as the plan accepts)"),
    ("▆ • ┃", "what 1 in 100 shots exceeds, the planned shot, the limit"),
    ("computed shots", "shots that the plan's inputs make possible; none is fired"),
    ("launch", "speed with which a tire leaves the ground above its hole"),
    ("height", "of a tire's centre; an edge may be half a diameter higher"),
    ("slide", "how far from its place a tire ends, along the ground"),
    ("dud", "a hole that does not fire: each one is tried"),
    ("4:3, 4:3-5:3", "tire of row 4, column 3, and its cable to that of row 5"),
    ("of tried", "shots that failed of those tried; … as long as more come"),
    ("90 % of shots", "between these ends lie 90 % of the shots tried"),
    ("planned", "the shot with exactly the numbers of the plan"),
    ("±", "estimated error of the computation, not of the plan"),
];

/// Width of a column with padding. `KEY`: width of the key or word in it.
const COLUMN: u16 = 76;
const KEY: usize = 16;
/// Least width of a screen with the help in two columns.
const TWO_COLUMNS: u16 = 100;

/// Least width at each side of the help. Narrower sides are cleared, because nothing can be read there.
const LEAST_SIDE: u16 = 8;

/// Draws the help over the screen: the meaning of words, the keys of this screen, then the keys of all screens.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let columns = if area.width >= TWO_COLUMNS { 2 } else { 1 };
    // The width without two borders and the padding beside them.
    let column = COLUMN.min((area.width - 2) / columns);
    let room = usize::from(column - 2).saturating_sub(KEY);
    let row = |left: String, right: &'static str| {
        let wrapped = wrapped(right, room).into_iter().enumerate();
        let left = |n: usize| if n == 0 { left.clone() } else { String::new() };
        let line = |(n, text)| {
            let key = format!("{:1$}", left(n), KEY);
            Line::from(vec![Span::styled(key, app.theme.title()), Span::raw(text)])
        };
        wrapped.map(line).collect::<Vec<_>>()
    };
    let key = |binding: &Binding| row(app.keymap.all_keys(binding.action), binding.text);
    let on_screen = BINDINGS.iter().filter(|binding| binding.is_on(app.screen));
    let (here, everywhere): (Vec<_>, Vec<_>) = on_screen.partition(|binding| !binding.on.is_empty());
    let head = |title: String| Line::styled(title, app.theme.muted());
    let words = WORDS.iter().flat_map(|(word, meaning)| row((*word).to_owned(), meaning));
    let words: Vec<Line> = [head("Words".to_owned())].into_iter().chain(words).collect();
    let mut keys = Vec::new();
    if !here.is_empty() {
        keys.push(head(format!("On the screen {}", app.screen.name())));
        keys.extend(here.into_iter().flat_map(key));
    }
    keys.push(head("Everywhere".to_owned()));
    keys.extend(everywhere.into_iter().flat_map(key));
    // The words stand beside the keys or before them: users look for words first.
    let parts = if columns == 2 { vec![words, keys] } else { vec![[words, keys].concat()] };
    let rows = parts.iter().map(Vec::len).max().unwrap_or(0);
    let width = column * columns + 2;
    let [middle] = Layout::horizontal([Constraint::Max(width)]).flex(Flex::Center).areas(area);
    let [help] = Layout::vertical([Constraint::Max(rows as u16 + 2)]).flex(Flex::Center).areas(middle);
    let more = rows as u16 + 2 > area.height;
    let [up, down] = [Action::Up, Action::Down].map(|action| app.keymap.hint(action));
    let title = if more { format!(" Help: {up} {down} for more ") } else { " Help ".to_owned() };
    let block = Block::bordered().title(title).padding(Padding::horizontal(1)).style(app.theme.base());
    let inside = block.inner(help);
    // Leave no single columns of the covered screen at the sides.
    let is_narrow = area.width - help.width < 2 * LEAST_SIDE;
    let cleared = if is_narrow { Rect { x: area.x, width: area.width, ..help } } else { help };
    frame.render_widget(Clear, cleared);
    frame.render_widget(block, help);
    let places = Layout::horizontal(vec![Constraint::Fill(1); columns.into()]).spacing(1).split(inside);
    *areas = vec![(area, ClickTarget::Act(Action::Help))];
    for (place, lines) in places.iter().zip(parts) {
        let over = (lines.len() as u16).saturating_sub(place.height);
        // Scroll as far as the longer of the two columns needs.
        let beyond = (rows as u16).saturating_sub(place.height);
        areas.push((Rect::ZERO, ClickTarget::Lines(beyond)));
        frame.render_widget(Paragraph::new(lines).scroll((app.help_scroll.min(over), 0)), *place);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_fits_its_line() {
        let texts = BINDINGS.iter().map(|binding| binding.text).chain(WORDS.iter().map(|(_, text)| *text));
        for text in texts {
            assert!(text.chars().count() <= usize::from(COLUMN) - 2 - KEY, "{text}");
        }
    }
}
