//! Effects of keys, clicks and commands on the app, screen by screen.

use std::path::Path;

use crossterm::event::{KeyCode, KeyEvent};
use ratatui::layout::Position;

use super::app::{App, ClickTarget, Request};
use super::editor::EditOutcome;
use super::keymap::{Action, BINDINGS};
use super::options::OptionState;
use super::paste::paste;
use super::player::Player;
use super::prompt::{Prompt, Purpose, Typed};
use super::screen::Screen;
use crate::choice::Accuracy;
use crate::jobs::StudyKind;

/// Lines that a page key moves.
pub(super) const PAGE: usize = 10;
/// Time that an arrow key moves the flight [s].
const SCRUB: f64 = 0.01;

impl App {
    /// Does the action of a key or of a chosen command.
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

    /// Scrolls the open help. Returns whether the action was for the help.
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

    /// Does what a click at a position of the screen asks for.
    pub fn click(&mut self, at: Position) -> Request {
        let hit = self.areas.iter().rev().find(|(area, _)| area.contains(at)).copied();
        let Some((area, target)) = hit else { return Request::None };
        match target {
            ClickTarget::Act(action) => return self.act(action),
            ClickTarget::Option(option) if option == self.selected => return self.act(Action::Open),
            ClickTarget::Option(option) => self.selected = option,
            ClickTarget::Sort(sort) => self.listing.sort_by(sort),
            ClickTarget::Field(field) if field == self.editor.selected => return self.act(Action::Open),
            ClickTarget::Field(field) => {
                return self.select_field(field as isize - self.editor.selected as isize);
            }
            ClickTarget::Lines(_) => {}
            ClickTarget::Study(kind) => self.studies.show(kind),
            ClickTarget::Offer(n) if n == self.studies.selected => return self.act(Action::Open),
            ClickTarget::Offer(n) => self.studies.selected = n,
            ClickTarget::Time(end) => {
                let share = f64::from(at.x - area.x) / f64::from(area.width.saturating_sub(1).max(1));
                self.player.seek(share * end, end);
            }
        }
        Request::None
    }

    /// Passes a key to the line being typed at the foot of the screen.
    pub fn type_in_prompt(&mut self, key: &KeyEvent) -> Request {
        let Some(mut prompt) = self.prompt.take() else { return Request::None };
        let typed = prompt.key(key);
        let text = prompt.input.value().to_owned();
        match (prompt.purpose, typed) {
            (Purpose::Find, Typed::Cancelled) => self.find("", false),
            (Purpose::Find, Typed::Changed) => self.find(&text, key.code == KeyCode::Down),
            (Purpose::Palette, Typed::Done) => {
                let Some(chosen) = prompt.commands().get(prompt.selected).copied() else {
                    return Request::None;
                };
                // The command belongs to another screen: show that screen first.
                if let Some(&screen) = chosen.on.first().filter(|_| !chosen.is_on(self.screen)) {
                    self.screen = screen;
                }
                return self.act(chosen.action);
            }
            (Purpose::Export, Typed::Done) if !text.is_empty() => return Request::Export(text.into()),
            (Purpose::Page, Typed::Done) if !text.is_empty() => return Request::Page(text.into()),
            (Purpose::SaveAs, Typed::Done) if !text.is_empty() => return Request::SaveAs(text.into()),
            _ => {}
        }
        if typed == Typed::Changed {
            self.prompt = Some(prompt);
        }
        Request::None
    }

    /// Puts a pasted text into the line being typed, if there is one.
    pub fn paste(&mut self, text: &str) {
        self.notice = if let Some(prompt) = &mut self.prompt {
            prompt.selected = 0;
            let note = paste(&mut prompt.input, text);
            if prompt.purpose == Purpose::Find {
                let typed = prompt.input.value().to_owned();
                self.find(&typed, false);
            }
            note
        } else if self.editor.typing() {
            self.editor.paste(text)
        } else {
            Some("nothing was pasted: no value is being typed".to_owned())
        };
    }

    /// Finds a text: lists only the options or lines that contain it, or selects the value of the plan that does.
    fn find(&mut self, text: &str, next: bool) {
        match self.screen {
            Screen::Plan => {
                self.editor.find(text, next);
                self.follow_field();
            }
            Screen::Studies => self.studies.filter = text.to_owned(),
            Screen::Compare | Screen::Flight | Screen::Accuracy => {
                self.listing.filter = text.to_owned();
                self.select_listed(0);
            }
        }
    }

