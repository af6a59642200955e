//! What jobs tell, and how it changes the app: options are judged, studies end, the answer is found; and how much is still to come.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::app::{App, HOLDS_SOUGHT, NOT_JUDGED_YET, STILL_LOOKED_FOR};
use super::compare::{OptionState, results};
use super::screen::Screen;
use super::studies::{ShownStudy, StudyState};
use crate::jobs::News;
use crate::report::words::headline::headline;
use crate::scene::Shot;
use crate::study::as_planned::step_error;
use crate::study::cost::{runs_to_come, time_of_runs};
use crate::study::judge::Part;
use crate::study::question::{Found, StudyKind};
use crate::verdict::Verdict;

/// Time from the last firing to rest that a run is expected to take [s].
const USUAL_FLIGHT: f64 = 1.6;

impl App {
    /// The expected time of a study at the pace of the verdicts, which shares the machine with whatever else runs; where these took too few
    /// runs to tell, from the first option that was checked. `None` while none was.
    pub fn expected_time(&self, kind: StudyKind) -> Option<Duration> {
        let checked = (0..self.options.len()).find_map(|option| self.judgement(option))?;
        if kind == StudyKind::Fit && self.record.is_empty() {
            return None;
        }
        let runs = kind.expected_runs(&self.case)?;
        Some(match self.pace.rate() {
            Some(rate) => Duration::from_secs_f64(runs as f64 / rate),
            None => time_of_runs(&self.case, &checked.checked, runs, self.threads),
        })
    }

    /// Runs that all options are still expected to take.
    fn runs_to_come(&self) -> usize {
        let shots = self.case.shots.iter().zip(&self.options);
        let of_option = |(shot, state): (&Shot, &OptionState)| match state {
            OptionState::Failed(_) | OptionState::Judged { more_samples: false, .. } => 0,
            state => runs_to_come(&self.case, shot, state.judgement()),
        };
        shots.map(of_option).sum()
    }

    /// Finds the answer once all options are judged, and selects the option that it recommends.
    pub(super) fn find_answer(&mut self) {
        let Ok(results) = results(&self.options) else {
            self.answer = None;
            return;
        };
        let is_first = self.recommended().is_none();
        self.answer = Some(headline(&self.case, &results));
        if is_first {
            self.select_recommended();
        }
    }

    /// Selects the recommended option where the user has selected none, unless what was found of another is on the screen.
    pub(super) fn select_recommended(&mut self) {
        let best = self.recommended();
        if let Some(best) = best.filter(|_| !self.has_selected && !self.shows_found_of_selected()) {
            self.selected = best;
        }
    }

