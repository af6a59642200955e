//! Effects of keys, clicks and commands on the app. This file holds the effects that all screens share; each screen has its own file.

mod accuracy;
mod compare;
pub mod dispatch;
mod estimates;
mod fit;
mod flight;
mod plan;
mod prompt;
mod remedies;
mod studies;

use std::path::Path;

use itertools::Itertools;
use ratatui::layout::Position;

use super::app::{App, ClickTarget, Request};
use super::keymap::{Action, BINDINGS};
use super::prompt::{Prompt, Purpose};
use super::screen::Screen;
use super::typed_line::TypedLine;
use crate::choice::Accuracy;
use crate::report::words::to_be_confirmed::to_be_confirmed;
use crate::study::judge::Judgement;
use crate::study::question::StudyKind;
use crate::study::standing::{Doubt, Hold};
use crate::tui::compare::results;
use crate::verdict::Verdict;

/// Stands for the path of a plan that has no file yet.
pub const NEW_PLAN: &str = "new plan";
/// Lines that a page key moves.
pub(in crate::tui) const PAGE_LINES: usize = 10;

/// Ending of the page name of an option that may be fired.
const TO_BE_FIRED: &str = "to-be-fired";

impl App {
    /// Does the action of a key or of a chosen command.
    pub fn act(&mut self, action: Action) -> Request {
        // The user pressed Enter to accept the page name, but the page was refused.
        if self.page_refused.take().is_some() && action == Action::Open {
            return Request::None;
        }
        self.notice = None;
        if action != Action::Quit {
            self.quit_warned = false;
        }
        // A user who asks for details or for the page of an option has selected this option.
        self.has_selected |= match action {
            Action::Open => self.screen == Screen::Compare,
            Action::Why
            | Action::Try
            | Action::Baseline
            | Action::WritePage
            | Action::AddOption
            | Action::RemoveOption => true,
            _ => false,
        };
        if (self.help || self.shows_differences) && self.act_on_cover(action) {
            return Request::None;
        }
        match self.screen {
            Screen::Plan => self.act_on_plan(action),
            Screen::Compare => self.act_on_compare(action),
            Screen::Flight => self.act_on_flight(action),
            Screen::Studies => self.act_on_studies(action),
            Screen::Accuracy => self.act_on_accuracy(action),
        }
    }

    /// Scrolls or closes the help or the list of differences. While either covers the screen, keys do not act on what is hidden.
    /// Returns whether the action is done.
    fn act_on_cover(&mut self, action: Action) -> bool {
        let lines = match action {
            Action::Up => -1,
            Action::Down => 1,
            Action::PageUp => -(PAGE_LINES as i16),
            Action::PageDown => PAGE_LINES as i16,
            Action::First => i16::MIN,
            Action::Last => i16::MAX,
            Action::Help | Action::Differences | Action::Theme | Action::Suspend | Action::Quit => {
                return false;
            }
            Action::Show(_) | Action::NextScreen | Action::PreviousScreen => return false,
            _ => {
                (self.help, self.shows_differences) = (false, false);
                return true;
            }
        };
        self.help_scroll = self.help_scroll.saturating_add_signed(lines).min(2 * BINDINGS.len() as u16);
        true
    }

