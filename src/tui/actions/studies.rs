//! Keys of the Studies screen: its tabs, and rows that offer a change of the plan.

use super::PAGE_LINES;
use crate::plan::edit;
use crate::report::parts::Offer;
use crate::report::words::plan_notes::launches_of_mass;
use crate::study::question::StudyKind;
use crate::tui::app::{App, Request};
use crate::tui::editor::EditOutcome;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;

impl App {
    pub(super) fn act_on_studies(&mut self, action: Action) -> Request {
        let kind = self.studies.shown;
        if !self.studies.open
            && let Some(request) = self.act_on_questions(action)
        {
            return request;
        }
        if let Some(request) = self.act_on_offers(action) {
            return request;
        }
        if kind == StudyKind::Fit
            && let Some(request) = self.act_on_fit(action)
        {
            return request;
        }
        match action {
            Action::Up => self.studies.scroll(-1),
            Action::Down => self.studies.scroll(1),
            Action::PageUp => self.studies.scroll(-(PAGE_LINES as i16)),
            Action::PageDown => self.studies.scroll(PAGE_LINES as i16),
            Action::First => self.studies.scroll = 0,
            Action::Last => self.studies.scroll = u16::MAX,
            Action::Left => self.studies.show_neighbour(-1),
            Action::Right => self.studies.show_neighbour(1),
            // The key that began a study does not stop the study.
            Action::Open if self.studies.is_running(kind) => {}
            Action::Open | Action::Rerun => return self.begin_study(kind),
            Action::Cancel => return self.cancel_study(kind),
            Action::UseEstimates => return self.use_estimates(),
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    /// Moves among the questions and opens the result of the selected one. `None` for an action of an open study.
    fn act_on_questions(&mut self, action: Action) -> Option<Request> {
        let kind = self.studies.shown;
        match action {
            Action::Up | Action::Left => self.studies.show_neighbour(-1),
            Action::Down | Action::Right => self.studies.show_neighbour(1),
            Action::First | Action::PageUp => self.studies.select(StudyKind::tabs()[0]),
            Action::Last | Action::PageDown => {
                StudyKind::tabs().pop().into_iter().for_each(|last| self.studies.select(last));
            }
            // Enter on the fit opens its result and asks for the next observation.
            Action::Open if kind == StudyKind::Fit => {
                self.studies.show(kind);
                return None;
            }
            Action::Open if self.studies.is_running(kind) || self.studies.finished(kind).is_some() => {
                self.studies.show(kind);
            }
            _ => return None,
        }
        Some(Request::None)
    }

    /// Moves among the rows that offer a change of the plan, and makes the change of the selected row. `None` if there are no such rows or
    /// the action is another.
    fn act_on_offers(&mut self, action: Action) -> Option<Request> {
        let finished = self.studies.finished(self.studies.shown).filter(|_| self.studies.open)?;
        let report = self.report_of(finished);
        let offers = report.offers(&self.studies.filter);
        let count = offers.len().max(1);
        if count == 1 && action != Action::Open {
            // With a single offer there is nothing to choose: the keys scroll.
            return None;
        }
        let selected = self.studies.selected.min(count - 1);
        let moved = match action {
            Action::Up => selected.saturating_sub(1),
            Action::Down => selected + 1,
            Action::PageUp => selected.saturating_sub(PAGE_LINES),
            Action::PageDown => selected + PAGE_LINES,
            Action::First => 0,
            Action::Last => count - 1,
            Action::Open => {
                let offer = (*offers.get(selected)?).clone();
                return Some(self.take_offer(&offer));
            }
            _ => return None,
        };
        if offers.is_empty() {
            return None;
        }
        self.studies.selected = moved.min(count - 1);
        Some(Request::None)
    }

    /// Makes the change that a row offers. Undo takes it back.
    fn take_offer(&mut self, offer: &Offer) -> Request {
        let (text, plan) = (self.editor.text.as_str(), &self.case.plan);
        if let Offer::Option(delay) = offer
            && let Some(same) = plan.delays.iter().position(|known| known.fires_like(delay))
        {
            self.notice = Some(format!("in the plan already: {}", plan.delays[same].name));
            (self.screen, self.selected, self.has_selected) = (Screen::Compare, same, true);
            return Request::None;
        }
        let (changed, done) = match offer {
            Offer::Option(delay) => (edit::add_delays(text, plan, &[delay]), "added".to_owned()),
            Offer::Sizes { rope, tire_mass, border_rows } => {
                let launches = launches_of_mass(plan, *tire_mass);
                let tires = launches.unwrap_or_else(|| format!("tires of {tire_mass} kg"));
                let done = format!("used: {rope}, {tires}, {border_rows} border rows");
                (edit::write_sizes(text, plan, rope, *tire_mass, *border_rows), done)
            }
        };
        let edit = self.editor.adopt(changed.map_err(|error| error.to_string()));
        if matches!(edit, EditOutcome::None) {
            self.notice = self.editor.problem.clone();
            return Request::None;
        }
        let undo = self.keymap.hint(Action::Undo);
        // Another option does not change the result of the study.
        let kept = self.studies.clone();
        let request = self.edited(edit);
        if matches!(offer, Offer::Option(_)) {
            self.studies.keep_shown_result(&kept);
        }
        // Compare shows the verdict of the new option.
        self.screen = Screen::Compare;
        let done = match (offer, self.case.plan.delays.last()) {
            (Offer::Option(_), Some(added)) => {
                self.selected = self.options.len().saturating_sub(1);
                self.has_selected = true;
                format!("{done}: {}", added.name)
            }
            _ => done,
        };
        self.notice = Some(format!("{done} · {undo} takes it back"));
        request
    }
}