    fn act_on_flight(&mut self, action: Action) -> Request {
        let end = self.flight_end();
        let seek = |player: &mut Player, by: f64| player.seek(player.time + by, end);
        match action {
            Action::Play => self.player.toggle(end),
            Action::NextEvent | Action::PreviousEvent => {
                let to = self.event_beside(self.player.time, action == Action::NextEvent);
                self.player.seek(to, end);
            }
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

    /// The nearest firing or peak of the flight after `time` [s], or before; the end or the beginning where there is none.
    fn event_beside(&self, time: f64, after: bool) -> f64 {
        let Some(flight) = self.studies.flight(self.selected) else { return time };
        let firings = self.case.shots[self.selected].times();
        let peaks = [flight.outcome.height.at, flight.outcome.force.at];
        let events = || firings.iter().chain(&peaks).copied();
        match after {
            true => events().filter(|&at| at > time + 1e-9).fold(self.flight_end(), f64::min),
            false => events().filter(|&at| at < time - 1e-9).fold(0.0, f64::max),
        }
    }

    fn act_on_accuracy(&mut self, action: Action) -> Request {
        match action {
            Action::Open | Action::Rerun => return self.begin_study(StudyKind::Accuracy),
            Action::Cancel => return self.cancel_study(StudyKind::Accuracy),
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
            Action::AddOption => {
                let edit = self.editor.copy_option(self.selected);
                let request = self.edited(edit);
                self.follow_field();
                return request;
            }
            Action::RemoveOption => self.editor.remove(),
            other => return self.act_anywhere(other),
        };
        self.edited(edit)
    }

    /// Selects the field `lines` further down, and the option of that field.
    fn select_field(&mut self, lines: isize) -> Request {
        self.editor.select(lines);
        self.follow_field();
        Request::None
    }

    /// Selects the option of the selected field.
    fn follow_field(&mut self) {
        if let Some(field) = self.editor.field().filter(|field| field.path.section == "delay") {
            self.selected = field.path.index.unwrap_or(0).min(self.options.len().saturating_sub(1));
        }
    }

    /// Passes a key to the value being typed, or to the blast rows being put in order.
    pub fn type_key(&mut self, key: &KeyEvent) -> Request {
        let edit = match (self.editor.order.is_some(), self.keymap.action(key)) {
            (true, Some(action)) if key.code != KeyCode::Esc => self.editor.arrange(action),
            _ => self.editor.type_key(key),
        };
        self.edited(edit)
    }

    pub(super) fn edited(&mut self, edit: EditOutcome) -> Request {
        match edit {
            EditOutcome::None => Request::None,
            EditOutcome::Changed(plan) => self.take_edited(*plan),
        }
    }

    fn act_on_options(&mut self, action: Action) -> Request {
        if let Some(request) = self.act_on_changes(action) {
            return request;
        }
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
                self.listing.sort = self.listing.sort.next();
                self.listing.reversed = false;
            }
            Action::Reverse => self.listing.reversed = !self.listing.reversed,
            Action::Why => return self.ask_for_changes(),
            Action::Baseline => {
                let same = self.listing.baseline == Some(self.selected);
                self.listing.baseline = (!same).then_some(self.selected);
            }
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    /// Does an action that is the same on every screen.
    pub(super) fn act_anywhere(&mut self, action: Action) -> Request {
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
            Action::SaveAs => return Request::NamePlan,
            Action::Find => self.prompt = Some(Prompt::new(Purpose::Find, "")),
            Action::Palette => self.prompt = Some(Prompt::new(Purpose::Palette, "")),
            Action::Export => return self.name_export(),
            Action::Page => return Request::NamePage(format!("{}-to-be-fired", self.stem())),
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

    /// Asks for the file to export to; the name offered says plan and screen.
    fn name_export(&self) -> Request {
        let ending = if self.screen == Screen::Plan { "svg" } else { "csv" };
        Request::NameExport(format!("{}-{}", self.stem(), self.screen.name().to_lowercase()), ending)
    }

    /// Name of the plan's file without its ending.
    fn stem(&self) -> &str {
        Path::new(&self.case.source.path).file_stem().and_then(|stem| stem.to_str()).unwrap_or("plan")
    }

    /// Closes the uppermost open thing; never leaves the program.
    pub fn escape(&mut self) -> Request {
        self.warned = false;
        if self.notice.take().is_some() {
            return Request::None;
        }
        if self.help {
            self.help = false;
        } else if let Some(kind) = self.cancellable() {
            return self.cancel_study(kind);
        } else if self.screen == Screen::Compare && self.studies.changes.take().is_some() {
            return Request::None;
        } else if !self.listing.filter.is_empty() || !self.studies.filter.is_empty() {
            self.listing.filter.clear();
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
    fn cancellable(&self) -> Option<StudyKind> {
        let kind = match self.screen {
            Screen::Studies => self.studies.shown,
            Screen::Accuracy => StudyKind::Accuracy,
            Screen::Compare => StudyKind::WouldPass,
            Screen::Plan | Screen::Flight => return None,
        };
        self.studies.is_running(kind).then_some(kind)
    }

    /// Asks to quit; the first time with unsaved changes only warns.
    fn quit(&mut self) -> Request {
        if !self.editor.unsaved() || self.warned {
            return Request::Quit;
        }
        self.warned = true;
        let [save, quit] = [Action::Save, Action::Quit].map(|action| self.keymap.hint(action));
        self.notice = Some(format!("changes are not saved: {save} saves, {quit} again leaves without"));
        Request::None
    }

    /// Asks to check every option at an accuracy.
    fn rerun(&mut self, accuracy: Accuracy) -> Request {
        self.compute.accuracy = accuracy;
        self.studies.changes = None;
        self.options.fill(OptionState::Waiting);
        self.player.option = None;
        Request::Check
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
