//! What is offered when no plan is named: the plans at hand, and the examples that come with the program.

use std::path::{Path, PathBuf};

use crossterm::event::{Event, KeyCode, KeyEventKind};
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, List, ListState, Paragraph, Wrap};

use super::theme::Theme;

/// Something to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Choice {
    /// A file.
    File(PathBuf),
    /// An example: its name and text.
    Example(&'static str, &'static str),
}

/// Plans that come with the program.
pub const EXAMPLES: &[(&str, &str)] = &[
    ("amur-three-rows", include_str!("../../plans/amur-three-rows.toml")),
    ("point-blasting", include_str!("../../plans/point-blasting.toml")),
    ("paper-5-tire", include_str!("../../plans/paper-5-tire.toml")),
    ("large-50x50", include_str!("../../plans/large-50x50.toml")),
];

/// Most files listed.
const MOST: usize = 50;
/// Files larger than this are not looked into for whether they are plans [bytes].
const LARGE: u64 = 1 << 20;

/// The list and what is selected in it.
#[derive(Clone, Debug)]
pub struct Start {
    /// What can be opened.
    pub choices: Vec<Choice>,
    /// Index of the selected one.
    pub selected: usize,
}

/// What a key came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Next {
    /// Wait for another.
    Wait,
    /// Open this.
    Open(Choice),
    /// Leave.
    Quit,
}

impl Start {
    /// Plans in `folder` and in `plans` below it, then the examples.
    pub fn new(folder: &Path) -> Self {
        let mut files: Vec<PathBuf> = [folder.to_owned(), folder.join("plans")]
            .iter()
            .filter_map(|folder| std::fs::read_dir(folder).ok())
            .flatten()
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| is_plan(path))
            .take(MOST)
            .map(|path| path.strip_prefix(".").map(Path::to_owned).unwrap_or(path))
            .collect();
        files.sort();
        let examples = EXAMPLES.iter().map(|(name, text)| Choice::Example(name, text));
        Self { choices: files.into_iter().map(Choice::File).chain(examples).collect(), selected: 0 }
    }

    /// A terminal event.
    pub fn update(&mut self, event: &Event) -> Next {
        let Event::Key(key) = event else { return Next::Wait };
        if key.kind == KeyEventKind::Release {
            return Next::Wait;
        }
        let last = self.choices.len().saturating_sub(1);
        match key.code {
            KeyCode::Down | KeyCode::Char('j') => self.selected = (self.selected + 1).min(last),
            KeyCode::Up | KeyCode::Char('k') => self.selected = self.selected.saturating_sub(1),
            KeyCode::Home | KeyCode::Char('g') => self.selected = 0,
            KeyCode::End | KeyCode::Char('G') => self.selected = last,
            KeyCode::Enter => return self.choices.get(self.selected).cloned().map_or(Next::Wait, Next::Open),
            KeyCode::Esc | KeyCode::Char('q' | 'c') => return Next::Quit,
            _ => {}
        }
        Next::Wait
    }

    /// Draws the list.
    pub fn draw(&self, theme: Theme, frame: &mut Frame) {
        let area = frame.area();
        frame.render_widget(Block::new().style(theme.base()), area);
        let [head, list, foot] =
            Layout::vertical([Constraint::Length(3), Constraint::Min(0), Constraint::Length(2)]).areas(area);
        let words = vec![
            Line::styled("shelter", theme.title()),
            Line::styled(
                "Which delay is safe under a shelter of tires and cables? Open a plan:",
                theme.base(),
            ),
        ];
        frame.render_widget(Paragraph::new(words).wrap(Wrap { trim: true }), head);
        let row = |(n, choice): (usize, &Choice)| {
            let style = if n == self.selected { theme.selected() } else { theme.base() };
            let (name, kind) = match choice {
                Choice::File(path) => (path.display().to_string(), ""),
                Choice::Example(name, _) => ((*name).to_owned(), "  example"),
            };
            Line::from(vec![Span::styled(format!(" {name} "), style), Span::styled(kind, theme.quiet())])
        };
        let mut state = ListState::default().with_selected(Some(self.selected));
        frame.render_stateful_widget(List::new(self.choices.iter().enumerate().map(row)), list, &mut state);
        let keys = "Enter opens · q leaves · a plan of your own: `shelter init FILE`, or from a list of holes with --from";
        frame
            .render_widget(Paragraph::new(Line::styled(keys, theme.quiet())).wrap(Wrap { trim: true }), foot);
    }
}

fn is_plan(path: &Path) -> bool {
    let small = |path: &Path| path.metadata().is_ok_and(|data| data.is_file() && data.len() <= LARGE);
    path.extension().is_some_and(|extension| extension == "toml")
        && small(path)
        && std::fs::read_to_string(path)
            .is_ok_and(|text| text.contains("shelter") && text.contains("blast_row"))
}
