//! The samples that other changes of an option failed: the next change is tried on them first.
//!
//! Sample n of one change has the same random numbers as sample n of another, so that both often fail. Where a change fails so many
//! of them that no PASS can come, whatever the other samples tell, it gets no other samples.

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

/// Most samples that a change is tried on first.
const MOST_HARD_SAMPLES: usize = 40;

/// Numbers of samples that failed, per option.
pub(super) struct HardSamples {
    /// Bounds of a change without a sample.
    bounds: FailureBounds,
    /// Most samples of a verdict.
    most: usize,
    /// How often each number failed.
    failed: BTreeMap<usize, BTreeMap<usize, usize>>,
}

/// The hard samples of one change.
pub(super) struct HardDrawn {
    /// In order of their numbers.
    pub samples: Vec<Sample>,
    /// Whether a pass can come in spite of them.
    pub can_pass: bool,
}

impl HardSamples {
    pub(super) fn new(accepted: f64, most: usize) -> Self {
        Self { bounds: FailureBounds::new(accepted, ErrorShare::Whole), most, failed: BTreeMap::new() }
    }

    /// Whether so many samples are allowed that a pass can come at all, where none of them fails.
    pub(super) fn enough_samples(&self) -> bool {
        self.can_pass(&[])
    }

    /// Whether a pass can still come where the samples with the numbers `failing`, in order, fail and no other does. A pass comes
    /// at any number of samples; just before the next failing sample, or at the end, the chance is best.
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

    /// Numbers of the samples that failed most often, in order.
    fn numbers(&self, option: usize) -> Vec<usize> {
        let mut failures: Vec<(usize, usize)> =
            self.failed.get(&option).into_iter().flatten().map(|(&number, &times)| (number, times)).collect();
        sort_by_key(&mut failures, |&(_, times)| Reverse(times));
        let mut numbers: Vec<usize> =
            failures.into_iter().take(MOST_HARD_SAMPLES).map(|(number, _)| number).collect();
        sort(&mut numbers);
        numbers
    }

    /// Draws the hard samples of changes, each for an option; `None` for changes that the time did not suffice for.
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