    /// Does the action of a click at a position on the screen.
    pub fn click(&mut self, at: Position) -> Request {
        let hit = self.areas.iter().rev().find(|(area, _)| area.contains(at)).copied();
        let Some((area, target)) = hit else { return Request::None };
        self.quit_warned &= matches!(target, ClickTarget::Act(_));
        match target {
            ClickTarget::Act(action) => return self.act(action),
            ClickTarget::Option(at) if at == self.selected_option() => return self.act(Action::Open),
            ClickTarget::Option(at) => self.select_option(at),
            ClickTarget::Sort(sort) => self.listing.sort_by(sort),
            ClickTarget::Field(field) if field == self.editor.selected => return self.act(Action::Open),
            ClickTarget::Field(field) => {
                return self.select_field(field as isize - self.editor.selected as isize);
            }
            ClickTarget::FiringTime(row) => {
                self.has_selected = true;
                self.editor.begin_time(self.selected, row);
            }
            ClickTarget::Lines(_) => {}
            ClickTarget::Study(kind) if kind == self.studies.shown && !self.studies.open => {
                return self.act(Action::Open);
            }
            ClickTarget::Study(kind) => self.studies.select(kind),
            ClickTarget::Offer(n) if n == self.studies.selected => return self.act(Action::Open),
            ClickTarget::Offer(n) => self.studies.selected = n,
            ClickTarget::Flight => self.show(Screen::Flight),
            ClickTarget::Time(end) => {
                let share = f64::from(at.x - area.x) / f64::from(area.width.saturating_sub(1).max(1));
                self.show_time(share * end);
            }
        }
        Request::None
    }

    /// Does an action that is the same on every screen.
    pub(super) fn act_anywhere(&mut self, action: Action) -> Request {
        match action {
            Action::Show(screen) => self.show(screen),
            Action::NextScreen => self.show(self.screen.next_by(1)),
            Action::PreviousScreen => self.show(self.screen.next_by(Screen::ALL.len() - 1)),
            Action::Undo => {
                let edit = self.editor.undo();
                return self.edited(edit);
            }
            Action::Redo => {
                let edit = self.editor.redo();
                return self.edited(edit);
            }
            Action::Save => return Request::Save,
            Action::SaveAs => return Request::AskPlanPath,
            Action::Find => self.prompt = Some(Prompt::new(Purpose::Find, TypedLine::default())),
            Action::Commands => self.prompt = Some(Prompt::new(Purpose::Palette, TypedLine::default())),
            Action::Export => return self.name_export(),
            Action::WritePage => return self.ask_for_page(),
            Action::Copy => return Request::Copy,
            Action::Play => {
                self.player.rests = !self.player.rests;
                // At rest the map shows all holes, not only the holes fired so far.
                self.firing_play.played = self.firing_play.played.filter(|_| !self.player.rests);
            }
            Action::OtherShot => self.shown_shot = self.shown_shot.other(),
            Action::Theme => self.theme = self.theme.next(),
            Action::Help => {
                (self.help, self.shows_differences) = (!self.help, false);
                self.help_scroll = 0;
            }
            Action::Differences => self.show_differences(),
            Action::Rerun => return self.judge_again(self.compute.accuracy),
            Action::Finer => return self.change_accuracy(finer(self.compute.accuracy)),
            Action::Coarser => return self.change_accuracy(coarser(self.compute.accuracy)),
            Action::Suspend => return Request::Suspend,
            Action::Quit => return self.quit(),
            _ => {}
        }
        Request::None
    }

    /// Shows a screen. The Plan screen selects the option that the other screens have selected.
    pub(super) fn show(&mut self, screen: Screen) {
        if screen == Screen::Plan && self.screen != Screen::Plan {
            self.editor.select_option(self.selected);
        }
        if screen == Screen::Flight && self.screen != Screen::Flight {
            self.forget_old_flight();
        }
        self.screen = screen;
    }

    /// Opens or closes the list of differences between the two plans.
    fn show_differences(&mut self) {
        if self.beside.is_none() {
            self.notice = Some("there is one plan: `shelter A.toml B.toml` shows two".to_owned());
            return;
        }
        (self.shows_differences, self.help) = (!self.shows_differences, false);
        self.help_scroll = 0;
    }

    /// Asks for the export file. The offered name contains the plan and the screen.
    fn name_export(&self) -> Request {
        let ending = if self.screen == Screen::Plan { "svg" } else { "csv" };
        Request::NameExport(format!("{}-{}", self.file_stem(), self.screen.name().to_lowercase()), ending)
    }

