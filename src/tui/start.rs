//! The start screen of a program that was started without a plan. It offers a new plan by a few questions, recent plans, the plans in
//! this folder, and the examples of the program.

use std::path::{Path, PathBuf};

use crossterm::event::{Event, KeyCode, KeyEvent, KeyEventKind, MouseButton, MouseEventKind};
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, List, ListState, Paragraph, Wrap};

use super::actions::PAGE_LINES;
use super::config::Config;
use super::keymap::{Action, Keymap, ctrl_c_as_esc};
use super::theme::Theme;
use super::typed_line::TypedLine;
use crate::file::canonical;
use crate::kept::Recovered;
use crate::plan::Plan;
use crate::plan::examples::EXAMPLES;
use crate::plan::starter::{self, QUESTIONS, ROPE};
use crate::ropes::catalogue;
use crate::sorting::sort;

/// A line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StartLine {
    /// A new plan of an earlier session that was never saved.
    Unsaved(Recovered),
    /// A new plan, made from the answers to questions.
    New,
    /// A file.
    File(PathBuf),
    /// An example, by name and text.
    Example(&'static str, &'static str),
}

/// A plan that the user chose.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Opened {
    /// A file.
    File(PathBuf),
    /// An example, by name and text.
    Example(&'static str, &'static str),
    /// The text of a new plan.
    New(String),
}

/// Most lines that the list of assumed values scrolls.
const MOST_SCROLLED: usize = 12;
/// Most files listed.
const MOST_FILES: usize = 50;
/// Largest file that is read to see whether it is a plan [bytes].
const LARGE: u64 = 1 << 20;

/// The start screen: the list of plans, or the questions.
#[derive(Clone, Debug)]
pub struct Start {
    /// The lines of the list.
    pub choices: Vec<StartLine>,
    /// Index of the selected line.
    pub selected: usize,
    /// The questions, while the user answers them.
    questions: Option<Questions>,
    /// Areas of the lines as last drawn, with the index of each line.
    areas: Vec<(Rect, usize)>,
}

/// The questions with the answers so far.
#[derive(Clone, Debug)]
struct Questions {
    answers: [TypedLine; QUESTIONS.len()],
    selected: usize,
    /// Whether all questions are answered. Then the screen shows the values that the plan assumes.
    answered: bool,
    /// Lines that the assumed values are scrolled.
    scrolled: usize,
    problem: Option<String>,
}

/// Effect of an event on the start screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Next {
    /// Wait for the next event.
    Wait,
    /// Open this plan.
    Open(Opened),
    /// Leave.
    Quit,
}

