//! What keys, clicks and commands do to the app, screen by screen.

use std::path::Path;

use crossterm::event::{KeyCode, KeyEvent};
use ratatui::layout::Position;

use super::app::{App, Request, Row, Screen, Target};
use super::editor::Edit;
use super::keymap::{Action, BINDINGS};
use super::player::Player;
use super::prompt::{Prompt, Purpose, Typed};
use super::studies::Progress;
use crate::choice::Accuracy;
use crate::file;
use crate::worker::Kind;

/// Options a page key moves.
const PAGE: usize = 10;
/// How far one key scrubs [s].
const SCRUB: f64 = 0.01;

impl App {
    /// A key was pressed, or a command chosen.
    pub fn act(&mut self, action: Action) -> Request {
        self.notice = None;
        if action != Action::Quit {
            self.warned = false;
        }
        if self.help && self.scroll_help(action) {
            return Request::None;
        }
        match self.screen {
            Screen::Plan => self.act_on_plan(action),
            Screen::Compare => self.act_on_options(action),
            Screen::Flight => self.act_on_flight(action),
            Screen::Studies => self.act_on_studies(action),
            Screen::Accuracy => self.act_on_accuracy(action),
        }
    }

    /// Whether an open help took the key.
    fn scroll_help(&mut self, action: Action) -> bool {
        let lines = match action {
            Action::Up => -1,
            Action::Down => 1,
            Action::PageUp => -(PAGE as i16),
            Action::PageDown => PAGE as i16,
            Action::First => i16::MIN,
            Action::Last => i16::MAX,
            _ => return false,
        };
        self.help_scroll = self.help_scroll.saturating_add_signed(lines).min(BINDINGS.len() as u16);
        true
    }

    /// A place of the screen was clicked.
    pub fn click(&mut self, at: Position) -> Request {
        let hit = self.places.iter().rev().find(|(place, _)| place.contains(at)).copied();
        let Some((place, target)) = hit else { return Request::None };
        match target {
            Target::Act(action) => return self.act(action),
            Target::Option(option) if option == self.selected => return self.act(Action::Open),
            Target::Option(option) => self.selected = option,
            Target::Sort(sort) => self.compare.sort_by(sort),
            Target::Field(field) if field == self.editor.selected => return self.act(Action::Open),
            Target::Field(field) => {
                return self.select_field(field as isize - self.editor.selected as isize);
            }
            Target::Lines(_) => {}
            Target::Study(kind) => self.studies.show(kind),
            Target::Time(end) => {
                let part = f64::from(at.x - place.x) / f64::from(place.width.saturating_sub(1).max(1));
                self.player.seek(part * end, end);
            }
        }
        Request::None
    }

    /// A key while something is typed at the foot of the screen.
    pub fn type_in_prompt(&mut self, key: &KeyEvent) -> Request {
        let Some(mut prompt) = self.prompt.take() else { return Request::None };
        let typed = prompt.key(key);
        let text = prompt.input.value().to_owned();
        match (prompt.purpose, typed) {
            (Purpose::Search, Typed::Cancelled) => self.find("", false),
            (Purpose::Search, Typed::Changed) => self.find(&text, key.code == KeyCode::Down),
            (Purpose::Palette, Typed::Done) => {
                let Some(chosen) = prompt.commands().get(prompt.selected).copied() else {
                    return Request::None;
                };
                // A command of another screen is given there.
                if let Some(&screen) = chosen.on.first().filter(|_| !chosen.is_on(self.screen)) {
                    self.screen = screen;
                }
                return self.act(chosen.action);
            }
            (Purpose::Export, Typed::Done) if !text.is_empty() => return Request::Export(text.into()),
            (Purpose::SaveAs, Typed::Done) if !text.is_empty() => return Request::SaveAs(text.into()),
            _ => {}
        }
        if typed == Typed::Changed {
            self.prompt = Some(prompt);
        }
        Request::None
    }

    /// Looks for something typed: options and lines that have it are kept, a value of the plan is selected.
    fn find(&mut self, text: &str, next: bool) {
        match self.screen {
            Screen::Plan => {
                self.editor.find(text, next);
                self.follow_field();
            }
            Screen::Studies => self.studies.filter = text.to_owned(),
            Screen::Compare | Screen::Flight | Screen::Accuracy => {
                self.compare.filter = text.to_owned();
                self.select_listed(0);
            }
        }
    }

