//! The question before the estimates of a fit go into the plan. The question lists the verdicts that the estimates change.

use crossterm::event::{KeyCode, KeyEvent};

use crate::sorting::sort_by_key;
use crate::study::NoResult;
use crate::study::judge::verdict_of;
use crate::study::question::{Found, StudyKind};
use crate::tui::app::{App, Request};
use crate::tui::keymap::Action;
use crate::tui::studies::StudyState;
use crate::verdict::{Verdict, VerdictWord};

/// Most verdict changes that the question lists one by one.
const MOST_CHANGES: usize = 3;

impl App {
    /// The question whether the estimates go into the plan. While the options are still judged with the estimates, the progress instead.
    /// `None` if the user has not asked for the estimates.
    pub fn question_of_estimates(&self) -> Option<String> {
        let fitted = self.fitted_plan.as_ref()?;
        let Some(with_estimates) = &fitted.verdicts else {
            let at = self.studies.state(StudyKind::Check);
            return Some(format!(
                "before the estimates go into the plan, all options are judged with them: {at}"
            ));
        };
        // The most dangerous changes come first: a new PASS, then a verdict that gets better.
        let mut changes: Vec<([bool; 2], String)> = Vec::new();
        for ((option, &then), delay) in with_estimates.iter().enumerate().zip(&self.case.plan.delays) {
            let (now, word) = (self.options[option].verdict(), self.word(option));
            let stays = word == then.into() || word == VerdictWord::Thin && then == Verdict::Pass;
            if !stays {
                let order = [then != Verdict::Pass, then > now];
                // It is not known yet whether the pass will be thin.
                let then = if then == Verdict::Pass { "PASS or THIN" } else { then.for_people() };
                let change = format!("{} {} → {then}", delay.name, word.for_people());
                changes.push((order, change));
            }
        }
        sort_by_key(&mut changes, |(order, _)| *order);
        let told = changes.iter().take(MOST_CHANGES).map(|(_, change)| change.as_str());
        let mut told: Vec<String> = told.map(str::to_owned).collect();
        let more = changes.len().saturating_sub(MOST_CHANGES);
        if more > 0 {
            told.push(format!("{more} more"));
        }
        let mut told = if told.is_empty() { "no verdict changes".to_owned() } else { told.join(", ") };
        for ((option, &then), delay) in with_estimates.iter().enumerate().zip(&self.case.plan.delays) {
            if self.word(option) == VerdictWord::Thin && then == Verdict::Pass {
                told += &format!(", {} may be no longer THIN", delay.name);
            }
        }
        // These are verdicts of the plan alone. The observations of one shot may contradict the plan with any launches.
        if with_estimates.contains(&Verdict::Pass) && self.standing().against_passes().is_some() {
            told += "; a PASS stands only if observations then fit";
        }
        let from = match fitted.n_observations {
            _ if self.record.has_typed() && self.record.has_closed() => {
                "if typed of ANOTHER shot than before".to_owned()
            }
            1 => "ONE observation is little, one tire of one shot".to_owned(),
            count => format!("from {count} observations"),
        };
        Some(format!("{from}; with the estimates: {told}"))
    }

    /// Whether the next key answers the question of the estimates.
    pub fn asks_for_estimates(&self) -> bool {
        self.fitted_plan.as_ref().is_some_and(|fitted| fitted.verdicts.is_some())
    }

    /// Takes the estimates into the plan (`y`) or leaves the plan unchanged (`n`). Enter is no answer: a user who types observations may
    /// press Enter just as the question appears.
    pub fn answer_estimates(&mut self, key: &KeyEvent) -> Request {
        match key.code {
            KeyCode::Char('y') => self.take_estimates(),
            KeyCode::Char('n') | KeyCode::Esc => {
                self.leave_estimates();
                self.notice = Some("the plan stays without the estimates".to_owned());
                Request::None
            }
            _ => {
                self.notice =
                    Some("first: y takes the estimates into the plan, n leaves it as it is".to_owned());
                Request::None
            }
        }
    }

    /// Drops estimates that are not in the plan.
    pub(in crate::tui) fn leave_estimates(&mut self) {
        self.fitted_plan = None;
        self.studies.set(StudyKind::Check, StudyState::Idle);
    }

    /// Stores the verdicts on the plan with the estimates.
    pub(in crate::tui) fn take_fitted_verdicts(&mut self, result: Result<Found, NoResult>) {
        self.studies.set(StudyKind::Check, StudyState::Idle);
        let Some(fitted) = &mut self.fitted_plan else { return };
        match result {
            Ok(Found::Check(judged)) => {
                fitted.verdicts = Some(judged.value.results.iter().map(verdict_of).collect());
            }
            _ => {
                self.fitted_plan = None;
                let use_ = self.keymap.hint(Action::UseEstimates);
                self.notice =
                    Some(format!("the options could not be judged with the estimates: {use_} tries again"));
            }
        }
    }
}
