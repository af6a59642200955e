//! Verdicts in the background: what becomes known of each option, as news.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use super::{Job, News};
use crate::study::judge_options::{CaseOption, JudgeEvent, judge_all_with_margins};
use crate::study::samples::sample_count::Sampling;
use crate::study::{NoResult, catch_panic};

/// Least time between two pieces of news about an option that computes.
const CHECKING_EVERY: Duration = Duration::from_millis(50);
/// Least time between two pieces of news about the samples of an option.
const SAMPLED_EVERY: Duration = Duration::from_millis(100);

/// When an option was last told to compute, and to have samples.
#[derive(Clone, Copy)]
struct LastSent {
    checking: Instant,
    sampled: Option<Instant>,
}

impl Job {
    /// Judges all options: as planned, then by samples, then for their launch margins.
    pub(super) fn judge_with_margins(&self) {
        let cases = [(&*self.case, self.compute)];
        let new = LastSent { checking: Instant::now(), sampled: None };
        let last_sent: Vec<Mutex<LastSent>> = self.case.shots.iter().map(|_| Mutex::new(new)).collect();
        let watch = |at: CaseOption, event: JudgeEvent<'_>| {
            let option = at.option;
            let Ok(mut last) = last_sent[option].lock() else { return };
            match event {
                JudgeEvent::Checking(progress) => {
                    if last.checking.elapsed() > CHECKING_EVERY {
                        last.checking = Instant::now();
                        self.send(News::Checking { option, runs: progress.runs, time: progress.time });
                    }
                }
                JudgeEvent::Checked(result) => {
                    self.send(News::Checked { option, result: result.clone().map(Box::new) });
                }
                JudgeEvent::Sampled { sampled, more } => {
                    if !more || last.sampled.is_none_or(|told| told.elapsed() >= SAMPLED_EVERY) {
                        last.sampled = Some(Instant::now());
                        self.send(News::Sampled { option, sampled: Box::new(sampled.clone()), more });
                    }
                }
                JudgeEvent::Margin(margin) => self.send(News::Margin { option, margin }),
            }
        };
        let judged = catch_panic(|| {
            judge_all_with_margins(&cases, Some(&Sampling::OF_VERDICT), &self.control, &watch)
        });
        if let Err(none) = judged {
            self.tell_no_result(&none);
        }
    }

    /// Tells that no option has a result. The news of a job that was stopped has no reader.
    pub(super) fn tell_no_result(&self, none: &NoResult) {
        for option in 0..self.case.shots.len() {
            self.send(News::Checked { option, result: Err(none.clone()) });
        }
    }
}