    /// The option of which surely few enough shots fail, so far, and of which the least risk is possible; of equal ones the one that uses
    /// least of a limit. `None` before there is such a one: who is named is taken for the answer.
    pub fn ahead(&self) -> Option<usize> {
        if self.standing().against_passes().is_some() {
            return None;
        }
        // Before all were tried, the first one would be ahead of nothing.
        let has_shots =
            |state: &OptionState| state.judgement().is_some_and(|judged| judged.sampled.known().is_some());
        let is_tried = |state: &OptionState| state.is_decided() || has_shots(state);
        if !self.options.iter().all(is_tried) {
            return None;
        }
        let limits = &self.case.limits;
        let risks = self.options.iter().enumerate().filter_map(|(option, state)| {
            let judged = state.judgement().filter(|judged| judged.verdict() != Verdict::Fail)?;
            let sampled = judged.sampled.known()?;
            let highest = Some(sampled.bounds.interval[1]).filter(|risk| *risk < limits.accepted_risk)?;
            let used = judged.nearest_limit(limits).map_or(0.0, |(_, used)| used);
            Some((option, highest, used))
        });
        risks.min_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2))).map(|(option, ..)| option)
    }

    /// Whether the screen shows what was found of the selected option alone.
    fn shows_found_of_selected(&self) -> bool {
        let found = |kind| self.studies.finished(kind).map(|finished| &finished.found);
        match self.screen {
            Screen::Plan | Screen::Compare => false,
            Screen::Flight => self.flight().is_some(),
            Screen::Studies => {
                self.studies.open
                    && matches!(found(self.studies.shown), Some(Found::Assumptions(found)) if found.value.option == self.selected)
            }
            Screen::Accuracy => {
                matches!(found(StudyKind::Accuracy), Some(Found::Accuracy(found)) if found.value.option == self.selected)
            }
        }
    }

    /// Takes news of a job.
    pub fn take_news(&mut self, news: News) {
        let may_end = matches!(
            news,
            News::Checked { .. }
                | News::Found {
                    part: Part::Samples { more: false, .. } | Part::Dud { .. } | Part::Confirmation(_),
                    ..
                }
        );
        let is_of_option = matches!(news, News::Checked { .. } | News::Found { .. });
        let tells_samples = matches!(news, News::Found { part: Part::Samples { .. }, .. });
        self.note_news(news);
        if is_of_option {
            self.pace.expect(self.runs_to_come());
        }
        let is_judged = self
            .options
            .get(self.selected)
            .is_some_and(|state| !state.is_computing() && !state.is_sampling());
        let is_found = !self.studies.is_running(StudyKind::Remedies);
        let is_held_until = self.stands_on(self.selected).is_some();
        self.notice.take_if(|said| {
            is_judged && said == NOT_JUDGED_YET
                || is_found && said == STILL_LOOKED_FOR
                || is_held_until && said.ends_with(HOLDS_SOUGHT)
        });
        // A page that was refused waited for this.
        if is_judged && (is_held_until || self.verdict(self.selected) != Verdict::Pass) {
            let refused = self.page_refused.take();
            self.notice.take_if(|said| refused.as_ref() == Some(said));
        }
        if may_end && !self.checking() && !self.sampling() {
            self.find_answer();
        } else if tells_samples
            && self.answer.is_none()
            && !self.has_selected
            && !self.shows_found_of_selected()
        {
            // What the headline names is what cursor and charts show.
            self.selected = self.ahead().unwrap_or(self.selected);
        }
    }

    fn note_news(&mut self, news: News) {
        match news {
            News::Checking { option, runs, time } => {
                let done = self.share_done(option, runs, time);
                self.set_option(option, OptionState::Running { runs, done });
            }
            News::Checked { option, result } => {
                // Until samples arrive the option stays OPEN: a shot that passes as planned shows no PASS.
                let begin = |judgement| OptionState::Judged { judgement, more_samples: true };
                self.set_option(option, result.map_or_else(OptionState::Failed, begin));
            }
            News::Found { option, part } => {
                if let Some(OptionState::Judged { judgement, more_samples }) = self.options.get_mut(option) {
                    let told = match part {
                        Part::Samples { more, .. } => Some([more, true]),
                        Part::Dud { .. } | Part::Confirmation(_) => Some([false; 2]),
                        Part::Deciding(_) | Part::Margin(_) => None,
                    };
                    judgement.take(part);
                    if let Some([more, dud_follows]) = told {
                        let grounds = judgement.grounds();
                        *more_samples =
                            more || dud_follows && grounds.awaits_one_dud() || grounds.awaits_confirmation();
                    }
                }
            }
            News::Judging(runs) => self.pace.note(runs, Instant::now()),
            News::Band { option, band } => {
                self.pace.note_found();
                if let Some(known) = self.bands.get_mut(option) {
                    *known = Some(band);
                }
            }
            News::Assumptions { option, found } => {
                self.pace.note_found();
                if let Some(known) = self.assumptions.get_mut(option) {
                    *known = Some(found);
                }
            }
            News::Studying { kind: StudyKind::Check, .. } if self.fitted_plan.is_none() => {}
            News::Studied { kind: StudyKind::Check, result, .. } => self.take_fitted_verdicts(result),
            News::Studying { kind, at } => {
                self.studies.set(kind, StudyState::Running(at));
            }
            News::Studied { kind, compute, result } => {
                let finish = |found| StudyState::Done(Arc::new(ShownStudy::new(&self.case, compute, found)));
                let state = result.map_or_else(StudyState::Failed, finish);
                self.studies.set(kind, state);
                if kind == StudyKind::Flight {
                    let asked_for = self.player.open_at.take();
                    self.player.is_steered |= asked_for.is_some();
                    let worst = || self.flight().map(|flight| flight.worst_moment(&self.case.limits));
                    let opens_at = asked_for.or_else(worst);
                    self.player.seek(opens_at.unwrap_or(0.0), self.flight_end());
                }
            }
        }
    }

    fn set_option(&mut self, option: usize, state: OptionState) {
        if let Some(known) = self.options.get_mut(option) {
            *known = state;
            self.assumptions[option] = None;
            self.bands[option] = None;
        }
    }

    /// Share done of the least number of runs: each run costs [`step_error::RATIO`] times the run before.
    fn share_done(&self, option: usize, runs: usize, time: f64) -> f64 {
        let firings = &self.case.shots[option].firings;
        let last = firings.last().map_or(0.0, |firing| firing.time);
        let end = self.case.plan.simulation.duration_s.unwrap_or(last + USUAL_FLIGHT);
        let cost = |runs: f64| step_error::RATIO.powf(runs) - 1.0;
        let whole = cost(1.0 + step_error::NEIGHBOURS as f64);
        let (before, after) = (cost(runs as f64), cost(runs as f64 + 1.0));
        ((before + (after - before) * (time / end).clamp(0.0, 1.0)) / whole).min(0.99)
    }

    /// Moves what tells that something computes. Returns whether anything moves.
    pub fn count_on(&mut self) -> bool {
        let moves = self.busy();
        self.beat += usize::from(moves);
        self.share_screen();
        moves
    }

    /// Shots tried so far of all options.
    pub fn shots_tried(&self) -> usize {
        let judged = self.options.iter().filter_map(OptionState::judgement);
        judged.filter_map(|judged| judged.sampled.known()).map(|sampled| sampled.samples.len()).sum()
    }

    /// Whether anything computes.
    pub fn busy(&self) -> bool {
        self.checking()
            || self.sampling()
            || self.studies.busy()
            || self.beside.as_ref().is_some_and(|app| app.busy())
    }

    /// Whether an option is not yet checked as planned.
    pub fn checking(&self) -> bool {
        self.options.iter().any(OptionState::is_computing)
    }

    /// Whether more samples of an option come.
    pub fn sampling(&self) -> bool {
        self.options.iter().any(OptionState::is_sampling)
    }
}