    /// Asks for the page of the selected option. If this option does not pass and another one is recommended, asks first which of the two.
    fn ask_for_page(&mut self) -> Request {
        let Some(best) = self.recommended_instead() else { return self.name_page() };
        self.prompt = Some(Prompt::new(Purpose::PageOf(best), TypedLine::default()));
        Request::None
    }

    /// Index of the recommended option, if its pass stands and the selected option does not pass.
    fn recommended_instead(&self) -> Option<usize> {
        self.judgement(self.selected)?;
        let best = self.recommended()?;
        let passes = |option: usize| self.verdict(option) == Verdict::Pass;
        let stands = self.standing_now().against_passes().is_none();
        (stands && passes(best) && !passes(self.selected)).then_some(best)
    }

    /// Asks for the file of the page. The offered name says which option it is, whether the option passes, and whether samples still come.
    /// If samples still come, or the assumptions of a pass are not known yet, the first request only warns.
    pub fn name_page(&mut self) -> Request {
        let Some(judged) = self.judgement(self.selected) else {
            return self.refuse_page("no page: the selected option has no result yet".to_owned());
        };
        let is_being_judged = self.options[self.selected].is_sampling();
        let lacks = judged.verdict() == Verdict::Pass && self.stands_on(self.selected).is_none();
        if (lacks || is_being_judged) && self.page_warned != Some(self.selected) {
            self.page_warned = Some(self.selected);
            let page = self.keymap.hint(Action::WritePage);
            return self.refuse_page(match is_being_judged {
                true => format!("more shots of this option are tried: wait, or {page} again for a page of what is known"),
                false => format!(
                    "wait for what this pass holds until, it is still being found; {page} again writes a page NOT to be fired by"
                ),
            });
        }
        let option = self.case.plan.delays.get(self.selected).map_or("", |delay| delay.name.as_str());
        Request::NamePage(format!("{}-{}-{}", self.file_stem(), in_file_name(option), self.page_ending()))
    }

    /// Asks for no page. The reason stays on the screen as long as it holds.
    fn refuse_page(&mut self, why: String) -> Request {
        self.notice = Some(why.clone());
        self.page_refused = Some(why);
        Request::None
    }

    /// Whether the file name says that the selected option is to be fired, but the option must not be fired (any more) or its pass is thin.
    pub fn misnames_page(&self, path: &Path) -> bool {
        let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
        let ending = self.page_ending();
        let stem = Path::new(name.as_ref()).with_extension("");
        // A number follows the name if the name was already taken.
        let stem = stem.to_string_lossy();
        let said = stem.trim_end_matches(|sign: char| sign.is_ascii_digit() || sign == '-');
        name.contains(TO_BE_FIRED) && !said.ends_with(ending)
    }

