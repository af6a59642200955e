//! Verdicts in the background: every option as planned, then samples of every option, then launch margins.

use std::ops::Range;
use std::time::{Duration, Instant};

use rayon::iter::{ParallelBridge, ParallelIterator};

use super::{Job, News};
use crate::study::batch::run_jobs;
use crate::study::check::check;
use crate::study::check_all::target;
use crate::study::margin::launch_margin;
use crate::study::risk::Risk;
use crate::study::sampling::{Sampling, ShotToSample, find_risks};
use crate::study::{Envelope, NoResult, guarded};

/// Least time between two pieces of news about an option that computes.
const CHECKING_EVERY: Duration = Duration::from_millis(50);
/// Least time between two pieces of news about the samples of an option.
const SAMPLED_EVERY: Duration = Duration::from_millis(100);
/// Steps between two looks at the clock.
const STEPS_PER_LOOK: usize = 64;

impl Job {
    /// Judges options: all as planned, then all by samples, then their launch margins.
    pub(super) fn check_all(&self, options: Range<usize>) {
        let checked = options.par_bridge().filter_map(|option| Some((option, self.check(option)?)));
        let mut checked: Vec<(usize, Envelope)> = checked.collect();
        checked.sort_by_key(|(option, _)| *option);
        // A job that was stopped has no result, and its news has no reader.
        if self.sample(&checked).is_ok() {
            let _ = self.find_margins(&checked);
        }
    }

    /// Checks an option as planned; returns what was judged.
    fn check(&self, option: usize) -> Option<Envelope> {
        if self.progress.stopped() {
            return None;
        }
        let (mut steps, mut told) = (0_usize, Instant::now());
        let result = guarded(|| {
            let checked = check(&self.case, option, &self.compute, &mut |run| {
                steps += 1;
                if steps.is_multiple_of(STEPS_PER_LOOK) && told.elapsed() > CHECKING_EVERY {
                    told = Instant::now();
                    self.tell(News::Checking { option, runs: run.runs, time: run.time });
                }
                self.progress.flow()
            });
            checked.map(Box::new).map_err(|failure| self.progress.no_result(failure))
        });
        let judged = result.as_ref().ok().map(|checked| Envelope::of(checked));
        self.tell(News::Checked { option, result });
        judged
    }

    /// Samples options, each with what it is as planned.
    fn sample(&self, options: &[(usize, Envelope)]) -> Result<(), NoResult> {
        let target = |(option, planned): &(usize, Envelope)| {
            target(&self.case, *option, planned, &Sampling::OF_VERDICT, self.compute)
        };
        let targets: Vec<ShotToSample<'_>> = options.iter().map(target).collect();
        let mut told: Vec<Option<Instant>> = vec![None; options.len()];
        let mut watch = |n: usize, risk: &Risk| {
            if told[n].is_none_or(|told| told.elapsed() >= SAMPLED_EVERY) {
                told[n] = Some(Instant::now());
                let result = Ok(Box::new(risk.clone()));
                self.tell(News::Sampled { option: options[n].0, result, more: true });
            }
        };
        let sampled = find_risks(&targets, &self.progress, &mut watch);
        let risks = sampled.map(|found| found.value).inspect_err(|none| {
            for &(option, _) in options {
                self.tell(News::Sampled { option, result: Err(none.clone()), more: false });
            }
        })?;
        for (&(option, _), risk) in options.iter().zip(risks) {
            self.tell(News::Sampled { option, result: Ok(Box::new(risk)), more: false });
        }
        Ok(())
    }

    /// Finds the launch margins of options, each with what it is as planned.
    fn find_margins(&self, options: &[(usize, Envelope)]) -> Result<(), NoResult> {
        let Self { case, compute, progress, .. } = self;
        let find = |&(option, planned): &(usize, Envelope)| {
            let shot = &case.shots[option];
            let margin = guarded(|| launch_margin(case, shot, planned.verdict, compute, progress))?;
            self.tell(News::Margin { option, margin });
            Ok(())
        };
        run_jobs(options, progress, find).map(drop)
    }
}