    fn act_on_flight(&mut self, action: Action) -> Request {
        let end = self.flight_end();
        let seek = |player: &mut Player, by: f64| player.seek(player.time + by, end);
        match action {
            Action::Play => self.player.toggle(end),
            Action::Faster => self.player.faster(),
            Action::Slower => self.player.slower(),
            Action::Turn => self.player.along_rows = !self.player.along_rows,
            Action::Left => seek(&mut self.player, -SCRUB),
            Action::Right => seek(&mut self.player, SCRUB),
            Action::PageUp => seek(&mut self.player, -SCRUB * PAGE as f64),
            Action::PageDown => seek(&mut self.player, SCRUB * PAGE as f64),
            Action::First => self.player.seek(0.0, end),
            Action::Last => self.player.seek(end, end),
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            Action::Open => self.screen = Screen::Compare,
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_accuracy(&mut self, action: Action) -> Request {
        match action {
            Action::Open | Action::Rerun => return self.start(Kind::Accuracy),
            Action::Cancel => return self.cancel(Kind::Accuracy),
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_plan(&mut self, action: Action) -> Request {
        let page = PAGE as isize;
        let edit = match action {
            Action::Up => return self.select_field(-1),
            Action::Down => return self.select_field(1),
            Action::PageUp => return self.select_field(-page),
            Action::PageDown => return self.select_field(page),
            Action::First => return self.select_field(isize::MIN),
            Action::Last => return self.select_field(isize::MAX),
            Action::Open => {
                self.editor.begin();
                return Request::None;
            }
            Action::Left => self.editor.step(false),
            Action::Right => self.editor.step(true),
            Action::AddOption => self.editor.copy_option(self.selected),
            Action::RemoveOption => self.editor.remove_option(self.selected),
            other => return self.act_anywhere(other),
        };
        self.edited(edit)
    }

    /// Selects a field, and with it the option it belongs to.
    fn select_field(&mut self, places: isize) -> Request {
        self.editor.select(places);
        self.follow_field();
        Request::None
    }

    /// Selects the option that the selected field belongs to.
    fn follow_field(&mut self) {
        if let Some(field) = self.editor.field().filter(|field| field.path.section == "delay") {
            self.selected = field.path.index.unwrap_or(0).min(self.rows.len().saturating_sub(1));
        }
    }

    /// A key while a value is typed.
    pub fn type_key(&mut self, key: &KeyEvent) -> Request {
        let edit = self.editor.type_key(key);
        self.edited(edit)
    }

    fn edited(&mut self, edit: Edit) -> Request {
        match edit {
            Edit::None => Request::None,
            Edit::Changed(plan) => self.take_edited(*plan),
        }
    }

    fn act_on_studies(&mut self, action: Action) -> Request {
        let kind = self.studies.shown;
        match action {
            Action::Up => self.studies.scroll(-1),
            Action::Down => self.studies.scroll(1),
            Action::PageUp => self.studies.scroll(-(PAGE as i16)),
            Action::PageDown => self.studies.scroll(PAGE as i16),
            Action::First => self.studies.scroll = 0,
            Action::Last => self.studies.scroll = u16::MAX,
            Action::Left => self.studies.turn(-1),
            Action::Right => self.studies.turn(1),
            Action::Open | Action::Rerun => return self.start(kind),
            Action::Cancel => return self.cancel(kind),
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_options(&mut self, action: Action) -> Request {
        let page = PAGE as isize;
        match action {
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            Action::PageUp => self.select_listed(-page),
            Action::PageDown => self.select_listed(page),
            Action::First => self.select_listed(isize::MIN),
            Action::Last => self.select_listed(isize::MAX),
            Action::Open => self.zoom = !self.zoom,
            Action::Sort => {
                self.compare.sort = self.compare.sort.next();
                self.compare.reversed = false;
            }
            Action::Reverse => self.compare.reversed = !self.compare.reversed,
            Action::Baseline => {
                let same = self.compare.baseline == Some(self.selected);
                self.compare.baseline = (!same).then_some(self.selected);
            }
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    /// Keys that mean the same on every screen.
    fn act_anywhere(&mut self, action: Action) -> Request {
        match action {
            Action::Show(screen) => self.screen = screen,
            Action::NextScreen => self.screen = self.screen.turned(1),
            Action::PreviousScreen => self.screen = self.screen.turned(Screen::ALL.len() - 1),
            Action::Undo => {
                let edit = self.editor.undo();
                return self.edited(edit);
            }
            Action::Redo => {
                let edit = self.editor.redo();
                return self.edited(edit);
            }
            Action::Save => return Request::Save,
            Action::Search => self.prompt = Some(Prompt::new(Purpose::Search, "")),
            Action::Palette => self.prompt = Some(Prompt::new(Purpose::Palette, "")),
            Action::Export => self.prompt = Some(Prompt::new(Purpose::Export, &self.export_name())),
            Action::Yank => return Request::Yank,
            Action::Theme => self.theme = self.theme.next(),
            Action::Help => {
                self.help = !self.help;
                self.help_scroll = 0;
            }
            Action::Rerun => return self.rerun(self.compute.accuracy),
            Action::Finer => return self.rerun(finer(self.compute.accuracy)),
            Action::Coarser => return self.rerun(coarser(self.compute.accuracy)),
            Action::Suspend => return Request::Suspend,
            Action::Quit => return self.quit(),
            _ => {}
        }
        Request::None
    }

    /// The file offered for what is shown.
    fn export_name(&self) -> String {
        let plan = Path::new(&self.case.source.path);
        let stem = plan.file_stem().and_then(|stem| stem.to_str()).unwrap_or("plan");
        let screen = self.screen.name().to_lowercase();
        let ending = if self.screen == Screen::Plan { "svg" } else { "csv" };
        file::unused_path(&format!("{stem}-{screen}"), ending)
    }

    /// Asks for a file to write the plan to: one that is not there yet.
    pub fn ask_for_file(&mut self) {
        let plan = Path::new(&self.case.source.path);
        let stem = if plan.exists() { plan.with_extension("") } else { "plan".into() };
        let free = file::unused_path(&stem.to_string_lossy(), "toml");
        self.prompt = Some(Prompt::new(Purpose::SaveAs, &free));
    }

    fn cancel(&mut self, kind: Kind) -> Request {
        if !matches!(self.studies.progress(kind), Progress::Running { .. }) {
            return Request::None;
        }
        self.studies.set(kind, Progress::Idle);
        Request::Cancel(kind)
    }

    /// Escape closes what is open, and never leaves.
    pub fn escape(&mut self) -> Request {
        self.warned = false;
        if self.notice.take().is_some() {
            return Request::None;
        }
        if self.help {
            self.help = false;
        } else if let Some(kind) = self.cancellable() {
            return self.cancel(kind);
        } else if !self.compare.filter.is_empty() || !self.studies.filter.is_empty() {
            self.compare.filter.clear();
            self.studies.filter.clear();
        } else if self.screen != Screen::Compare {
            self.screen = Screen::Compare;
        } else if self.zoom {
            self.zoom = false;
        } else {
            self.notice = Some(format!("{} leaves", self.keymap.hint(Action::Quit)));
        }
        Request::None
    }

    /// The study shown, while it computes.
    fn cancellable(&self) -> Option<Kind> {
        let kind = match self.screen {
            Screen::Studies => self.studies.shown,
            Screen::Accuracy => Kind::Accuracy,
            Screen::Plan | Screen::Compare | Screen::Flight => return None,
        };
        matches!(self.studies.progress(kind), Progress::Running { .. }).then_some(kind)
    }

    /// Leaves, but not at once with changes that are not saved.
    fn quit(&mut self) -> Request {
        if !self.editor.unsaved() || self.warned {
            return Request::Quit;
        }
        self.warned = true;
        let [save, quit] = [Action::Save, Action::Quit].map(|action| self.keymap.hint(action));
        self.notice = Some(format!("changes are not saved: {save} saves, {quit} again leaves without"));
        Request::None
    }

    fn rerun(&mut self, accuracy: Accuracy) -> Request {
        self.compute.accuracy = accuracy;
        self.rows.fill(Row::Waiting);
        self.player.option = None;
        Request::Run
    }
}

fn finer(accuracy: Accuracy) -> Accuracy {
    match accuracy {
        Accuracy::Draft => Accuracy::Field,
        Accuracy::Field | Accuracy::Reference => Accuracy::Reference,
    }
}

fn coarser(accuracy: Accuracy) -> Accuracy {
    match accuracy {
        Accuracy::Reference => Accuracy::Field,
        Accuracy::Field | Accuracy::Draft => Accuracy::Draft,
    }
}
