//! The list of choices above the line being typed: commands, the fired option, or the option of a page.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, List, ListState};
use unicode_width::UnicodeWidthStr;

use super::compare::verdict_words;
use super::fitting::option_name;
use crate::report::words::option_sentences::firing_times;
use crate::tui::app::App;
use crate::tui::prompt::{Prompt, Purpose};

/// Most choices shown at once.
const MOST_LINES: u16 = 10;

/// Draws the commands that match the typed letters above `line`.
pub fn draw_commands(app: &App, prompt: &Prompt, frame: &mut Frame, line: Rect) {
    let commands = prompt.commands();
    let rows = commands.iter().map(|binding| {
        let key = format!(" {:9} ", app.keymap.first_key(binding.action));
        [
            Span::raw(format!(" {:16}", binding.name)),
            Span::styled(key, app.theme.title()),
            Span::styled(binding.text, app.theme.muted()),
        ]
    });
    draw(app, rows.collect(), [" Commands ", " no command has these letters"], prompt, frame, line);
}

/// Draws the options that match the typed letters above `line`, each with its firing times.
pub fn draw_options(app: &App, prompt: &Prompt, frame: &mut Frame, line: Rect) {
    let options = app.fired_options(prompt.line.value());
    let rows = options.into_iter().map(|option| {
        let delay = &app.case.plan.delays[option];
        [
            Span::raw(format!(" {} ", named(app, option))),
            Span::styled(firing_times(delay), app.theme.muted()),
            Span::raw(""),
        ]
    });
    draw(
        app,
        rows.collect(),
        [" Which delay was fired? Down selects, or its letters ", " no option has these letters"],
        prompt,
        frame,
        line,
    );
}

/// Most cells of an option's name.
const LONGEST_NAME: usize = 30;

/// The name of an option, padded to the longest name.
fn named(app: &App, option: usize) -> String {
    let delays = &app.case.plan.delays;
    let longest = delays.iter().map(|delay| delay.name.width()).max().unwrap_or(0).min(LONGEST_NAME);
    format!("{:longest$}", option_name(app, option, longest))
}

/// Draws two options above `line` with their verdicts: `best`, which is recommended, and the selected option, which does not pass.
pub fn draw_pages(app: &App, best: usize, prompt: &Prompt, frame: &mut Frame, line: Rect) {
    let row = |(option, what): (usize, &'static str)| {
        let (words, style) = verdict_words(app, option);
        [
            Span::raw(format!(" {} ", named(app, option))),
            Span::styled(words, style),
            Span::styled(what, app.theme.muted()),
        ]
    };
    let rows = [(best, "  recommended"), (app.selected, "  selected")].map(row);
    draw(app, rows.into(), [" Page of which option? ", ""], prompt, frame, line);
}

fn draw(
    app: &App,
    rows: Vec<[Span<'_>; 3]>,
    [title, none]: [&'static str; 2],
    prompt: &Prompt,
    frame: &mut Frame,
    line: Rect,
) {
    let height = (rows.len() as u16).clamp(1, MOST_LINES) + 2;
    let area = Rect { y: line.y.saturating_sub(height), height, width: line.width.min(100), ..line };
    let block = Block::bordered().style(app.theme.base()).title(title).title_bottom(keys(prompt.purpose));
    frame.render_widget(Clear, area);
    if rows.is_empty() {
        let inside = block.inner(area);
        frame.render_widget(block, area);
        return frame.render_widget(Line::styled(none, app.theme.muted()), inside);
    }
    let rows = rows.into_iter().enumerate().map(|(n, [name, key, text])| {
        let style = if Some(n) == prompt.selected { app.theme.selected() } else { app.theme.base() };
        Line::from_iter([name.style(style), key, text])
    });
    let mut state = ListState::default().with_selected(prompt.selected);
    frame.render_stateful_widget(List::new(rows).block(block), area, &mut state);
}

/// Help text about the keys.
fn keys(purpose: Purpose) -> &'static str {
    match purpose {
        Purpose::PageOf(_) => " Up Down select, Enter takes it, Esc leaves ",
        _ => " Up Down or letters select, Enter takes it, Esc leaves ",
    }
}
