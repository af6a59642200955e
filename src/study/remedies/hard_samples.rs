//! Samples that failed with other changes of an option. The next change is tried on these first.
//!
//! Sample n has the same random numbers for every change, so it often fails with several changes. If a change fails too many hard samples
//! for a PASS, whatever the other samples say, it gets no other samples.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use crate::sorting::{sort, sort_by_key};
use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
use crate::study::samples::run_sample::{ShotToSample, run_sample};
use crate::study::samples::sample::Sample;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::work::batch::run_batch;
use crate::study::{NoResult, StudyControl};
use crate::verdict::Verdict;

/// Most hard samples that a change is tried on first.
const MOST_HARD_SAMPLES: usize = 40;

/// Numbers of the samples that failed, for each option.
pub(super) struct HardSamples {
    /// Failure bounds before the first sample.
    bounds: FailureBounds,
    /// Most samples of a verdict.
    most: usize,
    /// How often each sample failed: option, then sample number, then count.
    failed: BTreeMap<usize, BTreeMap<usize, usize>>,
}

/// The hard samples of one change.
pub(super) struct HardDrawn {
    /// The samples, in order of their numbers.
    pub samples: Vec<Sample>,
    /// Whether a pass is still possible.
    pub can_pass: bool,
}

impl HardSamples {
    pub(super) fn new(accepted: f64, most: usize) -> Self {
        Self { bounds: FailureBounds::new(accepted, ErrorShare::Whole), most, failed: BTreeMap::new() }
    }

    /// Whether enough samples are allowed for a pass if none fails.
    pub(super) fn enough_samples(&self) -> bool {
        self.can_pass(&[])
    }

    /// Whether a pass is still possible if exactly the samples with the numbers `failing`, in order, fail. A pass may come at any number of
    /// samples. The chance is best just before the next failing sample, or at the end.
    fn can_pass(&self, failing: &[usize]) -> bool {
        let ends = failing.iter().copied().chain([self.most]);
        ends.enumerate().any(|(failures, end)| {
            let mut bounds = self.bounds;
            bounds.failures = failures;
            bounds.can_pass(end)
        })
    }

    /// Notes the samples of an option that failed.
    pub(super) fn note(&mut self, option: usize, sampled: &SampledShot) {
        let of_option = self.failed.entry(option).or_default();
        for sample in sampled.samples.iter().filter(|sample| sample.finest().verdict == Verdict::Fail) {
            *of_option.entry(sample.number).or_default() += 1;
        }
    }

    /// Numbers of the samples that failed most often, in ascending order.
    fn numbers(&self, option: usize) -> Vec<usize> {
        let mut failures: Vec<(usize, usize)> =
            self.failed.get(&option).into_iter().flatten().map(|(&number, &times)| (number, times)).collect();
        sort_by_key(&mut failures, |&(_, times)| Reverse(times));
        let mut numbers: Vec<usize> =
            failures.into_iter().take(MOST_HARD_SAMPLES).map(|(number, _)| number).collect();
        sort(&mut numbers);
        numbers
    }

    /// Draws the hard samples of changes, each for an option; `None` for a change without enough time.
    pub(super) fn run(
        &self,
        targets: &[(usize, ShotToSample<'_>)],
        control: &StudyControl,
    ) -> Result<Vec<Option<HardDrawn>>, NoResult> {
        let of_target = |(n, (option, _)): (usize, &(usize, _))| {
            self.numbers(*option).into_iter().map(move |number| (n, number))
        };
        let jobs: Vec<(usize, usize)> = targets.iter().enumerate().flat_map(of_target).collect();
        let drawn = run_batch(&jobs, control, |&(n, number)| run_sample(&targets[n].1, number, 0, control))?;
        let mut drawn_of_each = vec![Some(Vec::new()); targets.len()];
        for ((n, _), sample) in jobs.into_iter().zip(drawn) {
            drawn_of_each[n] = drawn_of_each[n].take().zip(sample).map(|(mut samples, sample)| {
                samples.push(sample);
                samples
            });
        }
        let in_reach = |samples: Vec<Sample>| {
            let failing = samples.iter().filter(|sample| sample.finest().verdict != Verdict::Pass);
            let failing: Vec<usize> = failing.map(|sample| sample.number).collect();
            HardDrawn { samples, can_pass: self.can_pass(&failing) }
        };
        Ok(drawn_of_each.into_iter().map(|drawn| drawn.map(in_reach)).collect())
    }
}