impl Start {
    /// Lists, in this order: a plan that was never saved, the `recent` plans, a new plan, the plans in `folder` and in its subfolder
    /// `plans`, the examples.
    pub fn new(folder: &Path, recent: Vec<PathBuf>, unsaved: Option<Recovered>) -> Self {
        let mut files: Vec<PathBuf> = [folder.to_owned(), folder.join("plans")]
            .iter()
            .filter_map(|folder| std::fs::read_dir(folder).ok())
            .flatten()
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| is_plan(path) && !canonical(path).is_ok_and(|path| recent.contains(&path)))
            .take(MOST_FILES)
            .map(|path| path.strip_prefix(".").map(Path::to_owned).unwrap_or(path))
            .collect();
        sort(&mut files);
        let examples = EXAMPLES.iter().map(|(name, text)| StartLine::Example(name, text));
        let files = files.into_iter().map(StartLine::File);
        // A user who has opened plans continues the last plan more often than starting a new one.
        let known =
            unsaved.map(StartLine::Unsaved).into_iter().chain(recent.into_iter().map(StartLine::File));
        let choices = known.chain([StartLine::New]).chain(files).chain(examples).collect();
        Self { choices, selected: 0, questions: None, areas: Vec::new() }
    }

    /// Takes a terminal event.
    pub fn update(&mut self, event: &Event, keymap: &Keymap) -> Next {
        match event {
            Event::Key(key) if key.kind == KeyEventKind::Release => Next::Wait,
            Event::Key(key) => match &mut self.questions {
                Some(questions) => match questions.key(&ctrl_c_as_esc(key)) {
                    Some(next) => next,
                    None => {
                        self.questions = None;
                        Next::Wait
                    }
                },
                None => self.key(&ctrl_c_as_esc(key), keymap),
            },
            Event::Paste(text) => {
                if let Some(questions) = &mut self.questions {
                    questions.paste(text);
                }
                Next::Wait
            }
            Event::Mouse(mouse) if self.questions.is_none() => match mouse.kind {
                MouseEventKind::Down(MouseButton::Left) => {
                    let click = Position::new(mouse.column, mouse.row);
                    match self.areas.iter().find(|(area, _)| area.contains(click)) {
                        Some(&(_, choice)) if choice == self.selected => self.open(),
                        Some(&(_, choice)) => self.select(choice),
                        None => Next::Wait,
                    }
                }
                MouseEventKind::ScrollUp => self.select(self.selected.saturating_sub(1)),
                MouseEventKind::ScrollDown => self.select(self.selected + 1),
                _ => Next::Wait,
            },
            _ => Next::Wait,
        }
    }

    fn key(&mut self, key: &KeyEvent, keymap: &Keymap) -> Next {
        match keymap.action(key) {
            _ if key.code == KeyCode::Esc => Next::Quit,
            Some(Action::Down) => self.select(self.selected + 1),
            Some(Action::Up) => self.select(self.selected.saturating_sub(1)),
            Some(Action::PageDown) => self.select(self.selected + PAGE_LINES),
            Some(Action::PageUp) => self.select(self.selected.saturating_sub(PAGE_LINES)),
            Some(Action::First) => self.select(0),
            Some(Action::Last) => self.select(usize::MAX),
            Some(Action::Open) => self.open(),
            Some(Action::Quit) => Next::Quit,
            _ => Next::Wait,
        }
    }

    fn select(&mut self, choice: usize) -> Next {
        self.selected = choice.min(self.choices.len().saturating_sub(1));
        Next::Wait
    }

    fn open(&mut self) -> Next {
        match self.choices.get(self.selected).cloned() {
            Some(StartLine::File(path)) => Next::Open(Opened::File(path)),
            Some(StartLine::Example(name, text)) => Next::Open(Opened::Example(name, text)),
            Some(StartLine::Unsaved(kept)) => Next::Open(Opened::New(kept.text)),
            Some(StartLine::New) => {
                let answers = QUESTIONS.map(|question| TypedLine::offering(question.offered));
                self.questions =
                    Some(Questions { answers, selected: 0, answered: false, scrolled: 0, problem: None });
                Next::Wait
            }
            None => Next::Wait,
        }
    }

    /// Draws the list or the questions.
    pub fn draw(&mut self, config: &Config, frame: &mut Frame) {
        let (theme, area) = (config.theme, frame.area());
        frame.render_widget(Block::new().style(theme.base()), area);
        let [head, body, foot] =
            Layout::vertical([Constraint::Length(3), Constraint::Min(0), Constraint::Length(2)]).areas(area);
        let question = match &self.questions {
            None => "Which delay keeps a shelter of tires and cables within its limits? Open a plan:",
            Some(questions) if questions.answered => {
                "Assumed, to be changed on 1 Plan (give or take: one in three lies outside):"
            }
            Some(_) => "A new plan; everything can be changed later:",
        };
        let lines = vec![Line::styled("shelter", theme.title()), Line::styled(question, theme.base())];
        frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), head);
        let keys = match &self.questions {
            None => {
                self.draw_choices(theme, frame, body);
                let key = |action, otherwise: &str| {
                    Some(config.keymap.first_key(action))
                        .filter(|key| !key.is_empty())
                        .unwrap_or_else(|| otherwise.to_owned())
                };
                let (open, quit) = (key(Action::Open, "a double click"), key(Action::Quit, "Esc"));
                format!(
                    "{open} opens · {quit} leaves · from a list of holes: `shelter init PLAN --from HOLES.csv`"
                )
            }
            Some(questions) => {
                questions.draw(theme, frame, body);
                match questions.answered {
                    true => "Enter makes the plan · Up Down reads on · Esc back to the questions".to_owned(),
                    false => "Up Down question · Enter next · Esc back".to_owned(),
                }
            }
        };
        let keys = Paragraph::new(Line::styled(keys, theme.muted()));
        frame.render_widget(keys.wrap(Wrap { trim: true }), foot);
    }

    fn draw_choices(&mut self, theme: Theme, frame: &mut Frame, area: Rect) {
        let row = |(n, choice): (usize, &StartLine)| {
            let style = if n == self.selected { theme.selected() } else { theme.base() };
            let (name, kind) = match choice {
                StartLine::New => ("A new plan by a few questions".to_owned(), ""),
                StartLine::Unsaved(kept) => (format!("The new plan of {}, not saved", kept.time), ""),
                StartLine::File(path) => (crate::plan::visible(&path.display().to_string()).into_owned(), ""),
                StartLine::Example(name, _) => ((*name).to_owned(), "  example"),
            };
            Line::from(vec![Span::styled(format!(" {name} "), style), Span::styled(kind, theme.muted())])
        };
        let mut state = ListState::default().with_selected(Some(self.selected));
        frame.render_stateful_widget(List::new(self.choices.iter().enumerate().map(row)), area, &mut state);
        let shown = (state.offset()..self.choices.len()).take(usize::from(area.height));
        self.areas =
            (area.y..).zip(shown).map(|(y, choice)| (Rect { y, height: 1, ..area }, choice)).collect();
    }
}

