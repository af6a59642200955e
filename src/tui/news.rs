//! News of the jobs and how they change the app: options are judged, studies end, the answer is found. Also the work that remains.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::app::{ASSUMPTIONS_STILL_SOUGHT, App, NOT_JUDGED_YET, STILL_LOOKED_FOR};
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

/// Usual time of a run from the last firing to rest [s].
const USUAL_FLIGHT: f64 = 1.6;

impl App {
    /// Expected time of a study at the rate of runs of the judging job. This rate includes other load on the machine. If too few runs are
    /// done for a rate, the time follows from the first judged option. `None` if no option is judged, or a fit has no observations.
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

    /// Number of runs that all options still need, as expected.
    fn runs_to_come(&self) -> usize {
        let shots = self.case.shots.iter().zip(&self.options);
        let of_option = |(shot, state): (&Shot, &OptionState)| match state {
            OptionState::Failed(_) | OptionState::Judged { more_samples: false, .. } => 0,
            state => runs_to_come(&self.case, shot, state.judgement()),
        };
        shots.map(of_option).sum()
    }

    /// Finds the answer once all options are judged. If this is the first answer, selects the recommended option.
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

    /// Selects the recommended option, unless the user has selected an option or the screen shows results of another option.
    pub(super) fn select_recommended(&mut self) {
        let best = self.recommended();
        if let Some(best) = best.filter(|_| !self.has_selected && !self.shows_result_of_selected()) {
            self.selected = best;
        }
    }

    /// Index of the option that leads so far: its upper bound of the share of failing shots is the lowest, and below the accepted risk.
    /// Among equals, the lowest utilization wins. `None` until all options have samples: users take the option named here for the answer.
    pub fn ahead(&self) -> Option<usize> {
        if self.standing().against_passes().is_some() {
            return None;
        }
        // As long as some options have no samples, the first sampled option would lead against nothing.
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

    /// Whether the screen shows results of the selected option alone.
    fn shows_result_of_selected(&self) -> bool {
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

    /// Takes a piece of news from a job.
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
                || is_held_until && said.ends_with(ASSUMPTIONS_STILL_SOUGHT)
        });
        // A page was refused because this was not known yet.
        if is_judged && (is_held_until || self.verdict(self.selected) != Verdict::Pass) {
            let refused = self.page_refused.take();
            self.notice.take_if(|said| refused.as_ref() == Some(said));
        }
        if may_end && !self.checking() && !self.sampling() {
            self.find_answer();
        } else if tells_samples
            && self.answer.is_none()
            && !self.has_selected
            && !self.shows_result_of_selected()
        {
            // The cursor and the charts follow the option that the headline names.
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
                // Until samples arrive the option stays OPEN: a planned shot that passes shows no PASS.
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

    /// Done share of the least number of runs, 0 to 0.99. Each run costs [`step_error::RATIO`] times the run before.
    fn share_done(&self, option: usize, runs: usize, time: f64) -> f64 {
        let firings = &self.case.shots[option].firings;
        let last = firings.last().map_or(0.0, |firing| firing.time);
        let end = self.case.plan.simulation.duration_s.unwrap_or(last + USUAL_FLIGHT);
        let cost = |runs: f64| step_error::RATIO.powf(runs) - 1.0;
        let whole = cost(1.0 + step_error::NEIGHBOURS as f64);
        let (before, after) = (cost(runs as f64), cost(runs as f64 + 1.0));
        ((before + (after - before) * (time / end).clamp(0.0, 1.0)) / whole).min(0.99)
    }

    /// Advances the marks that show that something computes. Returns whether anything computes.
    pub fn count_on(&mut self) -> bool {
        let moves = self.busy();
        self.beat += usize::from(moves);
        self.share_screen();
        moves
    }

    /// Number of sampled shots so far, of all options.
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

    /// Whether the planned shot of any option is not judged yet.
    pub fn checking(&self) -> bool {
        self.options.iter().any(OptionState::is_computing)
    }

    /// Whether more samples of any option come.
    pub fn sampling(&self) -> bool {
        self.options.iter().any(OptionState::is_sampling)
    }
}