    /// Ending of the page name of the selected option: says whether the option may be fired.
    fn page_ending(&self) -> &'static str {
        let judged = self.judgement(self.selected);
        let verdict = judged.map_or(Verdict::Undecided, Judgement::verdict);
        let standing = self.standing_now();
        let seen = self.record.read(&self.case).unwrap_or_default();
        let fired = self.with_judgement(self.selected);
        let confirmed = to_be_confirmed(&self.case, fired, &seen, standing.compared());
        match standing.against_firing(judged, self.stands_on(self.selected)) {
            None => match (self.thin(self.selected).is_some(), !confirmed.is_empty()) {
                (false, false) => TO_BE_FIRED,
                (true, false) => "thin-to-be-fired",
                (false, true) => "if-confirmed-to-be-fired",
                (true, true) => "thin-if-confirmed-to-be-fired",
            },
            Some(Doubt::Example) => "example",
            Some(_) if verdict == Verdict::Fail => "fails",
            Some(Doubt::Hold(Hold::Contradicted | Hold::NotCompared) | Doubt::OtherDrawsFail) => "hold",
            Some(_) if verdict == Verdict::Undecided && results(&self.options).is_err() => "open-so-far",
            Some(Doubt::Hold(Hold::FileChanged) | Doubt::NoFile) if verdict == Verdict::Pass => "not-saved",
            Some(Doubt::StandsOnUnknown) => "not-complete",
            Some(
                Doubt::Hold(Hold::FileChanged)
                | Doubt::NoFile
                | Doubt::NoUncertainty
                | Doubt::LaunchUnstated
                | Doubt::RangeBesidePlan
                | Doubt::NotOfEarth
                | Doubt::AcceptsTooMuch
                | Doubt::NoPass
                | Doubt::PlannedAlone
                | Doubt::FixedStep,
            ) => "open",
        }
    }

    /// Path of the plan's file without its extension. Files written about a plan lie beside the plan.
    fn file_stem(&self) -> String {
        let stem = Path::new(&self.case.source.path).with_extension("");
        let is_file = |stem: &&str| !["", "-", NEW_PLAN].contains(stem);
        let title = in_file_name(&self.case.title());
        let otherwise = if title.is_empty() { "plan".to_owned() } else { title };
        stem.to_str().filter(is_file).map_or(otherwise, str::to_owned)
    }

    /// Closes the topmost open item. Never leaves the program.
    pub fn escape(&mut self) -> Request {
        self.quit_warned = false;
        if self.fitted_plan.take().is_some() {
            return self.cancel_study(StudyKind::Check);
        }
        if self.notice.take().is_some() {
            return Request::None;
        }
        if self.help || self.shows_differences {
            (self.help, self.shows_differences) = (false, false);
        } else if let Some(kind) = self.cancellable() {
            return self.cancel_study(kind);
        } else if self.screen == Screen::Compare && self.lists_remedies() {
            self.studies.remedy_list = None;
        } else if self.screen == Screen::Studies && self.studies.open {
            self.studies.open = false;
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

    /// The study on the screen, while it computes.
    pub fn cancellable(&self) -> Option<StudyKind> {
        let kind = match self.screen {
            Screen::Studies => self.studies.shown,
            Screen::Accuracy => StudyKind::Accuracy,
            Screen::Compare if self.lists_remedies() => StudyKind::Remedies,
            Screen::Plan | Screen::Compare | Screen::Flight => return None,
        };
        self.studies.is_running(kind).then_some(kind)
    }

    /// Asks to quit. If something would be lost, the first call only warns.
    fn quit(&mut self) -> Request {
        let [save, quit] = [Action::Save, Action::Quit].map(|action| self.keymap.hint(action));
        let unsaved = self.plans().iter().any(|app| app.editor.unsaved());
        // Observations are kept beside the file of their plan, so a plan without a file keeps none.
        let has_no_file = |app: &&App| !Path::new(&app.case.source.path).is_file() && app.record.has_typed();
        let told_of_no_file = self.plans().iter().any(has_no_file);
        if self.quit_warned || !(unsaved || told_of_no_file) {
            return Request::Quit;
        }
        self.quit_warned = true;
        let what = if unsaved { "changes are" } else { "observations are" };
        self.notice = Some(format!("{what} not saved: {save} saves, {quit} again leaves without"));
        Request::None
    }

    /// Judges all options again at another accuracy, or says why nothing would change.
    fn change_accuracy(&mut self, accuracy: Accuracy) -> Request {
        let same = match self.compute.step {
            Some(_) => "the step is fixed by --dt",
            None if accuracy == self.compute.accuracy => "there is no other level that way",
            None => {
                self.notice = Some(format!("accuracy: {}", accuracy.name()));
                return self.judge_again(accuracy);
            }
        };
        self.notice = Some(same.to_owned());
        Request::None
    }

    fn judge_again(&mut self, accuracy: Accuracy) -> Request {
        self.compute.accuracy = accuracy;
        self.studies.remedy_list = None;
        self.forget_verdicts();
        Request::Judge
    }
}

/// A name as part of a file name: its letters and digits, joined by `-`.
fn in_file_name(name: &str) -> String {
    name.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty()).join("-")
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