impl Questions {
    /// Takes a key. `None` goes back to the list.
    fn key(&mut self, key: &KeyEvent) -> Option<Next> {
        let last = QUESTIONS.len() - 1;
        if self.answered {
            return self.key_on_assumptions(key);
        }
        match key.code {
            KeyCode::Esc => return None,
            KeyCode::Up | KeyCode::BackTab => self.selected = self.selected.saturating_sub(1),
            KeyCode::Enter if self.selected == last => match self.plan() {
                Ok(_) => self.answered = true,
                Err(problem) => self.problem = Some(problem),
            },
            KeyCode::Down | KeyCode::Tab | KeyCode::Enter => self.selected = (self.selected + 1).min(last),
            KeyCode::Left | KeyCode::Right if self.selected == ROPE => {
                let ropes = &catalogue().ropes;
                let rope = self.answers[ROPE].value();
                let index = ropes.iter().position(|known| known.name == rope).unwrap_or(0);
                let next = if key.code == KeyCode::Right { index + 1 } else { index.saturating_sub(1) };
                if let Some(rope) = ropes.get(next) {
                    self.answers[ROPE] = TypedLine::offering(&rope.name);
                }
                self.problem = self.plan().err();
            }
            _ => {
                self.answers[self.selected].key(key);
                self.problem = self.plan().err();
                return Some(Next::Wait);
            }
        }
        self.answers[self.selected].offer();
        Some(Next::Wait)
    }

    /// Takes a key on the list of assumed values: Enter makes the plan, Esc goes back to the questions.
    fn key_on_assumptions(&mut self, key: &KeyEvent) -> Option<Next> {
        match key.code {
            KeyCode::Enter => match self.plan() {
                Ok(text) => return Some(Next::Open(Opened::New(text))),
                Err(problem) => (self.answered, self.problem) = (false, Some(problem)),
            },
            KeyCode::Esc => self.answered = false,
            KeyCode::Down => self.scrolled = (self.scrolled + 1).min(MOST_SCROLLED),
            KeyCode::Up => self.scrolled = self.scrolled.saturating_sub(1),
            _ => {}
        }
        Some(Next::Wait)
    }

    fn paste(&mut self, text: &str) {
        if self.answered {
            return;
        }
        let note = self.answers[self.selected].paste(text);
        self.problem = note.or(self.plan().err());
    }

    /// The text of the plan, or the first mistake in the answers.
    fn plan(&self) -> Result<String, String> {
        let text = starter::plan(&std::array::from_fn(|n| self.answers[n].value()))?;
        Plan::parse("new plan", &text).map(|_| text).map_err(|mistakes| mistakes.first())
    }

    /// Draws the assumed values from line `scrolled` on. If there is room, also the keys of the plan that change them.
    fn draw_assumed(&self, theme: Theme, frame: &mut Frame, area: Rect) {
        let assumed = starter::assumed(&std::array::from_fn(|n| self.answers[n].value()));
        let width = assumed.iter().map(|(what, _)| what.chars().count()).max().unwrap_or(0);
        let room = usize::from(area.width).saturating_sub(width + 3);
        let line = |(what, keys): &(String, Vec<&str>)| {
            let all = keys.join(", ");
            let keys = [all.as_str(), keys[0]].into_iter().find(|keys| keys.len() <= room).unwrap_or("");
            let what = if keys.is_empty() { format!(" {what}") } else { format!(" {what:width$}  ") };
            Line::from(vec![Span::styled(what, theme.base()), Span::styled(keys.to_owned(), theme.muted())])
        };
        let rigid = Line::styled(format!(" {}", starter::RIGID_ENDS), theme.base());
        let lines = assumed.iter().map(line).chain([Line::default(), rigid]).skip(self.scrolled);
        frame.render_widget(Paragraph::new(Vec::from_iter(lines)).wrap(Wrap { trim: false }), area);
    }

    fn draw(&self, theme: Theme, frame: &mut Frame, area: Rect) {
        if self.answered {
            return self.draw_assumed(theme, frame, area);
        }
        let width = QUESTIONS.iter().map(|question| question.text.len()).max().unwrap_or(0);
        let mut lines: Vec<Line> = QUESTIONS
            .iter()
            .zip(&self.answers)
            .enumerate()
            .map(|(n, (question, answer))| {
                let style = if n == self.selected { theme.selected() } else { theme.base() };
                let question = Span::styled(format!(" {:width$}  ", question.text), theme.muted());
                Line::from(vec![question, Span::styled(format!(" {} ", answer.value()), style)])
            })
            .collect();
        let help = QUESTIONS[self.selected].help.iter();
        let help = help.map(|text| Line::styled(format!(" {text}"), theme.muted()));
        lines.extend([Line::default()].into_iter().chain(help));
        if let Some(problem) = &self.problem {
            lines.extend([Line::default(), Line::styled(format!(" {problem}"), theme.limit())]);
        }
        frame.render_widget(Paragraph::new(lines), area);
        let column = width + 4 + self.answers[self.selected].input.visual_cursor();
        let (x, y) = (area.x + column as u16, area.y + self.selected as u16);
        if x < area.right() && y < area.bottom() {
            frame.set_cursor_position(Position::new(x, y));
        }
    }
}

/// Whether a file looks like a plan.
fn is_plan(path: &Path) -> bool {
    let small = |path: &Path| path.metadata().is_ok_and(|data| data.is_file() && data.len() <= LARGE);
    path.extension().is_some_and(|extension| extension == "toml")
        && small(path)
        && std::fs::read_to_string(path)
            .is_ok_and(|text| text.contains("shelter") && text.contains("blast_row"))
}
